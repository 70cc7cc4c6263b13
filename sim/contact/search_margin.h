// The margin (skin) with which near pairs are searched: how much farther than what touches.
//
// With a wide one lists hold for many steps and are long; with a narrow one they are short and soon used up. In
// a crumpled sheet, whose layers are nearer to each other than its cells are large, the number of pairs grows
// with the cube of the margin; of shards in a heap it hardly does. So the margin follows what was counted since
// the last search: it becomes narrower if going through the pairs took longer than to search them, or else
// wider, within bounds. It depends on the steps before, since the map was last changed; the lists contain
// all that touch with any margin.
#pragma once

#include <algorithm>
#include <cstddef>

namespace rend {

class SearchMargin {
public:
  static constexpr double least = 1.0 / 16; // share of the widest; the most is 1
  SearchMargin() = default;
  explicit SearchMargin(double share) : share_(share), held_(true) {} // stays there, whatever is counted

  void searched(std::size_t looks) { searched_ += looks; } // pairs and items that a search looked at
  void passed(std::size_t pairs) { passed_ += pairs; }     // listed ones that a step went through

  // For the next search [m].
  double next(double widest) {
    if (searched_ > 0 && !held_)
      share_ = std::clamp(passed_ > in_search * searched_ ? share_ * narrower : share_ / narrower, least, 1.0);
    searched_ = passed_ = 0;
    return share_ * widest;
  }
  SearchMargin anew() const { return held_ ? *this : SearchMargin(); } // with nothing counted yet

private:
  static constexpr std::size_t in_search = 16; // a look in a search takes as long as passing so many pairs
  static constexpr double narrower = 0.8;
  double share_ = 1; // of the widest
  bool held_ = false;
  std::size_t searched_ = 0, passed_ = 0;
};

} // namespace rend
