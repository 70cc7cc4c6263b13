#include "sim/contact/contact_answer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rend {
namespace {

constexpr double given_back = 0.5; // of the speed with which a point came: what it may leave with
constexpr std::uint32_t no_mover = std::numeric_limits<std::uint32_t>::max();

} // namespace

void ContactAnswer::add(const ContactConstraint& contact) {
  if (contact.gap() < 0) require(contact);
}

void ContactAnswer::require(const ContactConstraint& contact) {
  Row row{.normal = contact.normal,
          .inverse_masses = contact.a.inverse_mass() + contact.b.inverse_mass(),
          .before = contact.a.velocity_before() - contact.b.velocity_before(),
          .coefficient = contact.friction};
  row.along = inverse_mass_along(contact.normal, row.inverse_masses);
  if (row.along <= 0) return;
  contacts_.push_back(contact);
  sweeps_.add(row);
}

std::uint32_t ContactAnswer::add_mover(const Moved& mover, const Vec3& inverse_mass) {
  moved_.push_back(mover);
  return sweeps_.add({.velocity = mover.start, .inverse_mass = inverse_mass});
}

std::uint32_t ContactAnswer::mover_of(const ContactBody& body, Slot vertex) {
  if (body.number >= mover_of_.size()) mover_of_.resize(body.number + 1);
  std::vector<std::uint32_t>& of_body = mover_of_[body.number];
  if (of_body.size() != body.vertices()) of_body.assign(body.vertices(), no_mover);
  std::uint32_t& number = of_body[vertex];
  if (number == no_mover)
    number = add_mover({body.velocity(vertex), body.position(vertex), &body, nullptr, vertex},
                       body.inverse_mass(vertex));
  return number;
}

std::uint32_t ContactAnswer::mover_of(Sphere& sphere) {
  std::uint32_t number = 0;
  while (number < moved_.size() && moved_[number].sphere != &sphere) ++number;
  if (number < moved_.size()) return number;
  return add_mover({sphere.next_velocity, sphere.next_centre, nullptr, &sphere, 0},
                   Vec3::Constant(sphere.inverse_mass()));
}

// `sign`: of the side in the approach.
void ContactAnswer::gather(Row& row, const ContactSide& side, double sign) {
  const auto add = [&](std::uint32_t mover, double weight) {
    sweeps_.add_part(row, {weight, mover}, !side.held());
  };
  if (Sphere* sphere = side.sphere()) return add(mover_of(*sphere), sign);
  const ContactPoint& point = side.point();
  if (!point.body) {
    row.surface += sign * side.velocity();
    return;
  }
  for (std::size_t k = 0; k < 3; ++k)
    if (point.weight[k] != 0) add(mover_of(*point.body, point.vertex[k]), sign * point.weight[k]);
}

void ContactAnswer::gather(double step) {
  for (const ContactConstraint& contact : contacts_) // first, so that they are found soon
    for (const ContactSide* side : {&contact.a, &contact.b})
      if (side->sphere()) mover_of(*side->sphere());
  start_.resize(contacts_.size());
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const ContactConstraint& contact = contacts_[c];
    Row& row = sweeps_.rows()[c];
    gather(row, contact.a, 1);
    gather(row, contact.b, -1);
    start_[c] = sweeps_.approach(row);
    const double came = -row.before.dot(row.normal), most = came > 0 ? given_back * came : came;
    row.wanted = std::max(std::min(start_[c].dot(row.normal) - contact.gap() / step, most), least_rebound(c));
  }
}

// [m/s], of u'·n; −infinity: it is no impact.
double ContactAnswer::least_rebound(std::size_t contact) const {
  const Row& row = sweeps_.rows()[contact];
  const double restitution = contacts_[contact].restitution;
  const double u = row.before.dot(row.normal), given = (start_[contact] - row.before).dot(row.normal);
  const bool impact = restitution > 0 && -u > 2 * std::abs(given);
  return impact ? -restitution * u : -std::numeric_limits<double>::infinity();
}

void ContactAnswer::solve(double step) {
  if (contacts_.empty()) return;
  gather(step);
  if (pushes_) push(step);
  sweeps_.solve();
  if (!pushes_) make_no_energy();
  write_back(pushes_ ? 0 : step);
}

// Where the sweeps ended before all agreed, the sum of their work may be positive: then impulses are scaled.
void ContactAnswer::make_no_energy() {
  double taken = 0, twice = 0; // [J]: of the energy with the velocities before, and what they add to it
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Row& row = sweeps_.rows()[c];
    const Vec3 impulse = row.impulse();
    taken -= impulse.dot(row.before + start_[c]);
    twice += impulse.dot(sweeps_.approach(row) - start_[c]);
  }
  if (taken >= twice) return;
  const double share = std::max(0.0, taken) / twice;
  for (Row& row : sweeps_.rows()) {
    row.normal_impulse *= share;
    row.friction *= share;
  }
  for (std::size_t m = 0; m < moved_.size(); ++m) {
    Vec3& velocity = sweeps_.movers()[m].velocity;
    velocity = moved_[m].start + share * (velocity - moved_[m].start);
  }
}

// Moves what is inside to where impulses would, and leaves the velocities.
void ContactAnswer::push(double step) {
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const double u = start_[c].dot(contacts_[c].normal), gap = contacts_[c].gap();
    sweeps_.rows()[c].wanted = u - (gap + way_out(step * u - gap, step)) / step;
  }
  sweeps_.solve();
  for (std::size_t m = 0; m < moved_.size(); ++m) {
    const Moved& mover = moved_[m];
    Vec3& velocity = sweeps_.movers()[m].velocity;
    const Vec3 by = step * (velocity - mover.start);
    if (mover.sphere)
      mover.sphere->next_centre += by;
    else
      mover.body->position(mover.vertex) = Record(mover.body->position(mover.vertex).vec() + by);
    velocity = mover.start;
  }
  sweeps_.start_anew();
  for (Row& row : sweeps_.rows()) row.wanted = 0;
}

void ContactAnswer::write_back(double step) {
  for (std::size_t m = 0; m < moved_.size(); ++m) {
    const Moved& mover = moved_[m];
    const Vec3& velocity = sweeps_.movers()[m].velocity;
    if (Sphere* sphere = mover.sphere) {
      sphere->next_centre += step * (velocity - sphere->next_velocity);
      sphere->next_velocity = velocity;
      continue;
    }
    Record &x = mover.body->position(mover.vertex), &v = mover.body->velocity(mover.vertex);
    x = Record(x.vec() + step * (velocity - v.vec()));
    v = Record(velocity);
    mover_of_[mover.body->number][mover.vertex] = no_mover;
  }
}

void ContactAnswer::take_back() {
  for (const Moved& mover : moved_) {
    if (Sphere* sphere = mover.sphere) {
      sphere->next_centre = mover.position;
      sphere->next_velocity = mover.start;
      continue;
    }
    mover.body->position(mover.vertex) = Record(mover.position);
    mover.body->velocity(mover.vertex) = Record(mover.start);
  }
  moved_.clear();
  sweeps_.clear_parts();
}

void ContactAnswer::account() const {
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const ContactConstraint& contact = contacts_[c];
    const Row& row = sweeps_.rows()[c];
    const ContactSide &a = contact.a, &b = contact.b;
    const Vec3 twice = row.before + sweeps_.approach(row), impulse = row.impulse();
    const double gap = contact.gap();
    ContactWork work{.gap = gap + contact.kept, .overlap = std::max(0.0, -gap)};
    work.touched = !impulse.isZero(0);
    if (work.touched) {
      work.impact = -0.5 * row.normal_impulse * contact.normal.dot(twice);
      work.friction = -0.5 * row.friction.dot(twice);
      work.obstacles = a.work_of_supports(impulse) + b.work_of_supports(-impulse);
    }
    if (Sphere* sphere = a.sphere()) {
      sphere->contact_work += work;
    } else if (WorkMeter* meter = a.body()->work_meter.get()) { // none: an equilibrium
      meter->contact(work);
      if (work.touched && contact.obstacle) meter->touch(*contact.obstacle);
    }
  }
}

std::size_t ContactAnswer::mover_bytes() const {
  std::size_t sum = 0;
  for (const auto& of_body : mover_of_) sum += bytes_of(of_body);
  return sum;
}

std::size_t ContactAnswer::touching() const {
  return static_cast<std::size_t>(std::count_if(sweeps_.rows().begin(), sweeps_.rows().end(),
                                                [](const Row& row) { return row.normal_impulse > 0; }));
}

} // namespace rend
