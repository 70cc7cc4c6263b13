// Births of fragments: the number of connected components of a body after each topological change, computed for
// all changes of a step together.
//
// Fracture only removes links and darts. So the components after the last change are labelled once, and the
// changes are undone in reverse: a removed dart becomes a component of its own, and every pair that was
// unlinked joins two components (union-find; Tarjan 1975). That takes O(darts + links undone) per step, for any
// number of changes, and is exact for deletions as well. Done only if it is needed.
#pragma once

#include "sim/base/record.h"
#include "sim/topology/map_edit.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rend {

class Archive;
class GMap;

// One applied change.
struct TearEvent {
  double time = 0; // [s]
  long step = 0;
  int law = 0; // index among the laws of its body
  double value = 0;
  Dart dart;
  Vec3 place = Vec3::Zero(); // [m], the mean of the cell's vertices
  long fragments = -1;       // of the body after this change; -1: not counted
  long born = 0;             // increase of their number; negative if whole components were deleted

  void store(Archive& archive); // the caller checks that its law and its dart exist
};

class FragmentCounter {
public:
  // Before an edit. `growing`: the map, if the edit may create darts or links, which the above does not undo;
  // then the components before and after the step are counted, and all changes of the step have the number
  // after it.
  void begin(const GMap* growing = nullptr);
  void note(const Journal& journal); // after a change: reads the new entries of the journal

  // Writes fragments and born of the events, one per change noted since the last call, in their order; then
  // forgets the changes. `map` is the state after the last of them.
  void settle(const GMap& map, std::span<TearEvent> events);

private:
  struct Undoing {
    std::size_t pairs, removed; // where the entries of the change end in the lists
  };
  std::uint32_t piece_of(std::uint32_t piece);
  long undo(std::size_t change);

  void forget();
  void settle_grown(std::size_t pieces, std::span<TearEvent> events);

  std::optional<long> before_;           // components before the step, if something grows in it
  std::array<std::size_t, 4> touched_{}; // how much of the journal's lists was read
  std::size_t removed_read_ = 0;
  std::vector<Undoing> changes_;             // one per change noted
  std::vector<std::pair<Dart, Dart>> pairs_; // pairs that were unlinked, in the order of changes
  std::vector<Dart> removed_;                // in the order of changes

  std::vector<std::uint32_t> piece_of_dart_; // component of each dart
  std::vector<std::uint32_t> parent_;        // of each component, in the union-find
};

} // namespace rend
