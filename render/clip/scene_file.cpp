#include "render/clip/scene_file.h"

#include "render/console/json_text.h"
#include "render/draw/light.h"
#include "sim/export/obstacle_skin.h"

#include <fmt/format.h>

#include <utility>

namespace rend {
namespace {

using Json = nlohmann::ordered_json;

Json coordinates_of(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

// Of the n-th of a list that may be too short: the others look as by default.
template <class Look> Look look_at(const std::vector<Look>& looks, std::size_t n) {
  return n < looks.size() ? looks[n] : Look{};
}

Json json_of(const Body& body, const LookSettings& look) {
  const bool solid = body.map->dimension() == 3;
  Json out{{"name", body.name}, {"solid", solid}, {"colour", text_of(look.colour)}};
  if (solid) out["inside"] = text_of(look.inside);
  if (!solid) out["back"] = text_of(look.back.value_or(look.colour));
  return out;
}

Json obstacles_of(const World& world, const PictureSettings& picture) {
  Json all = Json::array();
  for (std::size_t n = 0; n < world.spheres.size(); ++n)
    all.push_back({{"name", fmt::format("sphere {}", n + 1)},
                   {"kind", "sphere"},
                   {"radius", world.spheres[n].radius},
                   {"colour", text_of(look_at(picture.spheres, n).colour)}});
  for (std::size_t n = 0; n < world.boxes.size(); ++n)
    all.push_back({{"name", fmt::format("box {}", n + 1)},
                   {"kind", "box"},
                   {"size", coordinates_of(world.boxes[n].high - world.boxes[n].low)},
                   {"colour", text_of(look_at(picture.boxes, n).colour)}});
  for (std::size_t n = 0; n < world.meshes.size(); ++n) {
    const MeshObstacle& mesh = world.meshes[n];
    Json points = Json::array();
    for (const Vec3& x : mesh.surface.points) points.push_back(coordinates_of(x - mesh.middle()));
    all.push_back({{"name", fmt::format("obstacle {}", n + 1)},
                   {"kind", "mesh"},
                   {"points", std::move(points)},
                   {"triangles", mesh.surface.triangles},
                   {"colour", text_of(look_at(picture.meshes, n).colour)}});
  }
  return all;
}

Json json_of(const Pose& pose, const Vec3& middle) {
  Json turn = Json::array();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) turn.push_back(pose.turn(row, column));
  return {{"middle", coordinates_of(pose.of(middle))}, {"turn", std::move(turn)}};
}

Json poses_of(const World& world, double time) {
  Json all = Json::array();
  for (const Sphere& sphere : world.spheres) all.push_back(json_of(pose_of(sphere, time), sphere.start));
  for (const Box& box : world.boxes) all.push_back(json_of(box.pose(time), box.middle()));
  for (const MeshObstacle& mesh : world.meshes) all.push_back(json_of(mesh.pose(time), mesh.middle()));
  return all;
}

} // namespace

SceneFile::SceneFile(const Session& session, const std::string& format)
    : session_(session), viewpoint_(session.picture().camera, session.scene(), session.image().aspect(),
                                    session.clock().duration()) {
  const Scene& scene = session.scene();
  const ImageSettings& image = session.image();
  file_ = {{"scene", scene.name()}, {"format", format}, {"fps", session.clock().fps()}};
  file_["size"] = {image.width(), image.height()};
  file_["background"] = image.background ? Json(text_of(*image.background)) : Json();
  file_["floor"] = scene.world().floor ? Json(scene.world().floor->z) : Json();
  file_["bodies"] = Json::array();
  for (std::size_t n = 0; n < scene.bodies().size(); ++n)
    file_["bodies"].push_back(json_of(*scene.bodies()[n], look_at(session.picture().looks, n)));
  file_["obstacles"] = obstacles_of(scene.world(), session.picture());
  file_["frames"] = Json::array();
}

void SceneFile::observe() {
  viewpoint_.observe(session_.scene());
}

Json SceneFile::frame(long frame, const std::string& file) const {
  const Scene& scene = session_.scene();
  Frame shown;
  if (scene.world().floor) shown.floor = FrameFloor{scene.world().floor->z};
  shown.camera = viewpoint_.at(session_.clock().time_of(frame));
  const FrameCamera& camera = shown.camera;
  return {{"frame", frame},
          {"file", file},
          {"time", scene.time()},
          {"camera",
           {{"eye", coordinates_of(camera.eye)},
            {"target", coordinates_of(camera.target)},
            {"up", coordinates_of(camera.up)},
            {"fov", camera.fov}}},
          {"light", coordinates_of(lights_of(shown).key)},
          {"obstacles", poses_of(scene.world(), scene.time())}};
}

void SceneFile::add(Json frame) {
  file_["frames"].push_back(std::move(frame));
}

std::string SceneFile::text() const {
  return text_of(file_) + "\n";
}

} // namespace rend
