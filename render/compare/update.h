// rend diff --update: what there is now becomes what is expected.
#pragma once

#include "render/compare/compare.h"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace rend {

// The cases to update: each of `names` is that of a case (with or without .png) or of a folder of cases, or a
// pattern with * and ?, which also stand for /. Returns indices into `cases`. Throws UserError (Usage) for a
// name that matches none.
std::set<std::size_t> named_cases(const std::vector<std::string>& names, const std::vector<CasePaths>& cases);

// Of the cases `which` of `results` those that an update changes: they do not match, and a current picture,
// where there is one, can be read. One that cannot hinders no other. Throws UserError (DiffError) where not one
// picture is there now: a render that failed must not empty what is expected.
std::set<std::size_t> updatable(const std::vector<CaseResult>& results, const std::set<std::size_t>& which,
                                MemoryBudget& memory);

// Copies the current over the expected pictures, byte by byte, or adds them, and removes expected pictures that
// are missing now, for the cases `which`, from updatable(). All new files are on the disk before the first
// rename or removal: if one cannot be written, nothing is changed. `expected`: the folder (or picture) of
// expected pictures. Throws UserError: CannotCreate, ReadWrite; DiffError where one file has two names.
void update_expected(const std::vector<CaseResult>& results, const std::set<std::size_t>& which,
                     const std::filesystem::path& expected);

} // namespace rend
