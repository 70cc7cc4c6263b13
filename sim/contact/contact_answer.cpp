#include "sim/contact/contact_answer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rend {
namespace {

constexpr int most_sweeps = 12;
constexpr double given_back = 0.5; // of the speed with which a point came: what it may leave with
constexpr double settled = 1e-6;   // relative to the fastest approach: changes of velocity that are none
constexpr std::uint32_t no_mover = std::numeric_limits<std::uint32_t>::max();

} // namespace

void ContactAnswer::add(const ContactConstraint& contact) {
  if (contact.gap() < 0) require(contact);
}

void ContactAnswer::require(const ContactConstraint& contact) {
  Answered one{.contact = contact,
               .inverse_masses = contact.a.inverse_mass() + contact.b.inverse_mass(),
               .before = contact.a.velocity_before() - contact.b.velocity_before()};
  one.along = inverse_mass_along(contact.normal, one.inverse_masses);
  if (one.along > 0) contacts_.push_back(one);
}

std::uint32_t ContactAnswer::mover_of(const ContactBody& body, Slot vertex) {
  if (body.number >= mover_of_.size()) mover_of_.resize(body.number + 1);
  std::vector<std::uint32_t>& of_body = mover_of_[body.number];
  if (of_body.size() != body.vertices()) of_body.assign(body.vertices(), no_mover);
  std::uint32_t& number = of_body[vertex];
  if (number == no_mover) {
    number = static_cast<std::uint32_t>(movers_.size());
    const Vec3 velocity = body.velocity(vertex);
    movers_.push_back(
        {velocity, velocity, body.inverse_mass(vertex), &body, nullptr, vertex, body.position(vertex)});
  }
  return number;
}

std::uint32_t ContactAnswer::mover_of(Sphere& sphere) {
  std::size_t number = 0;
  while (number < movers_.size() && movers_[number].sphere != &sphere) ++number;
  if (number == movers_.size())
    movers_.push_back({sphere.next_velocity, sphere.next_velocity, Vec3::Constant(sphere.inverse_mass()),
                       nullptr, &sphere, 0, sphere.next_centre});
  return static_cast<std::uint32_t>(number);
}

// `sign`: of the side in the approach.
void ContactAnswer::gather(Answered& one, const ContactSide& side, double sign) {
  const auto add = [&](std::uint32_t mover, double weight) {
    one.parts[one.part_count++] = {mover, weight, side.held() ? 0 : weight};
  };
  if (Sphere* sphere = side.sphere()) return add(mover_of(*sphere), sign);
  const ContactPoint& point = side.point();
  if (!point.body) {
    one.surface += sign * side.velocity();
    return;
  }
  for (std::size_t k = 0; k < 3; ++k)
    if (point.weight[k] != 0) add(mover_of(*point.body, point.vertex[k]), sign * point.weight[k]);
}

void ContactAnswer::gather(double step) {
  visits_ = 0;
  for (const Answered& one : contacts_) // first, so that they are found soon
    for (const ContactSide* side : {&one.contact.a, &one.contact.b})
      if (side->sphere()) mover_of(*side->sphere());
  for (Answered& one : contacts_) {
    gather(one, one.contact.a, 1);
    gather(one, one.contact.b, -1);
    one.start = approach(one);
    const Vec3& n = one.contact.normal;
    const double came = -one.before.dot(n), most = came > 0 ? given_back * came : came;
    one.wanted = std::max(std::min(one.start.dot(n) - one.contact.gap() / step, most), one.least_rebound());
  }
}

double ContactAnswer::Answered::least_rebound() const {
  const double u = before.dot(contact.normal), given = (start - before).dot(contact.normal);
  const bool impact = contact.restitution > 0 && -u > 2 * std::abs(given);
  return impact ? -contact.restitution * u : -std::numeric_limits<double>::infinity();
}

Vec3 ContactAnswer::approach(const Answered& one) const {
  Vec3 u = one.surface;
  for (std::size_t k = 0; k < one.part_count; ++k)
    u += one.parts[k].weight * movers_[one.parts[k].mover].velocity;
  return u;
}

void ContactAnswer::apply(const Answered& one, const Vec3& impulse, double tolerance) {
  for (std::size_t k = 0; k < one.part_count; ++k) {
    const Part& part = one.parts[k];
    if (part.pushed == 0) continue;
    Mover& mover = movers_[part.mover];
    const Vec3 change = part.pushed * mover.inverse_mass.cwiseProduct(impulse);
    mover.velocity += change;
    if (change.squaredNorm() > tolerance * tolerance) mover.changed = visits_;
  }
}

void ContactAnswer::press(Answered& one, double tolerance) {
  const double u = approach(one).dot(one.contact.normal);
  const double whole = std::max(0.0, one.normal_impulse + (one.wanted - u) / one.along);
  const double change = whole - one.normal_impulse;
  one.normal_impulse = whole;
  if (change != 0) apply(one, change * one.contact.normal, tolerance);
}

// λ_t that takes the sliding velocity away, from the relative velocity u that there is without it.
Vec3 ContactAnswer::slowing(const Answered& one, const Vec3& u) {
  const Vec3 &n = one.contact.normal, &K = one.inverse_masses;
  const Vec3 sliding = u - u.dot(n) * n;
  const double across = sliding.dot(K.cwiseProduct(sliding));
  if (across == 0) return Vec3::Zero();
  Vec3 impulse = -sliding.squaredNorm() / across * sliding;
  const double most = one.contact.friction * one.normal_impulse, length = impulse.norm();
  if (length > most) impulse *= most / length;
  const double taken = -impulse.dot(one.before + u), twice = impulse.dot(K.cwiseProduct(impulse));
  if (taken < twice) impulse *= std::max(0.0, taken) / twice;
  return impulse;
}

void ContactAnswer::rub(Answered& one, double tolerance) {
  if (one.contact.friction == 0 || (one.normal_impulse == 0 && one.friction.isZero(0))) return;
  const Vec3 without = approach(one) - one.inverse_masses.cwiseProduct(one.friction);
  const Vec3 wanted = slowing(one, without), change = wanted - one.friction;
  one.friction = wanted;
  if (!change.isZero(0)) apply(one, change, tolerance);
}

bool ContactAnswer::changed_since(const Answered& one) const {
  for (std::size_t k = 0; k < one.part_count; ++k)
    if (movers_[one.parts[k].mover].changed >= one.visited) return true;
  return false;
}

// Whether it changed something.
bool ContactAnswer::sweep(double tolerance) {
  const long before = visits_;
  for (Answered& one : contacts_) {
    if (!changed_since(one)) continue;
    one.visited = ++visits_;
    press(one, tolerance);
    rub(one, tolerance);
  }
  return visits_ > before;
}

void ContactAnswer::sweep_all() {
  double fastest = 0;
  for (const Answered& one : contacts_)
    fastest = std::max({fastest, std::abs(one.wanted), approach(one).norm(), one.before.norm()});
  for (int n = 0; n < most_sweeps; ++n)
    if (!sweep(settled * fastest)) break;
}

void ContactAnswer::solve(double step) {
  if (contacts_.empty()) return;
  gather(step);
  if (pushes_) push(step);
  sweep_all();
  if (!pushes_) make_no_energy();
  write_back(pushes_ ? 0 : step);
}

// Where the sweeps ended before all agreed, the sum of their work may be positive: then impulses are scaled.
void ContactAnswer::make_no_energy() {
  double taken = 0, twice = 0; // [J]: of the energy with the velocities before, and what they add to it
  for (const Answered& one : contacts_) {
    const Vec3 impulse = one.impulse();
    taken -= impulse.dot(one.before + one.start);
    twice += impulse.dot(approach(one) - one.start);
  }
  if (taken >= twice) return;
  const double share = std::max(0.0, taken) / twice;
  for (Answered& one : contacts_) {
    one.normal_impulse *= share;
    one.friction *= share;
  }
  for (Mover& mover : movers_) mover.velocity = mover.start + share * (mover.velocity - mover.start);
}

// Moves what is inside to where impulses would, and leaves the velocities.
void ContactAnswer::push(double step) {
  for (Answered& one : contacts_) {
    const double u = one.start.dot(one.contact.normal), gap = one.contact.gap();
    one.wanted = u - (gap + way_out(step * u - gap, step)) / step;
  }
  sweep_all();
  for (Mover& mover : movers_) {
    const Vec3 by = step * (mover.velocity - mover.start);
    if (mover.sphere)
      mover.sphere->next_centre += by;
    else
      mover.body->position(mover.vertex) = Record(mover.body->position(mover.vertex).vec() + by);
    mover.velocity = mover.start;
    mover.changed = 0;
  }
  visits_ = 0;
  for (Answered& one : contacts_) {
    one.wanted = 0;
    one.normal_impulse = 0;
    one.friction = Vec3::Zero();
    one.visited = 0;
  }
}

void ContactAnswer::write_back(double step) {
  for (const Mover& mover : movers_) {
    if (Sphere* sphere = mover.sphere) {
      sphere->next_centre += step * (mover.velocity - sphere->next_velocity);
      sphere->next_velocity = mover.velocity;
      continue;
    }
    Record &x = mover.body->position(mover.vertex), &v = mover.body->velocity(mover.vertex);
    x = Record(x.vec() + step * (mover.velocity - v.vec()));
    v = Record(mover.velocity);
    mover_of_[mover.body->number][mover.vertex] = no_mover;
  }
}

void ContactAnswer::take_back() {
  for (const Mover& mover : movers_) {
    if (Sphere* sphere = mover.sphere) {
      sphere->next_centre = mover.position;
      sphere->next_velocity = mover.start;
      continue;
    }
    mover.body->position(mover.vertex) = Record(mover.position);
    mover.body->velocity(mover.vertex) = Record(mover.start);
  }
  movers_.clear();
  for (Answered& one : contacts_) {
    one.part_count = 0;
    one.surface = one.friction = Vec3::Zero();
    one.normal_impulse = 0;
    one.visited = 0;
  }
}

void ContactAnswer::account() const {
  for (const Answered& one : contacts_) {
    const ContactSide &a = one.contact.a, &b = one.contact.b;
    const Vec3 twice = one.before + approach(one), impulse = one.impulse();
    const double gap = one.contact.gap();
    ContactWork work{.gap = gap + one.contact.kept, .overlap = std::max(0.0, -gap)};
    work.touched = !impulse.isZero(0);
    if (work.touched) {
      work.impact = -0.5 * one.normal_impulse * one.contact.normal.dot(twice);
      work.friction = -0.5 * one.friction.dot(twice);
      work.obstacles = a.work_of_supports(impulse) + b.work_of_supports(-impulse);
    }
    if (Sphere* sphere = a.sphere()) {
      sphere->contact_work += work;
    } else if (WorkMeter* meter = a.body()->work_meter.get()) { // none: an equilibrium
      meter->contact(work);
      if (work.touched && one.contact.obstacle) meter->touch(*one.contact.obstacle);
    }
  }
}

std::size_t ContactAnswer::mover_bytes() const {
  std::size_t sum = 0;
  for (const auto& of_body : mover_of_) sum += bytes_of(of_body);
  return sum;
}

std::size_t ContactAnswer::touching() const {
  return static_cast<std::size_t>(std::count_if(contacts_.begin(), contacts_.end(),
                                                [](const Answered& one) { return one.normal_impulse > 0; }));
}

} // namespace rend
