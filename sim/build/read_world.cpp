#include "sim/build/read_world.h"

#include "sim/build/read_obstacle.h"
#include "sim/build/read_settings.h"

namespace rend {
namespace {

const ElementType& floor_type() {
  static const ElementType type{
      "floor", "a horizontal floor; bodies with <contact> rest on it", attributes_of<Floor>(), {}};
  return type;
}

const ElementType& wind_type() {
  static const ElementType type{
      "wind",
      "wind: it pushes each face along its normal with the force drag x area x (air speed across the face)^2",
      attributes_of<Wind>(),
      {}};
  return type;
}

const ElementType& sphere_type() {
  static const ElementType type{"sphere",
                                "a rigid sphere, which bodies with <contact> collide with",
                                attributes_of<SphereSettings>(),
                                {{&key_type(), 0, -1}}};
  return type;
}

const ElementType& box_type() {
  static const ElementType type{"box",
                                "a rigid box, which bodies with <contact> collide with",
                                attributes_of<Box>(),
                                {{&key_type(), 0, -1}}};
  return type;
}

Sphere read_sphere(const PresetNode& node) {
  auto settings = read_settings<SphereSettings>(node);
  settings.keys = read_keys(node);
  return Sphere(settings);
}

Box read_box(const PresetNode& node) {
  auto box = read_settings<Box>(node);
  box.motion.keys = read_keys(node);
  return box;
}

} // namespace

const ElementType& key_type() {
  static const ElementType type{"key",
                                "where an obstacle is at a time, and how it is turned; between keys it moves "
                                "smoothly, and is at rest at the "
                                "first and last one",
                                attributes_of<ObstacleKey>(),
                                {}};
  return type;
}

std::vector<ObstacleKey> read_keys(const PresetNode& obstacle) {
  std::vector<ObstacleKey> keys;
  for (const PresetNode* key : obstacle.all("key")) keys.push_back(read_settings<ObstacleKey>(*key));
  return keys;
}

const ElementType& world_type() {
  static const ElementType type{"world",
                                "gravity, floor, obstacles and wind",
                                attributes_of<World>(),
                                {{&floor_type(), 0, 1},
                                 {&sphere_type(), 0, -1},
                                 {&box_type(), 0, -1},
                                 {&obstacle_type(), 0, -1},
                                 {&wind_type(), 0, 1}}};
  return type;
}

World read_world(const PresetNode* node) {
  if (!node) return {};
  World world = read_settings<World>(*node);
  if (const PresetNode* floor = node->child("floor")) world.floor = read_settings<Floor>(*floor);
  if (const PresetNode* wind = node->child("wind")) world.wind = read_settings<Wind>(*wind);
  for (const PresetNode* sphere : node->all("sphere")) world.spheres.push_back(read_sphere(*sphere));
  for (const PresetNode* box : node->all("box")) world.boxes.push_back(read_box(*box));
  for (const PresetNode* obstacle : node->all("obstacle")) world.meshes.push_back(read_obstacle(*obstacle));
  check_world(world);
  return world;
}

} // namespace rend
