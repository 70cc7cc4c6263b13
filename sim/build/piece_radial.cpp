#include "sim/build/piece_pattern.h"

#include "sim/base/math.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr double unevenness = 0.3;              // of the shares of wedges, which are drawn
constexpr double outer_share = 1.6;             // of the outermost cell of a wedge, to the innermost
constexpr double open_gap = 20 * pi / 180;      // without matter: the axis is at the border
constexpr double widest_wedge = 170 * pi / 180; // that chords may cross

// Wedges about an axis, whose angles grow from `begin` on.
struct Wedges {
  Vec3 at, u, v;            // the axis, and unit vectors across it
  double begin = 0;         // [rad]
  bool closed = true;       // the last one ends where the first one begins
  std::vector<double> ends; // [rad], of each wedge, from `begin`

  double angle(const Vec3& x) const { // from `begin`, in [0, 2π)
    const double a = arc_tangent((x - at).dot(v), (x - at).dot(u)) - begin;
    return a < 0 ? a + 2 * pi : a;
  }
  Vec3 direction(double angle) const { return cosine(begin + angle) * u + sine(begin + angle) * v; }
  double start(std::size_t wedge) const { return wedge == 0 ? 0 : ends[wedge - 1]; }
  double width(std::size_t wedge) const { return ends[wedge] - start(wedge); }
  Vec3 middle(std::size_t wedge) const { return direction(start(wedge) + width(wedge) / 2); }
  std::size_t of(const Vec3& x) const {
    const auto found = static_cast<std::size_t>(std::ranges::upper_bound(ends, angle(x)) - ends.begin());
    return std::min(found, ends.size() - 1);
  }
  // Through the axis; heights grow with the angle.
  OrientedPlane ray(double angle) const { return OrientedPlane::through(at, direction(angle + pi / 2)); }
};

std::vector<int> chords_of(int count) {
  const int rings = std::max(1, static_cast<int>(std::sqrt(count / pi)));
  const int wedges = count / rings, more = count % rings;
  std::vector<int> cells;
  for (int n = 0; n < wedges; ++n) cells.push_back(rings + ((n + 1) * more / wedges - n * more / wedges));
  return cells;
}

// The widest gap between directions in which there is matter begins at the first angle, which is from −π to π.
std::pair<double, double> widest_gap(const std::vector<SizedKey>& angles) {
  std::pair<double, double> widest{angles.back().key, angles.front().key + 2 * pi - angles.back().key};
  for (std::size_t n = 1; n < angles.size(); ++n)
    if (const double gap = angles[n].key - angles[n - 1].key; gap > widest.second)
      widest = {angles[n - 1].key, gap};
  return widest;
}

Wedges wedges_of(const PiecesSettings& settings, const std::vector<BodySample>& samples,
                 const std::vector<int>& cells) {
  const SampleBox box = box_of(samples);
  Wedges wedges{.at = *settings.at, .u = box.along[0], .v = box.along[1], .ends = {}};
  for (std::size_t side = 0; side < 2; ++side) {
    const double place = (wedges.at - box.low).dot(box.along[side]);
    if (place < -0.05 * box.length[side] || place > 1.05 * box.length[side])
      settings.source.fail("at", "the rays would meet outside of the body",
                           "a point of the shape, before it is placed");
  }
  std::vector<SizedKey> angles;
  for (const BodySample& sample : samples) angles.push_back({wedges.angle(sample.at), sample.size});
  for (SizedKey& each : angles)
    if (each.key > pi) each.key -= 2 * pi;
  std::ranges::sort(angles, {}, [](const SizedKey& k) { return std::pair(k.key, k.size); });
  const auto [edge, gap] = widest_gap(angles);
  wedges.closed = gap < open_gap;
  wedges.begin = wedges.closed ? pi * (2 * drawn(0, settings.seed) - 1) : edge + gap;
  if (!wedges.closed) wedges.begin -= 1e-6;
  if (wedges.begin > pi) wedges.begin -= 2 * pi;
  for (std::size_t n = 0; n < samples.size(); ++n) angles[n] = {wedges.angle(samples[n].at), samples[n].size};
  std::vector<double> shares;
  double whole = 0;
  for (std::size_t n = 0; n < cells.size(); ++n)
    shares.push_back(whole += cells[n] * (1 + unevenness * (drawn(n + 1, settings.seed) - 0.5)));
  for (double& share : shares) share /= whole;
  shares.pop_back();
  wedges.ends = quantiles(std::move(angles), shares);
  wedges.ends.push_back(wedges.closed ? 2 * pi : 2 * pi - gap + 2e-6);
  return wedges;
}

std::vector<double> chord_places(const Wedges& wedges, std::size_t wedge, int cells,
                                 const std::vector<BodySample>& samples) {
  std::vector<SizedKey> keys;
  for (const BodySample& sample : samples)
    if (wedges.of(sample.at) == wedge)
      keys.push_back({(sample.at - wedges.at).dot(wedges.middle(wedge)), sample.size});
  std::vector<double> shares;
  double whole = 0;
  for (int n = 0; n < cells; ++n) shares.push_back(whole += 1 + (outer_share - 1) * n / std::max(1, cells - 1));
  for (double& share : shares) share /= whole;
  shares.pop_back();
  return quantiles(std::move(keys), shares);
}

} // namespace

PiecePattern radial_pattern(const PiecesSettings& settings, const std::vector<BodySample>& samples) {
  const std::vector<int> cells = chords_of(settings.count);
  const Wedges wedges = wedges_of(settings, samples, cells);
  PiecePattern pattern;
  std::vector<std::vector<double>> chords;
  std::vector<std::uint32_t> first{0};
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const double start = wedges.start(n), end = wedges.ends[n];
    const Vec3 away = wedges.direction(start), middle = wedges.middle(n);
    if (cells.size() > 1 && (n > 0 || wedges.closed))
      pattern.walls.push_back({wedges.ray(start), {{-away, -away.dot(wedges.at)}}});
    chords.push_back(chord_places(wedges, n, cells[n], samples));
    first.push_back(first.back() + static_cast<std::uint32_t>(cells[n]));
    if (!chords.back().empty() && wedges.width(n) > widest_wedge)
      settings.source.fail("at", "a piece would go half around the point where rays meet",
                           "take a point well within the body, or more pieces");
    for (const double chord : chords.back())
      pattern.walls.push_back(
          {{middle, chord + middle.dot(wedges.at)}, {wedges.ray(start).turned(), wedges.ray(end)}});
  }
  pattern.cell = [=](const Vec3& x) {
    const std::size_t n = wedges.of(x);
    const double along = (x - wedges.at).dot(wedges.middle(n));
    return first[n] +
           static_cast<std::uint32_t>(std::ranges::upper_bound(chords[n], along) - chords[n].begin());
  };
  return pattern;
}

} // namespace rend
