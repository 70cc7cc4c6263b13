// rend diff --update: replaces expected pictures by current ones.
#pragma once

#include "render/compare/compare.h"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace rend {

// The cases to update: each of `names` is that of a case (with or without .png) or of a folder of cases.
// Returns indices into `cases`. Throws UserError (Usage) for a name that matches none.
std::set<std::size_t> named_cases(const std::vector<std::string>& names, const std::vector<CasePaths>& cases);

// Copies the current over the expected pictures, byte by byte, for the cases `which` of `results`. All new
// files are on the disk before the first rename: if one cannot be read or written, nothing is changed.
// `expected`: the folder (or picture) of expected pictures. Throws UserError: DiffError where there is nothing
// to copy (missing, unreadable); CannotCreate, ReadWrite.
void update_expected(const std::vector<CaseResult>& results, const std::set<std::size_t>& which,
                     const std::filesystem::path& expected, MemoryBudget& memory);

} // namespace rend
