#include "sim/rows/continuum.h"

#include "sim/mechanics/elasticity.h"
#include "sim/mechanics/mass_tensor.h"
#include "sim/topology/walk.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace rend {

Continuum::Continuum(const EmbeddedMap& map, const std::vector<std::unique_ptr<Interaction>>& interactions)
    : map_(&map) {
  for (std::size_t n = 0; n < interactions.size(); ++n) {
    const ForceLaw* law = interactions[n]->law.get();
    if (const auto* element = dynamic_cast<const ElementLaw*>(law))
      parts_.push_back({interactions[n].get(), element, n});
    const auto* tensors = dynamic_cast<const MassTensorLaw*>(law);
    if (!tensors || tensors->particles() != 1) continue; // the tensors of pairs belong to the same elements
    for (auto& made : linear_elements(map, tensors->request())) {
      parts_.push_back({made.get(), static_cast<const ElementLaw*>(made->law.get()), recreated});
      recreated_.push_back(std::move(made));
    }
  }
}

const VertexStress::Sum& VertexStress::of_element(Slot element, const Record* x) {
  const auto next = static_cast<std::uint32_t>(sums_.size());
  const std::uint32_t place = place_.insert(element, next);
  if (place != next) return sums_[place];
  Sum sum{Eigen::Matrix3d::Zero(), 0, 0};
  const Dart d = map_->cells(element_orbit(map_->dimension())).first_dart(element);
  continuum_->each_of(d, x, nullptr, [&](const Continuum::Part& part, const CurrentUnit& now) {
    sum.stress += stress_of(part, now);
    ++sum.count;
    sum.corners = now.particles;
  });
  sums_.push_back(sum);
  return sums_.back();
}

Eigen::Matrix3d VertexStress::at(Slot vertex, const Record* x) {
  const CellIndex &corners = map_->cells(mass_->orbit()),
                  &elements = map_->cells(element_orbit(map_->dimension()));
  corners_.clear();
  collect(map_->map(), Vertex, map_->cells(Vertex).first_dart(vertex), corners_);
  std::erase_if(corners_, [&](Dart d) { return corners.first_dart(corners.slot(d)) != d; });
  std::sort(corners_.begin(), corners_.end());
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double whole = 0;
  // number of corners of the first element. Weights relative to it are exactly 1 if all elements are of one
  // kind
  int first = 0;
  for (Dart d : corners_) {
    const Sum& element = of_element(elements.slot(d), x);
    if (element.count == 0) continue;
    if (first == 0) first = element.corners;
    const double m = (*mass_)[corners.slot(d)] * (static_cast<double>(element.corners) / first);
    sum += m * element.stress;
    whole += m * element.count;
  }
  if (whole > 0) sum /= whole;
  return sum;
}

Principal largest_principal(const Eigen::Matrix3d& tensor, Compression compression) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      tensor); // the iterative solver; the direct one needs cos and atan2
  const Vec3 values = solver.eigenvalues();
  const int which = compression == Compression::Counts && -values[0] > values[2] ? 0 : 2;
  Vec3 direction = solver.eigenvectors().col(which);
  int most = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(direction[axis]) > std::abs(direction[most])) most = axis;
  if (direction[most] < 0) direction = -direction;
  return {which == 0 ? -values[0] : values[2], direction};
}

} // namespace rend
