#include "render/picture/scene_picture.h"

#include "render/draw/hud.h"
#include "sim/base/archive.h"
#include "sim/base/wall_clock.h"

#include <algorithm>

namespace rend {

FrameBuilder::FrameBuilder(const PictureSettings& settings, Scene& scene, double aspect, double duration,
                           long frames)
    : scene_(scene), viewpoint_(settings.camera, scene, aspect, duration), image_(settings.image),
      spheres_(settings.spheres), boxes_(settings.boxes) {
  if (settings.hud && hud_available()) hud_.emplace(*settings.hud, scene, frames);
  spheres_.resize(scene.world().spheres.size());
  boxes_.resize(scene.world().boxes.size());
  for (std::size_t n = 0; n < scene.world().meshes.size(); ++n)
    meshes_.push_back(
        picture_of(scene.world().meshes[n], n < settings.meshes.size() ? settings.meshes[n] : MeshLook{}));
  std::vector<LookSettings> looks = settings.looks;
  looks.resize(scene.bodies().size());
  const double start = wall_clock();
  TextureFiles files;
  for (std::size_t n = 0; n < looks.size(); ++n)
    bodies_.push_back(std::make_unique<BodyPicture>(*scene.bodies()[n], looks[n], files.of(looks[n])));
  seconds_ = wall_clock() - start;
}

void FrameBuilder::observe() {
  const double start = wall_clock();
  for (auto& body : bodies_) body->observe(fragments_seen_);
  if (hud_) hud_->observe();
  viewpoint_.observe(scene_);
  seconds_ += wall_clock() - start;
}

// A state may be observed twice, before and after a run was stopped: the camera must not move on in between.
void FrameBuilder::observe_moment() {
  const double start = wall_clock();
  for (auto& body : bodies_) body->observe(fragments_seen_);
  if (!viewpoint_.has_observed(scene_.time())) viewpoint_.observe(scene_);
  seconds_ += wall_clock() - start;
}

FrameState FrameBuilder::state() {
  const double start = wall_clock();
  FrameState state;
  for (auto& body : bodies_) body->draw(state.bodies);
  for (const auto& body : scene_.bodies()) state.shape += body->boundary().revision();
  const World& world = scene_.world();
  for (std::size_t n = 0; n < spheres_.size(); ++n)
    state.obstacles.push_back(picture_of(world.spheres[n], spheres_[n]));
  for (std::size_t n = 0; n < boxes_.size(); ++n)
    state.obstacles.push_back(picture_of(world.boxes[n], boxes_[n], scene_.time()));
  for (std::size_t n = 0; n < meshes_.size(); ++n)
    state.obstacles.push_back(world.meshes[n].moves() ? moved(meshes_[n], world.meshes[n].pose(scene_.time()))
                                                      : meshes_[n]);
  seconds_ += wall_clock() - start;
  return state;
}

Frame FrameBuilder::draw(long number, double time) {
  FrameState now = state();
  Frame frame = draw_without_bodies(number, time);
  frame.bodies = std::move(now.bodies);
  frame.obstacles = std::move(now.obstacles);
  return frame;
}

Frame FrameBuilder::draw_without_bodies(long number, double time) {
  const double start = wall_clock();
  Frame frame;
  frame.time = scene_.time();
  frame.number = static_cast<int>(number);
  const World& world = scene_.world();
  if (world.floor) frame.floor = FrameFloor{world.floor->z};
  frame.camera = viewpoint_.at(time);
  const Colour background = image_.background.value_or(Colour{});
  for (std::size_t c = 0; c < 3; ++c) frame.background[c] = static_cast<float>(background[c]) / 255;
  frame.transparent = image_.transparent();
  frame.floor_shadow = image_.floor_shadow;
  frame.occlusion = image_.occlusion;
  if (hud_) frame.hud = hud_->content(legends(), number, image_.playback().speed_at(scene_.time()));
  seconds_ += wall_clock() - start;
  return frame;
}

// Each scale once, even if several bodies share it.
std::vector<HudLegend> FrameBuilder::legends() const {
  std::vector<HudLegend> all;
  if (!hud_->wants_legends()) return all;
  for (const auto& body : bodies_)
    if (auto legend = body->legend()) {
      const auto same = [&](const HudLegend& l) { return l.title == legend->title && l.high == legend->high; };
      if (std::none_of(all.begin(), all.end(), same)) all.push_back(std::move(*legend));
    }
  return all;
}

void FrameBuilder::store(Archive& archive) {
  archive.mark("pictures");
  archive.same(hud_ ? 1 : 0, "whether something is written over the pictures");
  for (auto& body : bodies_) body->store(archive);
  if (hud_) hud_->store(archive);
  viewpoint_.store(archive, scene_.time());
  archive(fragments_seen_);
  if (!archive.reading()) return;
  std::size_t seen = 0;
  for (const auto& body : bodies_) seen += body->fragments_seen();
  refuse_unless(seen == fragments_seen_, "not as many fragments were seen as have a colour");
}

std::size_t FrameBuilder::bytes() const {
  std::size_t total = 0;
  for (const auto& body : bodies_) total += body->bytes();
  return total;
}

} // namespace rend
