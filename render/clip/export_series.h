// Writes the states of a run to files, one a frame, numbered as pictures are.
//
// A state is held back until the simulation has advanced beyond it or has ended normally, as pictures are
// (frame_output.h). A state that several frames show is written once, under the number of the first, unless the
// readers of the format go by file numbers alone. The index file is written last, and lists the files that
// exist; so are SCENE.scene.json, which tells what meshes cannot (scene_file.h), and files that states name.
#pragma once

#include "render/clip/figures.h"
#include "render/clip/named_files.h"
#include "render/clip/scene_file.h"
#include "render/files/output_folder.h"
#include "sim/export/format.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace rend {

class ExportSeries {
public:
  // Before the first step. Throws UserError (CannotCreate) where the folder is not writable.
  ExportSeries(const Session& session, const ExportFormat& format, const std::filesystem::path& folder,
               const FrameChoice& choice);

  void name_files(NamedFiles& files) const; // registers every file that it may write

  void take(long frame); // takes the current state
  void finish();         // at the end, or after a signal: also writes the state that is held back
  void abandon();        // the state became unstable: what is held back is dropped

  ExportFigures figures() const;

private:
  void hold(long frame, long step); // the current state, for a frame that shows it
  void release();
  void write(const std::string& name, const std::string& bytes);
  // Empty: the format has no index.
  std::string index_name() const {
    return format_.index_extension.empty() ? "" : session_.scene().name() + format_.index_extension;
  }
  std::string scene_file_name() const { return session_.scene().name() + ".scene.json"; }

  const Session& session_;
  const ExportFormat& format_;
  OutputFolder folder_;
  FrameChoice choice_;
  std::unique_ptr<Exporter> exporter_;
  SceneFile scene_file_;
  std::string held_;                                // the bytes of the state that is held back; empty: none
  std::vector<ExportedFile> held_files_;            // its file names: one, or one for each frame that shows it
  std::vector<nlohmann::ordered_json> held_frames_; // of the scene file: those that show it
  long held_step_ = -1;                             // step number of the last state taken
  std::vector<ExportedFile> files_;                 // files written so far
  std::size_t bytes_ = 0;
  double seconds_ = 0;
};

// The format called `name`. Throws UserError (Usage) where there is none.
const ExportFormat& export_format(const std::string& name);

} // namespace rend
