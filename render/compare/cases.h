// Pairs up what is compared: two pictures, or the pictures of two folders by their paths.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rend {

// `a` is the expected picture, `b` the current one; empty where that side has no such picture.
struct CasePaths {
  // "tear/moebius-12.png": the path within the folders; for two single pictures, the name of the first
  std::string name;
  std::filesystem::path a, b;
};

struct Cases {
  std::vector<CasePaths> all;                 // sorted by name
  std::size_t left_out = 0;                   // files in the folders that do not end in .png
  std::vector<std::filesystem::path> folders; // all folders visited, as canonical paths
};

// Folders are searched recursively, links to folders included; names are compared as bytes, and every file that
// ends in .png (or .PNG) counts. Throws UserError: NoInput where one does not exist; DiffError for a folder
// against a file, where neither folder contains a picture, where a folder cannot be read, and for a link to a
// folder that contains it.
Cases cases_of(const std::filesystem::path& a, const std::filesystem::path& b);

} // namespace rend
