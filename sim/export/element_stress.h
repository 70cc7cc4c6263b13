// The stress of elements for export.
#pragma once

#include "sim/body/body.h"

#include <span>

namespace rend {

// σ [Pa] of the elements with these smallest darts: the mean over the continua of an element (usually one); 0
// if it has none, or if the element is so flat that its stress is undefined.
std::vector<Eigen::Matrix3d> stress_of_elements(const Body& body, std::span<const Dart> elements);

// √(3/2 s:s), s the deviator of σ (von Mises 1913).
double von_mises(const Eigen::Matrix3d& stress);

} // namespace rend
