#include "render/files/output.h"

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

// Whether an open file still has that name: another process may have renamed or removed it.
bool is_called(int file, const fs::path& path) {
  struct stat ours {
  }, there{};
  return ::fstat(file, &ours) == 0 && ::lstat(path.c_str(), &there) == 0 && ours.st_ino == there.st_ino &&
         ours.st_dev == there.st_dev;
}

// Whether it can be the temporary file of a killed run: no link, pipe or folder, not another user's, and
// without further hard links.
bool may_be_leftover(const struct stat& there) {
  return S_ISREG(there.st_mode) && there.st_nlink == 1 && there.st_uid == ::geteuid();
}

// Removes a killed run's temporary file of this name. False if something else has that name, or a running
// program writes to it. It is checked before it is opened, since opening can have effects (the other end of a
// pipe notices), and again once it is locked.
bool remove_if_leftover(const fs::path& temporary) {
  struct stat there {};
  if (::lstat(temporary.c_str(), &there) != 0) return errno == ENOENT;
  if (!may_be_leftover(there)) return false;
  const int file = ::open(temporary.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return errno == ENOENT;
  const bool removed = ::flock(file, LOCK_EX | LOCK_NB) == 0 && ::fstat(file, &there) == 0 &&
                       may_be_leftover(there) && is_called(file, temporary) && ::unlink(temporary.c_str()) == 0;
  ::close(file);
  return removed;
}

// The descriptor of a new temporary file, locked; -1 with errno on failure. Where files cannot be locked (some
// network file systems) it has no lock, and no existing file is taken for a leftover.
int make_temporary(const fs::path& wanted, fs::path& temporary) {
  constexpr int most = 1000; // names that are taken, and races with other programs
  constexpr int anew = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  for (int n = 1, tries = 0; tries < most; ++tries) {
    temporary = numbered(wanted, n);
    const int file = ::open(temporary.c_str(), anew, 0666);
    if (file < 0 && errno != EEXIST) return -1;
    if (file < 0) {
      n += !remove_if_leftover(temporary);
      continue;
    }
    // Another program may have taken it for a leftover and locked it first.
    const bool theirs = ::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!theirs && is_called(file, temporary)) return file;
    ::close(file);
  }
  errno = EBUSY;
  return -1;
}

// Removes leftovers up to the first number that does not exist: the program that wrote the file without a
// number may have ended and left those of others.
void remove_leftovers(const fs::path& wanted) {
  struct stat there {};
  for (int n = 1; n == 1 || ::lstat(numbered(wanted, n).c_str(), &there) == 0; ++n)
    remove_if_leftover(numbered(wanted, n));
}

// Refuses to replace anything but a file.
void check_what_is_there(const fs::path& path, const fs::file_status& there) {
  if (fs::is_directory(there))
    throw UserError(Exit::CannotCreate, {path.string()}, "a folder of this name is in the way",
                    "choose another name for the output");
  if (fs::is_other(there) && there.type() != fs::file_type::unknown) // unknown: opening it will report why
    throw UserError(Exit::CannotCreate, {path.string()},
                    "this is not a regular file, and would be replaced by one",
                    "name a regular file; rend writes a file completely or not at all, which pipes and devices "
                    "do not allow");
}

} // namespace

OutputFile::OutputFile(const std::filesystem::path& path) : OutputFile(path, {}) {}

OutputFile::OutputFile(const std::filesystem::path& path, const std::filesystem::path& temporary)
    : path_(path), base_temporary_(temporary.empty() ? path.string() + ".part"
                                                     : (path.parent_path() / temporary.filename()).string()) {
  if (path_ == "-")
    throw UserError(Exit::Usage, {},
                    "'-' (standard output) is not possible here: rend writes a file completely or not at all",
                    "name a file; a file called - is written as ./-");
  std::error_code error;
  const fs::file_status there = fs::symlink_status(path_, error);
  if (!fs::is_symlink(there)) check_what_is_there(path_, there);
  file_ = make_temporary(base_temporary_, temporary_);
  if (file_ < 0)
    throw UserError(Exit::CannotCreate, {path_.string()}, "the file cannot be created: " + reason(),
                    "check that the folder is there and may be written to");
  part_.register_path(temporary_.c_str());
}

OutputFile::~OutputFile() {
  if (file_ < 0) return;
  if (is_called(file_, temporary_)) ::unlink(temporary_.c_str()); // while it is still locked
  ::close(file_);
}

void OutputFile::write(std::span<const std::uint8_t> bytes) {
  CHECK(file_ >= 0);
  while (!bytes.empty()) {
    const ssize_t count = ::write(file_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0)
      throw UserError(Exit::ReadWrite, {path_.string()}, "writing failed: " + reason(),
                      "free some space on the disk, or write elsewhere");
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

std::int64_t OutputFile::seek(std::int64_t offset, int whence) {
  return ::lseek(file_, offset, whence);
}

void OutputFile::commit() {
  CHECK(file_ >= 0);
  errno = ENOENT; // for the case that another file has the name now
  const bool kept =
      is_called(file_, temporary_) && ::fsync(file_) == 0 && ::rename(temporary_.c_str(), path_.c_str()) == 0;
  const std::string why = kept ? "" : reason();
  if (!kept && is_called(file_, temporary_)) ::unlink(temporary_.c_str());
  part_.unregister();
  ::close(file_);
  file_ = -1;
  if (!kept)
    throw UserError(Exit::ReadWrite, {path_.string()}, "writing failed: " + why,
                    "check that the folder is still there and has room");
  remove_leftovers(base_temporary_);
}

void OutputFile::leave() {
  CHECK(file_ >= 0);
  const bool kept = ::fsync(file_) == 0;
  const std::string why = kept ? "" : reason();
  part_.unregister();
  ::close(file_);
  file_ = -1;
  if (!kept) throw UserError(Exit::ReadWrite, {temporary_.string()}, "writing failed: " + why + ".");
}

void remove_leftover(const fs::path& path) {
  remove_leftovers(path.string() + ".part");
}

void write_atomically(const std::filesystem::path& path, const std::string& bytes) {
  OutputFile file(path);
  file.write({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  file.commit();
}

fs::path resolve_link(const fs::path& path) {
  constexpr int most = 40; // symbolic links, the limit of Linux
  std::error_code error;
  check_what_is_there(path, fs::status(path, error)); // what /dev/stdout points to may have no path
  fs::path at = path;
  for (int n = 0; n < most; ++n) {
    if (!fs::is_symlink(at, error)) return at;
    at = at.parent_path() / fs::read_symlink(at, error); // `/` keeps only an absolute right-hand side
  }
  throw UserError(Exit::CannotCreate, {path.string()}, "this link leads in a circle",
                  "choose another name for the output");
}

void sync_folder(const fs::path& folder) {
  const fs::path path = folder.empty() ? fs::path(".") : folder;
  const int file = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool hidden = file < 0 && errno == EACCES; // the folder may be writable, but not readable
  // EINVAL: the file system does not support it
  const bool kept = file >= 0 && (::fsync(file) == 0 || errno == EINVAL);
  const std::string why = reason();
  if (file >= 0) ::close(file);
  if (!kept && !hidden)
    throw UserError(Exit::ReadWrite, {path.string()}, "the folder could not be flushed to the disk: " + why,
                    "check that it is still there");
}

} // namespace rend
