#include "sim/body/body.h"

#include "sim/base/archive.h"
#include "sim/base/profile.h"
#include "sim/embedding/reorder.h"
#include "sim/fracture/pairs.h"
#include "sim/integrate/leapfrog.h"
#include "sim/integrate/rigid_motions.h"
#include "sim/mechanics/spring_law.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rend {
namespace {

// The number of darts on the borders of elements that are not sewn.
std::size_t open_darts(const GMap& map) {
  std::size_t count = 0;
  map.for_each_dart([&](Dart d) { count += map.is_free(map.dimension(), d); });
  return count;
}

// The scratch of walks grows when it is first used: here, and not in the step in which a criterion first finds
// something.
void reserve_walks(const GMap& map) {
  Dart first;
  bool any = false;
  map.for_each_dart([&](Dart d) {
    if (!any) first = d;
    any = true;
  });
  if (any) smallest_dart(map, Vertex, first);
}

} // namespace

Body::~Body() {
  boundary_.reset(); // these let go of the map
  program.reset();
  if (map) map->unsubscribe(changes);
}

void Body::prepare(const Scheme& scheme, const RunSettings& settings) {
  const bool elementary =
      std::any_of(tear_laws.begin(), tear_laws.end(), [](const TearLaw& law) { return law.elementary(); });
  ProgramOptions options;
  options.elementary = elementary;
  options.fold = cumulated != Cumulated::No;
  options.walk = settings.walk;
  sums_ = elementary && !watches_ && sums_available(interactions, options) && awaited.only(spring_law()) &&
          std::all_of(tear_laws.begin(), tear_laws.end(),
                      [](const TearLaw& law) { return !law.elementary() || law.by_sums(); });
  options.folded = !elementary || scheme.evaluations > 1 || sums_ || watches_;
  options.threads = settings.threads;
  options.timed = profile && profile->every_step();
  options.parallel_small_bodies = parallel_small_bodies;
  program = std::make_unique<Program>(*map, interactions, *mass, drag, options);
  if (scheme.solves) assembly = std::make_unique<Assembly>(*map, *program);
  const double size = extent(map->rest().values(), program->inverse_mass());
  SchemeSettings own = settings.scheme;
  own.size = size > 0 ? size : 1;
  integrator = scheme.make(own);
  if (scheme.hands_on_acceleration) scheme_acceleration = &map->add(VertexAcceleration{});
  next.accelerates = scheme.hands_on_acceleration;
  if (elementary) corner_force.resize(map->cells(mass->orbit()).slots());
  map->subscribe(changes);
  if (solved_contact) rebind_solved_contact();
  if (tears()) reserve_for_separations();
  make_work_meter();
  constrain(0, map->position().values().data(), map->velocity().values().data());
}

// An equilibrium has no account of work.
void Body::make_work_meter() {
  const bool touched = floor_contact || (contact && contact->faces());
  if (integrator->has_inertia() &&
      (constraints.drives() || !loads.empty() || touched || tears() || changing_gravity))
    work_meter = std::make_unique<WorkMeter>(touched ? contact_table.obstacles.size() : 0);
}

MeteredBody Body::metered(const Record* internal_force) const {
  return {*this,         constraints, loads, map->position().values().data(), map->velocity().values().data(),
          internal_force};
}

Boundary& Body::boundary() {
  if (!boundary_) boundary_ = std::make_unique<Boundary>(*map, border);
  boundary_->update();
  return *boundary_;
}

void Body::reserve_for_separations() {
  reserve_walks(map->map());
  map->reserve_for_separations();
  program->reserve_for_separations();
  for (TearLaw& law : tear_laws) law.reserve_for_separations();
  force.reserve(map->slots_when_separated(Vertex));
  next.position.reserve(map->slots_when_separated(Vertex));
  next.velocity.reserve(map->slots_when_separated(Vertex));
  if (next.accelerates) next.acceleration.reserve(map->slots_when_separated(Vertex));
  loads.reserve_for_separations(*map);
}

void Body::forces(double time, const Record* position, const Record* velocity, Record* out) {
  {
    const PhaseScope within(profile, Phase::Forces);
    program->forces(position, velocity, out);
  }
  ++evaluations;
  if (solved_contact) solved_contact->add_forces(position, out);
  if (faulty.armed(StepStage::Forces)) faulty.inject(program->inverse_mass(), vertices(), out);
  update_loads(time, position, velocity);
}

void Body::forces_in_ranges(double time, const Record* position, const Record* velocity, Record* out,
                            RangeFunction whole) {
  update_loads(time, position, velocity);
  program->forces_in_ranges(position, velocity, out, range_size, whole);
  ++evaluations;
}

void Body::update_loads(double time, const Record* position, const Record* velocity) {
  if (changing_gravity) gravity = Record(changing_gravity(time));
  const PhaseScope within(loads.empty() ? nullptr : profile, Phase::Loads);
  load = loads.evaluate(*map, time, position, velocity);
  if (load && faulty.armed(StepStage::Loads))
    load = faulty.inject_copy(program->inverse_mass(), vertices(), load);
}

void Body::constrain(double time, Record* position, Record* velocity) {
  if (!constraints.vertices().empty()) constraints.apply(*map, time, position, velocity);
}

void Body::add_stiffness(const Record* position, const Record* velocity, Tangent tangent, double by_position,
                         double by_velocity, BlockMatrix& out) {
  const PhaseScope within(profile, Phase::Stiffness);
  assembly->add(position, velocity, tangent, by_position, by_velocity, out);
  if (solved_contact) solved_contact->add_stiffness(position, by_position, out);
}

void Body::begin_solve(double end, double step, const StateView& now, const Record* internal) {
  if (solved_contact) solved_contact->begin(*this, end, step, now, internal);
}

bool Body::tighten_contact(const Record* position) {
  return solved_contact && solved_contact->tighten(position);
}

void Body::mark_prescribed(double time, std::uint8_t* axes) {
  constraints.mark(time, axes);
}

// Not with a full profile, which separates forces from integration, nor in bodies that tear, whose criteria
// need the forces, nor in a step that drifts.
bool Body::may_defer_forces() const {
  return !drifts() && integrator->has_fused_advance() && !tears() && !(profile && profile->every_step()) &&
         !program->options().walk && !parallel_small_bodies && !faulty.armed(StepStage::Forces);
}

void Body::bind_program() {
  inverse_mass = program->inverse_mass(); // rebinding may have reallocated them
  drag_rate = program->drag_rate();
  force.resize(vertices());
}

void Body::defer_forces() {
  bind_program();
  forces_deferred_ = true;
}

void Body::evaluate() {
  const PhaseScope within(profile, Phase::Forces);
  bind_program();
  forces_deferred_ = false;
  const Record *x = map->position().values().data(), *v = map->velocity().values().data();
  if (sums_)
    program->forces_with_sums(x, v, force.data());
  else if (corner_force.empty() || watches_)
    program->forces(x, v, force.data());
  else
    program->corner_forces(x, v, corner_force.data(), force.data());
  ++evaluations;
  if (faulty.armed(StepStage::Forces)) faulty.inject(inverse_mass, vertices(), force.data());
  update_loads(time_, x, v);
  if (work_meter) work_meter->settle(metered());
}

BodyEnergy Body::energy(const Scheme& scheme, double step, std::vector<Record>& scratch) {
  bind_program();
  const Record *x = map->position().values().data(), *v = map->velocity().values().data();
  BodyEnergy sum{.elastic = program->elastic_energy(x), .shadow = 0, .work = {}};
  if (work_meter) sum.work = work(scratch);
  const double by_power = staggered ? 0.5 : scheme.shadow;
  const double by_forces = staggered ? 0 : drifts_always ? leapfrog_shadow : scheme.force_shadow;
  if (by_power == 0 && by_forces == 0) return sum;
  if (!work_meter) program->forces(x, v, scratch.data());
  const FreeMotion free = free_motion(metered(scratch.data()), time_);
  const double h = last_step_ > 0 ? last_step_ : step;
  if (by_power != 0) sum.shadow += by_power * h * free.power;
  if (by_forces != 0) sum.shadow -= by_forces * h * h * free.squared_forces;
  return sum;
}

Work Body::work(std::vector<Record>& scratch) {
  const Record *x = map->position().values().data(), *v = map->velocity().values().data();
  program->forces(x, v, scratch.data());
  update_loads(time_, x, v);
  return work_meter->work(metered(scratch.data()));
}

ForceView Body::view() const {
  return {*map,
          *program,
          *mass,
          map->position().values().data(),
          map->velocity().values().data(),
          force.data(),
          corner_force.empty() || sums_ ? nullptr : corner_force.data(),
          sums_ ? corner_force.data() : nullptr,
          time_,
          constraints.vertices()};
}

void Body::clear_sums() {
  for (Record& f : force) f.w = 0;
}

CriterionRequest Body::request_for(const LawSettings& law) const {
  return {*map,     interactions, *mass, law.kind, law.compression, LeastPart::of_size(law.smallest_part),
          law.grain};
}

void Body::watch_all_criteria() {
  watches_ = true;
  tear_laws.clear();
  const int dimension = map->dimension();
  for (const NamedCriterion& criterion : named_criteria()) {
    LawSettings law{.criterion = criterion.type,
                    .threshold = std::numeric_limits<double>::infinity(),
                    .kind = criterion.kind,
                    .cell = criterion.cell()};
    const CriterionRequest request = request_for(law);
    const bool merged = cumulated == Cumulated::Yes && criterion.type->elementary;
    if (merged || !criterion.without_meaning(dimension).empty() || !criterion.type->lacking(request).empty())
      continue;
    law.change = &default_change(law.cell);
    law.unit = criterion.type->unit_there ? criterion.type->unit_there(request) : criterion.type->unit;
    tear_laws.emplace_back(request, law);
  }
}

void Body::measure_elements() {
  if (corner_force.empty()) return;
  thread_local std::vector<Record> sums; // those of `force`, up to round-off
  sums.resize(force.size());
  program->corner_forces(map->position().values().data(), map->velocity().values().data(), corner_force.data(),
                         sums.data());
}

int Body::tear(double time, long number, const std::function<void()>& sound) {
  if (watches_ && number % look_every != 0 && number != last_look) return 0;
  if (watches_) measure_elements();
  const std::size_t before = events.size();
  int made = 0;
  for (std::size_t n = 0; n < tear_laws.size(); ++n)
    if (tear_laws[n].active(time)) made += apply_law(n, time, number, sound);
  if (made == 0) return 0;
  if (fragment_counter) fragment_counter->settle(map->map(), std::span(events).subspan(before));
  if (map->map().dart_count() == 0 && !deleted_at) deleted_at = time;
  return made;
}

int Body::apply_law(std::size_t number, double time, long step, const std::function<void()>& sound) {
  const ForceView now = view();
  const bool look = watches_ || step % look_every == 0;
  if (tear_laws[number].find_and_note(now, time, look).empty()) return 0;
  sound();
  if (change_observer) change_observer(WitnessAt::BeforeChanges);
  const bool remeshes = work_meter && tear_laws[number].settings().change->grows;
  double before = 0;
  const auto weigh = [&] { before = energy_of_matter(); };
  const int made = make_changes(number, now, time, step, remeshes ? std::function<void()>(weigh) : nullptr);
  if (made > 0) follow_changes();
  if (made > 0 && remeshes) work_meter->remesh(energy_of_matter() - before);
  if (change_observer) change_observer(WitnessAt::AfterChanges);
  return made;
}

namespace {

// What a rule makes may be nothing that the body's interactions can be put on. Then nothing has changed, and
// the run ends.
int apply_or_stop(Body& body, TearLaw& law, const ForceView& now, double time, long step,
                  const std::function<void()>& before_closing) {
  try {
    return law.apply(*body.map, now, body.events, body.fragment_counter.get(), before_closing);
  } catch (const UserError& error) {
    throw UserError(
        Exit::Unstable, law.settings().source.place(),
        fmt::format("the simulation was stopped at {:.6g} s (step {}) in body '{}', because '{}' makes "
                    "what it cannot go on with: {}",
                    time, step, body.name, law.settings().change->name, error.what()),
        error.hint);
  }
}

} // namespace

// Kinetic and elastic [J], by the rows and masses that are bound.
double Body::energy_of_matter() const {
  const double* w = program->inverse_mass();
  double kinetic = 0;
  for (Slot v = 0; v < program->vertices(); ++v)
    if (w[v] > 0) kinetic += 0.5 / w[v] * map->velocity()[v].vec().squaredNorm();
  return kinetic + program->elastic_energy(map->position().values().data());
}

int Body::make_changes(std::size_t number, const ForceView& now, double time, long step,
                       const std::function<void()>& before_closing) {
  const PhaseScope within(profile, Phase::Changes);
  const std::size_t before = events.size();
  const bool weighs =
      work_meter && !tear_laws[number].settings().change->keeps_matter && !Vec3(gravity).isZero(0);
  const double potential = weighs ? gravity_energy(*map, *mass, gravity) : 0;
  const int made = apply_or_stop(*this, tear_laws[number], now, time, step, before_closing);
  if (made > 0 && weighs) work_meter->change(gravity_energy(*map, *mass, gravity) - potential);
  for (std::size_t e = before; e < events.size(); ++e) {
    events[e].time = time;
    events[e].step = step;
    events[e].law = static_cast<int>(number);
  }
  return made;
}

void Body::follow_changes() {
  const PhaseScope within(profile, Phase::Rebinding);
  if (awaited.arrive(*map, changes, interactions)) take_up_interactions();
  if (slots_scattered(*map)) map->renumber();
  rebind();
  if (work_meter) work_meter->forget_vertices();
  evaluate();
}

void Body::take_up_interactions() {
  program->take_up_interactions();
  for (TearLaw& law : tear_laws) law.make_anew(request_for(law.settings()));
  reserve_for_separations();
}

void Body::advance(double time, double step) {
  const PhaseScope within(profile, Phase::Integration);
  if (sums_) clear_sums();
  next.resize(vertices());
  next.probe = Double4{};
  next_time_ = time + step;
  next.staggered = false;
  if (drifts())
    rend::drift(*this, time, step, current(), force.data(), next);
  else
    move(time, step);
  if (faulty.armed(StepStage::Integration)) inject_into_next();
  if (next.large) fence_streams(); // for schemes that write their state on this thread
}

void Body::drift_again(double time, double step) {
  const PhaseScope within(profile, Phase::Integration);
  update_loads(time, map->position().values().data(), map->velocity().values().data());
  next.probe = Double4{};
  rend::drift(*this, time, step, current(), force.data(), next);
}

void Body::kick(double time, double step) {
  const PhaseScope within(profile, Phase::Integration);
  rend::kick(*this, time, step, current(), next, kick_force_);
}

StateView Body::current() const {
  return {map->position().values().data(), map->velocity().values().data(),
          scheme_acceleration ? scheme_acceleration->values().data() : nullptr, staggered};
}

// By the scheme. Its fused advance evaluates the forces of the current state, and leaves the loads at them.
void Body::move(double time, double step) {
  if (!forces_deferred_) {
    if (solved_contact) solved_contact->end(); // of the step before, which may have failed
    integrator->advance(*this, time, step, current(), force.data(), next);
    if (solved_contact) end_solved_contact();
    return;
  }
  integrator->advance_fused(*this, time, step, current(), force.data(), next);
  if (work_meter) work_meter->settle(metered());
}

void Body::end_solved_contact() {
  if (work_meter) {
    work_meter->contact(solved_contact->work());
    for (const std::uint32_t obstacle : solved_contact->touched()) work_meter->touch(obstacle);
  }
  solved_contact->end();
}

void Body::restore_state(const State& start, double time) {
  map->position().values() = start.position;
  map->velocity().values() = start.velocity;
  if (scheme_acceleration) {
    scheme_acceleration->values() = start.acceleration;
    scheme_acceleration->values().resize(vertices()); // none, if the state knows none
  }
  staggered = start.staggered;
  time_ = time;
}

void Body::exchange_state(State& other, double& time, double& last_step) {
  map->position().values().swap(other.position);
  map->velocity().values().swap(other.velocity);
  if (scheme_acceleration) scheme_acceleration->values().swap(other.acceleration);
  std::swap(staggered, other.staggered);
  std::swap(time_, time);
  std::swap(last_step_, last_step);
}

void Body::inject_into_next() {
  faulty.inject(program->inverse_mass(), vertices(), next.velocity.data());
  next.probe_all();
}

void Body::rebind_solved_contact() {
  bind_program();
  solved_contact->end();
  solved_contact->rebind(*this, map->rest().values());
}

void Body::rebind() {
  if (!changes.any) return;
  program->rebind();
  if (assembly) assembly->rebind();
  if (solved_contact) rebind_solved_contact();
  if (!corner_force.empty()) corner_force.resize(map->cells(mass->orbit()).slots());
  constraints.rebind(*map, changes);
  loads.rebind(*map);
  if (work_meter) work_meter->rebind();
  for (TearLaw& law : tear_laws) law.rebind(changes);
  if (changes.whole && tears()) reserve_for_separations(); // there may be more rows than were reserved
  changes.clear();
}

// Derived data is bound again after reading; forces are evaluated at the start of the next step.
void Body::store(Archive& archive, long done, double step) {
  archive.mark(name);
  const bool fixed = archive.reading() && !tears();
  const std::size_t open = fixed ? open_darts(map->map()) : 0, darts = map->map().dart_count();
  if (awaited.store(archive, *map, interactions)) take_up_interactions();
  map->store(archive);
  refuse_unless(!fixed || (open_darts(map->map()) == open && map->map().dart_count() == darts),
                "a body is torn that nothing tears");
  std::vector<double> numbers = integrator->saved_state();
  archive.list(events, map->map().capacity(), "there are more tears than darts");
  archive(deleted_at, evaluations, time_, last_step_, staggered);
  next.store(archive, map->cells(Vertex).slots());
  archive.same(numbers.size(), "numbers that its steps hand on");
  for (double& number : numbers) archive.unbounded(number);
  for (Answer& answer : answers) archive(answer.asked, answer.measured);
  if (work_meter) work_meter->store(archive, map->cells(Vertex).slots());
  for (TearLaw& law : tear_laws) law.store(archive, static_cast<double>(done) * step);
  if (!archive.reading()) return;
  check_read(done, step);
  refuse_unless(integrator->restore_state(numbers), "what its steps hand on is nothing that they would");
  rebind();
  bind_program();
  update_loads(time_, map->position().values().data(), map->velocity().values().data());
}

// Times of steps are products in floating point.
void Body::check_read(long done, double step) const {
  const double now = static_cast<double>(done) * step;
  refuse_unless(is_count(evaluations), "forces were evaluated less often than never");
  refuse_unless(std::abs(time_ - now) <= 1e-3 * step, "a body has another time than the scene");
  refuse_unless(last_step_ >= 0 && last_step_ <= 1.001 * step, "a step was longer than it is");
  refuse_unless(!staggered || contact, "a body was touched that has no contact");
  refuse_unless(deleted_at.has_value() == (map->map().dart_count() == 0),
                "a body is gone that is there, or the reverse");
  refuse_unless(!deleted_at || (*deleted_at >= 0 && *deleted_at <= now),
                "a body was gone before the start, or later than now");
  for (const TearEvent& event : events) {
    refuse_unless(event.dart.value < map->map().capacity(), "a tear is at a dart that is not there");
    refuse_unless(static_cast<std::size_t>(event.law) < tear_laws.size(),
                  "a tear is of a law that is not there");
    refuse_unless(event.step <= done && event.time >= 0 && event.time <= now, "a tear is later than now");
  }
}

// Where gravity grows, what is in it changes without motion.
void Body::measure_gravity() {
  const Vec3 change = changing_gravity(next_time_) - changing_gravity(time_);
  if (change.isZero(0)) return;
  double sum = 0;
  for (std::size_t i = 0; i < vertices(); ++i)
    if (inverse_mass[i] > 0)
      sum -= change.dot(map->position().values()[i].vec() + next.position[i].vec()) / (2 * inverse_mass[i]);
  work_meter->change(sum);
}

void Body::commit() {
  if (work_meter) work_meter->measure(metered(), next_time_, next);
  if (changing_gravity && work_meter) measure_gravity();
  map->position().values().swap(next.position);
  map->velocity().values().swap(next.velocity);
  if (scheme_acceleration) scheme_acceleration->values().swap(next.acceleration);
  std::swap(staggered, next.staggered);
  last_step_ = next_time_ - time_;
  time_ = next_time_;
}

} // namespace rend
