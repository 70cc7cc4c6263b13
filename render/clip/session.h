// A run of a preset: what its options say, and the time loop that stops at every frame.
#pragma once

#include "render/clip/frame_clock.h"
#include "render/picture/scene_preset.h"
#include "sim/base/wall_clock.h"
#include "sim/scene/scene.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace rend {

// Options of the command line that all runs share.
struct SessionOptions {
  std::string preset;
  std::vector<std::string> sets; // PATH=VALUE
  std::optional<long> steps;     // instead of the duration
  std::optional<double> fps;     // instead of the preset's
  int threads = 0;               // 0: as many as the machine has
  std::string kernels = "flat";  // or walk
  bool quiet = false;
  bool allow_path = false; // meshes from anywhere
  bool guard = true;       // steps that go wrong are redone in parts
  bool births = false;     // events tell how many fragments there are
  bool profile = false;    // where the time of steps goes is asked for
};
void add_preset_options(CLI::App& app, SessionOptions& options); // the preset and --set
void add_run_options(CLI::App& app, SessionOptions& options);    // those, and how it is run

enum class Stopped { No, Interrupted, Unstable };
const char* name_of(Stopped stopped); // "unstable"

class Session {
public:
  // Reads the preset and builds the scene. Throws UserError; nothing was written then. Prints the bodies'
  // notes.
  explicit Session(const SessionOptions& options);

  const PresetNode& preset() const { return *preset_; }
  // Of all that the states of this run hang on: the preset's text, what was set, meshes, how it is run, rend's
  // version. Reads the meshes once more.
  std::uint64_t key() const;
  const std::string& preset_path() const { return options_.preset; }
  Scene& scene() { return *scene_; }
  const Scene& scene() const { return *scene_; }
  const FrameClock& clock() const { return *clock_; }
  const PictureSettings& picture() const { return picture_; }
  const ImageSettings& image() const { return picture_.image; }
  int threads() const; // that were asked for, or all that the machine has
  bool quiet() const { return options_.quiet; }

  // Called in the time loop.
  struct Calls {
    std::function<void(long frame)> frame; // the state of a frame is reached, from frame 0 on
    std::function<void()> step;            // after each step; may be empty
  };
  // How many steps run() does for this last frame.
  long last_step(long last_frame) const;
  // Steps until frame `last_frame`, or the end if it is the last of all; or until a signal or an instability.
  // failure() then says what went wrong. The state is that of a scene that was stored when `first_frame` was
  // next.
  Stopped run(long last_frame, const Calls& calls, long first_frame = 0);

  const std::optional<Unstable>& failure() const { return failure_; }
  double step_seconds() const { return step_seconds_; } // in the loop, without the calls at frames

private:
  Stopped loop(long first_frame, long last_frame, const Calls& calls, double& away);
  void check_counts() const;

  SessionOptions options_;
  std::uint64_t text_hash_ = 0; // of the preset, as it was read
  std::unique_ptr<PresetNode> preset_;
  std::unique_ptr<Scene> scene_; // reads from the preset for as long as it lives
  std::unique_ptr<FrameClock> clock_;
  PictureSettings picture_; // reads from the preset too
  std::optional<Unstable> failure_;
  double step_seconds_ = 0;
};

// The exit code of a run; says what went wrong, if anything did, and which bodies are gone.
Exit end_of(const Session& session, Stopped stopped);

} // namespace rend
