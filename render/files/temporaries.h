// What is to be gone when the program ends at once: temporary files, and folders that nothing was written to.
//
// Where an error goes up to main() destructors remove them. Where memory is gone, or a library gives up
// (render/console/last_resort.h), nothing is unwound any more, and remove_temporaries() does it: it asks for no
// memory, and may be called from a signal handler.
//
//   TemporaryPath part;      from here to is() the program waits a moment before it ends
//   ... creates the file
//   part.is(name);           by pointer: a name that outlives it
//   ... writes it, renames or removes it
//   part.is_gone();          as its destructor does
#pragma once

namespace rend {

class TemporaryPath {
public:
  TemporaryPath();
  explicit TemporaryPath(const char* path); // is() at once
  ~TemporaryPath();
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;

  // A file, or a folder; it need not be there yet. A folder goes if it is empty.
  void is(const char* path);
  void holds_files(); // a folder that goes with the files in it
  void is_gone();     // or is to stay

private:
  friend void remove_temporaries() noexcept;
  void remove() const noexcept;

  const char* path_ = nullptr; // null: none yet
  bool with_files_ = false, opening_ = true;
  TemporaryPath *before_ = nullptr, *after_ = nullptr; // in the list of all
};

// Removes all that there are, the newest first. The program is to end then: what other threads are about to
// create waits for that.
void remove_temporaries() noexcept;

} // namespace rend
