#include "sim/build/build_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {

const ElementType& contact_type() {
  static const ElementType type{
      "contact",
      "what the body does not pass through",
      {words_of("with", {"floor", "obstacles", "fragments", "self"},
                "any of: the floor; obstacles: floor, spheres and boxes; fragments: other fragments, and other "
                "bodies that say so too; self: all of its own faces as well")
           .otherwise("obstacles"),
       number("thickness", "m", "kept from it").at_least(0).otherwise("0.002"),
       number("friction", "", "Coulomb's coefficient, where the obstacle has none of its own")
           .at_least(0)
           .otherwise("0.5")},
      {}};
  return type;
}

namespace {

void say_what_it_passes(Body& body, const World& world, bool floor, bool obstacles) {
  const bool through_floor = world.floor && !floor, through_obstacles = world.has_obstacles() && !obstacles;
  if (!through_floor && !through_obstacles) return;
  body.left_out.push_back(
      fmt::format("contact: {} drawn, and this body passes through ({})",
                  through_floor && through_obstacles ? "floor, spheres and boxes are"
                  : through_floor                    ? "the floor is"
                                                     : "spheres and boxes are",
                  body.node->child("contact") ? "with of its <contact> names other things" : "no <contact>"));
  body.notes.push_back(body.left_out.back());
}

// What is below the floor is lifted onto it in the first step, which strains it.
void say_what_starts_below(Body& body, double height) {
  double lowest = height;
  for (Slot v = 0; v < body.map->cells(Vertex).slots(); ++v)
    if (body.map->cells(Vertex).alive(v)) lowest = std::min(lowest, body.map->rest()[v].z);
  const double depth = height - lowest;
  if (depth <= 1e-6 * std::abs(height) + 1e-9) return;
  body.notes.push_back(fmt::format("contact: it starts {:.3g} m below where the floor holds it (thickness "
                                   "counted), and is lifted there at once, which strains it: place it higher",
                                   depth));
}

ContactSettings settings_of(const PresetNode& contact) {
  const auto& with = contact.words("with");
  const auto has = [&](const char* word) { return std::find(with.begin(), with.end(), word) != with.end(); };
  ContactSettings settings;
  settings.obstacles = has("obstacles");
  settings.floor = has("floor") || settings.obstacles;
  settings.self = has("self");
  settings.fragments = has("fragments") || settings.self;
  settings.thickness = contact.number("thickness");
  settings.friction = contact.number("friction");
  return settings;
}

void check_world(const PresetNode& contact, const ContactSettings& settings, const World& world) {
  const auto& with = contact.words("with");
  const auto fail = [&](const char* what, const char* hint) {
    if (contact.given("with")) contact.fail("with", what, hint);
    throw UserError(Exit::BadInput, contact.place(), what, hint);
  };
  if (with.empty()) fail("the body is in contact with nothing", "with=\"obstacles\", or leave <contact> out");
  if (settings.obstacles && !world.floor && !world.has_obstacles())
    fail("there is neither a floor nor an obstacle to be in contact with",
         "add <floor z=\"0\"/>, <sphere> or <box> to <world>");
  if (settings.floor && !settings.obstacles && !world.floor)
    fail("there is no floor to be in contact with", "add <world><floor z=\"0\"/></world>");
}

} // namespace

void build_contact(Body& body, const PresetNode& node, const World& world) {
  const PresetNode* contact = node.child("contact");
  if (!contact) return say_what_it_passes(body, world, false, false);
  ContactSettings settings = settings_of(*contact);
  check_world(*contact, settings, world);
  say_what_it_passes(body, world, settings.floor, settings.obstacles);
  settings.obstacles = settings.obstacles && world.has_obstacles();
  if (settings.floor && world.floor)
    body.floor_contact =
        FloorContact{*world.floor + settings.thickness, world.floor_friction.value_or(settings.friction)};
  if (body.floor_contact) say_what_starts_below(body, body.floor_contact->height);
  body.contact = settings;
}

} // namespace rend
