#include "sim/integrate/rigid_motions.h"

#include "sim/base/wording.h"

#include <fmt/format.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rend {
namespace {

using Piece = std::vector<std::uint32_t>; // its vertex slots, in the order in which they are reached

constexpr double least_anchor = 1e-9; // relative to the largest stiffness at a vertex: beyond round-off

unsigned mask_of(const AxisMasks& masks, std::uint32_t v) {
  return masks.empty() ? 0U : masks[v];
}

// Calls f(piece) for every component, in the order of their smallest slots, until f returns true.
template <class F> bool any_piece(const BlockPattern& pattern, const double* inverse_mass, F&& f) {
  thread_local std::vector<bool> seen; // kept to avoid allocation in each step
  thread_local Piece piece;
  seen.assign(pattern.rows(), false);
  for (std::uint32_t first = 0; first < pattern.rows(); ++first) {
    if (seen[first] || inverse_mass[first] == 0) continue;
    piece.assign(1, first);
    seen[first] = true;
    for (std::size_t n = 0; n < piece.size(); ++n)
      for (std::size_t at = pattern.start[piece[n]]; at < pattern.start[piece[n] + std::size_t{1}]; ++at) {
        const std::uint32_t j = pattern.column[at];
        if (seen[j]) continue;
        seen[j] = true;
        piece.push_back(j);
      }
    if (f(piece)) return true;
  }
  return false;
}

// Of one component, about its centre and scaled by its size: which of the six rigid motions are constrained,
// and how well.
struct RigidMotions {
  const Record* position;
  Vec3 centre = Vec3::Zero();
  double size = 0; // [m]; 0: a point
  // Σ of outer products of the rows of constrained coordinates
  Eigen::Matrix<double, 6, 6> held = Eigen::Matrix<double, 6, 6>::Zero();

  RigidMotions(const Piece& piece, const std::vector<std::uint8_t>& axes, const Record* position_)
      : position(position_) {
    for (std::uint32_t v : piece) centre += position[v].vec() / static_cast<double>(piece.size());
    for (std::uint32_t v : piece) size = std::max(size, (position[v].vec() - centre).norm());
    for (std::uint32_t v : piece)
      for (unsigned axis = 0; axis < 3; ++axis)
        if (axes[v] >> axis & 1) hold(v, axis);
  }
  Vec3 arm(std::uint32_t v) const {
    return size > 0 ? Vec3((position[v].vec() - centre) / size) : Vec3(Vec3::Zero());
  }
  void hold(std::uint32_t v, unsigned axis) {
    Eigen::Matrix<double, 6, 1> row; // this coordinate's displacement in the six motions
    row << Vec3::Unit(axis), arm(v).cross(Vec3::Unit(axis));
    held += row * row.transpose();
  }
  Eigen::Index rank(double threshold) const {
    return Eigen::FullPivLU<Eigen::Matrix<double, 6, 6>>(held).setThreshold(threshold).rank();
  }
};

} // namespace

AxisMasks anchored_axes(const double* inverse_mass, const BlockMatrix& tangent) {
  const BlockPattern& pattern = *tangent.pattern();
  AxisMasks masks;
  any_piece(pattern, inverse_mass, [&](const Piece& piece) {
    Vec3 sum = Vec3::Zero(); // [N/m]: against a translation of the whole along each axis
    double largest = 0;      // [N/m]
    for (const std::uint32_t v : piece) {
      for (const Block3& block : tangent.row(v))
        for (int axis = 0; axis < 3; ++axis) sum[axis] += block(axis, axis);
      largest = std::max(largest, stiffness_of(tangent.diagonal(v)));
    }
    unsigned axes = 0;
    for (unsigned axis = 0; axis < 3; ++axis)
      if (std::abs(sum[axis]) > least_anchor * largest) axes |= 1U << axis;
    if (axes == 0) return false;
    if (masks.empty()) masks.assign(pattern.rows(), 0);
    for (const std::uint32_t v : piece) masks[v] = static_cast<std::uint8_t>(axes);
    return false;
  });
  return masks;
}

std::optional<std::string> free_translation_of(const BlockPattern& pattern, const double* inverse_mass,
                                               const AxisMasks& held, const AxisMasks& anchored) {
  std::optional<std::string> drift;
  any_piece(pattern, inverse_mass, [&](const Piece& piece) {
    unsigned axes = mask_of(anchored, piece.front());
    for (std::uint32_t v : piece) axes |= held[v];
    if (axes == 7) return false;
    std::string names;
    for (unsigned axis = 0; axis < 3; ++axis)
      if (!(axes >> axis & 1)) names += (names.empty() ? "" : ", ") + std::string(1, "xyz"[axis]);
    drift = fmt::format("a piece of {} {} is free to move along {}", piece.size(),
                        piece.size() == 1 ? "vertex" : "vertices", names);
    return true;
  });
  return drift;
}

bool can_rotate(const BlockPattern& pattern, const double* inverse_mass, const AxisMasks& held,
                const AxisMasks& anchored, const Record* position) {
  return any_piece(pattern, inverse_mass, [&](const Piece& piece) {
    if (mask_of(anchored, piece.front()) != 0) return false;
    const RigidMotions motions(piece, held, position);
    return motions.size > 0 && motions.rank(1e-9) < 6;
  });
}

void constrain_detached(const BlockPattern& pattern, const double* inverse_mass, const Record* position,
                        bool turns, const AxisMasks& anchored, AxisMasks& held,
                        std::vector<std::uint8_t>& detached) {
  any_piece(pattern, inverse_mass, [&](Piece& piece) {
    RigidMotions motions(piece, held, position);
    const unsigned anchors = mask_of(anchored, piece.front());
    unsigned axes = anchors;
    for (std::uint32_t v : piece) axes |= held[v];
    if (axes == 7 && (turns || anchors != 0 || motions.size == 0 || motions.rank(1e-9) == 6)) return false;
    for (std::uint32_t v : piece) detached[v] = 1;
    std::stable_sort(piece.begin(), piece.end(), [&](std::uint32_t a, std::uint32_t b) {
      return motions.arm(a).squaredNorm() > motions.arm(b).squaredNorm();
    });
    for (const double clearly : {0.05, 1e-9})
      for (std::uint32_t v : piece)
        for (unsigned axis = 0; axis < 3 && motions.rank(clearly) < 6; ++axis) {
          if (held[v] >> axis & 1) continue;
          RigidMotions more = motions;
          more.hold(v, axis);
          if (more.rank(clearly) == motions.rank(clearly)) continue;
          motions = more;
          held[v] = static_cast<std::uint8_t>(held[v] | 1U << axis);
        }
    return false;
  });
}

double stiffness_of(const Block3& d) {
  return std::max({std::abs(d(0, 0)), std::abs(d(1, 1)), std::abs(d(2, 2))});
}

double extent(const Records& x, const double* inverse_mass) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (inverse_mass[i] == 0) continue;
    low = low.cwiseMin(x[i].vec());
    high = high.cwiseMax(x[i].vec());
  }
  return (high - low).maxCoeff();
}

bool is_rotation_invariant(System& system, double time, const Records& position, double size,
                           const BlockMatrix& tangent, const AxisMasks& anchored, RotationScratch& room) {
  auto& [still, turned_position, force, after] = room;
  for (Records* each : {&turned_position, &force, &after}) each->resize(position.size());
  still.assign(position.size(), Record{});
  system.forces(time, position.data(), still.data(), force.data());
  for (const bool about_z : {true, false}) {
    const auto turned = [about_z](Double4 v) {
      return about_z ? Double4{-v[1], v[0], v[2], 0} : Double4{v[0], -v[2], v[1], 0};
    };
    for (std::size_t i = 0; i < position.size(); ++i) store(turned_position[i], turned(load(position[i])));
    system.forces(time, turned_position.data(), still.data(), after.data());
    Double4 change{}, scale{};
    for (std::size_t i = 0; i < position.size(); ++i) {
      if (system.inverse_mass[i] == 0 || mask_of(anchored, static_cast<std::uint32_t>(i)) != 0) continue;
      const Double4 f = turned(load(force[i])), d = load(after[i]) - f;
      const double stretch = stiffness_of(tangent.diagonal(i)) * size;
      change += d * d;
      scale += f * f + splat(stretch * stretch);
    }
    if (std::sqrt(sum3(change)) > 1e-6 * std::sqrt(sum3(scale))) return false;
  }
  return true;
}

double mean_stiffness(const BlockMatrix& matrix, const double* inverse_mass, std::size_t count) {
  double mass = 0, stiff = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (inverse_mass[i] == 0) continue;
    const Block3& d = matrix.diagonal(i);
    mass += 1 / inverse_mass[i];
    stiff += (d(0, 0) + d(1, 1) + d(2, 2)) / 3;
  }
  return stiff / mass;
}

// A component that was supported in the first equilibrium and is no longer was torn off or released.
void SupportState::check(System& system, double time, const Records& position, const Records& still,
                         double size, BlockMatrix& matrix) {
  const BlockPattern& pattern = *system.pattern();
  const double* inverse_mass = system.inverse_mass;
  detached.assign(position.size(), 0);
  anchored.clear();
  if (!free_translation_of(pattern, inverse_mass, held, {}) &&
      !can_rotate(pattern, inverse_mass, held, {}, position.data()))
    return;
  matrix.reset(system.pattern());
  system.add_stiffness(position.data(), still.data(), Tangent::SemiDefinite, 1, 0, matrix);
  anchored = anchored_axes(inverse_mass, matrix);
  const auto drift = free_translation_of(pattern, inverse_mass, held, anchored);
  const bool stiff_to_turns =
      can_rotate(pattern, inverse_mass, held, anchored, position.data()) &&
      (constrains_rotations || !is_rotation_invariant(system, time, position, size, matrix, anchored, room));
  if (found_equilibrium && (drift || stiff_to_turns)) {
    constrain_detached(pattern, inverse_mass, position.data(), !stiff_to_turns, anchored, held, detached);
    return;
  }
  if (drift)
    throw NotConverged(*drift + ", so it has no equilibrium", "add <fix>, or use integrator=\"implicit\"");
  if (stiff_to_turns)
    throw NotConverged("the body can turn as a whole, which a model for small displacements does not resist",
                       "fix more than a point or a line, or use model=\"corotational\"");
}

} // namespace rend
