#include "render/clip/film.h"

#include "render/clip/picture_check.h"
#include "render/console/console.h"
#include "sim/base/archive.h"
#include "sim/base/check.h"

#include <utility>

namespace rend {

Film::Film(Session& session, const PipelineOptions& options, const FramePlan& plan)
    : session_(session), options_(options), folder_(options.folder), plan_(plan),
      maker_(session.picture(), session.scene(), static_cast<double>(options.width) / options.height,
             session.clock().duration(), session.clock().frames()) {
  check_pipeline(options);
  if (session.quiet()) return;
  const double aspect = static_cast<double>(options.width) / options.height;
  for (const std::string& note : picture_notes(session.picture(), session.scene(), aspect, session.clock()))
    print_note(note);
}

Film::~Film() {
  pipeline_.reset(); // before the folder object, which removes the folder if it is empty
}

void Film::take(long frame) {
  maker_.observe();
  const long step = session_.scene().steps_done();
  if (step != held_step_) {
    release();
    early_.clear();
  }
  held_step_ = step;
  if (plan_.keeps(frame)) early_.push_back(frame);
  if (!plan_.has(frame)) return;
  if (!held_) held_ = maker_.draw(frame, session_.clock().time_of(frame));
  showings_.emplace_back(frame, maker_.camera(session_.clock().time_of(frame)));
}

void Film::release() {
  if (!held_) return;
  for (std::size_t n = 0; n < showings_.size(); ++n) {
    Frame frame = n + 1 < showings_.size() ? *held_ : std::move(*held_);
    frame.number = static_cast<int>(showings_[n].first);
    frame.camera = showings_[n].second;
    push(std::move(frame));
  }
  held_.reset();
  showings_.clear();
}

bool Film::settle() {
  if (held_ && session_.scene().steps_done() == held_step_) return false;
  release();
  if (pipeline_) pipeline_->drain();
  return true;
}

void Film::pause() {
  for (const auto& [frame, camera] : showings_) early_.push_back(frame);
  release();
  if (pipeline_) pipeline_->drain();
  folder_.make();
}

void Film::store(Archive& archive) {
  CHECK(!held_);
  maker_.store(archive);
  const FrameClock& clock = session_.clock();
  archive.list(early_, static_cast<std::size_t>(clock.frames()), "there are more early frames than frames");
  archive(held_step_);
  if (!archive.reading()) return;
  refuse_unless(held_step_ >= -1 && held_step_ <= session_.scene().steps_done(), "a frame shows a later state");
  for (const long frame : early_)
    refuse_unless(frame >= 0 && frame < clock.frames() && clock.step_of(frame) == held_step_,
                  "an early frame is not of the state that was shown last");
}

void Film::start() {
  folder_.make();
  pipeline_ = std::make_unique<Pipeline>(options_);
  if (pipeline_->has_fewer_threads() && !session_.quiet()) note_fewer_threads();
}

void Film::push(Frame&& frame) {
  if (!pipeline_) start();
  pipeline_->push(std::move(frame));
  ++frames_;
}

void Film::close() {
  if (!pipeline_) return;
  pipeline_->finish();
  seconds_ = pipeline_->seconds();
  pipeline_.reset();
}

void Film::finish() {
  release();
  close();
}

void Film::abandon() {
  held_.reset();
  showings_.clear();
  close();
  std::error_code error;
  for (long frame : early_) std::filesystem::remove(options_.folder / png_name(frame), error);
}

PipelineSeconds Film::seconds() const {
  return pipeline_ ? pipeline_->seconds() : seconds_;
}

} // namespace rend
