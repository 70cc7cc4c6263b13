// Runs the cases of a check in parallel, each from a preset file as a user would.
#pragma once

#include "sim/check/case.h"

#include <filesystem>
#include <functional>

namespace rend {

// A case's name with characters replaced that file names should not contain: its preset is this plus ".xml".
std::string file_name(const std::string& case_name);

// Writes each preset, and its input files, into the folder.
void write_cases(const std::filesystem::path& folder, const std::vector<CheckCase>& cases);

// In the order of the cases, for any number of jobs. `done` is called once per case, never concurrently. After
// a signal, remaining cases are missing from the result. `fewer` is called if not all threads could be started.
std::vector<CheckResult> run_cases(const std::filesystem::path& folder, const std::vector<CheckCase>& cases,
                                   int jobs,
                                   const std::function<void(std::size_t which, const CheckResult&)>& done,
                                   const std::function<void()>& fewer);

} // namespace rend
