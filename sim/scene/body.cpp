#include "sim/scene/body.h"

#include <algorithm>
#include <cmath>

namespace rend {

Body::~Body() {
  program.reset(); // lets go of the map
  if (map) map->unsubscribe(changes);
}

void Body::prepare(const Scheme& scheme, bool walk, int threads) {
  const bool elementary = std::any_of(laws.begin(), laws.end(),
                                      [](const TearLaw& law) { return law.settings().criterion->elementary; });
  ProgramOptions options;
  options.elementary = elementary;
  options.folded = !elementary || scheme.evaluations > 1;
  options.fold = cumulated != Cumulated::No;
  options.walk = walk;
  options.threads = threads;
  program = std::make_unique<Program>(*map, interactions, *mass, drag, options);
  integrator = scheme.make();
  if (elementary) corner_force.resize(map->cells(mass->orbit()).slots());
  if (tears()) {
    map->subscribe(changes);
    map->reserve_for_separations();
    program->reserve_for_separations();
    for (TearLaw& law : laws) law.reserve_for_separations();
    force.reserve(map->slots_when_separated(Vertex));
    next.position.reserve(map->slots_when_separated(Vertex));
    next.velocity.reserve(map->slots_when_separated(Vertex));
  }
  constrain(0, map->position().values().data(), map->velocity().values().data());
}

void Body::forces(double, const Record* position, const Record* velocity, Record* out) {
  program->forces(position, velocity, out);
}

void Body::constrain(double time, Record* position, Record* velocity) {
  if (!constraints.vertices().empty()) constraints.apply(*map, time, position, velocity);
}

void Body::evaluate(double) {
  inverse_mass = program->inverse_mass(); // rebinding may have moved them
  drag_rate = program->drag_rate();
  force.resize(vertices());
  const Record *x = map->position().values().data(), *v = map->velocity().values().data();
  if (corner_force.empty()) program->forces(x, v, force.data());
  else program->corner_forces(x, v, corner_force.data(), force.data());
}

int Body::tear(double time, double, long number) {
  int made = 0;
  for (std::size_t n = 0; n < laws.size(); ++n) {
    TearLaw& law = laws[n];
    if (!law.active(time)) continue;
    const ForceView view{*map, map->position().values().data(), force.data(),
                         corner_force.empty() ? nullptr : corner_force.data()};
    if (law.find(view).empty()) continue;
    const std::size_t before = events.size();
    const int changed = law.apply(*map, view, events);
    for (std::size_t e = before; e < events.size(); ++e) {
      events[e].time = time;
      events[e].step = number;
      events[e].law = static_cast<int>(n);
    }
    made += changed;
    if (changed == 0) continue;
    rebind();
    evaluate(time);
  }
  return made;
}

void Body::rebind() {
  if (!changes.any) return;
  program->rebind();
  if (!corner_force.empty()) corner_force.resize(map->cells(mass->orbit()).slots());
  constraints.rebind(*map, changes);
  for (TearLaw& law : laws) law.rebind(changes);
  changes.clear();
}

bool Body::commit() {
  if (!next.finite()) return false;
  map->position().values().swap(next.position);
  map->velocity().values().swap(next.velocity);
  return true;
}

} // namespace rend
