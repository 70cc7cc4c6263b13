#include "sim/contact/contact_names.h"

#include "sim/base/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace rend {
namespace {

using Bodies = std::vector<std::unique_ptr<Body>>;

// A body or an obstacle, by its number in the scene or in the world.
struct Thing {
  bool is_body = false;
  std::size_t number = 0;
};

// What one body says of another.
struct Said {
  std::optional<double> friction, restitution;
  const ContactPairSettings* by = nullptr; // the last; null: nothing
};

class Resolution {
public:
  Resolution(const World& world, const Bodies& bodies)
      : world_(world), bodies_(bodies), said_(bodies.size(), std::vector<Said>(bodies.size())) {
    list_names();
    for (const auto& body : bodies_)
      if (body->contact) begin_table(*body);
  }

  void resolve() {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      if (bodies_[b]->contact) exclude(b);
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (!bodies_[b]->contact) continue;
      for (const ContactPairSettings& pair : bodies_[b]->contact->pairs) take_pair(b, pair);
    }
    for (std::size_t a = 0; a < bodies_.size(); ++a)
      for (std::size_t b = a + 1; b < bodies_.size(); ++b) agree(a, b);
    for (const auto& body : bodies_)
      if (body->contact_table.excludes_obstacle(0)) body->floor_contact.reset();
  }

private:
  void list_names() {
    for (std::size_t b = 0; b < bodies_.size(); ++b) things_[bodies_[b]->name] = {true, b};
    if (world_.floor) add_obstacle(world_.floor->name, 0, world_.floor->source);
    for (std::size_t s = 0; s < world_.spheres.size(); ++s)
      add_obstacle(world_.spheres[s].name, world_.number_of_sphere(s), world_.spheres[s].source);
    for (std::size_t b = 0; b < world_.boxes.size(); ++b)
      add_obstacle(world_.boxes[b].name, world_.number_of_box(b), world_.boxes[b].source);
    for (std::size_t m = 0; m < world_.meshes.size(); ++m)
      add_obstacle(world_.meshes[m].name, world_.number_of_mesh(m), world_.meshes[m].source);
    for (const auto& [name, thing] : things_) names_.push_back(name);
  }

  void add_obstacle(const std::string& name, std::size_t number, const SettingsSource& source) {
    if (name.empty()) return;
    const auto& kinds = fields_of<ContactSettings>().front().type.words;
    if (name.find_first_of(" \t\n\r") != std::string::npos)
      source.fail("name", fmt::format("the name {} has a blank", in_quotes(name)),
                  "names in <contact> are separated by blanks: leave it out, or write -");
    if (std::find(kinds.begin(), kinds.end(), name) != kinds.end())
      source.fail("name", fmt::format("{} is a kind of thing in <contact>", in_quotes(name)),
                  "take another name");
    if (!things_.try_emplace(name, Thing{false, number}).second)
      source.fail("name", fmt::format("two things are called {}", in_quotes(name)),
                  "give each a name of its own, also bodies and obstacles");
  }

  // By what counts for all.
  void begin_table(Body& body) {
    const ContactSettings& own = *body.contact;
    ContactTable& table = body.contact_table;
    const auto add = [&](const std::optional<double>& friction, const std::optional<double>& restitution) {
      table.obstacles.push_back({friction.value_or(own.friction), restitution.value_or(own.restitution)});
    };
    table = {};
    const Floor floor = world_.floor.value_or(Floor{});
    add(floor.friction, floor.restitution);
    for (const Sphere& sphere : world_.spheres) add(sphere.friction, sphere.restitution);
    for (const Box& box : world_.boxes) add(box.friction, box.restitution);
    for (const MeshObstacle& mesh : world_.meshes) add(mesh.friction, mesh.restitution);
    for (const auto& other : bodies_) {
      const ContactSettings& its = other->contact ? *other->contact : own;
      table.bodies.push_back(
          {std::max(own.friction, its.friction), std::max(own.restitution, its.restitution)});
    }
  }

  Thing find(const std::string& name, const Body& body, const SettingsSource& source, const char* attribute) {
    const auto found = things_.find(name);
    if (found == things_.end()) {
      std::vector<std::string> all = fields_of<ContactSettings>().front().type.words;
      all.insert(all.begin(), names_.begin(), names_.end());
      source.fail(attribute, fmt::format("nothing here is called {}", in_quotes(name)),
                  suggestion(name, all, "names of this scene"));
    }
    if (found->second.is_body && bodies_[found->second.number].get() == &body)
      source.fail(attribute, fmt::format("{} is the body itself", in_quotes(name)),
                  "its <contact with> tells by fragments and self how it meets its own parts");
    return found->second;
  }

  void exclude(std::size_t b) {
    Body& body = *bodies_[b];
    for (const std::string& name : body.contact->excluded) {
      const Thing thing = find(name, body, body.contact->source, "not");
      if (!thing.is_body) {
        body.contact_table.obstacles[thing.number].excluded = true;
        continue;
      }
      body.contact_table.bodies[thing.number].excluded = true;
      if (bodies_[thing.number]->contact) bodies_[thing.number]->contact_table.bodies[b].excluded = true;
    }
  }

  // Whether by what counts for all the body is in contact with it; else a hint.
  std::optional<std::string> why_not(const Body& body, const Thing& thing) const {
    const auto lacks = [](const std::string& name, const char* kind) {
      return fmt::format("add {} to <contact with> of body {}", kind, in_quotes(name));
    };
    if (!thing.is_body) {
      const bool meets = thing.number == 0 ? body.floor_contact.has_value() : body.contact->obstacles;
      return meets ? std::nullopt : std::optional(lacks(body.name, thing.number == 0 ? "floor" : "obstacles"));
    }
    for (const Body* one : {&body, static_cast<const Body*>(bodies_[thing.number].get())})
      if (!one->contact || !one->contact->fragments) return lacks(one->name, "fragments");
    return {};
  }

  void take_pair(std::size_t b, const ContactPairSettings& pair) {
    Body& body = *bodies_[b];
    if (!pair.friction && !pair.restitution)
      pair.source.fail("", "this <contact> says nothing of what it names", "give it friction or restitution");
    for (const std::string& name : pair.with) {
      const Thing thing = find(name, body, pair.source, "with");
      ContactTable& table = body.contact_table;
      if (thing.is_body ? table.bodies[thing.number].excluded : table.obstacles[thing.number].excluded)
        pair.source.fail("with", fmt::format("{} is excluded by not=, and has no friction", in_quotes(name)),
                         "leave one of them out");
      if (const auto hint = why_not(body, thing))
        pair.source.fail("with", fmt::format("the body is not in contact with {}", in_quotes(name)), *hint);
      Said& said = thing.is_body ? said_[b][thing.number] : said_of_obstacles_[{b, thing.number}];
      if ((said.friction && pair.friction) || (said.restitution && pair.restitution))
        pair.source.fail("with", fmt::format("{} is named by two <contact> of the body", in_quotes(name)),
                         "leave one of them out");
      if (pair.friction) said.friction = pair.friction;
      if (pair.restitution) said.restitution = pair.restitution;
      said.by = &pair;
      if (!thing.is_body) give(said, table.obstacles[thing.number]);
    }
  }

  static void give(const Said& said, ContactTerms& terms) {
    terms.friction = said.friction.value_or(terms.friction);
    terms.restitution = said.restitution.value_or(terms.restitution);
  }

  // What two bodies say of each other.
  void agree(std::size_t a, std::size_t b) {
    const Said &one = said_[a][b], &other = said_[b][a];
    const auto compare = [&](const char* what, const std::optional<double>& x, const std::optional<double>& y) {
      if (x && y && *x != *y)
        other.by->source.fail(what,
                              fmt::format("{} {} here, and {} where {} names {}", what, *y, *x,
                                          in_quotes(bodies_[a]->name), in_quotes(bodies_[b]->name)),
                              "a pair has one value: leave one of them out");
    };
    compare("friction", one.friction, other.friction);
    compare("restitution", one.restitution, other.restitution);
    for (const Said* said : {&one, &other}) {
      if (!said->by) continue;
      give(*said, bodies_[a]->contact_table.bodies[b]);
      give(*said, bodies_[b]->contact_table.bodies[a]);
    }
  }

  const World& world_;
  const Bodies& bodies_;
  std::map<std::string, Thing> things_;
  std::vector<std::string> names_;                                        // of things_
  std::vector<std::vector<Said>> said_;                                   // by a body, of a body
  std::map<std::pair<std::size_t, std::size_t>, Said> said_of_obstacles_; // by a body, of an obstacle
};

} // namespace

void resolve_contact_names(const World& world, const std::vector<std::unique_ptr<Body>>& bodies) {
  Resolution(world, bodies).resolve();
}

void refuse_restitution(const World& world, const std::vector<std::unique_ptr<Body>>& bodies,
                        const std::string& scheme) {
  const std::string what =
      fmt::format("restitution with integrator '{}', which solves contact and knows no impacts", scheme);
  const char* hint = "leave restitution out, or take an explicit integrator, such as symplectic";
  const auto bounces = [](const ContactTerms& terms) { return terms.restitution > 0 && !terms.excluded; };
  for (const auto& body : bodies) {
    if (!body->contact) continue;
    for (const ContactPairSettings& pair : body->contact->pairs)
      if (pair.restitution.value_or(0) > 0) pair.source.fail("restitution", what, hint);
    if (std::any_of(body->contact_table.obstacles.begin(), body->contact_table.obstacles.end(), bounces) ||
        std::any_of(body->contact_table.bodies.begin(), body->contact_table.bodies.end(), bounces))
      body->contact->source.fail(body->contact->source.given("restitution") ? "restitution" : "", what, hint);
  }
  for (const Sphere& sphere : world.spheres)
    if (sphere.falls() && sphere.restitution.value_or(0) > 0) sphere.source.fail("restitution", what, hint);
}

void refuse_mesh_obstacles(const World& world, const std::vector<std::unique_ptr<Body>>& bodies,
                           const std::string& scheme) {
  for (std::size_t m = 0; m < world.meshes.size(); ++m)
    for (const auto& body : bodies)
      if (body->contact && body->contact->obstacles &&
          !body->contact_table.excludes_obstacle(world.number_of_mesh(m)))
        world.meshes[m].source.fail(
            "",
            fmt::format(
                "body '{}' meets an <obstacle>, and integrator '{}' solves contact with the floor, spheres "
                "and boxes alone",
                body->name, scheme),
            "take an explicit integrator, such as symplectic, or give the obstacle a name and list it in `not` "
            "of <contact>");
}

} // namespace rend
