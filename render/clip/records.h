// Files that a run leaves beside its pictures: figures over time, and topological changes. Both appear whole
// or not at all; numbers have as many digits as it takes to read them back unchanged.
#pragma once

#include "render/files/output.h"
#include "sim/scene/scene.h"

#include <filesystem>
#include <string>

namespace rend {

// A CSV file with one row a frame, nine columns for each probe among them: cells are empty where there is
// nothing to tell. Rows are held back as pictures are (film.h).
class Diagnostics {
public:
  explicit Diagnostics(const std::filesystem::path& path); // throws UserError (CannotCreate)
  void add(long frame, const Scene& scene);
  void finish();  // the end was reached: all rows
  void abandon(); // the state went wrong: without the last row; no file if there was no other

private:
  void flush();
  OutputFile file_;
  std::string text_, held_;
  bool any_ = false; // rows that are not held
};

// Topological changes as JSON, one a line, in the order of time; of one step, in the order of bodies. To be
// written of scenes with births alone (SceneOptions).
class EventFile {
public:
  explicit EventFile(const std::filesystem::path& path); // throws UserError (CannotCreate)
  void write(const Scene& scene);

private:
  OutputFile file_;
};

} // namespace rend
