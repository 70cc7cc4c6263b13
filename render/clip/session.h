// A run of a preset: its options, and the time loop that calls back at every frame.
#pragma once

#include "render/clip/frame_clock.h"
#include "render/console/command_line.h"
#include "render/picture/scene_preset.h"
#include "sim/base/wall_clock.h"
#include "sim/scene/scene.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rend {

// Command line options that all runs share.
struct SessionOptions {
  std::string preset;
  std::vector<std::string> sets; // PATH=VALUE
  std::optional<long> steps;     // instead of the duration
  std::optional<double> fps;     // instead of the preset's
  int threads = 0;               // 0: as many as the machine has
  std::string kernels = "flat";  // or walk
  bool quiet = false;
  bool allow_path = false;         // meshes, rules, pictures may lie outside the preset's folder
  bool guard = true;               // bad steps are rolled back and redone in substeps
  bool count_fragments = false;    // events record how many fragments there are
  bool reach = false;              // largest values of all criteria, without tearing
  std::optional<long> reach_every; // steps between looks at them
  bool profile = false;            // the time of each stage of the step is measured
};
void add_preset_options(const CommandLine& app, SessionOptions& options); // the preset and --set
void add_run_options(const CommandLine& app,
                     SessionOptions& options); // those, and the options of the simulation

enum class Stopped { No, Interrupted, Unstable };
const char* name_of(Stopped stopped); // "unstable"

class Session {
public:
  // Reads the preset and builds the scene. Throws UserError, before any file is written. Prints the bodies'
  // notes.
  explicit Session(const SessionOptions& options);

  const PresetNode& preset() const { return *preset_; }
  // A hash of everything that the states of this run depend on: the preset's text, overrides, meshes, options
  // of the simulation, rend's version. Reads the mesh files again.
  std::uint64_t key() const;
  const std::string& preset_path() const { return options_.preset; }
  const SessionOptions& options() const { return options_; }
  Scene& scene() { return *scene_; }
  const Scene& scene() const { return *scene_; }
  const FrameClock& clock() const { return *clock_; }
  const PictureSettings& picture() const { return picture_; }
  const ImageSettings& image() const { return picture_.image; }
  void set_camera_room(const Eigen::AlignedBox3d& room) { picture_.camera.room = room; } // [m]
  int threads() const; // that were asked for, or all that the machine has
  bool quiet() const { return options_.quiet; }
  bool reaches() const { return options_.reach; } // nothing tears: largest values of criteria are looked for

  // Callbacks of the time loop.
  struct Callbacks {
    // At the state of each frame, from frame 0 on, once it is certain (Scene::show_when_settled).
    std::function<void(long frame)> frame;
    std::function<void()> step; // after each step; may be empty
    // Before that, at each state that the picture of the frame looks at while the shutter is open
    // (FrameClock); may be empty.
    std::function<void(long frame)> moment = {};
    // Where nothing of this frame or a later one has been looked at, and all earlier ones have been shown: the
    // state may be stored. Not for every frame; may be empty.
    std::function<void(long frame)> between = {};
  };
  // The number of steps that run() does up to this last frame.
  long last_step(long last_frame) const;
  // Steps until frame `last_frame` (or the end of the clip, if it is the last frame), a signal, or an
  // instability, which failure() then describes. After a signal the scene goes back to where its last frame was
  // certain; while the shutter is open it goes on until it is not, or for no longer than the grace of a stop
  // (stop_request.h). To resume, restore first a state stored when `first_frame` was the next frame.
  Stopped run(long last_frame, const Callbacks& calls, long first_frame = 0);

  // Whether a run that was interrupted can go on from the state where it stopped: not where the shutter is
  // open, and not always within a step.
  bool can_be_stored() const { return can_be_stored_; }

  const std::optional<Unstable>& failure() const { return failure_; }
  double step_seconds() const { return step_seconds_; } // in the time loop, without the calls at frames

private:
  class FrameCursor;
  struct FrameWatch;
  Stopped loop(long first_frame, long last_frame, const Callbacks& calls, double& callback_seconds);
  Stopped loop(FrameWatch& watch, long last_step, const Callbacks& calls, double& callback_seconds);
  void look(FrameWatch& watch, const Callbacks& calls, double& callback_seconds);
  void check_counts() const;

  SessionOptions options_;
  std::uint64_t text_hash_ = 0; // of the preset's file, as it was read
  std::unique_ptr<PresetNode> preset_;
  std::unique_ptr<Scene> scene_; // refers to the preset for as long as it lives
  std::unique_ptr<FrameClock> clock_;
  PictureSettings picture_; // reads from the preset too
  std::optional<Unstable> failure_;
  bool can_be_stored_ = true;
  double step_seconds_ = 0;
};

// The exit code of a run; prints what went wrong, if anything, and which bodies have been removed.
Exit exit_code_of(const Session& session, Stopped stopped);

} // namespace rend
