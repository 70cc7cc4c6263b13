#include "sim/body/answer.h"

#include <cmath>

namespace rend {

double Answer::error() const {
  const double difference = measured.value_or(std::numeric_limits<double>::quiet_NaN()) - value;
  return value == 0 ? difference : difference / std::abs(value);
}

bool Answer::holds() const {
  return std::abs(error()) <= tolerance;
}

} // namespace rend
