#include "sim/fracture/tearing_mode.h"

#include <algorithm>

namespace rend {
namespace {

constexpr double least_torn = 0.5; // of what opens the crack, where it is torn

Vec3 across(const Vec3& normal, const Vec3& x) {
  return x - x.dot(normal) * normal;
}

} // namespace

std::optional<TearingPlane> TearingMode::at(const ForceView& view, std::span<const Dart> darts) {
  note_corners(view, darts);
  Vec3 normal = Vec3::Zero();
  for (const Corner& each : corners_) normal += each.now.before.cross(each.now.after);
  normal.stableNormalize(); // leaves 0 as it is
  if (!is_torn(normal)) return {};
  return plane_along(ahead_at_rest(normal));
}

void TearingMode::note_corners(const ForceView& view, std::span<const Dart> darts) {
  const GMap& g = view.map.map();
  const CellIndex& elements = view.map.cells(element_orbit(2));
  const auto at = [&](Dart d) { return view.position[view.map.vertex(d)].vec(); };
  const auto edge = [&](Dart d) { return Vec3(at(g.alpha(0, d)) - at(d)); };
  const auto edge_at_rest = [&](Dart d) { return Vec3(view.map.rest_of(g.alpha(0, d)) - view.map.rest_of(d)); };
  Dart d{};
  for (Dart each : darts)
    if (g.is_free(2, each) && (d == Dart{} || each < d)) d = each;
  const Slot vertex = view.map.vertex(d);
  corners_.clear();
  for (;;) {
    const Dart other = g.alpha(1, d);
    Corner corner{{edge(d), edge(other)}, {edge_at_rest(d), edge_at_rest(other)}, Vec3::Zero()};
    continuum_.each_of(elements.first_dart(elements.slot(d)), view.position, nullptr,
                       [&](const Continuum::Part&, const CurrentUnit& now) {
                         const auto forces = now.forces();
                         for (std::size_t n = 0; n < static_cast<std::size_t>(now.particles); ++n)
                           if (now.vertex[n] == vertex) corner.force += forces[n];
                       });
    corners_.push_back(corner);
    if (g.is_free(2, other)) return;
    d = g.alpha(2, other);
  }
}

bool TearingMode::is_torn(const Vec3& normal) const {
  Vec3 pull = Vec3::Zero(); // P_a
  for (const Corner& each : corners_) pull -= 0.5 * each.force;
  double most_torn = 0, most_opened = 0; // [N]
  for (const Corner& each : corners_) {
    pull += each.force;
    if (&each == &corners_.back()) break;
    const Vec3 edge = across(normal, each.now.after).stableNormalized();
    const Vec3 away = across(edge, across(normal, each.now.before)).stableNormalized();
    most_torn = std::max(most_torn, std::abs(pull.dot(normal)));
    most_opened = std::max(most_opened, pull.dot(away));
  }
  return most_torn > least_torn * most_opened;
}

// Across D, a unit vector; 0: there is none.
Vec3 TearingMode::ahead_at_rest(const Vec3& normal) const {
  Vec3 up = Vec3::Zero(), flat = Vec3::Zero();
  for (const Corner& each : corners_) {
    up += each.force.dot(normal) * (each.rest.before + each.rest.after).stableNormalized();
    flat += each.rest.before.cross(each.rest.after);
  }
  const Vec3 ahead = up.cross(flat).stableNormalized();
  const Vec3 flanks =
      corners_.front().rest.before.stableNormalized() + corners_.back().rest.after.stableNormalized();
  return ahead.dot(flanks) > 0 ? Vec3(-ahead) : ahead;
}

// As it is now, in the element that the direction at rest leads into.
std::optional<TearingPlane> TearingMode::plane_along(const Vec3& ahead) const {
  for (const auto& [now, rest, force] : corners_) {
    const Vec3 flat = rest.before.cross(rest.after);
    const double of_before = ahead.cross(rest.after).dot(flat), of_after = rest.before.cross(ahead).dot(flat);
    if (!(of_before >= 0 && of_after >= 0 && of_before + of_after > 0)) continue;
    const Vec3 leads = (of_before * now.before + of_after * now.after).stableNormalized();
    const Vec3 normal = now.before.cross(now.after).cross(leads).stableNormalized();
    if (normal.isZero(0)) return {};
    return TearingPlane{normal, leads};
  }
  return {};
}

} // namespace rend
