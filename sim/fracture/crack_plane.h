// The plane in which a crack goes on from a vertex: across the tension around it.
//
//   n = eigenvector of the largest eigenvalue of Σ_e m_e (σ_e⁺)²,   σ⁺ = Σ_i max(σ_i, 0) n_i n_iᵀ
//
// over the elements e at the vertex, m their masses, σ_i and n_i principal stresses and axes. Compression does
// not open a crack, and the square weighs what pulls most, as the singular field at a tip does. Integrated over
// a disc around the tip of a straight crack in plane stress, n turns the crack by these angles; the last row is
// what the largest hoop stress asks for (Erdogan & Sih 1963); a dot: not computed:
//
//   K_II / K_I        0.2    0.5    1      2      ∞
//   Σ m σ             .      .      38.0°  .      .       what vertex-stress measures
//   Σ m σ⁺            .      .      48.9°  .      .
//   Σ m (σ⁺)²         21.0°  39.9°  52.5°  60.6°  69.2°
//   hoop stress       21.1°  40.2°  53.1°  61.3°  70.5°
//
// With a grain (grain.h) n has the largest S over strength, S² = Σ m (σ⁺)².
#pragma once

#include "sim/fracture/criterion.h"
#include "sim/rows/continuum.h"

#include <optional>
#include <span>
#include <vector>

namespace rend {

class CrackPlane {
public:
  explicit CrackPlane(const CriterionRequest& request)
      : continuum_(request.map, request.interactions), grain_(Grain::of(request.grain)) {}

  // A unit normal; 0: nothing pulls there. `darts`: of a vertex, no element at which has changed in this edit.
  Vec3 at(const ForceView& view, std::span<const Dart> darts);

private:
  Continuum continuum_;
  std::optional<Grain> grain_;
  std::vector<Dart> corners_; // scratch: the smallest dart of each corner at the vertex
};

} // namespace rend
