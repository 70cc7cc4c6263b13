// The files that a command line asks for: none of them twice, and nothing that is read is written over.
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
  NamedFiles(); // standard output and error are written, where a shell has led them to files

  // `what` is it in messages: "the preset", "--events". All throw UserError (Usage) where a file that was named
  // before would be written over, or this one.
  void reads(const std::string& what, const std::filesystem::path& path);
  void reads_meshes(const PresetNode& scene); // of a preset
  void writes(const std::string& what, const std::filesystem::path& path);
  // In a folder all files called NUMBER and EXTENSION ("00012.png") whose number is one of these.
  void writes_frames(const std::string& what, const std::filesystem::path& folder, const std::string& extension,
                     const std::function<bool(long)>& has);

private:
  struct Input {
    std::string what;
    std::filesystem::path given, name, place; // as it was given, without links but for its own, without links
  };
  struct Output {
    std::string what;
    std::filesystem::path given, name;                      // of one file; none: of several
    std::function<bool(const std::filesystem::path&)> over; // whether what has that name is written over
  };
  void add(Output output);

  std::vector<Input> inputs_;
  std::vector<Output> outputs_;
};

} // namespace rend
