#include "sim/export/element_stress.h"

#include "sim/rows/continuum.h"

#include <cmath>

namespace rend {

std::vector<Eigen::Matrix3d> stress_of_elements(const Body& body, std::span<const Dart> elements) {
  const Continuum continuum(*body.map, body.interactions);
  std::vector<Eigen::Matrix3d> all(elements.size(), Eigen::Matrix3d::Zero());
  if (continuum.empty()) return all;
  const Record* position = body.map->position().values().data();
  for (std::size_t n = 0; n < elements.size(); ++n) {
    int count = 0;
    continuum.each_of(elements[n], position, nullptr,
                      [&](const Continuum::Part& part, const CurrentUnit& element) {
                        all[n] += stress_of(part, element);
                        ++count;
                      });
    if (count > 0) all[n] /= count;
    if (!all[n].allFinite()) all[n].setZero();
  }
  return all;
}

double von_mises(const Eigen::Matrix3d& stress) {
  const Eigen::Matrix3d s = stress - stress.trace() / 3 * Eigen::Matrix3d::Identity();
  return std::sqrt(1.5 * s.cwiseProduct(s).sum());
}

} // namespace rend
