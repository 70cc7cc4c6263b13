// The results of a comparison: as text, JSON, JSON lines, JUnit XML, and for GitLab and GitHub.
#pragma once

#include "render/compare/clips.h"
#include "render/compare/compare.h"
#include "render/console/json_text.h"
#include "sim/base/error.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace rend {

// What is expected: as it was, or replaced by what there is now.
enum class Expectation { Kept, Updated };

struct DiffReport {
  std::string a, b;                 // as on the command line
  std::vector<CaseResult> cases;    // by name
  std::vector<bool> updated;        // one per case: what is expected has been replaced
  std::vector<std::string> remarks; // on the whole, such as patterns that fit nothing
  std::vector<ClipDifference> clips = {};

  Expectation expectation(std::size_t n) const { return updated[n] ? Expectation::Updated : Expectation::Kept; }
};

// The number of cases in that state, not counting those that were updated.
std::size_t count(const DiffReport& report, CaseState state);
std::size_t updated(const DiffReport& report);
// Indices of the cases, failures first, by state in the order of all_states(), those that differ by decreasing
// mean of FLIP; then updated and matching cases, by name.
std::vector<std::size_t> failures_first(const DiffReport& report);
bool failed(const DiffReport& report, std::size_t n);

// 0: all match or were updated; 2: one cannot be read; else 1.
Exit exit_of(const DiffReport& report);

// Name, state, figures, reasons. psnr is null where the pictures are equal (it would be infinite).
nlohmann::ordered_json case_json(const CaseResult& one, Expectation expectation);
nlohmann::ordered_json diff_json(const DiffReport& report);

// "bowl: 60 frames; first other frame 00012.png, worst 00031.png (FLIP 0.021)"
std::string clip_text(const DiffReport& report, const ClipDifference& clip);

// A line per failure, then a summary; for a single pair, its metrics.
std::string diff_text(const DiffReport& report);

// JUnit XML for Jenkins, GitLab and others: a failure for every case that fails, an error for unreadable ones.
std::string diff_junit(const DiffReport& report);

// A Code Quality report, which GitLab shows beside a merge request: one issue for each case that fails.
std::string diff_gitlab(const DiffReport& report);

// Workflow commands, which GitHub shows as annotations once a step prints them: one for each case that fails.
std::string diff_github(const DiffReport& report);

} // namespace rend
