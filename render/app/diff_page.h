// The page of a comparison: failures first, each to be looked at in every way; and the files beside it.
#pragma once

#include "render/app/diff_report.h"

#include <filesystem>
#include <string>

namespace rend {

// Reads the pictures of what failed from their files, which it embeds as they are; a picture that cannot be shown is
// left out, and so are the pictures of further cases once the page has 100 MB of them (it says so).
std::string diff_page(const DiffReport& report);

// index.html (`page`), diff.json, and for what differs maps/NAME.png. Throws UserError: CannotCreate, ReadWrite.
void write_diff_folder(const std::filesystem::path& folder, const std::string& page, const DiffReport& report);

} // namespace rend
