// The darts whose links an edit has changed so far, read from its journal piece by piece, and others that are
// added: whether a change of the same step has been at a cell already.
#pragma once

#include "sim/topology/index_set.h"
#include "sim/topology/map_edit.h"

#include <algorithm>
#include <array>
#include <span>

namespace rend {

class TouchedDarts {
public:
  void clear() { // of another edit
    read_.fill(0);
    darts_.clear();
  }
  // Darts whose links stay, but not the values that depend on them.
  void add(std::span<const Dart> darts) {
    for (Dart d : darts) darts_.insert(d.value);
  }
  // `journal`: of the edit. What has been taken back since the last call counts as touched.
  bool any_of(const Journal& journal, std::span<const Dart> darts) {
    for (std::size_t i = 0; i < read_.size(); ++i) {
      for (; read_[i] < journal.touched[i].size(); ++read_[i])
        darts_.insert(journal.touched[i][read_[i]].value);
    }
    return std::any_of(darts.begin(), darts.end(), [&](Dart d) { return darts_.contains(d.value); });
  }

private:
  std::array<std::size_t, 4> read_{}; // of the journal
  IndexSet darts_;
};

} // namespace rend
