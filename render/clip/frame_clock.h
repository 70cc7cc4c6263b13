// The steps at which the frames of a clip are taken, and the frames that the user chose.
//
// Frame k shows the first state at or after k/fps. Frames never alter the steps: where no step falls on k/fps,
// the picture is up to one step late.
#pragma once

#include <string>
#include <vector>

namespace rend {

class FrameClock {
public:
  // A clip of `duration` [s], in steps of `step` [s], with `fps` pictures a second.
  FrameClock(double duration, double step, double fps);

  double duration() const { return duration_; }
  double fps() const { return fps_; }
  long steps() const { return steps_; }   // of the first step whose state is at or after the duration
  long frames() const { return frames_; } // frames 0 .. frames()-1 lie within the duration
  double time_of(long frame) const { return static_cast<double>(frame) / fps_; } // [s]
  long step_of(long frame) const; // number of steps done when the frame is taken

private:
  double duration_, step_, fps_;
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
