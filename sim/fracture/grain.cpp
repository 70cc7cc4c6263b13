#include "sim/fracture/grain.h"

#include "sim/base/math.h"
#include "sim/rows/continuum.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace rend {
namespace {

// Evenly over the half of the sphere above z = 0, 8 degrees apart: on a spiral, turned by the golden angle.
const std::array<Vec3, 200>& directions_around() {
  static const std::array<Vec3, 200> all = [] {
    std::array<Vec3, 200> made;
    for (std::size_t n = 0; n < made.size(); ++n) {
      const double z = (static_cast<double>(n) + 0.5) / static_cast<double>(made.size());
      const double degrees = 137.50776405003785 * static_cast<double>(n), radius = std::sqrt(1 - z * z);
      made[n] = {radius * cosine_of_degrees(degrees), radius * sine_of_degrees(degrees), z};
    }
    return made;
  }();
  return all;
}

Vec3 with_positive_largest(const Vec3& n) {
  Eigen::Index largest;
  n.cwiseAbs().maxCoeff(&largest);
  return n[largest] < 0 ? Vec3(-n) : n;
}

// Up by ever smaller turns, a few of each size: along an edge of the value, where each gains little, the
// maximum is known otherwise.
template <class Value> Vec3 climbed(Vec3 n, const Value& value) {
  constexpr int most_turns = 6;
  double best = value(n);
  const auto turns = [&](double angle) {
    const Vec3 u = n.unitOrthogonal(), v = n.cross(u);
    for (const Vec3& way : {u, Vec3(-u), v, Vec3(-v)}) {
      const Vec3 there = (n + angle * way).normalized();
      const double here = value(there);
      if (!(here > best)) continue;
      best = here;
      n = there;
      return true;
    }
    return false;
  };
  for (double angle = 0.1; angle > 1e-5; angle /= 2)
    for (int turn = 0; turn < most_turns && turns(angle); ++turn) {
    }
  return n;
}

// How the surroundings of a vertex have moved; 0 for what leads out of a sheet.
Eigen::Matrix3d deformation_at(const EmbeddedMap& map, const Record* position, std::span<const Dart> vertex) {
  Eigen::Matrix3d moved = Eigen::Matrix3d::Zero(), square = Eigen::Matrix3d::Zero();
  const GMap& g = map.map();
  for (Dart d : vertex) {
    const Dart end = g.alpha(0, d);
    const Vec3 rest = map.rest_of(end) - map.rest_of(d);
    moved += (position[map.vertex(end)].vec() - position[map.vertex(d)].vec()) * rest.transpose();
    square += rest * rest.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(square);
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
  for (int n = 0; n < 3; ++n) {
    const double value = solver.eigenvalues()[n];
    const Vec3 axis = solver.eigenvectors().col(n);
    if (value > 1e-9 * solver.eigenvalues()[2]) inverse += axis * axis.transpose() / value;
  }
  return moved * inverse;
}

} // namespace

template <> const Fields<GrainSettings>& fields_of() {
  using S = GrainSettings;
  static const Fields<S> fields{
      field(&S::along, numbers("grain", 0, "",
                               "x y z of the direction of fibres at rest, along which the body splits "
                               "more easily; of two directions: warp and weft")),
      field(&S::ratio,
            number("ratio", "", "strength of planes along the grain; across it, it is 1").above(0).at_most(1))};
  return fields;
}

void Grain::check(const GrainSettings& settings, const SettingsSource& source) {
  if (!settings.along) {
    if (source.given("ratio"))
      source.fail("ratio", "<tear> has a ratio, and no grain", "grain=\"1 0 0\" ratio=\"0.3\"");
    return;
  }
  const std::vector<double>& x = *settings.along;
  if (x.size() != 3 && x.size() != 6)
    source.fail("grain", fmt::format("{} numbers are no directions of a grain", x.size()),
                "x y z of one direction, or of two");
  for (std::size_t n = 0; n < x.size(); n += 3)
    if (!(Vec3(x[n], x[n + 1], x[n + 2]).norm() > 0))
      source.fail("grain", "a direction of the grain has no length", "grain=\"1 0 0\"");
}

Grain::Grain(const GrainSettings& settings) : ratio_(settings.ratio) {
  CHECK(settings.along);
  const std::vector<double>& x = *settings.along;
  CHECK(!x.empty() && x.size() <= 6 && x.size() % 3 == 0);
  for (std::size_t n = 0; n < x.size(); n += 3)
    at_rest_.push_back(Vec3(x[n], x[n + 1], x[n + 2]).stableNormalized());
}

std::optional<Grain> Grain::of(const GrainSettings& settings) {
  return settings.along ? std::optional<Grain>(settings) : std::nullopt;
}

double Grain::strength(const Vec3& normal, std::span<const Vec3> directions) const {
  double least = 1;
  for (const Vec3& f : directions) least = std::min(least, ratio_ + (1 - ratio_) * std::abs(normal.dot(f)));
  return least;
}

Grain::Plane Grain::weakest(const Eigen::Matrix3d& stress, std::span<const Vec3> directions) const {
  const auto value = [&](const Vec3& n) { return n.dot(stress * n) / strength(n, directions); };
  std::optional<Plane> best;
  const auto offer = [&](const Vec3& n) {
    const double there = value(n);
    if (!best || there > best->value) best = Plane{n, there};
  };
  offer(largest_principal(stress, Compression::Ignored).direction);
  for (const Vec3& n : directions_around()) offer(n);
  offer(climbed(best->normal, value));
  offer(climbed(largest_principal(stress, Compression::Ignored).direction, value));
  for (const Vec3& f : directions) {
    const Eigen::Matrix3d along = Eigen::Matrix3d::Identity() - f * f.transpose();
    offer(largest_principal(along * stress * along, Compression::Ignored).direction);
  }
  return {with_positive_largest(best->normal), best->value};
}

Grain::Plane Grain::weakest(const Eigen::Matrix3d& stress, const EmbeddedMap& map, const Record* position,
                            std::span<const Dart> vertex) const {
  const Eigen::Matrix3d moved = deformation_at(map, position, vertex);
  std::array<Vec3, 2> directions;
  std::size_t count = 0;
  for (const Vec3& f : at_rest_) {
    const Vec3 now = moved * f;
    if (now.squaredNorm() > 1e-12) directions[count++] = now.normalized();
  }
  return weakest(stress, std::span(directions.data(), count));
}

} // namespace rend
