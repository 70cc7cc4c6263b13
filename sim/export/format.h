// The file formats for states. To add one: a file with a function `ExportFormat my_format()`, and its name in
// all_export_formats().
#pragma once

#include "sim/export/skin_picture.h"
#include "sim/scene/scene.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rend {

// A file that was written, for the index.
struct ExportedFile {
  double time;      // [s], of the state
  std::string name; // in the folder of the index
};

// A file beside those of the states.
struct FileBeside {
  std::string name, bytes;
};

// Writes the states of one scene.
class Exporter {
public:
  virtual ~Exporter() = default;
  virtual std::string state() const = 0; // the bytes of a file with the current state
  // The bytes of the file that lists the others; only for formats that have one.
  virtual std::string index(std::span<const ExportedFile>) const { return {}; }
  // Files that those of the states name, and that are the same for all of them.
  virtual std::vector<FileBeside> beside() const { return {}; }
};

struct ExportFormat {
  std::string name, what;                 // "vtu", one line
  std::string extension, index_extension; // ".vtu", ".pvd"; empty: no index
  bool every_frame; // files are numbered by frame: a state shown in several frames is written for each
  // called in the scene's first state; the scene outlives the exporter
  std::unique_ptr<Exporter> (*make)(const Scene& scene, const SkinPictures& pictures);
};

// ExportFormat::make of an exporter.
template <class Made>
std::unique_ptr<Exporter> make_exporter(const Scene& scene, const SkinPictures& pictures) {
  return std::make_unique<Made>(scene, pictures);
}

const std::vector<ExportFormat>& all_export_formats();
const ExportFormat* find_export_format(const std::string& name); // null: there is none
std::vector<std::string> export_format_names();

// A body's name as one word, for text formats: blanks separate the names of several groups (.obj), and the end
// of a line ends a comment (.ply). Invisible characters become '_', and so does a backslash, which joins two
// lines of .obj; UTF-8 is kept.
std::string one_word(const std::string& name);

ExportFormat vtu_format();
ExportFormat ply_format();
ExportFormat obj_format();

} // namespace rend
