#include "render/facts/inventory.h"

#include "render/facts/left_out.h"
#include "sim/rows/frequency.h"
#include "sim/scene/step_cause.h"
#include "sim/topology/count.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rend {
namespace {

TimeFacts time_of(const Session& session) {
  const Scene& scene = session.scene();
  double limit = std::numeric_limits<double>::infinity();
  FrequencyBounds all{0, 0, std::numeric_limits<double>::infinity()};
  for (const auto& body : scene.bodies()) {
    const FrequencyBounds b = frequency_bounds(*body->map, body->interactions, *body->mass, body->drag);
    all.omega_squared = std::max(all.omega_squared, b.omega_squared);
    all.damping_rate = std::max(all.damping_rate, b.damping_rate + body->uniform_drag);
    all.least_drag_rate = std::min(all.least_drag_rate, b.least_drag_rate + body->uniform_drag);
    limit = std::min(limit, scene.scheme().limit({b.omega_squared, b.damping_rate + body->uniform_drag,
                                                  b.least_drag_rate + body->uniform_drag}));
  }
  return {.integrator = scene.scheme().name,
          .order = scene.scheme().order,
          .evaluations = scene.scheme().evaluations,
          .step = scene.step_size(),
          .automatic = scene.automatic_step(),
          .limit = std::isfinite(limit) ? std::optional(limit) : std::nullopt,
          .cause = std::isfinite(limit) ? cause_of_step(scene).words : std::string(),
          .omega = std::sqrt(all.omega_squared),
          .damping_rate = all.damping_rate,
          .duration = session.clock().duration(),
          .fps = session.clock().fps(),
          .steps = session.clock().steps(),
          .frames = session.clock().frames(),
          .clip_duration = session.clock().playback().is_real_time()
                               ? std::nullopt
                               : std::optional(session.clock().clip_duration())};
}

std::vector<SlotFacts> slots_of(const EmbeddedMap& map) {
  std::vector<SlotFacts> all;
  for (int mask = 0; mask < orbit_kinds; ++mask) {
    Orbit orbit;
    orbit.mask = static_cast<std::uint8_t>(mask);
    if (map.uses(orbit)) all.push_back({orbit, map.cells(orbit).slots(), map.cells(orbit).bytes()});
  }
  return all;
}

std::vector<EmbeddingFacts> embeddings_of(const EmbeddedMap& map) {
  std::vector<EmbeddingFacts> all;
  for (const auto& column : map.columns()) all.push_back({column->name(), column->orbit(), column->bytes()});
  return all;
}

std::vector<InteractionFacts> interactions_of(const Program& program) {
  std::vector<InteractionFacts> all;
  const auto add = [&](const std::vector<Binder>& binders, RowsAre rows_are) {
    for (const Binder& binder : binders)
      all.push_back({.name = binder.interaction()->name,
                     .rows_are = rows_are,
                     .owner = binder.pattern().owner,
                     .rows = binder.rows().live_count(),
                     .bytes = binder.rows().bytes()});
  };
  add(program.folded(), folded_rows_are(program));
  add(program.elementary(), RowsAre::Cornered);
  return all;
}

std::vector<LawFacts> laws_of(const Body& body) {
  std::vector<LawFacts> all;
  for (const TearLaw& law : body.tear_laws) {
    const LawSettings& s = law.settings();
    all.push_back({.criterion = s.criterion->name,
                   .what = s.criterion->what,
                   .threshold = s.threshold,
                   .unit = s.unit,
                   .change = s.change->name,
                   .bytes = law.bytes()});
  }
  return all;
}

BodyFacts cells_of(const Body& body) {
  const GMap& map = body.map->map();
  const CellCounts counts = count_cells(map);
  BodyFacts facts;
  facts.name = body.name;
  facts.dimension = map.dimension();
  facts.vertices = counts.vertices;
  facts.edges = counts.edges;
  facts.elements = map.dimension() == 2 ? counts.faces : counts.volumes;
  facts.darts = map.dart_count();
  facts.fragments = counts.fragments;
  facts.euler = counts.euler;
  facts.prescribed = body.constraints.vertices().size();
  return facts;
}

BytesByPart by_part(const std::vector<MemoryEntry>& arrays) {
  BytesByPart bytes;
  for (const std::string& part : footprint_parts()) {
    const std::size_t of_part = bytes_of_part(arrays, part);
    if (of_part > 0) bytes.parts.emplace_back(part, of_part);
    bytes.total += of_part;
  }
  return bytes;
}

void add_built(const Scene& scene, const Body& body, BodyFacts& facts) {
  facts.slots = slots_of(*body.map);
  facts.embeddings = embeddings_of(*body.map);
  facts.interactions = interactions_of(*body.program);
  facts.laws = laws_of(body);
  facts.arrays = footprint_of(body);
  facts.bytes = by_part(facts.arrays);
  facts.left_out = left_out_of(scene, body);
  facts.applied = body.applied;
  facts.notes = body.notes;
  if (body.assembly)
    facts.solver = SolvingFigures{body.integrator->solver(), body.assembly->pattern()->blocks()};
}

} // namespace

Inventory inventory_of(Session& session) {
  Scene& scene = session.scene();
  Inventory inventory;
  inventory.preset = session.preset_path();
  inventory.name = scene.name();
  if (session.preset().has("thesis")) inventory.thesis = session.preset().text("thesis");
  inventory.time = time_of(session);
  for (const auto& body : scene.bodies()) inventory.bodies.push_back(cells_of(*body));
  try {
    scene.step();
  } catch (const Unstable& error) {
    inventory.first_step = error.what();
  }
  inventory.arrays = footprint_of(scene);
  std::vector<MemoryEntry> all = inventory.arrays;
  for (std::size_t n = 0; n < inventory.bodies.size(); ++n) {
    BodyFacts& facts = inventory.bodies[n];
    add_built(scene, *scene.bodies()[n], facts);
    all.insert(all.end(), facts.arrays.begin(), facts.arrays.end());
  }
  inventory.bytes = by_part(all);
  inventory.step = passes_of(scene);
  inventory.left_out = left_out_of(scene);
  return inventory;
}

} // namespace rend
