#include "sim/build/build_world.h"

namespace rend {
namespace {

AttributeType friction() {
  return number("friction", "",
                "Coulomb's coefficient of all that slides on it; absent: that of each body's <contact>")
      .at_least(0);
}

const ElementType& floor_type() {
  static const ElementType type{"floor",
                                "a floor, drawn below the bodies",
                                {number("z", "m", "its height").otherwise("0"), friction()},
                                {}};
  return type;
}

const ElementType& wind_type() {
  static const ElementType type{
      "wind",
      "air that pushes faces along their normals: drag x area x the square of its speed against them",
      {numbers("velocity", 3, "m/s", "of the air").is_required(),
       number("drag", "kg/m3", "half its density times the drag coefficient").at_least(0).otherwise("0.6")},
      {}};
  return type;
}

const ElementType& sphere_type() {
  static const ElementType type{
      "sphere",
      "a rigid sphere, for bodies with <contact>",
      {numbers("centre", 3, "m", "at the start").is_required(),
       number("radius", "m", "its size").above(0).at_most(1e30).is_required(),
       numbers("velocity", 3, "m/s", "constant; with a mass: at the start").otherwise("0 0 0"),
       number("mass", "kg", "if given, it falls, and is pushed back by what it meets").above(0), friction()},
      {}};
  return type;
}

const ElementType& box_type() {
  static const ElementType type{"box",
                                "a rigid box that stands still, for bodies with <contact>",
                                {numbers("low", 3, "m", "the corner of least x, y, z").is_required(),
                                 numbers("high", 3, "m", "the corner opposite to it").is_required(),
                                 friction()},
                                {}};
  return type;
}

std::optional<double> friction_of(const PresetNode& node) {
  return node.given("friction") ? std::optional(node.number("friction")) : std::nullopt;
}

Sphere sphere_of(const PresetNode& node) {
  Sphere sphere;
  sphere.start = sphere.centre = sphere.next_centre = node.vector("centre");
  sphere.velocity = sphere.next_velocity = node.vector("velocity");
  sphere.radius = node.number("radius");
  if (node.given("mass")) sphere.mass = node.number("mass");
  sphere.friction = friction_of(node);
  return sphere;
}

Box box_of(const PresetNode& node) {
  const Box box{node.vector("low"), node.vector("high"), friction_of(node)};
  if (!(box.low.array() < box.high.array()).all())
    node.fail("high", "the box has no inside: each number of high must be above that of low",
              "low=\"0 0 0\" high=\"1 1 0.5\"");
  return box;
}

} // namespace

const ElementType& world_type() {
  static const ElementType type{
      "world",
      "what surrounds the bodies",
      {numbers("gravity", 3, "m/s2", "its acceleration").otherwise("0 0 -9.81")},
      {{&floor_type(), 0, 1}, {&sphere_type(), 0, -1}, {&box_type(), 0, -1}, {&wind_type(), 0, 1}}};
  return type;
}

World build_world(const PresetNode* node) {
  World world;
  if (!node) return world;
  world.gravity = node->vector("gravity");
  if (const PresetNode* floor = node->child("floor")) {
    world.floor = floor->number("z");
    world.floor_friction = friction_of(*floor);
  }
  if (const PresetNode* wind = node->child("wind"))
    world.wind = Wind{wind->vector("velocity"), wind->number("drag")};
  for (const PresetNode* sphere : node->all("sphere")) world.spheres.push_back(sphere_of(*sphere));
  for (const PresetNode* box : node->all("box")) world.boxes.push_back(box_of(*box));
  return world;
}

} // namespace rend
