// The page of a comparison, failures first, with an interactive view of each; and the files beside it.
#pragma once

#include "render/files/output.h"
#include "render/files/output_folder.h"
#include "render/pages/diff_report.h"

#include <optional>
#include <string>

namespace rend {

// Reads the pictures of failed cases from their files, and embeds them unchanged; a picture that cannot be
// shown is omitted, and so are the pictures of further cases once the page has 100 MB of them (the page says
// so).
std::string diff_page(const DiffReport& report);

// Names of output files; empty: not written.
struct DiffFileNames {
  std::string folder; // of the page
  std::string junit;  // JUnit XML
  std::string gitlab; // Code Quality report of GitLab
  std::string github; // annotations of GitHub
};

// The output files: a folder with index.html, diff.json, and maps/NAME.png for cases that differ; and reports
// for other programs. That they are writable is tested before anything is compared; each is written atomically.
class DiffFiles {
public:
  explicit DiffFiles(const DiffFileNames& names); // throws UserError: CannotCreate
  // `page`: from diff_page(). Throws UserError: CannotCreate, ReadWrite.
  void write(const std::string& page, const DiffReport& report);

private:
  void write_maps(const DiffReport& report) const;

  std::optional<OutputFolder> folder_, maps_;
  std::optional<OutputFile> json_, page_, junit_, gitlab_, github_;
};

} // namespace rend
