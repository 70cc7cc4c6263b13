// A folder for work of a run, in the system's folder for temporary files, that is removed with its files.
//
// A run that is killed cannot remove it; the next run that makes one of the same name does. The folder is
// locked while it is used (flock(2), which ends with the program): what can be locked belongs to no run any
// more.
#pragma once

#include "render/files/temporaries.h"

#include <filesystem>
#include <string>

namespace rend {

class WorkFolder {
public:
  // `name`: how it begins, such as "rend-fill". UserError (CannotCreate), with `hint`: none can be made.
  WorkFolder(const std::string& name, const std::string& hint);
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
  int lock_ = -1;           // descriptor of the folder
  TemporaryPath temporary_; // path_
};

} // namespace rend
