#include "render/clip/clip_run.h"

#include "render/clip/fitted_camera.h"
#include "render/console/console.h"
#include "render/console/progress.h"
#include "render/console/signals.h"
#include "render/files/output.h"
#include "render/files/video.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {

namespace fs = std::filesystem;

namespace {

PngShape shape_of(const Session& session, const PipelineOptions& files) {
  return {files.width, files.height, session.image().transparent() ? 4 : 3};
}

} // namespace

ClipRun::ClipRun(Session& session, const ClipRunOptions& options)
    : session_(session), options_(options), plan_(options.choice, session.clock(), options.shard),
      checkpoint_(checkpoint_path(options.files.folder, options.files.name, options.shard)) {
  PipelineOptions& files = options_.files;
  files.mark = picture_key(session, files.width, files.height, files.samples);
  key_ = checkpoint_key(files.mark);
  options_.resume = options.resume && files.png;
  if (options.resume && !files.png && !session.quiet())
    print_note("--resume has nothing to go on from without PNG files: the video is made again from its start");
  if (options_.resume)
    plan_.skip_existing(files.folder, files.mark, shape_of(session, files), session.threads());
  existing_ = static_cast<long>(plan_.all().size() - plan_.to_make().size());
  video_at_end_ = files.video && existing_ > 0;
  PipelineOptions now = files;
  now.video = files.video && !video_at_end_;
  if (!plan_.to_make().empty() || fs::exists(checkpoint_)) camera_found_ = fit_camera_to_clip(session);
  frame_output_.emplace(session, now, plan_);
  if (camera_found_ == Stopped::No) begin();
}

// Whether a state whose next frame is this one lies between this run's start and its end. After the clip's last
// frame there can be more steps up to its end.
bool ClipRun::is_within_run(long next) const {
  if (plan_.all().empty()) return false;
  const long last = plan_.all().back();
  return next <= last || last + 1 == session_.clock().frames();
}

// Starts from the best checkpoint; without --resume none is used.
void ClipRun::begin() {
  const PipelineOptions& files = options_.files;
  last_ = plan_.last();
  if (!options_.resume) return remove_checkpoint();
  const auto own = read_checkpoint_header(checkpoint_, key_);
  keeps_later_checkpoint_ = own && !is_within_run(own->next);
  if (own && !keeps_later_checkpoint_) last_ = plan_.all().back();
  if (keeps_later_checkpoint_ && !session_.quiet())
    print_note(fmt::format("{} is of a later frame than those asked for: it is kept and not used",
                           checkpoint_.string()));
  if (!simulates()) return;
  const long first = plan_.to_make().empty() ? plan_.all().back() + 1 : plan_.first();
  for (const FoundCheckpoint& found : find_checkpoints(files.folder, files.name, options_.shard, key_, first)) {
    const auto head = read_checkpoint(found.path, key_, first, session_, *frame_output_);
    if (!head) continue; // removed meanwhile: its shard has completed
    first_ = head->next;
    if (!session_.quiet())
      print_note(fmt::format("continuing at {:.6g} s, from {}", session_.scene().time(), found.path.string()));
    return;
  }
}

Stopped ClipRun::run() {
  if (camera_found_ != Stopped::No) {
    frame_output_->abandon(camera_found_);
    return camera_found_;
  }
  Stopped stopped = simulates() ? simulate() : Stopped::No;
  if (!session_.quiet())
    for (const std::string& note : frame_output_->notes()) print_note(note);
  if (stopped != Stopped::Interrupted && video_at_end_ && video_of_files() == Stopped::Interrupted)
    stopped = Stopped::Interrupted;
  if (stopped != Stopped::Interrupted) remove_checkpoint();
  frame_output_->folder().sync();
  return stopped;
}

// Also removes the temporary file of a killed run.
void ClipRun::remove_checkpoint() const {
  if (!keeps_checkpoints()) return;
  std::error_code error;
  fs::remove(checkpoint_, error);
  remove_leftover(checkpoint_);
}

void ClipRun::checkpoint(long next) {
  write_checkpoint(checkpoint_, key_, next, session_, *frame_output_);
}

// Called between frames. Checkpoints take at most a twentieth of the run time.
void ClipRun::checkpoint_if_due(long next) {
  constexpr double most_share = 20;
  const double start = wall_clock();
  if (start < due_ || !keeps_checkpoints()) return;
  if (!frame_output_->flush_earlier()) {
    if (!session_.clock().has_shutter()) return; // the frames that show this state come first
    frame_output_->flush_all();
  }
  frame_output_->folder().make();
  checkpoint(next);
  due_ = wall_clock() + std::max(options_.checkpoint_every, most_share * (wall_clock() - start));
}

Stopped ClipRun::simulate() {
  Progress progress(session_.quiet(), session_.last_step(last_), session_.clock().time_of(last_), last_ + 1);
  long next = first_;
  if (options_.checkpoint_every > 0) due_ = wall_clock() + options_.checkpoint_every;
  Session::Callbacks calls;
  const auto tell = [&] { progress.update(session_.scene().steps_done(), session_.scene().time(), next); };
  calls.between = [&](long frame) {
    if (frame > first_) checkpoint_if_due(frame);
  };
  if (session_.clock().has_shutter()) calls.moment = [&](long frame) { frame_output_->expose(frame); };
  calls.frame = [&](long frame) {
    frame_output_->take(frame);
    next = frame + 1;
    tell();
  };
  calls.step = tell;
  const Stopped stopped = session_.run(last_, calls, first_);
  if (stopped == Stopped::Unstable) {
    frame_output_->abandon(stopped);
    return stopped;
  }
  if (stopped == Stopped::Interrupted && keeps_checkpoints() && !session_.can_be_stored()) {
    left_checkpoint_ = read_checkpoint_header(checkpoint_, key_).has_value();
    frame_output_->abandon(stopped);
    return stopped;
  }
  if (stopped == Stopped::Interrupted && keeps_checkpoints()) {
    frame_output_->flush_all();
    checkpoint(next);
    left_checkpoint_ = true;
  }
  frame_output_->finish(stopped);
  return stopped;
}

// Of the pictures that exist: an unstable run has fewer.
Stopped ClipRun::video_of_files() {
  const PipelineOptions& files = options_.files;
  VideoWriter video;
  video.open(files.folder / (files.name + files.extension), files.width, files.height, files.fps,
             files.transparent);
  PngChecker checker(shape_of(session_, files));
  for (long frame : plan_.all()) {
    if (stop_signal() != 0) return Stopped::Interrupted;
    const fs::path path = files.folder / png_name(frame);
    if (!checker.is_whole(path, png_mark(files.mark, frame))) break;
    video.add(read_png(path));
  }
  video.close();
  return Stopped::No;
}

} // namespace rend
