// Makes the pictures of a run, from its first frame or from a checkpoint.
//
// Existing pictures are detected one by one (frame_plan.h). The simulation starts from the latest checkpoint
// whose next frame is not after the first missing one, or from the start if there is none. A checkpoint of this
// run means that the run has not completed: it continues to its end even if no picture is missing, since it
// might become unstable on the way and then has to remove the pictures of that state (frame_output.h). A
// checkpoint beyond this run's end comes from a run with more frames: it is kept, and this run writes none over
// it.
//
// A video is encoded while the pictures are made; if some existed before, it is encoded from the PNG files at
// the end instead: an encoder needs all frames in order, and PNG is lossless, so the bytes are those of an
// uninterrupted run.
#pragma once

#include "render/clip/checkpoint.h"
#include "render/clip/frame_output.h"
#include "render/clip/frame_plan.h"
#include "render/clip/session.h"

#include <limits>

namespace rend {

struct ClipRunOptions {
  PipelineOptions files;
  FrameChoice choice;
  Shard shard;
  bool resume = false;
  double checkpoint_every = 60; // [s] of wall-clock time, at frames; 0: only after a signal
};

class ClipRun {
public:
  // Finds existing pictures and checkpoints. UserError (BadInput): a checkpoint with another key; (Usage): no
  // frames.
  ClipRun(Session& session, const ClipRunOptions& options);

  Stopped run();

  long frames_made() const { return frame_output_ ? frame_output_->frames() : 0; }
  long frames_kept() const { return existing_; } // existed already
  // false: all pictures exist, and the scene stays in its initial state
  bool simulates() const { return last_ >= 0; }
  bool left_checkpoint() const { return left_checkpoint_; }
  const FrameOutput& output() const { return *frame_output_; }

private:
  bool keeps_checkpoints() const { return options_.files.png && !keeps_later_checkpoint_; }
  bool is_within_run(long next) const;
  void begin();
  Stopped simulate();
  void checkpoint(long next);
  void checkpoint_if_due(long next);
  void remove_checkpoint() const;
  Stopped video_of_files();

  Session& session_;
  ClipRunOptions options_;
  FramePlan plan_;
  std::filesystem::path checkpoint_;
  std::string key_;                    // of the checkpoint
  Stopped camera_found_ = Stopped::No; // Interrupted: before it was known where the camera stands
  bool video_at_end_ = false, left_checkpoint_ = false;
  bool keeps_later_checkpoint_ = false; // the existing checkpoint is beyond this run's end
  long existing_ = 0;                   // frames that exist
  long first_ = 0, last_ = -1;          // frames: the next one at the start; the last one, or -1: none
  double due_ = std::numeric_limits<double>::infinity(); // [s], wall clock: when the next checkpoint is due
  std::optional<FrameOutput> frame_output_;
};

} // namespace rend
