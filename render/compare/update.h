// rend diff --update: pictures that are right as they are now become what is expected.
#pragma once

#include "render/compare/compare.h"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace rend {

// Which cases are meant: each of `names` is that of a case (with or without .png) or of a folder of cases. The
// indices into `cases`. Throws UserError (Usage) for a name that is none of them.
std::set<std::size_t> named_cases(const std::vector<std::string>& names, const std::vector<CasePaths>& cases);

// Copies what there is now over what is expected, byte by byte, for the cases `which` of `results`. All new
// files are on the disk before the first takes its place: where one cannot be read or written, nothing is
// changed. `expected`: the folder (or picture) of what is expected. Throws UserError: Trouble where there is
// nothing to copy (missing, unreadable); CannotCreate, ReadWrite.
void update_expected(const std::vector<Compared>& results, const std::set<std::size_t>& which,
                     const std::filesystem::path& expected, MemoryBudget& memory);

} // namespace rend
