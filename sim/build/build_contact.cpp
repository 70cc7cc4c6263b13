#include "sim/build/build_contact.h"

#include <fmt/format.h>

namespace rend {

namespace {

// `contact`: none where the body has none. Whether it does pass through is known once it has moved: pictures
// tell (render/clip/pass_through.h).
void say_what_it_passes(Body& body, const World& world, const std::optional<ContactSettings>& contact) {
  const bool floor = contact && contact->floor, obstacles = contact && contact->obstacles;
  const bool through_floor = world.floor && !floor, through_obstacles = world.has_obstacles() && !obstacles;
  if (!through_floor && !through_obstacles) return;
  const char* obstacles_in_words = world.meshes.empty() ? "spheres and boxes" : "obstacles";
  body.left_out.push_back(fmt::format(
      "contact: '{}' will pass through {}: {}", body.name,
      through_floor && through_obstacles ? fmt::format("the floor, {}", obstacles_in_words)
      : through_floor                    ? "the floor"
                                         : obstacles_in_words,
      !contact ? fmt::format("add <contact with=\"{}\"/>", through_obstacles ? "obstacles" : "floor")
               : fmt::format("add `{}` to its <contact with>", through_obstacles ? "obstacles" : "floor")));
}

void check_world(const ContactSettings& contact, const World& world) {
  const auto fail = [&](const char* what, const char* hint) {
    contact.source.fail(contact.source.given("with") ? "with" : "", what, hint);
  };
  if (!contact.floor && !contact.faces())
    fail("the body is in contact with nothing", "with=\"obstacles\", or leave <contact> out");
  if (contact.obstacles && !world.floor && !world.has_obstacles())
    fail("there is neither a floor nor an obstacle to be in contact with",
         "add <floor z=\"0\"/>, <sphere>, <box> or <obstacle> to <world>");
  if (contact.floor && !contact.obstacles && !world.floor)
    fail("there is no floor to be in contact with", "add <world><floor z=\"0\"/></world>");
}

} // namespace

void build_contact(Body& body, const BodySettings& settings, const World& world) {
  if (!settings.contact) return say_what_it_passes(body, world, {});
  ContactSettings contact = *settings.contact;
  check_settings(contact);
  for (const ContactPairSettings& pair : contact.pairs) check_settings(pair);
  contact.floor = contact.floor || contact.obstacles;
  contact.fragments = contact.fragments || contact.self;
  check_world(contact, world);
  say_what_it_passes(body, world, contact);
  contact.obstacles = contact.obstacles && world.has_obstacles();
  if (contact.floor && world.floor) body.floor_contact = FloorContact{world.floor->z + contact.thickness};
  body.contact = contact;
}

} // namespace rend
