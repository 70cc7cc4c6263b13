#include "render/clip/frame_output.h"

#include "render/clip/picture_check.h"
#include "render/console/console.h"
#include "sim/base/archive.h"
#include "sim/base/check.h"

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
  if (!held_) {
    held_ = maker_.draw(frame, session_.clock().time_of(frame));
    pass_through_.look(frame);
  }
  held_frames_.emplace_back(frame, maker_.camera(session_.clock().time_of(frame)));
}

void FrameOutput::release() {
  if (!held_) return;
  for (std::size_t n = 0; n < held_frames_.size(); ++n) {
    Frame frame = n + 1 < held_frames_.size() ? *held_ : std::move(*held_);
    frame.number = static_cast<int>(held_frames_[n].first);
    frame.camera = held_frames_[n].second;
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
  for (const auto& [frame, camera] : held_frames_) flushed_early_.push_back(frame);
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

void FrameOutput::close() {
  if (!pipeline_) return;
  pipeline_->finish();
  seconds_ = pipeline_->seconds();
  pipeline_.reset();
}

void FrameOutput::finish() {
  release();
  close();
}

void FrameOutput::abandon() {
  held_.reset();
  held_frames_.clear();
  close();
  std::error_code error;
  for (long frame : flushed_early_) std::filesystem::remove(options_.folder / png_name(frame), error);
}

PipelineSeconds FrameOutput::seconds() const {
  return pipeline_ ? pipeline_->seconds() : seconds_;
}

} // namespace rend
