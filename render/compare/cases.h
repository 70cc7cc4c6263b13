// What is compared with what: two pictures, or two folders of pictures by their names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rend {

// `a` is what is expected, `b` what there is now; one of them is empty where that side has no such picture.
struct CasePaths {
  std::string name; // "tear/moebius-12.png": the path within the folders; of two pictures the name of the first
  std::filesystem::path a, b;
};

struct Cases {
  std::vector<CasePaths> all;                 // sorted by name
  std::size_t left_out = 0;                   // files in the folders that are not called .png
  std::vector<std::filesystem::path> folders; // all that were looked through, without links
};

// Folders are walked to the bottom, through links to others too; names are compared as bytes, and every file
// that is called .png (or .PNG) counts. Throws UserError (Trouble) where one is not there, for a folder against
// a file, where there is no picture in either folder, where a folder cannot be read, and for a link to a folder
// that it is in.
Cases cases_of(const std::filesystem::path& a, const std::filesystem::path& b);

} // namespace rend
