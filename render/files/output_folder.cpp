#include "render/files/output_folder.h"

#include "render/files/output.h"
#include "sim/base/error.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <unistd.h>

namespace rend {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(const fs::path& path) : path_(path) {
  std::error_code error;
  fs::path at = path_.lexically_normal();
  if (!at.has_filename()) at = at.parent_path(); // "out/": its filename is empty
  for (; !at.empty() && !fs::exists(at, error); at = at.parent_path()) missing_.push_back(at);
  std::reverse(missing_.begin(), missing_.end());
  const fs::path there = at.empty() ? fs::path(".") : at;
  if (!fs::is_directory(there, error))
    throw UserError(Exit::CannotCreate, {there.string()}, "a file is in the way of the output folder",
                    "choose another one with -o");
  if (::access(there.c_str(), W_OK | X_OK) != 0)
    throw UserError(Exit::CannotCreate, {there.string()},
                    std::string("nothing can be written there: ") + std::strerror(errno),
                    "choose another one with -o");
  for (const fs::path& folder : missing_) temporary_.emplace_back(folder.c_str());
}

OutputFolder::~OutputFolder() {
  std::error_code error;
  for (auto folder = missing_.rbegin(); folder != missing_.rend(); ++folder)
    if (!fs::is_directory(*folder, error) || !fs::is_empty(*folder, error) || !fs::remove(*folder, error))
      break;
}

void OutputFolder::make() const {
  std::error_code error;
  const bool made = fs::create_directories(path_, error);
  if (error)
    throw UserError(Exit::CannotCreate, {path_.string()}, "the folder cannot be made: " + error.message(),
                    "choose another one with -o");
  if (made)
    for (const fs::path& folder : missing_) sync_folder(folder.parent_path());
}

void OutputFolder::sync() const {
  std::error_code error;
  if (fs::is_directory(path_, error)) sync_folder(path_);
}

fs::path folder_for(const std::string& given, const std::string& scene) {
  return given.empty() ? fs::path("out") / scene : fs::path(given);
}

} // namespace rend
