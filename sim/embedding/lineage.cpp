#include "sim/embedding/lineage.h"

namespace rend {

std::uint32_t Lineage::add_family(std::span<const Parent> parents) {
  parents_.resize(first_.back()); // left by an exception
  parents_.insert(parents_.end(), parents.begin(), parents.end());
  first_.push_back(parents_.size());
  return static_cast<std::uint32_t>(first_.size() - 2);
}

void Lineage::assign(Dart child, Orbit orbit, std::uint32_t family) {
  IndexMap& last = last_[orbit.mask];
  const std::uint32_t before = last.find(child.value), now = static_cast<std::uint32_t>(family_of_.size());
  family_of_.push_back({child, orbit.mask, family, before});
  try {
    last.assign(child.value, now);
  } catch (...) {
    family_of_.pop_back();
    throw;
  }
}

std::optional<std::span<const Parent>> Lineage::parents(Dart child, Orbit orbit) const {
  const std::uint32_t at = last_[orbit.mask].find(child.value);
  if (at == IndexMap::none) return {};
  const std::size_t family = family_of_[at].family;
  return std::span(parents_).subspan(first_[family], first_[family + 1] - first_[family]);
}

void Lineage::rollback(const Savepoint& to) noexcept {
  for (; family_of_.size() > to.assigned; family_of_.pop_back()) {
    const Assigned& last = family_of_.back();
    last_[last.orbit].replace(last.child.value, last.before);
  }
  first_.resize(to.families + 1);
  parents_.resize(first_.back());
}

} // namespace rend
