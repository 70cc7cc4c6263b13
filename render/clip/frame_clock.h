// The steps at which the frames of a clip are taken, and the frames that the user chose.
//
// Frame k is shown at k/fps of the clip. It shows the first state at or after the time t that the simulation
// has then: t = k/fps, or where the clip plays at another speed the integral of the speed until k/fps
// (playback.h). Frames never alter the steps: where no step falls on t, the picture is up to one step late.
#pragma once

#include "render/picture/playback.h"

#include <string>
#include <vector>

namespace rend {

// The shutter of the camera: it closes at the time of a frame.
struct Shutter {
  double open = 0; // share of the time between two frames; 0: all pictures are of one moment
  int samples = 8; // moments of that time of which a picture is made
};

// A moment at which the shutter is open.
struct Moment {
  double time = 0;  // [s], of the simulation
  long step = 0;    // it shows the state after so many steps,
  double share = 1; // or so far of the way there from the state before, at least 0
};

class FrameClock {
public:
  // `duration` [s] of simulation in steps of `step` [s], with `fps` pictures a second of the clip.
  FrameClock(double duration, double step, double fps, Playback playback = Playback(), Shutter shutter = {});

  double duration() const { return duration_; }                      // [s], of the simulation
  double clip_duration() const { return playback_.clip(duration_); } // [s], of the clip
  const Playback& playback() const { return playback_; }
  double fps() const { return fps_; }
  long steps() const { return steps_; }   // of the first step whose state is at or after the duration
  long frames() const { return frames_; } // frames 0 .. frames()-1 lie within the duration
  double time_of(long frame) const { return playback_.simulated(static_cast<double>(frame) / fps_); } // [s]
  long step_of(long frame) const; // number of steps done when the frame is taken

  // The moments of which the picture of a frame is the mean, in order of time; none without a shutter. They
  // are the middles of equal parts of the time of the clip for which the shutter is open, and frame 0 has its
  // start. A moment shows the first state at or after it. Where steps are longer than the time between
  // moments, that would blur into a few sharp pictures; there it lies between two neighbouring states, and
  // positions are interpolated. No moment looks further back than to the state of the frame before: so what a
  // run has to remember between two frames is the state alone.
  std::vector<Moment> moments_of(long frame) const;
  // The first step whose state is looked at for the picture of a frame of the clip.
  long first_step(long frame) const;
  bool has_shutter() const { return shutter_.open > 0; }

private:
  long step_at(double time) const; // of the first state at or after a time

  double duration_, step_, fps_;
  Playback playback_;
  Shutter shutter_;
  long steps_, frames_;
};

// The frames that the user asked for: "7", "0-100", "0-100x2", "10-", or several with commas between.
class FrameChoice {
public:
  FrameChoice() = default; // all
  // UserError (Usage) if the text is not such a list.
  explicit FrameChoice(const std::string& text);

  bool has(long frame) const;
  long last(long frames) const; // the last chosen one of 0 .. frames-1; -1: none of them

private:
  struct Range {
    long first = 0, last = 0, stride = 1;
  };
  bool all_ = true;
  std::vector<Range> ranges_;
};

// The last chosen frame of the clip. UserError (Usage) if none of them lies within the clip.
long last_chosen(const FrameChoice& choice, const FrameClock& clock);

// "1280x720". UserError (Usage) if it is not a size, or a side is not between 16 and 8192 pixels.
struct PictureSize {
  int width = 0, height = 0; // [pixels]
};
PictureSize parse_size(const std::string& text);

} // namespace rend
