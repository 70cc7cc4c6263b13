// Text files with a run's history: figures over time (CSV) and topological changes (JSON lines). Both are
// written atomically; numbers have as many digits as it takes to read them back unchanged.
#pragma once

#include "render/files/output.h"
#include "sim/scene/scene.h"

#include <filesystem>
#include <string>

namespace rend {

// A CSV file with one row a frame, with nine columns for each probe; cells without a value are empty. Rows are
// held back as pictures are (frame_output.h).
class Diagnostics {
public:
  explicit Diagnostics(const std::filesystem::path& path); // throws UserError (CannotCreate)
  void add(long frame, const Scene& scene);
  void finish();  // at the end: writes all rows
  void abandon(); // the state became unstable: drops the last row; no file if there is no other

private:
  void flush();
  OutputFile file_;
  std::string text_, held_;
  bool any_ = false; // a row has been written (beyond the held one)
};

// Topological changes as JSON, one a line, ordered by time, and within a step by body. Needs a scene that
// records births of fragments (SceneOptions).
class EventFile {
public:
  explicit EventFile(const std::filesystem::path& path); // throws UserError (CannotCreate)
  void write(const Scene& scene);

private:
  OutputFile file_;
};

} // namespace rend
