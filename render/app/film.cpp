#include "render/app/film.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace rend {

namespace fs = std::filesystem;

Film::Film(Session& session, const PipelineOptions& options, const FrameChoice& choice)
    : session_(session), options_(options), choice_(choice),
      maker_(session.preset(), session.scene(), static_cast<double>(options.width) / options.height,
             session.clock().duration()) {
  note_missing_folders();
}

// Which folders have to be made. That they can be is found out now, and not after an hour of simulation.
void Film::note_missing_folders() {
  std::error_code error;
  fs::path at = options_.folder.lexically_normal();
  if (!at.has_filename()) at = at.parent_path(); // "out/": its filename is empty
  for (; !at.empty() && !fs::exists(at, error); at = at.parent_path()) made_.push_back(at);
  std::reverse(made_.begin(), made_.end());
  const fs::path there = at.empty() ? fs::path(".") : at;
  if (!fs::is_directory(there, error))
    throw UserError(Exit::CannotCreate, {there.string()}, "a file is in the way of the output folder",
                    "choose another one with -o");
  if (::access(there.c_str(), W_OK | X_OK) != 0)
    throw UserError(Exit::CannotCreate, {there.string()},
                    std::string("nothing can be written there: ") + std::strerror(errno),
                    "choose another one with -o");
}

Film::~Film() {
  pipeline_.reset();
  std::error_code error;
  for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder)
    if (!fs::is_directory(*folder, error) || !fs::is_empty(*folder, error) || !fs::remove(*folder, error))
      break;
}

void Film::take(long frame) {
  maker_.observe();
  const long step = session_.scene().steps_done();
  if (held_ && step != held_step_) release();
  if (!choice_.has(frame)) return;
  if (!held_) held_ = maker_.draw(frame, session_.clock().time_of(frame));
  numbers_.push_back(frame);
  held_step_ = step;
}

void Film::release() {
  if (!held_) return;
  for (std::size_t n = 0; n < numbers_.size(); ++n) {
    Frame frame = n + 1 < numbers_.size() ? *held_ : std::move(*held_);
    frame.number = static_cast<int>(numbers_[n]);
    frame.camera = maker_.camera(session_.clock().time_of(numbers_[n]));
    push(std::move(frame));
  }
  held_.reset();
  numbers_.clear();
}

void Film::push(Frame&& frame) {
  if (!pipeline_) pipeline_ = std::make_unique<Pipeline>(options_);
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
  numbers_.clear();
  close();
}

PipelineSeconds Film::seconds() const {
  return pipeline_ ? pipeline_->seconds() : seconds_;
}

} // namespace rend
