#include "sim/scene/scene.h"

#include "sim/base/archive.h"
#include "sim/base/hash.h"
#include "sim/base/stop_request.h"
#include "sim/base/wall_clock.h"
#include "sim/contact/start_overlap.h"
#include "sim/guard/guard.h"
#include "sim/integrate/rigid_motions.h"
#include "sim/rows/vertex_bounds.h"
#include "sim/topology/count.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rend {
Scene::Scene(SceneDefinition definition, const SceneOptions& options)
    : name_(std::move(definition.name)), world_(std::move(definition.world)),
      profile_(std::make_unique<Profile>(options.profile ? Profile::Extent::EveryStep
                                                         : Profile::Extent::SampledSteps)),
      bodies_(std::move(definition.bodies)), time_(definition.time), duration_(duration_of(time_)),
      step_place_(time_.source.place("step")), finds_set_states_(options.set_between_steps),
      fault_(options.fault) {
  const double start = wall_clock();
  if (bodies_.empty()) throw UserError(Exit::BadInput, {}, "a scene needs a body", "add a <body>");
  check_world(world_);
  for (const MeshObstacle& mesh : world_.meshes)
    notes_.insert(notes_.end(), mesh.notes.begin(), mesh.notes.end());
  build_seconds_ = definition.build_seconds;
  for (auto& body : bodies_) {
    body->profile = profile_.get();
    body->parallel_small_bodies = options.parallel_small_bodies;
    if (options.reach) body->watch_all_criteria();
    if (options.count_fragments) body->fragment_counter = std::make_unique<FragmentCounter>();
  }
  check_contact();
  contacts_ = Contacts::of(world_, bodies_, scheme());
  solve_contact();
  const RunSettings run{options.walk, options.threads, checked_settings()};
  clear_start(world_, bodies_);
  scale_masses();
  for (auto& body : bodies_) body->prepare(scheme(), run);
  throw_if_stop_is_due(); // what follows takes long in a large body
  set_step();
  set_looks(options);
  guard_ = std::make_unique<Guard>(world_, bodies_, scheme(), step_, options.guard, profile_.get());
  divide_for_contact();
  set_answers();
  bind_seconds_ = wall_clock() - start;
}

Scene::~Scene() = default;

// Contact acts by impulses after the step, which an implicit scheme does not take into account in its solution;
// and an equilibrium does not determine the position of free bodies.
void Scene::check_contact() {
  if (!scheme().solves) return;
  for (const auto& body : bodies_) {
    if (scheme().name == "static" && body->tears())
      body->notes.push_back("static: a piece that tears off and is held by nothing stays where it is, without "
                            "its weight and loads; with implicit it falls");
    if (!body->contact) continue;
    const bool falling = std::any_of(world_.spheres.begin(), world_.spheres.end(),
                                     [](const Sphere& sphere) { return sphere.falls(); });
    if (scheme().name == "static" && (body->contact->fragments || falling))
      time_.source.fail("integrator",
                        "integrator 'static' supports contact with the floor and with obstacles that do not "
                        "fall, but not between bodies",
                        "use implicit, or symplectic with <viscosity>, and let the bodies come to rest");
    if (!scheme().solves_contact)
      time_.source.fail(
          "integrator",
          fmt::format("integrator '{}' does not support <contact>: what rests would be compressed "
                      "by its weight in every step anew",
                      scheme().name),
          "use implicit, which solves contact together with the other forces, or symplectic");
    if (body->contact->fragments)
      body->notes.push_back(fmt::format(
          "contact: '{}' solves contact with the floor and obstacles; bodies and fragments that rest on each "
          "other are compressed too much, more so if they are stiff or the step is large: take a smaller step, "
          "or symplectic",
          scheme().name));
  }
}

void Scene::solve_contact() {
  if (!scheme().solves_contact) return;
  for (auto& body : bodies_)
    if (body->contact && (body->floor_contact || body->contact->obstacles))
      body->solved_contact = std::make_unique<SolvedContact>(world_, *body->contact, body->contact_table);
}

SchemeSettings Scene::checked_settings() const {
  const bool given = time_.source.given("tolerance") || time_.tolerance != TimeSettings{}.tolerance;
  if (given && !scheme().adaptive)
    time_.source.fail("tolerance", fmt::format("tolerance is used by rk45 alone, not by '{}'", scheme().name),
                      "leave it out, or write integrator=\"rk45\"");
  const bool damps = time_.source.given("rho-infinity") || time_.rho_infinity != TimeSettings{}.rho_infinity;
  if (damps && !scheme().takes_rho_infinity)
    time_.source.fail("rho-infinity",
                      fmt::format("rho-infinity is used by alpha alone, not by '{}'", scheme().name),
                      "leave it out, or write integrator=\"alpha\"");
  return {.tolerance = time_.tolerance, .rho_infinity = time_.rho_infinity};
}

// Looking for the largest value that a law has reached can take as long as a step or two, where looking for
// what exceeds its threshold takes little. So it is done at every 256th step, in short clips more often; a step
// that solves takes so long that it is done at every one.
void Scene::set_looks(const SceneOptions& options) {
  constexpr long least_looks = 32, longest = 256; // looks in a run; steps from one to the next
  const long steps = options.steps ? *options.steps : std::lround(std::min(duration_ / step_, 1e15));
  const long cheap = scheme().solves ? 1 : std::clamp(steps / least_looks, 1L, longest);
  for (auto& body : bodies_) {
    body->look_every = options.look_every.value_or(cheap);
    body->last_look = steps - 1;
  }
}

double Scene::time() const {
  return static_cast<double>(steps_done_) * step_;
}

// Times of steps are products in floating point: an answer is due slightly before its time.
void Scene::set_answers() {
  const double slack = 1e-6 * step_;
  for (auto& body : bodies_) {
    for (Answer& answer : body->answers) {
      if (std::isinf(answer.at)) answer.at = duration_;
      if (answer.at > duration_ + slack)
        notes_.push_back(fmt::format(
            "{}: the clip ends at {:g} s, before the time of this answer, {:g} s: it is not checked",
            answer.source.place("at").text(), duration_, answer.at));
      next_answer_ = std::min(next_answer_, answer.at - slack);
    }
  }
  if (time() >= next_answer_) measure_answers();
}

void Scene::measure_answers() {
  next_answer_ = std::numeric_limits<double>::infinity();
  for (auto& body : bodies_) {
    for (Answer& answer : body->answers) {
      const double due = answer.at - 1e-6 * step_;
      if (time() < due) {
        next_answer_ = std::min(next_answer_, due);
      } else if (!answer.asked) {
        answer.asked = true;
        if (const auto reading = body->probes[answer.number].read(*body))
          answer.measured = quantity_of(*reading, answer.quantity);
      }
    }
  }
}

SceneSeconds Scene::seconds() const {
  const auto of = [&](std::initializer_list<Phase> phases) {
    double sum = 0;
    for (const Phase phase : phases) sum += profile_->seconds(phase);
    return sum;
  };
  using enum Phase;
  return {.build = build_seconds_,
          .bind = bind_seconds_,
          .forces = of({Forces, Loads}),
          .criteria = of({Criteria}),
          .change = of({Changes}),
          .rebind = of({Rebinding}),
          .integrate = of({Integration, Stiffness, Contact, Guard})};
}

// Those measured in steps that are being redone.
void Scene::forget_answers() {
  for (auto& body : bodies_) {
    for (Answer& answer : body->answers) {
      const double due = answer.at - 1e-6 * step_;
      if (time() >= due) continue;
      answer.asked = false;
      next_answer_ = std::min(next_answer_, due);
    }
  }
}

std::size_t Scene::tears() const {
  std::size_t count = 0;
  for (const auto& body : bodies_) count += body->events.size();
  return count;
}

std::size_t Scene::fragments() const {
  std::size_t count = 0;
  for (const auto& body : bodies_) count += count_cells(body->map->map(), Component);
  return count;
}

const GuardFigures& Scene::guard() const {
  return guard_->figures();
}

std::size_t Scene::guard_bytes() const {
  return guard_->bytes();
}

long Scene::evaluations() const {
  long count = 0;
  for (const auto& body : bodies_) count += body->evaluations;
  return count;
}

double Scene::kinetic_energy() const {
  double sum = 0;
  for (const auto& body : bodies_) sum += rend::kinetic_energy(*body->map, *body->mass);
  for (const Sphere& s : world_.spheres)
    if (s.falls()) sum += 0.5 * s.mass * s.velocity.squaredNorm();
  return sum;
}
double Scene::elastic_energy() const {
  double sum = 0;
  for (const auto& body : bodies_) sum += body->program->elastic_energy(body->map->position().values().data());
  return sum;
}
double Scene::gravity_energy() const {
  const Vec3 gravity = world_.gravity_at(time());
  double sum = 0;
  for (const auto& body : bodies_) sum += rend::gravity_energy(*body->map, *body->mass, gravity);
  for (const Sphere& s : world_.spheres) sum -= s.mass * gravity.dot(s.centre);
  return sum;
}
EnergyFigures Scene::energy() const {
  return account_.figures(energy_state());
}

namespace {

// Of a velocity of 1e-12 of the body's size in a step, or of lifting it by 1e-8 of its size.
double body_round_off(const Body& body, double step) {
  const double size = extent(body.map->rest().values(), body.program->inverse_mass());
  const double speed = 1e-12 * size / step;
  return total_mass(*body.map, *body.mass) * std::max(speed * speed, 1e-8 * size * body.gravity.vec().norm());
}

} // namespace

EnergyState Scene::energy_state() const {
  EnergyState sum;
  sum.kinetic = kinetic_energy();
  sum.gravity = gravity_energy();
  sum.round_off = 1e-12 * std::abs(sum.gravity);
  static thread_local std::vector<Record> force;
  for (const auto& body : bodies_) {
    force.resize(body->vertices());
    const BodyEnergy one = body->energy(scheme(), step_, force);
    sum.elastic += one.elastic;
    sum.shadow += one.shadow;
    sum.work += one.work;
    sum.round_off = std::max(sum.round_off, body_round_off(*body, step_));
  }
  for (const Sphere& s : world_.spheres) {
    if (!s.falls()) continue;
    sum.shadow += 0.5 * step_ * s.mass * s.velocity.dot(world_.gravity_at(time()));
    sum.work.contact += s.contact_work;
    sum.work.changes += s.gravity_work;
  }
  return sum;
}

double Scene::mass() const {
  double sum = 0;
  for (const auto& body : bodies_) sum += total_mass(*body->map, *body->mass);
  for (const Sphere& s : world_.spheres) sum += s.mass;
  return sum;
}
Vec3 Scene::momentum() const {
  Vec3 sum = Vec3::Zero();
  for (const auto& body : bodies_) sum += total_momentum(*body->map, *body->mass);
  for (const Sphere& s : world_.spheres) sum += s.mass * s.velocity;
  return sum;
}
Vec3 Scene::angular_momentum() const {
  Vec3 sum = Vec3::Zero();
  for (const auto& body : bodies_) sum += total_angular_momentum(*body->map, *body->mass);
  for (const Sphere& s : world_.spheres) sum += s.mass * s.centre.cross(s.velocity);
  return sum;
}

// Fault injection (injected_fault.h) is not part of a checkpoint.
void Scene::store(Archive& archive) {
  archive.mark("scene");
  double step = step_;
  archive(step, steps_done_);
  archive.unbounded(next_answer_);
  archive(laws_applied_at_);
  refuse_unless(step == step_, "its steps have another length");
  if (archive.reading())
    refuse_unless(is_count(steps_done_) &&
                      (laws_applied_at_ == steps_done_ - 1 || laws_applied_at_ == steps_done_),
                  "it is not between two steps");
  archive.same(bodies_.size(), "number of bodies");
  for (auto& body : bodies_) body->store(archive, steps_done_, step_);
  archive.same(world_.spheres.size(), "number of spheres");
  for (Sphere& sphere : world_.spheres) sphere.store(archive);
  account_.store(archive, steps_done_);
  if (contacts_) contacts_->store(archive);
  guard_->store(archive, steps_done_);
  // a stop within a step leaves the state after its laws, with which a stretch begins
  refuse_unless(laws_applied_at_ < steps_done_ || guard_->begins_at(steps_done_),
                "it is not between two steps");
  archive.mark("seconds"); // last, since they differ from run to run
  archive(build_seconds_, bind_seconds_, *profile_);
  if (archive.reading()) check_read();
}

void Scene::check_read() const {
  double next = std::numeric_limits<double>::infinity();
  for (const auto& body : bodies_) {
    for (const Answer& answer : body->answers) {
      const double due = answer.at - 1e-6 * step_;
      refuse_unless(answer.asked == (time() >= due), "an answer was measured before its time, or not then");
      if (!answer.asked) next = std::min(next, due);
    }
  }
  refuse_unless(next_answer_ == next, "an answer is measured at another time");
  for (const Sphere& sphere : world_.spheres)
    refuse_unless(sphere.can_be_there(time()), "a sphere is where its keys do not lead");
}

std::uint64_t Scene::hash() const {
  std::uint64_t hash = 0;
  for (const auto& body : bodies_) {
    const auto& x = body->map->position().values();
    const auto& v = body->map->velocity().values();
    hash = hash_bytes(x.data(), x.size() * sizeof(Record), hash);
    hash = hash_bytes(v.data(), v.size() * sizeof(Record), hash);
    body->map->map().for_each_dart([&](Dart d) {
      std::array<std::uint32_t, 5> links{d.value};
      for (int i = 0; i < 4; ++i) links[static_cast<std::size_t>(i) + 1] = body->map->map().alpha(i, d).value;
      hash = hash_bytes(links.data(), sizeof links, hash);
    });
  }
  for (const Sphere& s : world_.spheres) {
    if (!s.moves()) continue;
    hash = hash_bytes(s.centre.data(), 3 * sizeof(double), hash);
    hash = hash_bytes(s.velocity.data(), 3 * sizeof(double), hash);
  }
  return hash;
}

} // namespace rend
