#include "sim/guard/rollback.h"

#include "sim/base/archive.h"
#include "sim/rows/frequency.h"
#include "sim/solve/vectors.h"

#include <algorithm>
#include <cmath>

namespace rend {
Rollback::Rollback(World& world, const Bodies& bodies, double step)
    : world_(world), bodies_(bodies), step_(step), starts_(bodies.size()), spheres_(world.spheres.size()) {
  for (const Sphere& sphere : world.spheres)
    if (!sphere.falls()) push_ = std::max(push_, sphere.velocity.norm());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Body& body = *bodies[b];
    if (body.constraints.drives() || pushed(body))
      starts_[b].omega_squared =
          frequency_bounds(*body.map, body.interactions, *body.mass, body.drag).omega_squared;
  }
}

bool Rollback::pushed(const Body& body) const {
  return push_ > 0 && body.contact && body.contact->obstacles;
}

void Rollback::reserve_for_separations() {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Body& body = *bodies_[b];
    if (!body.tears()) continue;
    const std::size_t most = body.map->slots_when_separated(Vertex);
    starts_[b].state.position.reserve(most);
    starts_[b].state.velocity.reserve(most);
    if (!body.loads.empty()) starts_[b].load.reserve(most);
  }
}

void Rollback::begin(long step) {
  first_ = step;
  aside_ = false;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Body& body = *bodies_[b];
    Start& start = starts_[b];
    start.time = body.time();
    if (body.load) start.load.assign(body.load, body.load + body.vertices());
    start.force.clear();
    if (body.constraints.drives())
      for (Slot v : body.constraints.vertices()) start.force.push_back(Record(body.force[v].vec()));
    if (!pushed(body)) continue;
    start.forces = 0;
    for (const Record& f : body.force) start.forces += f.vec().norm();
  }
  for (std::size_t s = 0; s < spheres_.size(); ++s)
    spheres_[s] = {world_.spheres[s].centre, world_.spheres[s].velocity};
}

void Rollback::save_start() {
  if (aside_) return;
  aside_ = true;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    starts_[b].state.position.swap(bodies_[b]->next.position);
    starts_[b].state.velocity.swap(bodies_[b]->next.velocity);
  }
}

bool Rollback::fits() const {
  for (std::size_t b = 0; aside_ && b < bodies_.size(); ++b)
    if (starts_[b].state.position.size() != bodies_[b]->vertices()) return false;
  return true;
}

void Rollback::restore() {
  if (!aside_) return;
  for (std::size_t b = 0; b < bodies_.size(); ++b) bodies_[b]->restore_state(starts_[b].state, starts_[b].time);
  for (std::size_t s = 0; s < spheres_.size(); ++s) {
    world_.spheres[s].centre = spheres_[s].centre;
    world_.spheres[s].velocity = spheres_[s].velocity;
  }
}

Rollback::Account Rollback::account() {
  Account sum;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    add(*bodies_[b], starts_[b], sum);
    if (!starts_[b].load.empty()) add_loads(*bodies_[b], starts_[b], sum);
    if (bodies_[b]->constraints.drives()) add_drives(*bodies_[b], starts_[b], sum);
    if (pushed(*bodies_[b])) add_pushes(*bodies_[b], starts_[b], sum);
  }
  for (std::size_t s = 0; s < spheres_.size(); ++s) {
    const Sphere& sphere = world_.spheres[s];
    if (!sphere.falls()) continue;
    sum.kinetic += 0.5 * sphere.mass * sphere.velocity.squaredNorm();
    sum.work += of_gravity(sphere.mass * world_.gravity.dot(sphere.centre - spheres_[s].centre),
                           starts_.front().time, bodies_.front()->time());
    sum.headroom += 2 * sphere.mass * (step_ * world_.gravity).squaredNorm();
  }
  return sum;
}

double Rollback::elastic_energy() const {
  double sum = 0;
  for (const auto& body : bodies_) sum += body->program->elastic_energy(body->map->position().values().data());
  return sum;
}

// The most that gravity can have done: all of it at the share at the start, or at the end.
double Rollback::of_gravity(double whole, double from, double until) const {
  return std::max(whole * world_.gravity_share(from), whole * world_.gravity_share(until));
}

const Record* Rollback::from(const Body& body, const Start& start) const {
  return aside_ ? start.state.position.data() : body.map->position().values().data();
}

void Rollback::add(const Body& body, const Start& start, Account& sum) const {
  const Record *x = body.map->position().values().data(), *v = body.map->velocity().values().data();
  const Record* x0 = from(body, start);
  const double* inverse = body.program->inverse_mass();
  const Double4 g = load(Record(world_.gravity));
  double mass = 0, heaviest = sum.heaviest;
  Double4 motion{}, speeds{}, fall{};
  for (std::size_t i = 0; i < body.vertices(); ++i) {
    if (inverse[i] == 0) continue;
    const double m = 1 / inverse[i];
    const Double4 w = load(v[i]);
    motion += splat(m) * w * w;
    speeds += w * w;
    fall += splat(m) * g * (load(x[i]) - load(x0[i]));
    mass += m;
    heaviest = std::max(heaviest, m);
  }
  sum.kinetic += 0.5 * sum3(motion);
  sum.squared_speeds += sum3(speeds);
  sum.work += of_gravity(sum3(fall), start.time, body.time());
  sum.heaviest = heaviest;
  sum.mass += mass;
  sum.headroom += 2 * mass * (step_ * world_.gravity).squaredNorm();
}

// The loads at the start, and as they would be there at the current time.
void Rollback::add_loads(Body& body, const Start& start, Account& sum) const {
  const Record *x = body.map->position().values().data(), *v = body.map->velocity().values().data();
  const Record* x0 = from(body, start);
  const Record* v0 = aside_ ? start.state.velocity.data() : v;
  const Record* later = body.loads.evaluate(*body.map, body.time(), x0, v0);
  const bool dead = body.loads.constant();
  const double* inverse = body.program->inverse_mass();
  for (std::size_t i = 0; i < body.vertices(); ++i) {
    const Vec3 f = start.load[i], dx = x[i].vec() - x0[i].vec();
    const double most = std::max(f.norm(), later[i].vec().norm());
    if (most == 0) continue;
    sum.work += dead && f == later[i].vec() ? f.dot(dx) : most * dx.norm();
    sum.headroom += 2 * inverse[i] * most * most * step_ * step_;
  }
  body.update_loads(body.time(), x, v); // restores the loads of the current step
}

void Rollback::add_drives(const Body& body, const Start& start, Account& sum) const {
  const Record *x = body.map->position().values().data(), *v = body.map->velocity().values().data();
  const Record* x0 = from(body, start);
  const double* inverse = body.program->inverse_mass();
  const std::vector<Slot>& held = body.constraints.vertices();
  for (std::size_t n = 0; n < held.size(); ++n) {
    const double m = 1 / inverse[held[n]], way = (x[held[n]].vec() - x0[held[n]].vec()).norm();
    sum.work += (start.force[n].vec().norm() + m * world_.gravity.norm()) * way;
    sum.work += 0.5 * m * start.omega_squared * way * way;
    sum.headroom += 0.5 * m * v[held[n]].vec().squaredNorm();
  }
}

void Rollback::add_pushes(const Body& body, const Start& start, Account& sum) const {
  const double way = push_ * (body.time() - start.time);
  double mass = 0;
  for (std::size_t i = 0; i < body.vertices(); ++i)
    if (const double w = body.program->inverse_mass()[i]; w > 0) mass += 1 / w;
  sum.work += (start.forces + mass * world_.gravity.norm()) * way;
  sum.work += 0.5 * mass * start.omega_squared * way * way;
  sum.headroom += 2 * mass * push_ * push_;
}

void Rollback::Start::store(Archive& archive, const Body& body) {
  state.store(archive, body.vertices());
  archive(time);
  archive.list(load, body.vertices(), "loads are of more vertices than the body has");
  archive.list(force, body.vertices(), "forces are of more vertices than the body has");
  archive(forces);
  double omega = omega_squared;
  archive(omega);
  refuse_unless(omega == omega_squared, "a body's frequencies are others");
}

void Rollback::SphereStart::store(Archive& archive) {
  archive(centre, velocity);
}

void Rollback::store(Archive& archive, long done) {
  archive(first_, aside_);
  archive.same(starts_.size(), "number of bodies");
  for (std::size_t b = 0; b < starts_.size(); ++b) starts_[b].store(archive, *bodies_[b]);
  archive.fixed(spheres_, "number of spheres");
  if (archive.reading()) check_read(done);
}

// After each step a start with the current topology is put aside. Before the first step there is none.
void Rollback::check_read(long done) const {
  refuse_unless(aside_ == (done > 0), "a stretch of steps has no start");
  refuse_unless(first_ >= 0 && first_ <= done && done - first_ <= longest,
                "a stretch of steps starts elsewhere");
  for (std::size_t b = 0; aside_ && b < starts_.size(); ++b) {
    const Body& body = *bodies_[b];
    const Start& start = starts_[b];
    const std::size_t driven = body.constraints.drives() ? body.constraints.vertices().size() : 0;
    refuse_unless(start.state.position.size() == body.vertices(), "a stretch starts with another body");
    refuse_unless(start.load.size() == (body.load ? body.vertices() : 0), "a stretch starts with other loads");
    refuse_unless(start.force.size() == driven, "a stretch starts with other drives");
    refuse_unless(std::abs(start.time - static_cast<double>(first_) * step_) <= 1e-3 * step_,
                  "a stretch starts at another time");
    refuse_unless(start.forces >= 0, "a stretch starts with a sum of forces below 0");
  }
}

std::size_t Rollback::bytes() const {
  std::size_t records = 0;
  for (const Start& start : starts_)
    records +=
        start.state.position.size() + start.state.velocity.size() + start.load.size() + start.force.size();
  return records * sizeof(Record);
}

} // namespace rend
