// Births of fragments: how many connected pieces a body has after each topological change, told for all changes
// of a step together.
//
// Changes only ever let go: they unlink darts and remove some. So the pieces after the last change are labelled
// once, and the changes are undone in reverse: a removed dart comes back as a piece by itself, and every pair
// that was unlinked joins two pieces (union-find; Tarjan 1975). That is O(darts + links undone) a step, however
// many changes were made, and exact for deletions as well. Costs nothing where nobody asks.
#pragma once

#include "sim/base/record.h"
#include "sim/topology/map_edit.h"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace rend {

class Archive;

// One applied change.
struct TearEvent {
  double time = 0; // [s]
  long step = 0;
  int law = 0; // of its body
  double value = 0;
  Dart dart;
  Vec3 place = Vec3::Zero(); // [m], the middle of the cell
  long fragments = -1;       // of the body after this change; -1: nobody asked
  long born = 0;             // how many more that are than before; below 0 where whole pieces were deleted

  void store(Archive& archive); // whether its law and its dart are there is for others to say
};

class Births {
public:
  void begin();                      // an edit was opened
  void note(const Journal& journal); // a change was made: what stands in the journal since the one before

  // Writes fragments and born of the events, which were noted since the last call, in their order; then forgets
  // them. `map` is as the last of them left it.
  void settle(const GMap& map, std::span<TearEvent> events);

private:
  struct Undoing {
    std::size_t pairs, removed; // where the change's part of the lists ends
  };
  std::uint32_t piece_of(std::uint32_t piece);
  long undo(std::size_t change);

  std::array<std::size_t, 4> touched_{}; // of the journal's lists: how much was read
  std::size_t removed_read_ = 0;
  std::vector<Undoing> changes_;             // one per change noted
  std::vector<std::pair<Dart, Dart>> pairs_; // that let go of each other, change after change
  std::vector<Dart> removed_;                // change after change

  std::vector<std::uint32_t> piece_of_dart_; // one per dart
  std::vector<std::uint32_t> parent_;        // of a piece, in the union-find
};

} // namespace rend
