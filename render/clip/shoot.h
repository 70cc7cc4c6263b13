// The pictures of a run, from its first frame or from where an earlier run was stopped.
//
// What is there already is found out picture by picture (frame_plan.h). The simulation begins at the checkpoint
// whose next frame is the last that is not after the first one missing, and at the start where there is none.
// Where this run has a checkpoint it was not at its end: it goes on to there even if no picture is missing,
// since it might explode on the way, and then keeps no picture of the state that did (film.h). A checkpoint of
// a state after this run's end is of one that was asked for more frames: it stays, and this run writes none
// over it.
//
// A video is made of the pictures as they come; where some were there before, of the files at the end: encoders
// go through a clip once, and pictures lose nothing in a PNG, so that the bytes are those of a run that was
// never stopped.
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
  double checkpoint_every = 60; // [s] on the clock, at frames; 0: only when a signal comes
};

class Shoot {
public:
  // Looks at what is there. UserError (BadInput): a checkpoint of something else; (Usage): no frames.
  Shoot(Session& session, const ShootOptions& options);

  Stopped run();

  long made() const { return film_ ? film_->frames() : 0; } // frames
  long kept() const { return kept_; }                       // that were there
  bool simulates() const { return last_ >= 0; } // false: all was there, and the scene is as it was built
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
  std::string key_; // of it
  bool video_at_end_ = false, left_checkpoint_ = false;
  bool spares_ = false;        // the checkpoint there is of a state after this run's end
  long kept_ = 0;              // frames that are there
  long first_ = 0, last_ = -1; // frames: the next when it begins; the last, or -1: none
  double due_ = std::numeric_limits<double>::infinity(); // [s], on the clock: the next checkpoint
  std::optional<Film> film_;
};

} // namespace rend
