#include "sim/guard/rollback.h"

#include "sim/base/archive.h"
#include "sim/solve/vectors.h"

#include <algorithm>
#include <cmath>

namespace rend {
Rollback::Rollback(World& world, const Bodies& bodies, double step)
    : world_(world), bodies_(bodies), step_(step), starts_(bodies.size()), spheres_(world.spheres.size()) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    starts_[b].copy_measures(*bodies[b]);
    starts_[b].state.accelerates = bodies[b]->next.accelerates;
  }
}

void Rollback::reserve_for_separations() {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Body& body = *bodies_[b];
    if (!body.tears()) continue;
    const std::size_t most = body.map->slots_when_separated(Vertex);
    starts_[b].state.position.reserve(most);
    starts_[b].state.velocity.reserve(most);
    if (body.next.accelerates) starts_[b].state.acceleration.reserve(most);
  }
}

void Rollback::begin(long step) {
  first_ = step;
  aside_ = false;
  for (std::size_t b = 0; b < bodies_.size(); ++b) starts_[b].copy_measures(*bodies_[b]);
  for (std::size_t s = 0; s < spheres_.size(); ++s) spheres_[s].copy(world_.spheres[s]);
}

void Rollback::save_start() {
  if (aside_) return;
  aside_ = true;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    starts_[b].state.position.swap(bodies_[b]->next.position);
    starts_[b].state.velocity.swap(bodies_[b]->next.velocity);
    starts_[b].state.acceleration.swap(bodies_[b]->next.acceleration);
    starts_[b].state.staggered = bodies_[b]->next.staggered;
  }
}

bool Rollback::fits() const {
  for (std::size_t b = 0; aside_ && b < bodies_.size(); ++b)
    if (starts_[b].state.position.size() != bodies_[b]->vertices()) return false;
  return true;
}

void Rollback::restore() {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (aside_) bodies_[b]->restore_state(starts_[b].state, starts_[b].time);
    starts_[b].restore_measures(*bodies_[b]);
  }
  for (std::size_t s = 0; s < spheres_.size(); ++s) spheres_[s].restore(world_.spheres[s]);
}

Rollback::Account Rollback::account() const {
  Account sum;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    add(*bodies_[b], starts_[b], sum);
    if (bodies_[b]->load) add_loads(*bodies_[b], sum);
  }
  for (std::size_t s = 0; s < spheres_.size(); ++s) {
    const Sphere& sphere = world_.spheres[s];
    if (!sphere.falls()) continue;
    sum.kinetic += 0.5 * sphere.mass * sphere.velocity.squaredNorm();
    sum.work += of_gravity(sphere.mass * world_.gravity.dot(sphere.centre - spheres_[s].centre),
                           starts_.front().time, bodies_.front()->time());
    sum.headroom += 2 * sphere.mass * (step_ * world_.gravity).squaredNorm();
  }
  sum.work += measured_work();
  return sum;
}

double Rollback::measured_work() const {
  Work work;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    if (!starts_[b].meter) continue;
    const Work before = starts_[b].meter->work();
    work += bodies_[b]->work_meter->work();
    work +=
        {.loads = -before.loads, .drives = -before.drives, .contact = {.obstacles = -before.contact.obstacles}};
  }
  for (std::size_t s = 0; s < spheres_.size(); ++s)
    work.contact.obstacles += world_.spheres[s].contact_work.obstacles - spheres_[s].contact_work.obstacles;
  return work.loads + work.drives + work.contact.obstacles;
}

double Rollback::pending_work() const {
  thread_local std::vector<Record> force; // keeps its capacity, since the guard calls this during a run
  double sum = 0;
  for (const auto& body : bodies_) {
    if (!body->work_meter) continue;
    force.resize(body->vertices());
    const Work exact = body->work(force), known = body->work_meter->work();
    sum += exact.sum() - known.sum();
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

const Record* Rollback::from(const Body& body, const BodyCopy& start) const {
  return aside_ ? start.state.position.data() : body.map->position().values().data();
}

void Rollback::add(const Body& body, const BodyCopy& start, Account& sum) const {
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

void Rollback::add_loads(const Body& body, Account& sum) const {
  for (std::size_t i = 0; i < body.vertices(); ++i)
    sum.headroom += 2 * body.inverse_mass[i] * body.load[i].vec().squaredNorm() * step_ * step_;
}

void Rollback::store(Archive& archive, long done) {
  archive(first_, aside_);
  archive.same(starts_.size(), "number of bodies");
  for (std::size_t b = 0; b < starts_.size(); ++b) starts_[b].store(archive, bodies_[b]->vertices());
  archive.fixed(spheres_, "number of spheres");
  if (archive.reading()) check_read(done);
}

// After each step a start with the current topology is put aside. Where the current state is the start, there
// is none yet: before the first step, and after the laws of a step that was stopped.
void Rollback::check_read(long done) const {
  refuse_unless(aside_ || first_ == done, "a stretch of steps has no start");
  refuse_unless(first_ >= 0 && first_ <= done && done - first_ <= longest,
                "a stretch of steps starts elsewhere");
  for (std::size_t b = 0; aside_ && b < starts_.size(); ++b) {
    const Body& body = *bodies_[b];
    const BodyCopy& start = starts_[b];
    refuse_unless(start.state.position.size() == body.vertices(), "a stretch starts with another body");
    refuse_unless(std::abs(start.time - static_cast<double>(first_) * step_) <= 1e-3 * step_,
                  "a stretch starts at another time");
  }
}

std::size_t Rollback::bytes() const {
  std::size_t sum = 0;
  for (const BodyCopy& start : starts_) sum += start.state.bytes() + (start.meter ? start.meter->bytes() : 0);
  return sum;
}

} // namespace rend
