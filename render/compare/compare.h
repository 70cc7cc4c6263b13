// Compares one case: reads the pictures, measures them, checks the tolerances.
#pragma once

#include "render/compare/cases.h"
#include "render/compare/limits.h"
#include "render/compare/memory_budget.h"

#include <optional>
#include <string>
#include <vector>

namespace rend {

enum class CaseState {
  Match,      // every metric within its limit
  Differ,     // at least one is not
  Size,       // width or height differ: no metrics
  Missing,    // expected, but does not exist
  New,        // exists, but is not expected
  Unreadable, // cannot be compared: a picture that cannot be read or is too large, or a mask that does not fit
};
const char* name_of(CaseState state); // "match", "differ", ...
const std::vector<CaseState>& all_states();

struct CaseResult {
  CasePaths paths;
  CaseState state = CaseState::Match;
  std::vector<std::string> why;   // sentences or metrics: why it does not match
  std::vector<std::string> notes; // conversions that were made
  int width = 0, height = 0;      // [pixels] of the expected picture, or of the only one
  std::optional<Metrics> metrics; // of Match and Differ; without the maps
  Tolerance tolerance;
  std::vector<std::uint8_t> heat; // PNG of the FLIP map, for Differ, if it was asked for
};

struct CompareOptions {
  Tolerance tolerance;
  std::filesystem::path mask; // a PNG; empty: all pixels count
  bool heat = false;          // make the heat map
  int threads = 1;
};

// Every error of one pair (in its pictures, its mask, or the memory that it needs) gives the state Unreadable,
// with a sentence in `why`.
CaseResult compare_case(const CasePaths& paths, const CompareOptions& options, MemoryBudget& memory);

// Validates a picture that has no counterpart, without keeping it. Throws UserError as png_info() and
// check_png() do; Trouble if it needs more than the whole memory budget.
PngInfo check_picture(const std::filesystem::path& path, MemoryBudget& memory);

} // namespace rend
