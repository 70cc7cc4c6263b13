// One case compared: read, measured, judged.
#pragma once

#include "render/compare/cases.h"
#include "render/compare/limits.h"
#include "render/compare/memory_budget.h"

#include <optional>
#include <string>
#include <vector>

namespace rend {

enum class CaseState {
  Match,      // every figure within its limit
  Differ,     // one is not
  Size,       // width or height differ: nothing is measured
  Missing,    // expected, and not there
  New,        // there, and not expected
  Unreadable, // they cannot be compared: one of the two is no picture that can be read, or too large, or the
              // mask does not fit
};
const char* name_of(CaseState state); // "match", "differ", ...
const std::vector<CaseState>& all_states();

struct Compared {
  CasePaths paths;
  CaseState state = CaseState::Match;
  std::vector<std::string> why;   // sentences or figures: what is not as it should be
  std::vector<std::string> notes; // what was converted
  int width = 0, height = 0;      // [pixels] of the expected picture, or of the one there is
  std::optional<Metrics> metrics; // of Match and Differ; without the maps
  Tolerance tolerance;
  std::vector<std::uint8_t> heat; // a PNG of FLIP's map, of Differ where it was asked for
};

struct CompareOptions {
  Tolerance tolerance;
  std::filesystem::path mask; // a PNG; empty: all pixels count
  bool heat = false;          // make that map
  int threads = 1;
};

// Whatever goes wrong with one pair (its pictures, its mask, the memory that it takes) is the state Unreadable,
// and a sentence in `why`.
Compared compare_case(const CasePaths& paths, const CompareOptions& options, MemoryBudget& memory);

// Looks through a picture that is compared with nothing, and keeps none of it. Throws UserError: as png_head()
// and check_png() do; Trouble where it would take more than the whole of the memory.
PngHead check_picture(const std::filesystem::path& path, MemoryBudget& memory);

} // namespace rend
