// What must be removed if the program ends without unwinding: temporary files, and folders that stayed empty.
//
// An error that propagates to main() runs destructors, which remove them. When memory has run out, or a library
// aborts (render/console/fatal_errors.h), the stack is not unwound, and remove_temporaries() does it: it
// allocates no memory, and may be called from a signal handler.
//
//   TemporaryPath part;         until register_path(), a program that ends waits for this file, for a moment
//   ... creates the file
//   part.register_path(name);   keeps the pointer: the name must outlive it
//   ... writes it, renames or removes it
//   part.unregister();          also done by its destructor
#pragma once

namespace rend {

class TemporaryPath {
public:
  TemporaryPath();
  explicit TemporaryPath(const char* path); // calls register_path(path)
  ~TemporaryPath();
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;

  // A file, or a folder, which is removed only if it is empty; it need not exist yet.
  void register_path(const char* path);
  void remove_contents(); // it is a folder to be removed with the files in it
  void unregister();      // removed, renamed, or to be kept

private:
  friend void remove_temporaries() noexcept;
  void remove() const noexcept;

  const char* path_ = nullptr; // null: none yet
  bool with_files_ = false, opening_ = true;
  TemporaryPath *before_ = nullptr, *after_ = nullptr; // doubly linked list of all objects
};

// Removes all registered files and folders, the newest first. Call it only before the program ends: other
// threads that are about to create a file block for ever.
void remove_temporaries() noexcept;

} // namespace rend
