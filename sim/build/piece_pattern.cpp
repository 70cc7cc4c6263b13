#include "sim/build/piece_pattern.h"

#include "sim/base/hash.h"
#include "sim/mechanics/mass.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>

namespace rend {
namespace {

// In a triangle or tetrahedron: weights of its corners are the gaps between sorted draws.
Vec3 spread_point(std::span<const Vec3> corners, std::uint64_t number) {
  std::array<double, 5> cut{0, 1, 1, 1, 1};
  for (std::size_t n = 1; n < corners.size(); ++n) cut[n] = drawn(4 * number + n, 1);
  std::sort(cut.begin() + 1, cut.begin() + static_cast<std::ptrdiff_t>(corners.size()));
  Vec3 point = Vec3::Zero();
  for (std::size_t n = 0; n < corners.size(); ++n) point += (cut[n + 1] - cut[n]) * corners[n];
  return point;
}

std::vector<double> even_shares(int parts) {
  std::vector<double> shares;
  for (int n = 1; n < parts; ++n) shares.push_back(static_cast<double>(n) / parts);
  return shares;
}

// How many bricks there are in each course.
std::vector<int> courses_of(int count, const SampleBox& box) {
  const double height = std::sqrt(box.length[0] * box.length[1] / (2.0 * count));
  int courses = std::clamp(static_cast<int>(std::lround(box.length[1] / height)), 1, count);
  while (courses > 1 && (count - courses / 2) / courses < 2) --courses;
  std::vector<int> bricks(static_cast<std::size_t>(courses), (count - courses / 2) / courses);
  for (std::size_t c = 1; c < bricks.size(); c += 2) ++bricks[c]; // two halves in place of one
  int left = count - std::accumulate(bricks.begin(), bricks.end(), 0);
  for (std::size_t c = 0; left > 0; c = (c + 2 < bricks.size()) ? c + 2 : 1 - c % 2, --left) ++bricks[c];
  return bricks;
}

std::vector<double> joints(int bricks, bool halves) {
  if (!halves || bricks < 2) return even_shares(bricks);
  std::vector<double> shares;
  for (int n = 1; n < bricks; ++n) shares.push_back((n - 0.5) / (bricks - 1));
  return shares;
}

std::uint32_t place_in(const std::vector<double>& increasing, double key) {
  return static_cast<std::uint32_t>(std::ranges::upper_bound(increasing, key) - increasing.begin());
}

} // namespace

double drawn(std::uint64_t number, int seed) {
  const std::uint64_t hash = hash_bytes(&number, sizeof number, static_cast<std::uint64_t>(seed));
  return (static_cast<double>(hash >> 12) + 0.5) * 0x1p-52;
}

std::vector<BodySample> samples_of(const EmbeddedMap& map, std::size_t least) {
  const GMap& g = map.map();
  const bool sheet = map.dimension() == 2;
  const CellIndex& elements = map.cells(element_orbit(map.dimension()));
  const std::size_t each = least / elements.count() + 1;
  std::vector<BodySample> samples;
  for (Slot e = 0; e < elements.slots(); ++e) {
    if (!elements.alive(e)) continue;
    const Dart d = elements.first_dart(e);
    std::vector<Vec3> corners{map.rest_of(d), map.rest_of(g.alpha(0, d)),
                              map.rest_of(g.follow(d, std::string_view("10")))};
    if (!sheet) corners.push_back(map.rest_of(g.follow(d, std::string_view("210"))));
    const double size = (sheet ? rest_area(map, d) : rest_volume(map, d)) / static_cast<double>(each);
    for (std::size_t n = 0; n < each; ++n) samples.push_back({spread_point(corners, samples.size()), size});
  }
  return samples;
}

SampleBox box_of(const std::vector<BodySample>& samples) {
  SampleBox box{.low = samples.front().at, .high = samples.front().at, .along = {}, .length = {}};
  for (const BodySample& sample : samples) {
    box.low = box.low.cwiseMin(sample.at);
    box.high = box.high.cwiseMax(sample.at);
  }
  const Vec3 size = box.high - box.low;
  std::vector<int> axes{0, 1, 2};
  for (std::size_t n = 0; n < 3; ++n) { // of those that are about as long, x before y before z
    double most = 0;
    for (const int axis : axes) most = std::max(most, size[axis]);
    const auto next = std::ranges::find_if(axes, [&](int axis) { return 1.001 * size[axis] >= most; });
    box.along[n] = Vec3::Unit(*next);
    box.length[n] = size[*next];
    axes.erase(next);
  }
  return box;
}

std::vector<double> quantiles(std::vector<SizedKey> keys, const std::vector<double>& shares) {
  std::ranges::sort(keys, {}, [](const SizedKey& k) { return std::pair(k.key, k.size); });
  double whole = 0;
  for (const SizedKey& each : keys) whole += each.size;
  std::vector<double> found;
  std::size_t n = 0;
  double below = 0;
  for (const double share : shares) {
    while (n < keys.size() && below + keys[n].size < share * whole) below += keys[n++].size;
    const std::size_t next = std::min(n + 1, keys.size() - 1);
    found.push_back(keys.empty() ? 0 : (keys[std::min(n, next)].key + keys[next].key) / 2);
  }
  return found;
}

PiecePattern slab_pattern(const PiecesSettings& settings, const std::vector<BodySample>& samples) {
  const Vec3 along = box_of(samples).along[0];
  std::vector<SizedKey> keys;
  for (const BodySample& sample : samples) keys.push_back({along.dot(sample.at), sample.size});
  const std::vector<double> cuts = quantiles(std::move(keys), even_shares(settings.count));
  PiecePattern pattern;
  for (const double cut : cuts) pattern.walls.push_back({{along, cut}});
  pattern.cell = [along, cuts](const Vec3& x) { return place_in(cuts, along.dot(x)); };
  return pattern;
}

PiecePattern brick_pattern(const PiecesSettings& settings, const std::vector<BodySample>& samples) {
  const SampleBox box = box_of(samples);
  const Vec3 along = box.along[0], up = box.along[1];
  const std::vector<int> bricks = courses_of(settings.count, box);
  std::vector<double> shares; // of courses: by whole bricks
  double whole = 0;
  for (std::size_t c = 0; c < bricks.size(); ++c)
    shares.push_back(whole += bricks[c] - static_cast<int>(c % 2));
  for (double& share : shares) share /= whole;
  shares.pop_back();
  std::vector<SizedKey> keys;
  for (const BodySample& sample : samples) keys.push_back({up.dot(sample.at), sample.size});
  const std::vector<double> beds = quantiles(std::move(keys), shares);
  PiecePattern pattern;
  for (const double bed : beds) pattern.walls.push_back({{up, bed}});
  std::vector<std::vector<double>> cuts;
  std::vector<std::uint32_t> first{0};
  for (std::size_t c = 0; c < bricks.size(); ++c) {
    std::vector<SizedKey> own;
    for (const BodySample& sample : samples)
      if (place_in(beds, up.dot(sample.at)) == c) own.push_back({along.dot(sample.at), sample.size});
    cuts.push_back(quantiles(std::move(own), joints(bricks[c], c % 2 == 1)));
    first.push_back(first.back() + static_cast<std::uint32_t>(bricks[c]));
    for (const double cut : cuts.back()) {
      Wall wall{{along, cut}};
      if (c > 0) wall.bounds.push_back({-up, -beds[c - 1]});
      if (c < beds.size()) wall.bounds.push_back({up, beds[c]});
      pattern.walls.push_back(wall);
    }
  }
  pattern.cell = [=](const Vec3& x) {
    const std::uint32_t c = place_in(beds, up.dot(x));
    return first[c] + place_in(cuts[c], along.dot(x));
  };
  return pattern;
}

PiecePattern pattern_of(const PiecesSettings& settings, const std::vector<BodySample>& samples) {
  using P = PiecesSettings::Pattern;
  const SettingsSource& source = settings.source;
  const bool radial = settings.pattern == P::Radial;
  const bool draws = radial || settings.pattern == P::Voronoi;
  if (radial && !settings.at)
    source.fail("", "pattern=\"radial\" needs a point, where its rays meet",
                "at=\"0.5 0.5 0\", of the shape [m]");
  if (!radial && settings.at)
    source.fail("at", "only pattern=\"radial\" has a point where rays meet", "leave it out");
  if (!draws && source.given("seed"))
    source.fail("seed", "<pieces> has a seed, and a pattern that draws nothing",
                "pattern=\"voronoi\" and \"radial\" are drawn");
  switch (settings.pattern) {
  case P::Voronoi:
    return voronoi_pattern(settings, samples);
  case P::Radial:
    return radial_pattern(settings, samples);
  case P::Slabs:
    return slab_pattern(settings, samples);
  case P::Bricks:
    break;
  }
  return brick_pattern(settings, samples);
}

} // namespace rend
