// Where the tip v of a crack goes on through a sheet that is torn out of its plane (mode III), as paper is: one
// flank is pulled up, the other one down. There tension runs along the flanks, and the plane across it
// (crack_plane.h) would turn the crack sideways.
//
//   D = Σ_e (f_e·N) m_e
//
// over the elements e at v: f_e the force of e on v, N the mean normal of these elements, m_e the unit vector
// from v towards the middle of e at rest. D leads from those that pull down to those that pull up, and the
// crack runs across D at rest, away from its flanks; the plane is that across the element which it enters.
//
// With the elements at v in order from flank to flank, what one side of an edge a between them pulls more than
// the other is
//
//   P_a = Σ_(e before a) f_e − ½ Σ_e f_e
//
// The crack is torn in this way where the largest |P_a·N| exceeds half of the largest P_a·b, b across N and a,
// away from the other side: what pulls out of the plane, and what opens the crack in it. (Half: legs that are
// not quite upright pull along the flanks, too.)
#pragma once

#include "sim/fracture/criterion.h"
#include "sim/rows/continuum.h"

#include <optional>
#include <span>
#include <vector>

namespace rend {

struct TearingPlane {
  Vec3 normal, ahead; // unit; ahead: in which the crack goes on
};

class TearingMode {
public:
  explicit TearingMode(const CriterionRequest& request) : continuum_(request.map, request.interactions) {}

  // None: the crack is not torn in this way. `darts`: of a vertex of a sheet of triangles on its border, no
  // element at which has changed in this edit.
  std::optional<TearingPlane> at(const ForceView& view, std::span<const Dart> darts);

private:
  struct Edges { // of an element at the vertex, to its neighbours [m]
    Vec3 before, after;
  };
  struct Corner { // of one element
    Edges now, rest;
    Vec3 force; // on the vertex [N]
  };
  void note_corners(const ForceView& view, std::span<const Dart> darts);
  bool is_torn(const Vec3& normal) const;
  Vec3 ahead_at_rest(const Vec3& normal) const;
  std::optional<TearingPlane> plane_along(const Vec3& ahead) const;

  Continuum continuum_;
  std::vector<Corner> corners_; // scratch: from flank to flank
};

} // namespace rend
