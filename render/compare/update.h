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

// Throws UserError (Usage) where one folder lies in the other, or both are one: an update would remove or
// replace pictures of the wrong one. Single pictures may lie anywhere.
void check_folders_of_update(const std::filesystem::path& expected, const std::filesystem::path& now);

// Of the cases `which` of `results` those that an update changes: they do not match, and what is copied, or
// removed because it is missing now, is a picture that can be read. One that is not hinders no other. Throws
// UserError (DiffError) where not one picture is there now: a render that failed must not empty what is
// expected.
std::set<std::size_t> updatable(const std::vector<CaseResult>& results, const std::set<std::size_t>& which,
                                MemoryBudget& memory);

// Copies the current over the expected pictures, byte by byte, or adds them, and removes expected pictures that
// are missing now, for the cases `which`, from updatable(). All new files are on the disk before the first
// rename or removal: if one cannot be written, nothing is changed. `expected`: the folder (or picture) of
// expected pictures; nothing outside of this folder is changed, and of a link the link itself. Throws
// UserError: CannotCreate, ReadWrite; DiffError where one file has two names, or where a link leads out of the
// folder.
void update_expected(const std::vector<CaseResult>& results, const std::set<std::size_t>& which,
                     const std::filesystem::path& expected);

} // namespace rend
