#include "render/clip/frame_output.h"

#include "render/clip/picture_check.h"
#include "render/console/console.h"
#include "sim/base/archive.h"
#include "sim/base/check.h"

#include <algorithm>
#include <utility>

namespace rend {

FrameOutput::FrameOutput(Session& session, const PipelineOptions& options, const FramePlan& plan)
    : session_(session), options_(options), folder_(options.folder), plan_(plan),
      maker_(session.picture(), session.scene(), static_cast<double>(options.width) / options.height,
             session.clock().duration(), session.clock().frames()),
      pass_through_(session.scene()) {
  check_pipeline(options);
  if (session.quiet()) return;
  const double aspect = static_cast<double>(options.width) / options.height;
  for (const std::string& note : picture_notes(session.picture(), session.scene(), aspect, session.clock()))
    print_note(note);
}

FrameOutput::~FrameOutput() {
  pipeline_.reset(); // before the folder object, which removes the folder if it is empty
}

void FrameOutput::expose(long frame) {
  maker_.observe_moment();
  if (!plan_.has(frame)) return;
  Exposed& now = exposed_.emplace_back();
  now.step = session_.scene().steps_done();
  now.state = maker_.state();
  for (const Moment& moment : session_.clock().moments_of(frame))
    now.cameras.push_back(maker_.camera(moment.time));
}

namespace {

bool same(const FrameCamera& a, const FrameCamera& b) {
  return a.eye == b.eye && a.target == b.target && a.up == b.up && a.fov == b.fov;
}

FrameCamera between(const FrameCamera& a, const FrameCamera& b, double share) {
  FrameCamera camera = a;
  camera.eye += share * (b.eye - a.eye);
  camera.target += share * (b.target - a.target);
  camera.fov += share * (b.fov - a.fov);
  return camera;
}

} // namespace

// Makes the moments of a frame of what was exposed for it. Moments that show the same are one that counts more.
void FrameOutput::develop(Held& out) {
  const std::vector<Moment> moments = session_.clock().moments_of(out.number);
  for (std::size_t n = 0; n < moments.size(); ++n) {
    const auto of_step = [&](long step) {
      const auto found =
          std::find_if(exposed_.begin(), exposed_.end(), [&](const Exposed& e) { return e.step >= step; });
      CHECK(found != exposed_.end());
      return static_cast<std::size_t>(found - exposed_.begin());
    };
    FrameMoment moment{.after = of_step(moments[n].step), .share = moments[n].share};
    moment.before = moment.share < 1 ? of_step(moments[n].step - 1) : moment.after;
    const Exposed &before = exposed_[moment.before], &after = exposed_[moment.after];
    moment.camera = between(before.cameras[n], after.cameras[n], moment.share);
    if (before.state.shape != after.state.shape) { // they have no corners in common
      moment.before = moment.after;
      moment.share = 1;
    }
    FrameMoment* last = out.moments.empty() ? nullptr : &out.moments.back();
    if (last && last->after == moment.after && last->share == moment.share && same(last->camera, moment.camera))
      ++last->weight;
    else
      out.moments.push_back(moment);
  }
  for (Exposed& one : exposed_) out.states.push_back(std::move(one.state));
  exposed_.clear();
}

void FrameOutput::take(long frame) {
  maker_.observe();
  const long step = session_.scene().steps_done();
  if (step != held_step_) {
    release();
    flushed_early_.clear();
  }
  held_step_ = step;
  if (plan_.has_existing(frame)) flushed_early_.push_back(frame);
  if (!plan_.has(frame)) return;
  const double time = session_.clock().time_of(frame);
  const bool blurred = session_.clock().has_shutter();
  if (!held_) {
    held_ = blurred ? maker_.draw_without_bodies(frame, time) : maker_.draw(frame, time);
    pass_through_.look(frame);
  }
  held_frames_.push_back({.number = frame, .camera = maker_.camera(time)});
  if (blurred) develop(held_frames_.back());
}

void FrameOutput::release() {
  if (!held_) return;
  for (std::size_t n = 0; n < held_frames_.size(); ++n) {
    Frame frame = n + 1 < held_frames_.size() ? *held_ : std::move(*held_);
    frame.number = static_cast<int>(held_frames_[n].number);
    frame.camera = held_frames_[n].camera;
    frame.moments = std::move(held_frames_[n].moments);
    frame.states = std::move(held_frames_[n].states);
    push(std::move(frame));
  }
  held_.reset();
  held_frames_.clear();
}

bool FrameOutput::flush_earlier() {
  if (held_ && session_.scene().steps_done() == held_step_) return false;
  release();
  if (pipeline_) pipeline_->drain();
  return true;
}

void FrameOutput::flush_all() {
  for (const Held& held : held_frames_) flushed_early_.push_back(held.number);
  release();
  if (pipeline_) pipeline_->drain();
  folder_.make();
}

void FrameOutput::store(Archive& archive) {
  CHECK(!held_);
  maker_.store(archive);
  const FrameClock& clock = session_.clock();
  archive.list(flushed_early_, static_cast<std::size_t>(clock.frames()),
               "there are more early frames than frames");
  archive(held_step_);
  if (!archive.reading()) return;
  refuse_unless(held_step_ >= -1 && held_step_ <= session_.scene().steps_done(), "a frame shows a later state");
  for (const long frame : flushed_early_)
    refuse_unless(frame >= 0 && frame < clock.frames() && clock.step_of(frame) == held_step_,
                  "an early frame is not of the state that was shown last");
}

void FrameOutput::start() {
  folder_.make();
  pipeline_ = std::make_unique<Pipeline>(options_);
  if (pipeline_->threads_were_refused() && !session_.quiet()) note_fewer_threads();
}

void FrameOutput::push(Frame&& frame) {
  if (!pipeline_) start();
  pipeline_->push(std::move(frame));
  ++frames_;
}

void FrameOutput::close(Stopped stopped) {
  if (!pipeline_) return;
  pipeline_->finish(stopped == Stopped::Interrupted ? Pipeline::End::CutShort : Pipeline::End::Whole);
  seconds_ = pipeline_->seconds();
  pipeline_.reset();
}

void FrameOutput::finish(Stopped stopped) {
  release();
  close(stopped);
}

void FrameOutput::abandon(Stopped stopped) {
  held_.reset();
  held_frames_.clear();
  close(stopped);
  std::error_code error;
  for (long frame : flushed_early_) std::filesystem::remove(options_.folder / png_name(frame), error);
}

PipelineSeconds FrameOutput::seconds() const {
  return pipeline_ ? pipeline_->seconds() : seconds_;
}

} // namespace rend
