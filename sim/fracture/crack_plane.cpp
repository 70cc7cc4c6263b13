#include "sim/fracture/crack_plane.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

// (σ⁺)² [Pa²]
Eigen::Matrix3d squared_tension(const Eigen::Matrix3d& stress) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(stress); // as in largest_principal()
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int n = 0; n < 3; ++n) {
    const double pull = std::max(solver.eigenvalues()[n], 0.0);
    const Vec3 axis = solver.eigenvectors().col(n);
    sum += pull * pull * axis * axis.transpose();
  }
  return sum;
}

// Its eigenvalues are 0 or more.
Eigen::Matrix3d square_root_of(const Eigen::Matrix3d& tensor) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int n = 0; n < 3; ++n) {
    const Vec3 axis = solver.eigenvectors().col(n);
    sum += std::sqrt(std::max(solver.eigenvalues()[n], 0.0)) * axis * axis.transpose();
  }
  return sum;
}

} // namespace

Vec3 CrackPlane::at(const ForceView& view, std::span<const Dart> darts) {
  const CellIndex& corners = view.map.cells(view.mass.orbit());
  corners_.assign(darts.begin(), darts.end());
  std::erase_if(corners_, [&](Dart d) { return corners.first_dart(corners.slot(d)) != d; });
  std::sort(corners_.begin(), corners_.end());
  const CellIndex& elements = view.map.cells(element_orbit(view.map.dimension()));
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (Dart d : corners_) {
    const double m = view.mass[corners.slot(d)]; // an equal share of each corner's element
    continuum_.each_of(elements.first_dart(elements.slot(d)), view.position, view.velocity,
                       [&](const Continuum::Part& part, const CurrentUnit& now) {
                         sum += m * now.particles * squared_tension(stress_of(part, now));
                       });
  }
  if (!(sum.trace() > 0)) return Vec3::Zero();
  sum /= sum.trace();
  if (grain_) return grain_->weakest(square_root_of(sum), view.map, view.position, darts).normal;
  return largest_principal(sum, Compression::Ignored).direction;
}

} // namespace rend
