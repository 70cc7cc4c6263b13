// The files that a command line names. No file may be written twice, and no input overwritten.
//
// A file that is written replaces what has its name (render/files/output.h). So of two outputs of one name
// one would be lost without a word, and so would an input that has it. Names are the same where they lead to
// the same place: s.csv, ./s.csv, and s.csv in a link to this folder. (Two hard links are two files:
// replacing one leaves the other.)
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rend {

class PresetNode;

class NamedFiles {
public:
  NamedFiles(); // standard output and error count as written if the shell redirected them to files

  // `what` names the file in messages: "the preset", "--events". All throw UserError (Usage) where a file named
  // before would be overwritten, or this one.
  void reads(const std::string& what, const std::filesystem::path& path);
  void reads_files(const PresetNode& scene); // of a preset
  void writes(const std::string& what, const std::filesystem::path& path);
  // In a folder, all files named NUMBER and EXTENSION ("00012.png") with these numbers.
  void writes_frames(const std::string& what, const std::filesystem::path& folder, const std::string& extension,
                     const std::function<bool(long)>& has);

private:
  struct Input {
    std::string what;
    // as it was given; with its folder's links resolved; with all links resolved
    std::filesystem::path given, name, place;
  };
  struct Output {
    std::string what;
    std::filesystem::path given, name;                      // of a single file; empty: of several
    std::function<bool(const std::filesystem::path&)> over; // whether a file of that name is overwritten
  };
  void add(Output output);

  std::vector<Input> inputs_;
  std::vector<Output> outputs_;
};

} // namespace rend
