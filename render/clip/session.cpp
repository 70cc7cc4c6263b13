#include "render/clip/session.h"

#include "render/clip/early_tears.h"
#include "render/clip/inputs.h"
#include "render/clip/missed_obstacles.h"
#include "render/clip/picture_check.h"
#include "render/clip/run_estimate.h"
#include "render/console/console.h"
#include "render/console/number_option.h"
#include "render/console/signals.h"
#include "render/report/machine.h"
#include "sim/base/enum_words.h"
#include "sim/base/hash.h"
#include "sim/base/start_threads.h"
#include "sim/base/stop_request.h"
#include "sim/base/threads.h"
#include "sim/build/build_scene.h"
#include "sim/preset/paths.h"
#include "sim/preset/preset_reader.h"
#include "sim/scene/step_cause.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <limits>

namespace rend {

void add_preset_options(const CommandLine& app, SessionOptions& options) {
  app.add_option("preset", options.preset, "the preset: a scene, as an XML file")
      .required()
      .type_name("PRESET");
  app.add_option("--set", options.sets,
                 "replace an attribute of the preset, such as time.step=1e-4 (can be repeated)")
      .type_name("PATH=VALUE")
      .allow_extra_args(false);
  app.add_flag("--allow-path", options.allow_path,
               "allow the preset to name meshes, rules and pictures outside of its folder");
}

void add_run_options(const CommandLine& app, SessionOptions& options) {
  add_preset_options(app, options);
  app.add_option("--steps", options.steps, "simulate N steps instead of the preset's duration")
      .type_name("N")
      .transform(whole_number(0, 1000000000));
  app.add_option("--fps", options.fps,
                 "frames per second, of pictures, exports and diagnostics; default: the preset's")
      .type_name("N")
      .transform(real_number(1e-6, 1e6));
  app.add_option(
         "--threads", options.threads,
         "number of threads (the result is the same for any number); default: all that the machine has, of "
         "which a small scene uses fewer")
      .type_name("N")
      .transform(whole_number(1, 256));
  app.add_option("--kernels", options.kernels,
                 "how forces are computed (flat: from arrays; walk: from the mesh, slowly, for comparison); "
                 "default: flat")
      .type_name("flat|walk")
      .one_of({"flat", "walk"});
  app.add_flag("!--no-guard", options.guard,
               "stop with an error at a step that is too large, instead of repeating it as smaller steps");
  app.add_flag("-q,--quiet", options.quiet, "print no progress and no notes");
}

namespace {

// For the threads that the steps of the scene are going to use.
void note_refused_threads(const Scene& scene) {
  int wanted = 1;
  for (const auto& body : scene.bodies()) wanted = std::max(wanted, body->program->parts());
  start_threads(wanted);
  if (threads_refused()) note_fewer_threads();
}

} // namespace

Session::Session(const SessionOptions& options) : options_(options) {
  std::vector<Override> overrides;
  for (const std::string& set : options.sets) overrides.push_back(parse_override(set));
  const std::string text = read_preset_file(options.preset);
  text_hash_ = hash_bytes(text.data(), text.size());
  preset_ = load_scene_text(text, options.preset, overrides);
  if (!options.allow_path) check_paths(*preset_);
  picture_ = picture_settings(*preset_);
  if (options.fps) picture_.image.fps = *options.fps;
  scene_ = std::make_unique<Scene>(read_scene(*preset_, scene_pictures()),
                                   SceneOptions{.walk = options.kernels == "walk",
                                                .threads = threads(),
                                                .count_fragments = options.count_fragments,
                                                .set_between_steps = false,
                                                .guard = options.guard,
                                                .reach = options.reach,
                                                .look_every = options.reach_every,
                                                .steps = options.steps,
                                                .profile = options.profile});
  check_counts();
  const double step = scene_->step_size();
  const double duration = options.steps ? static_cast<double>(*options.steps) * step : scene_->duration();
  clock_ = std::make_unique<FrameClock>(duration, step, image().fps, image().playback(),
                                        Shutter{image().shutter, image().shutter_samples});
  check_looks(picture_, *scene_);
  check_camera(picture_, *scene_, image().aspect(), *clock_);
  if (options.quiet) return;
  note_refused_threads(*scene_);
  for (const std::string& note : scene_->notes()) print_note(note);
  for (const auto& body : scene_->bodies())
    for (const std::string& note : body->notes) print_note(fmt::format("body '{}': {}", body->name, note));
}

int Session::threads() const {
  return options_.threads > 0 ? options_.threads : hardware_threads();
}

std::uint64_t Session::key() const {
  std::string words = fmt::format("rend {}\n{:016x}\n", this_machine().version, text_hash_);
  for (const std::string& set : options_.sets) words += "set " + set + "\n";
  words += fmt::format("steps {} fps {} kernels {} guard {}\n", options_.steps.value_or(-1),
                       options_.fps.value_or(-1), options_.kernels, options_.guard);
  words += hashes_of_files(*preset_);
  return hash_bytes(words.data(), words.size());
}

void Session::check_counts() const {
  constexpr double most = std::numeric_limits<int>::max() / 2;
  const double step = scene_->step_size();
  const double duration = options_.steps ? static_cast<double>(*options_.steps) * step : scene_->duration();
  if (image().playback().clip(duration) * image().fps < most) return;
  preset_->child("time")->fail(
      "duration", fmt::format("{:g} s{} at {:g} pictures a second are more than {:.0f} frames", duration,
                              image().playback().is_real_time() ? "" : ", slowed down,", image().fps, most));
}

Stopped Session::run(long last_frame, const Callbacks& calls, long first_frame) {
  const double start = wall_clock();
  double callback_seconds = 0; // [s] spent in the calls at frames
  Stopped stopped = Stopped::No;
  try {
    stopped = loop(first_frame, last_frame, calls, callback_seconds);
  } catch (const Unstable& error) {
    failure_ = error;
    stopped = Stopped::Unstable;
  }
  step_seconds_ = wall_clock() - start - callback_seconds;
  return stopped;
}

long Session::last_step(long last_frame) const {
  const bool to_the_end = last_frame + 1 >= clock_->frames();
  return to_the_end ? clock_->steps() : clock_->step_of(last_frame);
}

// Goes through the states that the frames of a run need, in the order of their steps.
class Session::FrameCursor {
public:
  FrameCursor(const FrameClock& clock, bool moments, long first_frame, long last_frame)
      : clock_(clock), moments_(moments), frame_(first_frame), last_(last_frame) {
    find_steps();
  }

  long frame() const { return frame_; } // the next one
  bool is_due(long done) const { return done >= taken_ || done >= looks_.front(); }
  // Something of an earlier state is remembered for the next frame.
  bool is_shutter_open() const { return looks_.front() > first_look_; }

  // Passes the state after so many steps; `calls`: what is called with it. The state may be stored only if it
  // is the scene's own, and none that was kept.
  enum class Passed { Current, Kept };
  void pass(long done, const Callbacks& calls, Passed state) {
    while (is_due(done)) {
      if (state == Passed::Current && calls.between && !is_shutter_open()) calls.between(frame_);
      if (done == looks_.front() && calls.moment) calls.moment(frame_);
      while (looks_.front() <= done) looks_.pop_front();
      if (done < taken_) return;
      if (calls.frame) calls.frame(frame_);
      ++frame_;
      find_steps();
    }
  }

private:
  static constexpr long never = std::numeric_limits<long>::max();

  void find_steps() {
    looks_.clear();
    taken_ = frame_ <= last_ ? clock_.step_of(frame_) : never;
    if (moments_ && frame_ <= last_)
      for (const Moment& moment : clock_.moments_of(frame_))
        for (long step = moment.share < 1 ? moment.step - 1 : moment.step; step <= moment.step; ++step)
          if (looks_.empty() || looks_.back() < step) looks_.push_back(step);
    looks_.push_back(never);
    first_look_ = looks_.front();
  }

  const FrameClock& clock_;
  bool moments_;
  long frame_, last_;       // the next frame, the last one
  long taken_ = never;      // the step at which the next one is taken
  std::deque<long> looks_;  // the steps whose states it looks at, from the next one on; ends with `never`
  long first_look_ = never; // the first of all of them
};

struct Session::FrameWatch {
  FrameCursor asked; // for what the scene was asked
  FrameCursor shown; // what it has shown: once it was certain
};

Stopped Session::loop(long first_frame, long last_frame, const Callbacks& calls, double& callback_seconds) {
  const long last_step = this->last_step(last_frame);
  const FrameCursor start(*clock_, calls.moment != nullptr, first_frame, last_frame);
  FrameWatch watch{start, start};
  Stopped stopped = Stopped::Interrupted;
  try {
    stopped = loop(watch, last_step, calls, callback_seconds);
  } catch (const StopRequested&) {
    can_be_stored_ = scene_->can_be_stored();
  }
  if (stopped == Stopped::No) return stopped;
  if (can_be_stored_) scene_->return_to_settled();
  can_be_stored_ = can_be_stored_ && !watch.shown.is_shutter_open();
  return stopped;
}

// Asks for the current state, if a frame needs it.
void Session::look(FrameWatch& watch, const Callbacks& calls, double& callback_seconds) {
  using Passed = FrameCursor::Passed;
  const long done = scene_->steps_done();
  if (!watch.asked.is_due(done)) return;
  const auto timed = [&](const auto& call) {
    const double since = wall_clock();
    call();
    callback_seconds += wall_clock() - since;
  };
  const Passed state = scene_->is_settled() ? Passed::Current : Passed::Kept;
  if (state == Passed::Kept && calls.between && !scene_->keeps_states() && !watch.shown.is_shutter_open())
    timed([&] { calls.between(watch.shown.frame()); });
  scene_->show_when_settled([&, timed, done, state] { timed([&] { watch.shown.pass(done, calls, state); }); });
  watch.asked.pass(done, {}, Passed::Kept);
}

namespace {

// What of the step makes a run long: the step that the preset gives, or what limits that of its scheme.
std::string why_so_many_steps(const Scene& scene) {
  const StepCause cause = cause_of_step(scene);
  if (std::isinf(cause.limit)) return "";
  if (!scene.automatic_step() && cause.limit > 2 * scene.step_size())
    return fmt::format("; steps of up to {:.3g} s are stable here (--set time.step=auto)", cause.limit);
  return "; " + cause.words;
}

} // namespace

Stopped Session::loop(FrameWatch& watch, long last_step, const Callbacks& calls, double& callback_seconds) {
  RunEstimate estimate(last_step - scene_->steps_done());
  const auto step = [&] {
    if (!estimate.is_open()) return scene_->step();
    const double since = wall_clock();
    scene_->step();
    const auto left = estimate.add(wall_clock() - since);
    if (!left || options_.quiet) return;
    print_note(fmt::format("this run takes about {}, as its first steps went: {} steps of {:.3g} s{}",
                           hours_in_words(*left), last_step - scene_->steps_done(), scene_->step_size(),
                           why_so_many_steps(*scene_)));
  };
  while (true) {
    const long done = scene_->steps_done();
    if (watch.asked.is_due(done) || done >= last_step) scene_->check_sound();
    look(watch, calls, callback_seconds);
    if (done >= last_step) {
      scene_->settle();
      scene_->check_account();
      return Stopped::No;
    }
    if (stop_signal() != 0 && !watch.shown.is_shutter_open()) return Stopped::Interrupted;
    step();
    if (calls.step) calls.step();
  }
}

namespace {

void note_removed_bodies(const Scene& scene) {
  for (const auto& body : scene.bodies())
    if (body->deleted_at)
      print_note(fmt::format("all elements of body '{}' have been deleted, the last at {:.6g} s", body->name,
                             *body->deleted_at));
}

void note_substeps(const Scene& scene) {
  const GuardFigures& guard = scene.guard();
  if (guard.rejected == 0 || guard.redone == 0) return;
  print_note(fmt::format(
      "{} steps were too large and were redone as {} smaller ones; --set time.step={:.3g} avoids that",
      guard.rejected, guard.redone, guard.smallest));
}

// Of a whole clip alone: before its end they may still come.
void note_missed_obstacles(const Scene& scene) {
  if (scene.steps_done() == 0 || scene.time() < (1 - 1e-9) * scene.duration()) return;
  const std::string untouched = untouched_in_words(scene);
  if (!untouched.empty())
    print_note((touched_nothing(scene).value_or(false) ? "no body has touched anything: at the end "
                                                       : "no body has touched, at the end, ") +
               untouched);
}

} // namespace

const char* name_of(Stopped stopped) {
  static constexpr EnumWords<Stopped::Unstable> words{"no", "interrupted", "unstable"};
  return words[stopped];
}

Exit exit_code_of(const Session& session, Stopped stopped) {
  if (!session.quiet()) {
    note_removed_bodies(session.scene());
    note_substeps(session.scene());
    note_missed_obstacles(session.scene());
    for (const std::string& note : notes_on_early_tears(session)) print_note(note);
  }
  if (stopped == Stopped::No) return Exit::Done;
  if (stopped == Stopped::Unstable) {
    print_error(session.failure()->what(), session.failure()->hint);
    return Exit::Unstable;
  }
  print_error(fmt::format("stopped by a signal at {:.6g} s (step {} of {})", session.scene().time(),
                          session.scene().steps_done(), session.clock().steps()));
  return exit_code_of_signal();
}

} // namespace rend
