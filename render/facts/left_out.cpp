#include "render/facts/left_out.h"

#include <fmt/format.h>

namespace rend {
namespace {

// Parallel springs that share a row.
void add_folded(const Body& body, std::vector<std::string>& out) {
  const Program& program = *body.program;
  if (program.folded().empty()) {
    out.push_back(
        "rows of parallel springs folded into one: a law asks for the forces of each element, and the scheme "
        "evaluates but those");
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
      out.push_back(
          fmt::format("rows of parallel springs: {} of {} act between particles that others join, and share "
                      "a row",
                      units - rows, binder.interaction()->name));
  }
}

void add_undamped(const Body& body, std::vector<std::string>& out) {
  std::string names;
  for (const auto& interaction : body.interactions)
    if (!interaction->damped) names += (names.empty() ? "" : ", ") + interaction->name;
  if (!names.empty()) out.push_back(fmt::format("velocities in forces: no damping of {}", names));
}

void add_laws(const Body& body, std::vector<std::string>& out) {
  if (body.corner_force.empty())
    out.push_back(
        "forces on element corners, and rows for them: no law compares the forces of single elements");
  else if (body.view().corner_buffer)
    out.push_back(
        "forces on element corners in every step: sums of sizes tell where none can exceed the threshold");
  if (!body.fragment_counter)
    out.emplace_back("births of fragments at each change: asked for by rend run --events alone");
}

void add_contact(const Scene& scene, const Body& body, std::vector<std::string>& out) {
  if (!body.floor_contact && !scene.world().floor)
    out.emplace_back("contact with the floor: the world has none");
  if (!body.contact || !body.contact->faces())
    out.emplace_back("contact of faces: the body is in contact with neither obstacles nor fragments");
  else if (!body.contact->fragments)
    out.emplace_back("contact between fragments and bodies: <contact> does not name them");
}

} // namespace

std::vector<std::string> left_out_of(const Scene& scene, const Body& body) {
  std::vector<std::string> out = body.left_out;
  add_folded(body, out);
  add_undamped(body, out);
  add_laws(body, out);
  add_contact(scene, body, out);
  if (!body.assembly)
    out.push_back(fmt::format("matrix of stiffness and its solver: '{}' does not solve", scene.scheme().name));
  if (body.integrator->bytes() == 0)
    out.push_back(
        fmt::format("arrays of the scheme: '{}' needs none besides the two states", scene.scheme().name));
  if (body.probes.empty()) out.emplace_back("probes and answers: none");
  return out;
}

std::vector<std::string> left_out_of(const Scene& scene) {
  std::vector<std::string> out;
  const World& world = scene.world();
  if (world.gravity.isZero(0)) out.emplace_back("gravity: none");
  if (!world.wind) out.emplace_back("wind: none");
  if (!world.has_obstacles()) out.emplace_back("obstacles: neither sphere nor box");
  if (!world.floor) out.emplace_back("floor: none is drawn, and so no shadow on it");
  if (!scene.contacts()) out.emplace_back("contacts beyond a body's own with the floor: no body asks for any");
  out.emplace_back("surfaces, and all that draws: rend render makes them, rend run does not");
  return out;
}

} // namespace rend
