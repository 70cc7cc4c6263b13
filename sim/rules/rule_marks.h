// Marks that the steps of a script set on darts (<for mark="m">), and that expressions ask for: marked(a, m).
// They last until the script has run.
#pragma once

#include "sim/base/id.h"
#include "sim/topology/index_set.h"

#include <string>
#include <string_view>
#include <vector>

namespace rend {

class RuleMarks {
public:
  static constexpr std::size_t most = 32; // names

  void clear() {
    names_.clear();
    of_dart_.clear();
  }
  void set(Dart d, std::string_view name) {
    std::size_t n = find(name);
    if (n == names_.size()) names_.emplace_back(name);
    of_dart_.assign(d.value, bits(d) | 1u << n);
  }
  // Its number belongs to a new dart now.
  void forget(Dart d) {
    if (bits(d) != 0) of_dart_.assign(d.value, 0);
  }
  bool has(Dart d, std::string_view name) const {
    const std::size_t n = find(name);
    return n < names_.size() && (bits(d) >> n & 1u) != 0;
  }

private:
  std::size_t find(std::string_view name) const {
    std::size_t n = 0;
    while (n < names_.size() && names_[n] != name) ++n;
    return n;
  }
  std::uint32_t bits(Dart d) const {
    const std::uint32_t found = of_dart_.find(d.value);
    return found == IndexMap::none ? 0 : found;
  }

  std::vector<std::string> names_;
  IndexMap of_dart_; // dart → bit n: it has the mark names_[n]
};

} // namespace rend
