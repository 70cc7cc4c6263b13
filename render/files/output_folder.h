// A folder that files are going to be written to. That they can be is found out at once, and not after an hour
// of simulation; it is made when the first file comes; and what was made and stays empty is removed.
#pragma once

#include "render/files/temporaries.h"

#include <deque>
#include <filesystem>
#include <string>
#include <vector>

namespace rend {

class OutputFolder {
public:
  // Throws UserError (CannotCreate) where the folder could not be made or written to.
  explicit OutputFolder(const std::filesystem::path& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void make() const; // throws UserError (CannotCreate)
  void sync() const; // the end was reached: what it has is on the disk (render/files/output.h), if it was made

private:
  std::filesystem::path path_;
  std::vector<std::filesystem::path> missing_; // folders that were not there before, outermost first
  std::deque<TemporaryPath> temporary_;        // these, as long as they may be empty
};

// `given`, or out/ and the scene's name where nothing was.
std::filesystem::path folder_for(const std::string& given, const std::string& scene);

} // namespace rend
