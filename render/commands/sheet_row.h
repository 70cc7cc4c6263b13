// A row of a contact sheet: one preset simulated, at three moments, or at its end alone.
#pragma once

#include "render/clip/session.h"
#include "render/draw/frame.h"

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace rend {

class FrameBuilder;

// Frames are chosen while the clip runs: the first; the one a twentieth of the clip after the first tear (the
// middle one if nothing tears by then); the last.
class SheetRow {
public:
  static constexpr int moments = 3;

  // `aspect`: width / height of a picture. Nothing is simulated yet.
  SheetRow(const SessionOptions& options, double aspect, bool end_alone);

  // Simulates the clip. What comes of it is known then: frames, tears, times.
  Exit run();

  const Frame& shown(int k) const { return frames_[static_cast<std::size_t>(end_alone_ ? moments - 1 : k)]; }
  std::array<double, moments> times() const { return times_; } // [s], of the pictures
  std::optional<double> tear() const {
    return tear_time_;
  }                                            // [s], of the picture after the first tear; none: none
  std::size_t tears() const { return tears_; } // at the end
  int samples() const { return samples_; }     // of the picture
  const std::string& threshold_unit() const {
    return unit_;
  } // of all its laws; empty: they differ, or have none

  // Makes the frame at `time` [s], or at the end where that is earlier, the middle one; simulates again up to
  // there unless it is there already.
  Exit set_middle(double time);

private:
  // Calls back at each frame up to the last.
  Exit simulate(Session& session, long last, const std::function<void(long, FrameBuilder&)>& frame);

  SessionOptions options_;
  double aspect_;
  bool end_alone_;
  std::array<Frame, moments> frames_;
  std::array<double, moments> times_{};
  std::optional<double> tear_time_;
  std::size_t tears_ = 0;
  int samples_ = 1;
  std::string unit_;
};

// The rows of one preset have their middle pictures at one time: that of the row that tears first.
Exit set_middles(std::span<SheetRow> rows);

} // namespace rend
