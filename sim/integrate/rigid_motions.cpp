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

std::optional<std::string> free_translation_of(const BlockPattern& pattern, const double* inverse_mass,
                                               const std::vector<std::uint8_t>& held) {
  std::optional<std::string> drift;
  any_piece(pattern, inverse_mass, [&](const Piece& piece) {
    unsigned axes = 0;
    for (std::uint32_t v : piece) axes |= held[v];
    if (axes == 7) return false;
    std::string names;
    for (unsigned axis = 0; axis < 3; ++axis)
      if (!(axes >> axis & 1)) names += (names.empty() ? "" : ", ") + std::string(1, "xyz"[axis]);
    drift = fmt::format("nothing holds a piece of {} {} along {}", piece.size(),
                        piece.size() == 1 ? "vertex" : "vertices", names);
    return true;
  });
  return drift;
}

bool can_rotate(const BlockPattern& pattern, const double* inverse_mass, const std::vector<std::uint8_t>& held,
                const Record* position) {
  return any_piece(pattern, inverse_mass, [&](const Piece& piece) {
    const RigidMotions motions(piece, held, position);
    return motions.size > 0 && motions.rank(1e-9) < 6;
  });
}

void constrain_detached(const BlockPattern& pattern, const double* inverse_mass, const Record* position,
                        bool turns, std::vector<std::uint8_t>& held, std::vector<std::uint8_t>& detached) {
  any_piece(pattern, inverse_mass, [&](Piece& piece) {
    RigidMotions motions(piece, held, position);
    unsigned axes = 0;
    for (std::uint32_t v : piece) axes |= held[v];
    if (axes == 7 && (turns || motions.size == 0 || motions.rank(1e-9) == 6)) return false;
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
                           BlockMatrix& matrix, RotationScratch& room) {
  auto& [still, turned_position, force, after] = room;
  for (Records* each : {&turned_position, &force, &after}) each->resize(position.size());
  still.assign(position.size(), Record{});
  system.forces(time, position.data(), still.data(), force.data());
  matrix.reset(system.pattern());
  system.add_stiffness(position.data(), still.data(), Tangent::SemiDefinite, 1, 0, matrix);
  for (const bool about_z : {true, false}) {
    const auto turned = [about_z](Double4 v) {
      return about_z ? Double4{-v[1], v[0], v[2], 0} : Double4{v[0], -v[2], v[1], 0};
    };
    for (std::size_t i = 0; i < position.size(); ++i) store(turned_position[i], turned(load(position[i])));
    system.forces(time, turned_position.data(), still.data(), after.data());
    Double4 change{}, scale{};
    for (std::size_t i = 0; i < position.size(); ++i) {
      if (system.inverse_mass[i] == 0) continue;
      const Double4 f = turned(load(force[i])), d = load(after[i]) - f;
      const double stretch = stiffness_of(matrix.diagonal(i)) * size;
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
void SupportState::check(System& system, double time, const Records& position, double size,
                         BlockMatrix& matrix) {
  const BlockPattern& pattern = *system.pattern();
  detached.assign(position.size(), 0);
  const auto drift = free_translation_of(pattern, system.inverse_mass, held);
  const bool stiff_to_turns =
      can_rotate(pattern, system.inverse_mass, held, position.data()) &&
      (constrains_rotations || !is_rotation_invariant(system, time, position, size, matrix, room));
  if (found_equilibrium && (drift || stiff_to_turns)) {
    constrain_detached(pattern, system.inverse_mass, position.data(), !stiff_to_turns, held, detached);
    return;
  }
  if (drift)
    throw NotConverged(*drift + ", and a static solve needs that",
                       "add <fix>, or use implicit, which needs no hold");
  if (stiff_to_turns)
    throw NotConverged(
        "what is held lets the body turn as a whole, and a model of small displacements resists no turn",
        "fix more than a point or a line, or use a co-rotational model");
}

} // namespace rend
