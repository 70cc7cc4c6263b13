// The page of a comparison: failures first, each to be looked at in every way; and the files beside it.
#pragma once

#include "render/files/output.h"
#include "render/files/output_folder.h"
#include "render/pages/diff_report.h"

#include <optional>
#include <string>

namespace rend {

// Reads the pictures of what failed from their files, which it embeds as they are; a picture that cannot be
// shown is left out, and so are the pictures of further cases once the page has 100 MB of them (it says so).
std::string diff_page(const DiffReport& report);

// What is left on the disk: a folder with index.html, diff.json, and for what differs maps/NAME.png; and
// JUnit's XML. That they can be written is known before anything is compared, and none is there before it is
// whole.
class DiffFiles {
public:
  // Of an empty name nothing is written. Throws UserError: CannotCreate.
  DiffFiles(const std::string& folder, const std::string& junit);
  // `page`: what diff_page() gave. Throws UserError: CannotCreate, ReadWrite.
  void write(const std::string& page, const DiffReport& report);

private:
  void write_maps(const DiffReport& report) const;

  std::optional<OutputFolder> folder_, maps_;
  std::optional<OutputFile> json_, page_, junit_;
};

} // namespace rend
