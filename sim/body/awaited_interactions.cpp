#include "sim/body/awaited_interactions.h"

#include "sim/base/archive.h"
#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {
namespace {

// The elements of these darts, one after the other, and where each begins.
void collect_elements(const GMap& map, const std::vector<Dart>& touched, IndexSet& seen,
                      std::vector<Dart>& darts, std::vector<std::size_t>& begin) {
  for (Dart d : touched) {
    if (!map.alive(d) || seen.contains(d.value)) continue;
    begin.push_back(darts.size());
    collect(map, element_orbit(map.dimension()), d, darts);
    for (std::size_t n = begin.back(); n < darts.size(); ++n) seen.insert(darts[n].value);
  }
}

} // namespace

bool AwaitedInteractions::arrive(EmbeddedMap& map, const Changes& changes,
                                 std::vector<std::unique_ptr<Interaction>>& interactions) {
  if (arrived_.size() == all_.size()) return false;
  thread_local IndexSet seen;
  seen.clear();
  darts_.clear();
  begin_.clear();
  for (const std::vector<Dart>& touched : changes.touched)
    collect_elements(map.map(), touched, seen, darts_, begin_);
  const std::size_t before = arrived_.size();
  for (std::uint32_t n = 0; n < all_.size(); ++n)
    if (!has_arrived(n) && acts_in(all_[n], map.map())) add(n, map, interactions);
  return arrived_.size() > before;
}

// In one of the elements at hand. Where the owner is an element, all of its darts say the same.
bool AwaitedInteractions::acts_in(const AwaitedInteraction& awaited, const GMap& map) const {
  const Pattern& pattern = awaited.pattern;
  const auto present = [&](Dart d) {
    for (std::size_t unit = 0; unit < pattern.units.size(); ++unit)
      if (pattern.present(map, d, unit)) return true;
    return false;
  };
  if (pattern.owner == element_orbit(map.dimension()))
    return std::any_of(begin_.begin(), begin_.end(), [&](std::size_t first) { return present(darts_[first]); });
  return std::any_of(darts_.begin(), darts_.end(), present);
}

bool AwaitedInteractions::has_arrived(std::uint32_t n) const {
  return std::find(arrived_.begin(), arrived_.end(), n) != arrived_.end();
}

void AwaitedInteractions::add(std::uint32_t n, EmbeddedMap& map,
                              std::vector<std::unique_ptr<Interaction>>& interactions) {
  interactions.push_back(all_[n].make(map));
  arrived_.push_back(n);
}

bool AwaitedInteractions::only(const std::shared_ptr<const ForceLaw>& law) const {
  return std::all_of(all_.begin(), all_.end(), [&](const AwaitedInteraction& each) { return each.law == law; });
}

std::vector<std::string> AwaitedInteractions::names() const {
  std::vector<std::string> names;
  for (std::uint32_t n = 0; n < all_.size(); ++n)
    if (!has_arrived(n)) names.push_back(all_[n].name);
  return names;
}

bool AwaitedInteractions::store(Archive& archive, EmbeddedMap& map,
                                std::vector<std::unique_ptr<Interaction>>& interactions) {
  if (all_.empty()) return false;
  std::vector<std::uint32_t> arrived = arrived_;
  archive.list(arrived, all_.size(), "more interactions were added than there are");
  if (!archive.reading()) return false;
  const std::size_t before = arrived_.size();
  refuse_unless(arrived.size() >= before && std::equal(arrived_.begin(), arrived_.end(), arrived.begin()),
                "other interactions were added before");
  for (std::size_t n = before; n < arrived.size(); ++n) {
    refuse_unless(arrived[n] < all_.size() && !has_arrived(arrived[n]),
                  "an interaction was added that is not there");
    add(arrived[n], map, interactions);
  }
  return arrived_.size() > before;
}

} // namespace rend
