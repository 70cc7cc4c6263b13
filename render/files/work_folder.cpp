#include "render/files/work_folder.h"

#include "sim/base/error.h"
#include "sim/base/wording.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace rend {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view pattern = "-XXXXXX"; // of mkdtemp

fs::path temporary_folder(const std::string& hint) {
  std::error_code error;
  fs::path folder = fs::temp_directory_path(error); // of TMPDIR or another variable, or /tmp
  if (!error) return folder;
  const char* named = std::getenv("TMPDIR");
  throw UserError(Exit::CannotCreate, {},
                  named ? fmt::format("TMPDIR is {}, which is no folder", in_quotes(named))
                        : "there is no folder for temporary files",
                  hint);
}

// The lock of a folder of ours.
class Lock {
public:
  explicit Lock(const fs::path& folder)
      : file_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC)) {
    struct stat mine {
    }, there{};
    if (file_ < 0 || ::fstat(file_, &mine) != 0 || mine.st_uid != ::geteuid()) return;
    locked_ = ::flock(file_, LOCK_EX | LOCK_NB) == 0;
    taken_ = !locked_ && errno == EWOULDBLOCK;
    is_there_ =
        ::lstat(folder.c_str(), &there) == 0 && mine.st_ino == there.st_ino && mine.st_dev == there.st_dev;
  }
  ~Lock() {
    if (file_ >= 0) ::close(file_);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  bool is_abandoned() const { return locked_ && is_there_; }
  // Also where folders cannot be locked: there none counts as abandoned.
  bool is_ours() const { return is_there_ && !taken_; }
  int keep() { return std::exchange(file_, -1); }

private:
  int file_;
  bool locked_ = false, taken_ = false, is_there_ = false;
};

void remove_abandoned(const fs::path& all, const std::string& name) {
  std::error_code error;
  for (fs::directory_iterator at(all, error), end; !error && at != end; at.increment(error)) {
    const std::string here = at->path().filename().string();
    if (!here.starts_with(name + "-") || here.size() != name.size() + pattern.size()) continue;
    const Lock lock(at->path());
    std::error_code ignored;
    if (lock.is_abandoned()) fs::remove_all(at->path(), ignored);
  }
}

} // namespace

WorkFolder::WorkFolder(const std::string& name, const std::string& hint) {
  const fs::path all = temporary_folder(hint);
  remove_abandoned(all, name);
  // Before it is locked, another run may take it for abandoned, and remove it: then there is a next one.
  constexpr int most_tries = 10;
  for (int n = 0; n < most_tries && lock_ < 0; ++n) {
    std::string made = (all / (name + std::string(pattern))).string();
    if (!::mkdtemp(made.data())) break;
    path_ = made;
    if (Lock lock(path_); lock.is_ours()) lock_ = lock.keep();
  }
  if (lock_ < 0)
    throw UserError(Exit::CannotCreate, {}, "no temporary folder can be made in " + in_quotes(all.string()),
                    hint);
  temporary_.register_path(path_.c_str());
  temporary_.remove_contents();
}

WorkFolder::~WorkFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
  ::close(lock_);
}

} // namespace rend
