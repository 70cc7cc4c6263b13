// The results of a check, as JSON and as a page.
#pragma once

#include "sim/check/case.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace rend {

// A family, with those of its cases that were run.
struct CheckChapter {
  CheckFamily family;
  std::vector<CheckCase> cases;
  std::vector<CheckResult> results; // one per case
};

struct CheckCounts {
  std::size_t ok = 0, refused = 0, limits = 0, failed = 0;
  std::size_t all() const { return ok + refused + limits + failed; }
};
CheckCounts count(const std::vector<CheckChapter>& chapters);

// `seconds`: of the whole. The page links the cases' presets as cases/NAME.xml.
nlohmann::ordered_json check_json(const std::vector<CheckChapter>& chapters, double seconds);
std::string check_page(const std::vector<CheckChapter>& chapters, double seconds);

} // namespace rend
