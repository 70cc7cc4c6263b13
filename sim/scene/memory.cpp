#include "sim/scene/memory.h"

namespace rend {
namespace {

// A list of holdings; skips empty ones.
class Gathering {
public:
  void add(const char* part, std::string name, std::string per, std::size_t bytes) {
    if (bytes > 0) all.push_back({part, std::move(name), std::move(per), bytes});
  }
  std::vector<MemoryEntry> all;
};

void add_map(const EmbeddedMap& map, Gathering& to) {
  to.add("map", "links of darts", "dart", map.map().bytes());
  for (int mask = 0; mask < orbit_kinds; ++mask) {
    Orbit orbit;
    orbit.mask = static_cast<std::uint8_t>(mask);
    if (map.uses(orbit))
      to.add("slots", std::string("slots of ") + name(orbit), "dart and slot", map.cells(orbit).bytes());
  }
  for (const auto& column : map.columns())
    to.add("embeddings", column->name(), std::string(name(column->orbit())) + " " + to_string(column->orbit()),
           column->bytes());
}

void add_program(const Program& program, Gathering& to) {
  std::size_t rows = 0;
  const auto add_rows = [&](const std::vector<Binder>& binders, const char* which) {
    for (const Binder& binder : binders) {
      to.add("program", "rows of " + binder.interaction()->name + which, "unit", binder.rows().bytes());
      rows += binder.rows().bytes();
    }
  };
  add_rows(program.folded(), "");
  add_rows(program.elementary(), ", into corners");
  const std::size_t vertices = program.vertices() * sizeof(double);
  const std::size_t drag = program.drag_rate() ? vertices : 0;
  to.add("program", "inverse masses", "vertex", vertices);
  to.add("program", "rates of viscosity", "vertex", drag);
  to.add("program", "vertices of corners", "corner", program.bytes() - rows - vertices - drag);
}

} // namespace

const std::vector<std::string>& footprint_parts() {
  static const std::vector<std::string> all{"map",         "slots",  "embeddings", "program",
                                            "laws",        "solver", "integrator", "state",
                                            "constraints", "loads",  "contact",    "guard"};
  return all;
}

std::vector<MemoryEntry> footprint_of(const Body& body) {
  Gathering to;
  add_map(*body.map, to);
  add_program(*body.program, to);
  for (const TearLaw& law : body.tear_laws) to.add("laws", law.settings().criterion->name, "", law.bytes());
  if (body.assembly) to.add("solver", "places of blocks and their pattern", "block", body.assembly->bytes());
  to.add("solver", "matrix, factors and preconditioner", "block", body.integrator->solver().bytes);
  to.add("integrator", "the scheme's own", "vertex", body.integrator->bytes());
  if (body.drifts()) to.add("integrator", "forces of the kick", "vertex", body.vertices() * sizeof(Record));
  to.add("state", "forces at the start of the step", "vertex", bytes_of(body.force));
  to.add("state", "forces on corners", "corner", bytes_of(body.corner_force));
  to.add("state", "the state at the end of the step", "vertex", body.next.bytes());
  to.add("constraints", "motions, and vertices that obey them", "", body.constraints.bytes());
  to.add("loads", "patches, and the sum of loads", "", body.loads.bytes());
  if (body.work_meter) to.add("guard", "work of loads, drives and contact", "vertex", body.work_meter->bytes());
  return std::move(to.all);
}

std::vector<MemoryEntry> footprint_of(const Scene& scene) {
  Gathering to;
  if (scene.contacts()) to.add("contact", "faces, pairs and touches", "", scene.contacts()->bytes());
  std::size_t meshes = 0;
  for (const MeshObstacle& mesh : scene.world().meshes) meshes += mesh.bytes();
  to.add("contact", "meshes of obstacles", "", meshes);
  to.add("guard", "a state to go back to", "vertex", scene.guard_bytes());
  return std::move(to.all);
}

std::size_t bytes_of_part(const std::vector<MemoryEntry>& all, const std::string& part) {
  std::size_t sum = 0;
  for (const MemoryEntry& one : all)
    if (one.part == part) sum += one.bytes;
  return sum;
}

std::size_t bytes_of_all(const Scene& scene) {
  std::size_t sum = 0;
  for (const MemoryEntry& one : footprint_of(scene)) sum += one.bytes;
  for (const auto& body : scene.bodies())
    for (const MemoryEntry& one : footprint_of(*body)) sum += one.bytes;
  return sum;
}

} // namespace rend
