// Turns the states of a run into pictures and hands them to the pipeline.
//
// A frame is held back until the simulation has advanced to a later frame or has ended normally: a simulation
// that becomes unstable at once leaves nothing behind, and no picture shows the last state before an
// instability. OpenGL is started and the folder created when the first frame is released; a folder that was
// created here and stays empty is removed.
//
// With motion blur a frame consists of the states that the shutter has seen until it closes at the frame
// (FrameClock::moments_of).
//
// A run that is stopped by a signal releases the frames that it holds, and records them in its checkpoint: if
// the simulation becomes unstable before the next frame after resuming, those pictures are removed again, so
// that the result is that of an uninterrupted run.
#pragma once

#include "render/clip/frame_plan.h"
#include "render/clip/pass_through.h"
#include "render/clip/session.h"
#include "render/files/output_folder.h"
#include "render/picture/scene_picture.h"
#include "render/pipeline/pipeline.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rend {

class FrameOutput {
public:
  // Throws UserError where the folder could not be created, or the machine cannot draw or encode. Prints notes
  // on what the pictures will not show.
  FrameOutput(Session& session, const PipelineOptions& options, const FramePlan& plan);
  ~FrameOutput();
  FrameOutput(const FrameOutput&) = delete;
  FrameOutput& operator=(const FrameOutput&) = delete;

  void expose(long frame); // with a shutter: looks at the current state for the picture of this frame
  void take(long frame);   // takes the current state
  // Call before take() of a frame: flushes all earlier frames to the disk. False if one of them shows the
  // current state and is still held back.
  bool flush_earlier();
  const OutputFolder& folder() const { return folder_; }
  void flush_all();             // after a signal: flushes all frames, held ones too; creates the folder
  void store(Archive& archive); // what pictures remember; after flush_earlier() or flush_all()

  // At the end, or after a signal: held frames are written too, and files are closed. A video that a signal
  // cuts short keeps the name of a part.
  void finish(Stopped stopped);
  // The state became unstable, or is lost by a stop within a step: held frames are dropped, earlier ones stay;
  // files are closed as by finish().
  void abandon(Stopped stopped);

  long frames() const { return frames_; } // passed to the pipeline
  // what the pictures so far show that is likely a mistake
  const std::vector<std::string>& notes() const { return pass_through_.notes(); }
  PipelineSeconds seconds() const;
  double picture_seconds() const { return maker_.seconds(); }
  std::size_t surface_bytes() const { return maker_.bytes(); }

private:
  struct Held { // a frame that shows the held state
    long number = 0;
    FrameCamera camera = {};
    std::vector<FrameMoment> moments = {}; // of the time for which the shutter was open
    std::vector<FrameState> states = {};
  };
  struct Exposed { // a state that was looked at while the shutter was open
    long step = 0;
    FrameState state;
    std::vector<FrameCamera> cameras; // of each moment
  };
  void develop(Held& out);
  void release();
  void start();
  void push(Frame&& frame);
  void close(Stopped stopped);

  Session& session_;
  PipelineOptions options_;
  OutputFolder folder_;
  FramePlan plan_;
  FrameBuilder maker_;
  PassThrough pass_through_;
  std::unique_ptr<Pipeline> pipeline_;
  PipelineSeconds seconds_; // valid once the pipeline is closed
  std::optional<Frame> held_;
  std::vector<Held> held_frames_;
  std::vector<Exposed> exposed_; // for the next frame
  long held_step_ = -1;
  std::vector<long> flushed_early_; // frames of the state of held_step_ that flush_all() wrote
  long frames_ = 0;
};

} // namespace rend
