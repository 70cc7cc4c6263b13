// A file that appears whole or not at all.
//
// It is written under a temporary name in the same folder (only a rename within one file system is atomic),
// brought to the disk, and renamed. Until commit() the old file, if any, is untouched; without commit() the
// temporary file is removed. The temporary name is fixed (NAME.part), so that what a killed run leaves behind
// is replaced by the next and never piles up.
//
// Nothing is ever written through a link. The temporary file is made anew (O_EXCL), and locked while it is
// written (flock(2), which ends with the program). Where there is something of its name already, that goes if
// it can only be a killed run's: a regular file of this user's, without a second name, whose lock is free.
// Anything else stays, unopened, and NAME.2.part is taken: of two programs that write the same file at once,
// the last to end wins. Were the second killed, commit() of the next removes what it left. The final name may
// be a link or another user's file: a rename replaces the name, and not what it leads to.
#pragma once

#include "render/files/temporaries.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace rend {

class OutputFile {
public:
  // Creates the temporary file. Throws UserError (CannotCreate; Usage for "-").
  explicit OutputFile(const std::filesystem::path& path);
  // The same with another temporary name, in the same folder.
  OutputFile(const std::filesystem::path& path, const std::filesystem::path& temporary);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& temporary() const { return temporary_; } // for libraries that write by name

  void write(std::span<const std::uint8_t> bytes);    // throws UserError (ReadWrite)
  std::int64_t seek(std::int64_t offset, int whence); // as lseek(2)
  void commit();                                      // fsync and rename; throws UserError (ReadWrite)

private:
  std::filesystem::path path_, wanted_, temporary_; // wanted_: the temporary name without a number
  TemporaryPath part_;                              // temporary_, as long as it is there
  int file_ = -1;                                   // descriptor; -1 once it is closed
};

// Removes the temporary files of runs that were killed; one that is being written stays.
void remove_leftover(const std::filesystem::path& path);

// The whole file at once. Throws as OutputFile does.
void write_whole(const std::filesystem::path& path, const std::string& bytes);

// The file that a name of the user's stands for: a link that he names is followed, even to what is not there
// yet. Throws UserError (CannotCreate) where links lead in a circle.
std::filesystem::path followed(const std::filesystem::path& path);

// Brings to the disk which files a folder has: a file that was renamed is there after a crash only then. Too
// dear for every picture. "" is the present folder. Throws UserError (ReadWrite).
void sync_folder(const std::filesystem::path& folder);

} // namespace rend
