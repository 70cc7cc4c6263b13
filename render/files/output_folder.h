// An output folder. Whether it is writable is tested at once, not after an hour of simulation; it is created
// when the first file is written; a folder that was created here and stays empty is removed.
#pragma once

#include "render/files/temporaries.h"

#include <deque>
#include <filesystem>
#include <string>
#include <vector>

namespace rend {

class OutputFolder {
public:
  // Throws UserError (CannotCreate) if the folder cannot be created or written to.
  explicit OutputFolder(const std::filesystem::path& path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void make() const; // throws UserError (CannotCreate)
  void sync() const; // at the end: flushes its entries to the disk (render/files/output.h), if it was created

private:
  std::filesystem::path path_;
  std::vector<std::filesystem::path> missing_; // folders that did not exist, outermost first
  std::deque<TemporaryPath> temporary_;        // registers them while they may be empty
};

// `given`, or out/ and the scene's name if it is empty.
std::filesystem::path folder_for(const std::string& given, const std::string& scene);

} // namespace rend
