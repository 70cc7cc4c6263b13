// The stress of elements as it is exported.
#pragma once

#include "sim/body/body.h"

#include <span>

namespace rend {

// σ [Pa] of the elements whose smallest darts these are, one each: the mean over the continua that an element
// belongs to (usually one); 0 where there is none, and where an element is so flat that it has no stress.
std::vector<Eigen::Matrix3d> stress_of_elements(const Body& body, std::span<const Dart> elements);

// √(3/2 s:s), s the deviator of σ (von Mises 1913).
double von_mises(const Eigen::Matrix3d& stress);

} // namespace rend
