#include "sim/contact/contact_sweeps.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr int most_sweeps = 12;
constexpr double settled = 1e-6; // relative to the fastest approach: changes of velocity that are none

} // namespace

void ContactSweeps::clear() {
  rows_.clear();
  movers_.clear();
  parts_.clear();
}

void ContactSweeps::clear_parts() {
  movers_.clear();
  parts_.clear();
  for (Row& row : rows_) {
    row.parts = row.parts_end = row.pushed = row.pushed_end = 0;
    row.surface = Vec3::Zero();
  }
  start_anew();
}

void ContactSweeps::start_anew() {
  visits_ = 0;
  for (Mover& mover : movers_) mover.changed = 0;
  for (Row& row : rows_) {
    row.normal_impulse = 0;
    row.friction = Vec3::Zero();
    row.visited = 0;
  }
}

std::uint32_t ContactSweeps::add(const Mover& mover) {
  movers_.push_back(mover);
  return static_cast<std::uint32_t>(movers_.size() - 1);
}

void ContactSweeps::add_part(Row& row, const Part& part, bool pushed) {
  const auto at = static_cast<std::uint32_t>(parts_.size());
  parts_.push_back(part);
  if (row.parts_end == 0) row.parts = at;
  row.parts_end = at + 1;
  if (!pushed) return;
  if (row.pushed_end == 0) row.pushed = at;
  row.pushed_end = at + 1;
}

Vec3 ContactSweeps::approach(const Row& row) const {
  Vec3 u = row.surface;
  for (std::uint32_t p = row.parts; p < row.parts_end; ++p)
    u += parts_[p].weight * movers_[parts_[p].mover].velocity;
  return u;
}

void ContactSweeps::apply(const Row& row, const Vec3& impulse, double tolerance) {
  for (std::uint32_t p = row.pushed; p < row.pushed_end; ++p) {
    Mover& mover = movers_[parts_[p].mover];
    const Vec3 change = parts_[p].weight * mover.inverse_mass.cwiseProduct(impulse);
    mover.velocity += change;
    if (change.squaredNorm() > tolerance * tolerance) mover.changed = visits_;
  }
}

void ContactSweeps::press(Row& row, double tolerance) {
  const double u = approach(row).dot(row.normal);
  const double whole = std::max(0.0, row.normal_impulse + (row.wanted - u) / row.along);
  const double change = whole - row.normal_impulse;
  row.normal_impulse = whole;
  if (change != 0) apply(row, change * row.normal, tolerance);
}

// λ_t that takes the sliding velocity away, from the relative velocity u that there is without it.
Vec3 ContactSweeps::slowing(const Row& row, const Vec3& u) {
  const Vec3 &n = row.normal, &K = row.inverse_masses;
  const Vec3 sliding = u - u.dot(n) * n;
  const double across = sliding.dot(K.cwiseProduct(sliding));
  if (across == 0) return Vec3::Zero();
  Vec3 impulse = -sliding.squaredNorm() / across * sliding;
  const double most = row.coefficient * row.normal_impulse, length = impulse.norm();
  if (length > most) impulse *= most / length;
  const double taken = -impulse.dot(row.before + u), twice = impulse.dot(K.cwiseProduct(impulse));
  if (taken < twice) impulse *= std::max(0.0, taken) / twice;
  return impulse;
}

void ContactSweeps::rub(Row& row, double tolerance) {
  if (row.coefficient == 0 || (row.normal_impulse == 0 && row.friction.isZero(0))) return;
  const Vec3 without = approach(row) - row.inverse_masses.cwiseProduct(row.friction);
  const Vec3 wanted = slowing(row, without), change = wanted - row.friction;
  row.friction = wanted;
  if (!change.isZero(0)) apply(row, change, tolerance);
}

bool ContactSweeps::changed_since(const Row& row) const {
  for (std::uint32_t p = row.parts; p < row.parts_end; ++p)
    if (movers_[parts_[p].mover].changed >= row.visited) return true;
  return false;
}

// Whether it changed something.
bool ContactSweeps::sweep(double tolerance) {
  const long before = visits_;
  for (Row& row : rows_) {
    if (!changed_since(row)) continue;
    row.visited = ++visits_;
    press(row, tolerance);
    rub(row, tolerance);
  }
  return visits_ > before;
}

void ContactSweeps::solve() {
  double fastest = 0; // [m/s]
  for (const Row& row : rows_)
    fastest = std::max({fastest, std::abs(row.wanted), approach(row).norm(), row.before.norm()});
  for (int n = 0; n < most_sweeps; ++n)
    if (!sweep(settled * fastest)) break;
}

} // namespace rend
