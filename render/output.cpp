#include "render/output.h"

#include "sim/base/check.h"
#include "sim/base/error.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rend {
namespace {

namespace fs = std::filesystem;

std::string reason() {
  return std::strerror(errno);
}

// "x.2.part" of "x.part".
fs::path numbered(const fs::path& temporary, int n) {
  if (n == 1) return temporary;
  return temporary.parent_path() /
         (temporary.stem().string() + "." + std::to_string(n) + temporary.extension().string());
}

// Whether a file that was opened still has that name: who had it before may have renamed it meanwhile.
bool is_called(int file, const fs::path& path) {
  struct stat ours {
  }, there{};
  return ::fstat(file, &ours) == 0 && ::stat(path.c_str(), &there) == 0 && ours.st_ino == there.st_ino &&
         ours.st_dev == there.st_dev;
}

// A descriptor of a temporary file that no running program writes to, and empty; -1, with errno. Where files
// cannot be locked (some network file systems) it is the first.
int open_free(const fs::path& wanted, fs::path& temporary) {
  constexpr int most = 1000; // programs that write the same file at once, or change it while we look
  for (int n = 1, tries = 0; tries < most; ++tries) {
    temporary = numbered(wanted, n);
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0) return -1;
    const bool taken = ::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!taken && is_called(file, temporary) && ::ftruncate(file, 0) == 0) return file;
    ::close(file);
    n += taken;
  }
  errno = EBUSY;
  return -1;
}

// Removes those of the temporary files that no running program writes to, up to the first number that is not
// there: the file without a number goes when its program ends, and others may still be there.
void remove_free(const fs::path& wanted) {
  for (int n = 1;; ++n) {
    const fs::path temporary = numbered(wanted, n);
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0 && n > 1) return;
    if (file < 0) continue;
    if (::flock(file, LOCK_EX | LOCK_NB) == 0 && is_called(file, temporary)) ::unlink(temporary.c_str());
    ::close(file);
  }
}

} // namespace

// A link is followed: what it points at is replaced, not the link.
OutputFile::OutputFile(const std::filesystem::path& path) : OutputFile(path, {}) {}

OutputFile::OutputFile(const std::filesystem::path& path, const std::filesystem::path& temporary)
    : path_(std::filesystem::is_symlink(path) ? std::filesystem::weakly_canonical(path) : path),
      wanted_(temporary.empty() ? path_.string() + ".part"
                                : (path_.parent_path() / temporary.filename()).string()) {
  if (path_ == "-")
    throw UserError(Exit::Usage, {}, "'-' is no file, and what is written there appears whole or not at all",
                    "name a file; ./- is one of that name");
  if (std::filesystem::is_directory(path_))
    throw UserError(Exit::CannotCreate, {path_.string()}, "a folder of this name is in the way.",
                    "Choose another name for the output.");
  if (std::filesystem::exists(path_) && !std::filesystem::is_regular_file(path_))
    throw UserError(
        Exit::CannotCreate, {path_.string()}, "this is no ordinary file, and would be replaced by one.",
        "Name a file; what is written appears whole or not at all, which a pipe or device cannot do.");
  file_ = open_free(wanted_, temporary_);
  if (file_ < 0)
    throw UserError(Exit::CannotCreate, {path_.string()}, "the file cannot be created: " + reason() + ".",
                    "Check that the folder is there and may be written to.");
  part_.is(temporary_.c_str());
}

OutputFile::~OutputFile() {
  if (file_ < 0) return;
  ::unlink(temporary_.c_str()); // while it is ours
  ::close(file_);
}

void OutputFile::write(std::span<const std::uint8_t> bytes) {
  CHECK(file_ >= 0);
  while (!bytes.empty()) {
    const ssize_t count = ::write(file_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0)
      throw UserError(Exit::ReadWrite, {path_.string()}, "writing failed: " + reason() + ".",
                      "Free some space on the disk, or write elsewhere.");
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

std::int64_t OutputFile::seek(std::int64_t offset, int whence) {
  return ::lseek(file_, offset, whence);
}

void OutputFile::commit() {
  CHECK(file_ >= 0);
  const bool kept = ::fsync(file_) == 0 && ::rename(temporary_.c_str(), path_.c_str()) == 0;
  const std::string why = kept ? "" : reason();
  if (!kept) ::unlink(temporary_.c_str());
  part_.is_gone();
  ::close(file_);
  file_ = -1;
  if (!kept)
    throw UserError(Exit::ReadWrite, {path_.string()}, "writing failed: " + why + ".",
                    "Check that the folder is still there and has room.");
  remove_free(wanted_);
}

void remove_leftover(const fs::path& path) {
  remove_free(path.string() + ".part");
}

void write_whole(const std::filesystem::path& path, const std::string& bytes) {
  OutputFile file(path);
  file.write({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  file.commit();
}

} // namespace rend
