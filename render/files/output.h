// A file that is written atomically: it appears complete or not at all.
//
// It is written under a temporary name in the same folder (rename is atomic only within one file system),
// flushed to the disk (fsync), and renamed. Until commit() an existing file is untouched; without commit() the
// temporary file is removed. The temporary name is fixed (NAME.part), so that what a killed run leaves behind
// is replaced by the next run and does not accumulate.
//
// Nothing is ever written through a link. The temporary file is created with O_EXCL, and locked while it is
// written (flock(2), released when the program ends). If its name is taken, that file is removed if it can only
// be a killed run's: a regular file of this user, with one hard link, whose lock is free. Anything else is
// kept, unopened, and NAME.2.part is used: if two programs write the same file at once, the last to finish
// wins. If the second one is killed, the next commit() removes its temporary file. The final name may be a link
// or another user's file: rename replaces the name, not the target.
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
  const std::filesystem::path& temporary() const { return temporary_; } // for libraries that open files by name

  void write(std::span<const std::uint8_t> bytes);    // throws UserError (ReadWrite)
  std::int64_t seek(std::int64_t offset, int whence); // as lseek(2)
  void commit();                                      // fsync and rename; throws UserError (ReadWrite)
  void leave(); // fsync; the file keeps its temporary name. Throws UserError (ReadWrite)

private:
  // base_temporary_: the temporary name without a number
  std::filesystem::path path_, base_temporary_, temporary_;
  TemporaryPath part_; // registers temporary_ while the file exists
  int file_ = -1;      // descriptor; -1 once closed
};

// Removes temporary files of killed runs; one that is being written is kept.
void remove_leftover(const std::filesystem::path& path);

// Writes a whole file at once. Throws as OutputFile does.
void write_atomically(const std::filesystem::path& path, const std::string& bytes);

// The file that a user's path stands for: a symbolic link in the path that the user named is followed, even if
// its target does not exist yet. Throws UserError (CannotCreate) where links form a cycle.
std::filesystem::path resolve_link(const std::filesystem::path& path);

// Flushes a folder's entries to the disk: only then does a renamed file survive a crash of the system. Too slow
// to do for every picture. "" is the current folder. Throws UserError (ReadWrite).
void sync_folder(const std::filesystem::path& folder);

} // namespace rend
