#include "render/facts/left_out.h"

#include <fmt/format.h>

namespace rend {
namespace {

// Parallel springs that share a row.
void add_folded(const Body& body, std::vector<std::string>& out) {
  const Program& program = *body.program;
  if (program.folded().empty()) {
    out.push_back("merging of parallel springs: a <tear> needs the force of each element");
    return;
  }
  if (!program.options().fold) return;
  for (const Binder& binder : program.folded()) {
    std::size_t units = 0;
    std::vector<std::size_t> keys;
    binder.rows().for_each([&](std::size_t key, std::size_t) {
      keys.clear();
      binder.units_of_row(key, keys);
      units += keys.size();
    });
    const std::size_t rows = binder.rows().live_count();
    if (units > rows)
      out.push_back(fmt::format(
          "parallel springs: {} of {} act between vertices that another one joins, and are merged with it",
          units - rows, binder.interaction()->name));
  }
}

void add_undamped(const Body& body, std::vector<std::string>& out) {
  std::string names;
  for (const auto& interaction : body.interactions)
    if (!interaction->damped) names += (names.empty() ? "" : ", ") + interaction->name;
  if (!names.empty()) out.push_back(fmt::format("damping: none of {}", names));
}

void add_awaited(const Body& body, std::vector<std::string>& out) {
  for (const std::string& name : body.awaited.names())
    out.push_back(fmt::format("{}: no cell here is one for it; where a law makes one, it is added", name));
}

void add_laws(const Body& body, std::vector<std::string>& out) {
  if (body.corner_force.empty())
    out.push_back("forces of single elements: no <tear> compares them");
  else if (body.view().corner_buffer)
    out.push_back(
        "forces of single elements in most steps: an upper bound tells when none can exceed the threshold");
  if (!body.fragment_counter)
    out.emplace_back("fragments counted at each tear: only rend run --events needs it");
}

void add_contact(const Scene& scene, const Body& body, std::vector<std::string>& out) {
  if (!body.floor_contact && !scene.world().floor)
    out.emplace_back("contact with the floor: there is no floor");
  if (!body.contact || !body.contact->faces())
    out.emplace_back("contact of faces: the body collides with neither obstacles nor fragments");
  else if (!body.contact->fragments)
    out.emplace_back("contact between fragments and bodies: not in <contact with>");
}

} // namespace

std::vector<std::string> left_out_of(const Scene& scene, const Body& body) {
  std::vector<std::string> out = body.left_out;
  add_awaited(body, out);
  add_folded(body, out);
  add_undamped(body, out);
  add_laws(body, out);
  add_contact(scene, body, out);
  if (!body.assembly)
    out.push_back(fmt::format("stiffness matrix and solver: '{}' solves no system", scene.scheme().name));
  if (body.integrator->bytes() == 0)
    out.push_back(fmt::format("arrays of the scheme: '{}' needs none", scene.scheme().name));
  if (body.probes.empty()) out.emplace_back("probes and answers: none");
  return out;
}

std::vector<std::string> left_out_of(const Scene& scene) {
  std::vector<std::string> out;
  const World& world = scene.world();
  if (world.gravity.isZero(0)) out.emplace_back("gravity: none");
  if (!world.wind) out.emplace_back("wind: none");
  if (!world.has_obstacles()) out.emplace_back("obstacles: none");
  if (!world.floor) out.emplace_back("floor: none, and so no shadow on it");
  if (!scene.contacts() || !scene.contacts()->with_faces())
    out.emplace_back("contact other than with the floor: no body asks for it");
  out.emplace_back("surfaces and drawing: only rend render makes them");
  return out;
}

} // namespace rend
