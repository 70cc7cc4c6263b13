// Grain: a body splits along its fibres more easily than across them, as wood does; warp and weft of cloth.
//
//   s(n) = r + (1 − r) |n·f|       n: unit normal of a plane; f: unit vector along the fibres; r: ratio
//
// is 1 for the plane across the fibres and r for every plane along them; with two directions the lesser one
// counts. A vertex breaks where the largest value of
//
//   nᵀ σ n / s(n)
//
// over all planes exceeds the threshold, along that plane: the largest stress over strength. Fibres move with
// the body: f is F f₀, made a unit vector, F the least-squares deformation of the edges at the vertex
//
//   F = Σ dx dXᵀ (Σ dX dXᵀ)⁺       dX: an edge at rest, dx: now
//
// The maximum over the planes along the fibres, where s has its edge, is an eigenvector of P σ P, P = I − f fᵀ;
// elsewhere it is searched for from the best of the principal axes and of directions all around.
#pragma once

#include "sim/base/settings.h"
#include "sim/embedding/embedded_map.h"

#include <optional>
#include <span>
#include <vector>

namespace rend {

struct GrainSettings {
  std::optional<std::vector<double>> along = {}; // x y z of one direction or of two, at rest; none: no grain
  double ratio = 0.3;                            // r, above 0, at most 1
};
template <> const Fields<GrainSettings>& fields_of();

class Grain {
public:
  explicit Grain(const GrainSettings& settings); // CHECK: there are directions, and none of them is 0
  static std::optional<Grain> of(const GrainSettings& settings); // none: no grain
  // UserError: other numbers than these.
  static void check(const GrainSettings& settings, const SettingsSource& source);

  struct Plane {
    Vec3 normal;  // a unit vector, whose largest component is positive
    double value; // nᵀ σ n / s(n) [Pa]
  };
  // `directions`: of the fibres now, unit vectors. σ: symmetric [Pa].
  Plane weakest(const Eigen::Matrix3d& stress, std::span<const Vec3> directions) const;
  // The same at a vertex. `position`: one per vertex slot [m]; `vertex`: its darts.
  Plane weakest(const Eigen::Matrix3d& stress, const EmbeddedMap& map, const Record* position,
                std::span<const Dart> vertex) const;

  double ratio() const { return ratio_; } // the least strength of all planes
  double strength(const Vec3& normal, std::span<const Vec3> directions) const;

private:
  std::vector<Vec3> at_rest_; // f₀
  double ratio_;
};

} // namespace rend
