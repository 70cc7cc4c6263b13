// The states of a run on their way to files, one a frame, numbered as pictures are.
//
// A state is held back until the simulation has gone on, or has ended well, as pictures are (film.h). A state
// that several frames show is written once, under the number of the first, unless the format is one whose
// readers go by the numbers alone. The index comes last, and lists what there is.
#pragma once

#include "render/clip/figures.h"
#include "render/clip/named_files.h"
#include "render/clip/session.h"
#include "render/files/output_folder.h"
#include "sim/export/format.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace rend {

class ExportSeries {
public:
  // Before the first step. Throws UserError (CannotCreate) where nothing could be written to the folder.
  ExportSeries(const Session& session, const ExportFormat& format, const std::filesystem::path& folder,
               const FrameChoice& choice);

  void name_files(NamedFiles& files) const; // that it may write

  void take(long frame); // of the present state
  void finish();         // the end was reached, or a signal came
  void abandon();        // the state went wrong: what is held is dropped

  ExportFigures figures() const;

private:
  void release();
  void write(const std::string& name, const std::string& bytes);
  // Empty: the format has no index.
  std::string index_name() const {
    return format_.index_extension.empty() ? "" : session_.scene().name() + format_.index_extension;
  }

  const Session& session_;
  const ExportFormat& format_;
  OutputFolder folder_;
  FrameChoice choice_;
  std::unique_ptr<Exporter> exporter_;
  std::string held_;                     // bytes of a file; empty: none is held
  std::vector<ExportedFile> held_files_; // what it is going to be: one, or one for each frame that shows it
  long held_step_ = -1;                  // of the state taken last
  std::vector<ExportedFile> files_;      // that were written
  std::size_t bytes_ = 0;
  double seconds_ = 0;
};

// The format called `name`. Throws UserError (Usage) where there is none.
const ExportFormat& export_format(const std::string& name);

} // namespace rend
