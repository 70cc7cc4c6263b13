#include "sim/contact/contact_zone.h"

#include <Eigen/Eigenvalues>

namespace rend {
namespace {

constexpr double heavy = 1e6;    // of a prescribed vertex's mass
constexpr double no_turn = 1e-9; // relative to the largest moment of inertia: about a line that all lie on

// I⁻¹ a, but no rotation about a line on which all vertices lie.
Vec3 turn_of(const Eigen::Matrix3d& inertia, const Vec3& angular) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(inertia);
  const double largest = axes.eigenvalues().maxCoeff();
  Vec3 turn = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = axes.eigenvectors().col(k);
    if (axes.eigenvalues()[k] > no_turn * largest) turn += axis.dot(angular) / axes.eigenvalues()[k] * axis;
  }
  return turn;
}

// Cayley's rotation, which is that by ω to second order and needs no elementary functions: with c = ω/2,
// R = I + 2/(1 + c²) (C + C²), C x = c × x.
Eigen::Matrix3d rotation_by(const Vec3& turn) {
  const Vec3 c = 0.5 * turn;
  Eigen::Matrix3d cross;
  cross << 0, -c.z(), c.y(), c.z(), 0, -c.x(), -c.y(), c.x(), 0;
  return Eigen::Matrix3d::Identity() + 2 / (1 + c.squaredNorm()) * (cross + cross * cross);
}

} // namespace

void ContactZones::clear() {
  number_.clear();
  parent_.clear();
}

std::size_t ContactZones::root(std::size_t n) const {
  while (parent_[n] != n) n = parent_[n];
  return n;
}

bool ContactZones::unite(std::span<const ZonePart> parts) {
  std::size_t first = 0;
  bool grew = false;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto [at, added] = number_.try_emplace(parts[k], parent_.size());
    if (added) parent_.push_back(at->second);
    const std::size_t own = root(at->second);
    if (k == 0)
      first = own;
    else
      grew = grew || own != first;
    parent_[own] = first;
  }
  return grew;
}

std::vector<std::vector<ZonePart>> ContactZones::all() const {
  std::map<std::size_t, std::size_t> zone_of; // of a root
  std::vector<std::vector<ZonePart>> zones;
  for (const auto& [part, number] : number_) {
    const auto [at, added] = zone_of.try_emplace(root(number), zones.size());
    if (added) zones.emplace_back();
    zones[at->second].push_back(part);
  }
  return zones;
}

std::function<Vec3(const Vec3&)> nearest_rigid_motion(std::span<const ZoneMember> members) {
  const auto mass_of = [](const ZoneMember& one) { return (one.prescribed ? heavy : 1) * one.mass; };
  double mass = 0;
  Vec3 centre = Vec3::Zero(), way = Vec3::Zero();
  for (const ZoneMember& one : members) {
    mass += mass_of(one);
    centre += mass_of(one) * one.from;
    way += mass_of(one) * (one.to - one.from);
  }
  centre /= mass;
  way /= mass;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Vec3 angular = Vec3::Zero();
  for (const ZoneMember& one : members) {
    const Vec3 r = one.from - centre;
    inertia += mass_of(one) * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
    angular += mass_of(one) * r.cross(one.to - one.from - way);
  }
  const Eigen::Matrix3d turned = rotation_by(turn_of(inertia, angular));
  return [=](const Vec3& from) -> Vec3 { return centre + way + turned * (from - centre); };
}

} // namespace rend
