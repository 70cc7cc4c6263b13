// Makes the pictures of a run, from its first frame or from a checkpoint.
//
// Existing pictures are detected one by one (frame_plan.h). The simulation starts from the latest checkpoint
// whose next frame is not after the first missing one, or from the start if there is none. A checkpoint of this
// run means that the run has not completed: it continues to its end even if no picture is missing, since it
// might become unstable on the way and then has to remove the pictures of that state (film.h). A checkpoint
// beyond this run's end comes from a run with more frames: it is kept, and this run writes none over it.
//
// A video is encoded while the pictures are made; if some existed before, it is encoded from the PNG files at
// the end instead: an encoder needs all frames in order, and PNG is lossless, so the bytes are those of an
// uninterrupted run.
#pragma once

#include "render/clip/checkpoint.h"
#include "render/clip/film.h"
#include "render/clip/frame_plan.h"
#include "render/clip/session.h"

#include <limits>

namespace rend {

struct ShootOptions {
  PipelineOptions files;
  FrameChoice choice;
  Shard shard;
  bool resume = false;
  double checkpoint_every = 60; // [s] of wall-clock time, at frames; 0: only after a signal
};

class Shoot {
public:
  // Finds existing pictures and checkpoints. UserError (BadInput): a checkpoint with another key; (Usage): no
  // frames.
  Shoot(Session& session, const ShootOptions& options);

  Stopped run();

  long made() const { return film_ ? film_->frames() : 0; } // frames made
  long kept() const { return kept_; }                       // frames that existed
  // false: all pictures exist, and the scene stays in its initial state
  bool simulates() const { return last_ >= 0; }
  bool left_checkpoint() const { return left_checkpoint_; }
  const Film& film() const { return *film_; }

private:
  bool keeps_checkpoints() const { return options_.files.png && !spares_; }
  bool is_on_the_way(long next) const;
  void begin();
  Stopped simulate();
  void checkpoint(long next);
  void checkpoint_if_due(long next);
  void remove_checkpoint() const;
  Stopped video_of_files();

  Session& session_;
  ShootOptions options_;
  FramePlan plan_;
  std::filesystem::path checkpoint_;
  std::string key_; // of the checkpoint
  bool video_at_end_ = false, left_checkpoint_ = false;
  bool spares_ = false;        // the existing checkpoint is of a state after this run's end, and is kept
  long kept_ = 0;              // frames that exist
  long first_ = 0, last_ = -1; // frames: the next one at the start; the last one, or -1: none
  double due_ = std::numeric_limits<double>::infinity(); // [s], wall clock: when the next checkpoint is due
  std::optional<Film> film_;
};

} // namespace rend
