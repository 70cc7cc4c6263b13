// Runs the cases of a check, several at once, each from a preset file as a user would.
#pragma once

#include "sim/check/case.h"

#include <filesystem>
#include <functional>

namespace rend {

// A case's name without what no file name should hold: its preset is this and ".xml".
std::string file_name(const std::string& case_name);

// Writes each preset, and what it reads, into the folder.
void write_cases(const std::filesystem::path& folder, const std::vector<CheckCase>& cases);

// In the order of the cases, whatever the number of jobs. `done` is called once a case, one at a time. Cases
// that a signal leaves over are not in the result. `fewer` is called where not all threads could be started.
std::vector<CheckResult> run_cases(const std::filesystem::path& folder, const std::vector<CheckCase>& cases,
                                   int jobs,
                                   const std::function<void(std::size_t which, const CheckResult&)>& done,
                                   const std::function<void()>& fewer);

} // namespace rend
