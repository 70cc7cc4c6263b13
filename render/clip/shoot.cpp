#include "render/clip/shoot.h"

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

Shoot::Shoot(Session& session, const ShootOptions& options)
    : session_(session), options_(options), plan_(options.choice, session.clock(), options.shard),
      checkpoint_(checkpoint_path(options.files.folder, options.files.name, options.shard)) {
  PipelineOptions& files = options_.files;
  files.mark = picture_key(session, files.width, files.height, files.samples);
  key_ = checkpoint_key(files.mark);
  options_.resume = options.resume && files.png;
  if (options.resume && !files.png && !session.quiet())
    print_note("without PNG files there is nothing to go on from: the video is made anew");
  if (options_.resume)
    plan_.leave_out_whole(files.folder, files.mark, shape_of(session, files), session.threads());
  kept_ = static_cast<long>(plan_.all().size() - plan_.to_make().size());
  video_at_end_ = files.video && kept_ > 0;
  PipelineOptions now = files;
  now.video = files.video && !video_at_end_;
  film_.emplace(session, now, plan_);
  begin();
}

// Whether a state whose next frame is this one lies between this run's start and its end. After the clip's last
// frame there can be more steps up to its end.
bool Shoot::is_on_the_way(long next) const {
  if (plan_.all().empty()) return false;
  const long last = plan_.all().back();
  return next <= last || last + 1 == session_.clock().frames();
}

// Starts from the best checkpoint; without --resume none is used.
void Shoot::begin() {
  const PipelineOptions& files = options_.files;
  last_ = plan_.last();
  if (!options_.resume) return remove_checkpoint();
  const auto own = read_checkpoint_head(checkpoint_, key_);
  spares_ = own && !is_on_the_way(own->next);
  if (own && !spares_) last_ = plan_.all().back();
  if (spares_ && !session_.quiet())
    print_note(fmt::format("{} is of frames beyond these, and stays", checkpoint_.string()));
  if (!simulates()) return;
  const long first = plan_.to_make().empty() ? plan_.all().back() + 1 : plan_.first();
  for (const FoundCheckpoint& found : find_checkpoints(files.folder, files.name, options_.shard, key_, first)) {
    const auto head = read_checkpoint(found.path, key_, first, session_, *film_);
    if (!head) continue; // removed meanwhile: its shard has completed
    first_ = head->next;
    if (!session_.quiet())
      print_note(fmt::format("goes on at {:.6g} s, from {}", session_.scene().time(), found.path.string()));
    return;
  }
}

Stopped Shoot::run() {
  Stopped stopped = simulates() ? simulate() : Stopped::No;
  if (stopped != Stopped::Interrupted && video_at_end_ && video_of_files() == Stopped::Interrupted)
    stopped = Stopped::Interrupted;
  if (stopped != Stopped::Interrupted) remove_checkpoint();
  film_->folder().sync();
  return stopped;
}

// Also removes the temporary file of a killed run.
void Shoot::remove_checkpoint() const {
  if (!keeps_checkpoints()) return;
  std::error_code error;
  fs::remove(checkpoint_, error);
  remove_leftover(checkpoint_);
}

void Shoot::checkpoint(long next) {
  write_checkpoint(checkpoint_, key_, next, session_, *film_);
}

// Called between frames. Checkpoints take at most a twentieth of the run time.
void Shoot::checkpoint_if_due(long next) {
  constexpr double most_share = 20;
  const double start = wall_clock();
  if (start < due_ || !keeps_checkpoints() || !film_->settle()) return;
  film_->folder().make();
  checkpoint(next);
  due_ = wall_clock() + std::max(options_.checkpoint_every, most_share * (wall_clock() - start));
}

Stopped Shoot::simulate() {
  Progress progress(session_.quiet(), session_.last_step(last_), session_.clock().time_of(last_), last_ + 1);
  long next = first_;
  if (options_.checkpoint_every > 0) due_ = wall_clock() + options_.checkpoint_every;
  Session::Calls calls;
  const auto tell = [&] { progress.update(session_.scene().steps_done(), session_.scene().time(), next); };
  calls.frame = [&](long frame) {
    if (frame > first_) checkpoint_if_due(frame);
    film_->take(frame);
    next = frame + 1;
    tell();
  };
  calls.step = tell;
  const Stopped stopped = session_.run(last_, calls, first_);
  if (stopped == Stopped::Unstable) {
    film_->abandon();
    return stopped;
  }
  if (stopped == Stopped::Interrupted && keeps_checkpoints()) {
    film_->pause();
    checkpoint(next);
    left_checkpoint_ = true;
  }
  film_->finish();
  return stopped;
}

// Of the pictures that exist: an unstable run has fewer.
Stopped Shoot::video_of_files() {
  const PipelineOptions& files = options_.files;
  VideoWriter video;
  video.open(files.folder / (files.name + files.extension), files.width, files.height, files.fps);
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
