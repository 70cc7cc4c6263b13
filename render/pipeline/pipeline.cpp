#include "render/pipeline/pipeline.h"

#include "render/draw/device.h"
#include "render/draw/hud.h"
#include "render/draw/renderer.h"
#include "render/files/png.h"
#include "render/files/video.h"
#include "render/pipeline/queue.h"
#include "sim/base/check.h"
#include "sim/base/error.h"
#include "sim/base/wall_clock.h"
#include "sim/base/worker_threads.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <fmt/format.h>
#include <mutex>

namespace rend {
namespace {

struct Picture {
  int number = 0;
  Image image;
};
using SharedPicture = std::shared_ptr<const Picture>; // shared by both writers

constexpr std::size_t queue_capacity = 3; // capacity of each queue: enough to smooth over an uneven stage

} // namespace

void check_pipeline(const PipelineOptions& options) {
  // picture size that every OpenGL 3.3 supports: OpenGL is started in advance only for larger ones
  constexpr int guaranteed_size = 4096;
  if (options.video) require_video(options.extension);
  const int supersampling = options.samples == 16 ? 2 : 1;
  if (supersampling * std::max(options.width, options.height) <= guaranteed_size) return;
  const std::unique_ptr<Device> device = make_device();
  const Renderer renderer(options.width, options.height, options.samples);
}

std::string png_name(long number) {
  return fmt::format("{:05d}.png", number);
}

PngText png_mark(const std::string& mark, long number) {
  if (mark.empty()) return {};
  return {"rend:scene", fmt::format("{} {}", mark, number)};
}

struct Pipeline::Stages {
  explicit Stages(const PipelineOptions& options);
  ~Stages();
  void start(); // not in the constructor: if a thread fails to start, the destructor stops the others
  void push(Frame&& frame);
  void drain();
  void finish(End end);
  PipelineSeconds seconds() const;
  bool threads_were_refused() const { return fewer_threads_; }

private:
  void draw();
  void write_png_files();
  void write_video();
  template <class Work> bool start(Work work);
  template <class Work> void must_start(Work work, const char* what);
  void fail(std::exception_ptr error);
  void note_done();
  void rethrow() const;
  void spent(double PipelineSeconds::*renderer, double since);

  PipelineOptions options_;
  std::unique_ptr<Device> device_;     // current in the drawing thread
  std::unique_ptr<Renderer> renderer_; // of that thread too
  VideoWriter video_;
  BoundedQueue<Frame> frames_{queue_capacity};
  BoundedQueue<SharedPicture> for_png_{queue_capacity}, for_video_{queue_capacity};
  mutable std::mutex mutex_; // guards the next two
  std::exception_ptr error_; // the first one of any thread
  PipelineSeconds seconds_;
  int last_number_ = -1;
  long pushed_ = 0, done_ = 0; // frames; done_: drawn, and written if PNGs are made
  std::condition_variable one_done_;
  bool finished_ = false;
  bool fewer_threads_ = false;
  WorkerThreads threads_;
};

Pipeline::Stages::Stages(const PipelineOptions& options) : options_(options) {
  CHECK(options.png_writers == 1 || options.png_writers == 2);
  std::error_code error;
  std::filesystem::create_directories(options.folder, error);
  if (error)
    throw UserError(Exit::CannotCreate, {options.folder.string()},
                    "the folder cannot be made: " + error.message() + ".", "Choose another one with -o.");
  device_ = make_device();
  renderer_ = std::make_unique<Renderer>(options.width, options.height, options.samples);
  device_->release();
  if (options.video)
    video_.open(options.folder / (options.name + options.extension), options.width, options.height, options.fps,
                options.transparent);
}

void Pipeline::Stages::start() {
  must_start([this] { draw(); }, "drawing");
  if (options_.video) must_start([this] { write_video(); }, "the video");
  if (options_.png) must_start([this] { write_png_files(); }, "writing PNG files");
  const bool second = options_.png && options_.png_writers == 2;
  fewer_threads_ = device_->threads_were_refused();
  if (second && !start([this] { write_png_files(); })) fewer_threads_ = true;
}

Pipeline::Stages::~Stages() {
  if (!finished_) fail(nullptr);
  threads_.wait();
}

template <class Work> bool Pipeline::Stages::start(Work work) {
  return threads_.start([this, work] {
    try {
      work();
    } catch (...) {
      fail(std::current_exception());
    }
  });
}

template <class Work> void Pipeline::Stages::must_start(Work work, const char* what) {
  if (!start(work)) refuse_without_thread(what);
}

// Stops all threads; queued items are dropped.
void Pipeline::Stages::fail(std::exception_ptr error) {
  {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = error;
    one_done_.notify_all();
  }
  frames_.abandon();
  for_png_.abandon();
  for_video_.abandon();
}

void Pipeline::Stages::note_done() {
  const std::lock_guard lock(mutex_);
  ++done_;
  one_done_.notify_all();
}

void Pipeline::Stages::drain() {
  {
    std::unique_lock lock(mutex_);
    one_done_.wait(lock, [this] { return done_ == pushed_ || error_; });
  }
  rethrow();
}

void Pipeline::Stages::rethrow() const {
  const std::lock_guard lock(mutex_);
  if (error_) std::rethrow_exception(error_);
}

void Pipeline::Stages::spent(double PipelineSeconds::*renderer, double since) {
  const std::lock_guard lock(mutex_);
  seconds_.*renderer += wall_clock() - since;
}

void Pipeline::Stages::draw() {
  device_->make_current();
  // frees its OpenGL objects in this thread, where they are current
  const std::unique_ptr<Renderer> renderer = std::move(renderer_);
  std::unique_ptr<Hud> hud; // created for the first frame that has one
  while (auto frame = frames_.pop()) {
    const double start = wall_clock();
    auto picture = std::make_shared<Picture>();
    picture->number = frame->number;
    renderer->draw(*frame);
    if (!frame->hud.empty() && !hud) hud = std::make_unique<Hud>(options_.width, options_.height);
    if (!frame->hud.empty()) hud->draw(frame->hud);
    picture->image = renderer->read();
    spent(&PipelineSeconds::draw, start);
    if (!options_.png) note_done();
    const double drawn = wall_clock();
    if (options_.png && !for_png_.push(picture)) break;
    if (options_.video && !for_video_.push(picture)) break;
    spent(&PipelineSeconds::draw_waits, drawn);
  }
  for_png_.close();
  for_video_.close();
}

void Pipeline::Stages::write_png_files() {
  while (auto picture = for_png_.pop()) {
    const double start = wall_clock();
    const int number = (*picture)->number;
    write_png(options_.folder / png_name(number), (*picture)->image, png_mark(options_.mark, number));
    spent(&PipelineSeconds::png, start);
    note_done();
  }
}

void Pipeline::Stages::write_video() {
  while (auto picture = for_video_.pop()) {
    const double start = wall_clock();
    video_.add((*picture)->image);
    spent(&PipelineSeconds::video, start);
  }
}

void Pipeline::Stages::push(Frame&& frame) {
  CHECK(!finished_);
  CHECK(frame.number > last_number_);
  rethrow();
  last_number_ = frame.number;
  ++pushed_;
  if (!frames_.push(std::move(frame))) rethrow();
}

void Pipeline::Stages::finish(End end) {
  CHECK(!finished_);
  frames_.close();
  threads_.wait();
  finished_ = true;
  rethrow();
  if (options_.video) {
    const double start = wall_clock();
    end == End::Whole ? video_.close() : video_.stop();
    spent(&PipelineSeconds::video, start);
  }
}

PipelineSeconds Pipeline::Stages::seconds() const {
  const std::lock_guard lock(mutex_);
  return seconds_;
}

Pipeline::Pipeline(const PipelineOptions& options) : stages_(std::make_unique<Stages>(options)) {
  stages_->start();
}
Pipeline::~Pipeline() = default;
void Pipeline::push(Frame&& frame) {
  stages_->push(std::move(frame));
}
void Pipeline::drain() {
  stages_->drain();
}
void Pipeline::finish(End end) {
  stages_->finish(end);
}
PipelineSeconds Pipeline::seconds() const {
  return stages_->seconds();
}
bool Pipeline::threads_were_refused() const {
  return stages_->threads_were_refused();
}

} // namespace rend
