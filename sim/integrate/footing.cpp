#include "sim/integrate/footing.h"

#include "sim/base/wording.h"

#include <fmt/format.h>

#include <Eigen/Dense>

namespace rend {
namespace {

using Piece = std::vector<std::uint32_t>; // its vertex slots, as they are reached

// Calls f(piece) for every piece, in the order of their smallest slots, until f returns true.
template <class F> bool any_piece(const BlockPattern& pattern, const double* inverse_mass, F&& f) {
  std::vector<bool> seen(pattern.rows(), false);
  Piece piece;
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

} // namespace

std::optional<std::string> drift_of(const BlockPattern& pattern, const double* inverse_mass,
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

bool can_turn(const BlockPattern& pattern, const double* inverse_mass, const std::vector<std::uint8_t>& held,
              const Record* position) {
  return any_piece(pattern, inverse_mass, [&](const Piece& piece) {
    Vec3 centre = Vec3::Zero();
    for (std::uint32_t v : piece) centre += position[v].vec() / static_cast<double>(piece.size());
    double size = 0;
    for (std::uint32_t v : piece) size = std::max(size, (position[v].vec() - centre).norm());
    if (size == 0) return false;
    Eigen::Matrix<double, 6, 6> held_motions = Eigen::Matrix<double, 6, 6>::Zero();
    for (std::uint32_t v : piece) {
      const Vec3 arm = (position[v].vec() - centre) / size;
      for (int axis = 0; axis < 3; ++axis) {
        if (!(held[v] >> axis & 1)) continue;
        Eigen::Matrix<double, 6, 1> row; // this coordinate's part in the six motions
        row << Vec3::Unit(axis), arm.cross(Vec3::Unit(axis));
        held_motions += row * row.transpose();
      }
    }
    return Eigen::FullPivLU<Eigen::Matrix<double, 6, 6>>(held_motions).setThreshold(1e-9).rank() < 6;
  });
}

} // namespace rend
