// Frames of a run on their way to files.
//
// A frame is held back until the simulation has gone on to a later frame, or has ended well: a simulation
// that explodes at once leaves nothing behind, and no picture shows the state that was about to explode.
// OpenGL is started and the folder made when the first frame is let go; a folder that was made here and stays
// empty is removed.
//
// A run that a signal stops lets go what it holds, and remembers that in its checkpoint: should the simulation
// explode before the next frame once it goes on, those pictures are removed again, as if it had never been
// stopped.
#pragma once

#include "render/clip/frame_plan.h"
#include "render/clip/session.h"
#include "render/files/output_folder.h"
#include "render/picture/scene_picture.h"
#include "render/pipeline/pipeline.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rend {

class Film {
public:
  // Throws UserError where the folder could not be made, or the machine could not draw or encode. Tells what
  // pictures will not show.
  Film(Session& session, const PipelineOptions& options, const FramePlan& plan);
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  void take(long frame); // of the present state
  // Before take() of a frame: brings all frames before it to the disk. False where one of them shows the
  // present state, and is held.
  bool settle();
  const OutputFolder& folder() const { return folder_; }
  void pause();                 // a signal came: brings all there is to the disk; the folder is there
  void store(Archive& archive); // what pictures follow; after settle() or pause()

  void finish();  // the end was reached, or a signal came: what is held goes out too, and files are closed
  void abandon(); // the state went wrong: what is held is dropped; frames before it stay, files are closed

  long frames() const { return frames_; } // handed on
  PipelineSeconds seconds() const;
  double picture_seconds() const { return maker_.seconds(); }
  std::size_t surface_bytes() const { return maker_.bytes(); }

private:
  void release();
  void start();
  void push(Frame&& frame);
  void close();

  Session& session_;
  PipelineOptions options_;
  OutputFolder folder_;
  FramePlan plan_;
  PictureMaker maker_;
  std::unique_ptr<Pipeline> pipeline_;
  PipelineSeconds seconds_; // once it is closed
  std::optional<Frame> held_;
  std::vector<std::pair<long, FrameCamera>> showings_; // the frames that show the held state
  long held_step_ = -1;
  std::vector<long> early_; // frames that show the state of held_step_, and are files: pause() let them go
  long frames_ = 0;
};

} // namespace rend
