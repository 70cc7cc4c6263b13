// What presets there are: their figure in the thesis, a line about each, and how long they take.
//
// The line is the first sentence of the comment that a preset begins with. How long a preset takes stands in
// times.csv of its folder, which presets/measure writes: processor time of `rend run` on one thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rend {

struct ListedPreset {
  std::string file;              // within the folder: "tear/moebius.xml"
  std::string thesis;            // figure or table; empty: none
  std::string about;             // one sentence; empty: the preset has no comment
  std::optional<double> seconds; // processor time; none: not measured
  std::optional<long> steps;     // that were counted when it was measured
};

// The folder of presets that rend comes with: "presets" here, or where it is installed. Throws UserError
// (NoInput).
std::filesystem::path folder_of_presets();

// All presets of a folder and below, by file. What is no scene, such as a file of rules, is left out. Throws
// UserError: NoInput, ReadWrite.
std::vector<ListedPreset> list_presets(const std::filesystem::path& folder);

// The first sentence of the first comment of an XML text, on one line. An abbreviation (fig. 7.17) ends none.
std::string first_sentence(const std::string& xml);

} // namespace rend
