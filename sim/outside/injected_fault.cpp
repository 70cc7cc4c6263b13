#include "sim/outside/injected_fault.h"

#include "sim/base/enum_words.h"

#include <limits>

namespace rend {

const char* name_of(StepStage stage) {
  static constexpr EnumWords<StepStage::Contact> words{"forces", "loads", "integration", "contact"};
  return words[stage];
}

void FaultInjector::inject(const double* inverse_mass, std::size_t count, Record* values) {
  std::size_t first = 0;
  while (first < count && inverse_mass[first] == 0) ++first;
  if (first == count) return;
  values[first].x = std::numeric_limits<double>::quiet_NaN();
  if (!armed_->lasting) disarm();
}

const Record* FaultInjector::inject_copy(const double* inverse_mass, std::size_t count, const Record* values) {
  copy_.assign(values, values + count);
  inject(inverse_mass, count, copy_.data());
  return copy_.data();
}

} // namespace rend
