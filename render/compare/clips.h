// Clips among the pictures that are compared: frames of one folder, called by their numbers (00000.png,
// 00001.png, ...), as one curve over time.
#pragma once

#include "render/compare/compare.h"

#include <cstddef>
#include <string>
#include <vector>

namespace rend {

struct ClipDifference {
  std::string name;               // its folder; "": the compared folder itself
  std::vector<std::size_t> cases; // indices of its frames among the results, by number
  std::vector<double> flip;       // mean of FLIP of each frame; 1 where it could not be compared
  std::size_t worst = 0;          // index in `flip`
  std::size_t first = 0;          // of the first frame that does not match; flip.size(): all match
};

// Of three frames and more of which at least one does not match, by name.
std::vector<ClipDifference> clips_of(const std::vector<CaseResult>& results);

} // namespace rend
