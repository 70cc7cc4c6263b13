#include "sim/base/stop_request.h"
#include "sim/build/piece_pattern.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace rend {
namespace {

constexpr int most_steps = 60;
constexpr double even = 2; // largest cell to smallest

std::uint32_t nearest_seed(const std::vector<Vec3>& seeds, const Vec3& x) {
  std::uint32_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t n = 0; n < seeds.size(); ++n) {
    const double away = (seeds[n] - x).squaredNorm();
    if (away >= least) continue;
    least = away;
    nearest = n;
  }
  return nearest;
}

struct SeedCell {
  double size = 0;         // [m³], [m²]
  Vec3 sum = Vec3::Zero(); // of sizes times places
};

std::vector<SeedCell> seed_cells(const std::vector<Vec3>& seeds, const std::vector<BodySample>& samples) {
  std::vector<SeedCell> cells(seeds.size());
  for (const BodySample& sample : samples) {
    SeedCell& own = cells[nearest_seed(seeds, sample.at)];
    own.size += sample.size;
    own.sum += sample.size * sample.at;
  }
  return cells;
}

Vec3 drawn_seed(const std::vector<BodySample>& samples, double whole, double draw) {
  double below = 0;
  for (const BodySample& sample : samples)
    if ((below += sample.size) > draw * whole) return sample.at;
  return samples.back().at;
}

// Seeds of cells without samples are drawn again.
std::vector<Vec3> seeds_of(const PiecesSettings& settings, const std::vector<BodySample>& samples) {
  double whole = 0;
  for (const BodySample& sample : samples) whole += sample.size;
  std::uint64_t draws = 0;
  const auto draw = [&] { return drawn_seed(samples, whole, drawn(draws++, settings.seed)); };
  std::vector<Vec3> seeds(static_cast<std::size_t>(settings.count));
  for (Vec3& seed : seeds) seed = draw();
  for (int step = 0; step < most_steps; ++step) {
    throw_if_stop_is_due();
    const std::vector<SeedCell> cells = seed_cells(seeds, samples);
    const auto [least, most] = std::ranges::minmax(cells, {}, &SeedCell::size);
    if (step > 1 && most.size <= even * least.size) break;
    for (std::size_t n = 0; n < seeds.size(); ++n)
      seeds[n] = cells[n].size > 0 ? Vec3(cells[n].sum / cells[n].size) : draw();
  }
  return seeds;
}

OrientedPlane bisector(const Vec3& from, const Vec3& to) {
  return OrientedPlane::through((from + to) / 2, (to - from).normalized());
}

// A square in the plane that covers a ball.
std::vector<Vec3> square_in(const OrientedPlane& plane, const Vec3& middle, double radius) {
  const Vec3 foot = middle - plane.height(middle) * plane.normal;
  const Vec3 u = 2 * radius * plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
  return {foot + u, foot + v, foot - u, foot - v};
}

} // namespace

// A wall between i and j is bounded by the bisectors of i and others that cut something off, of which those
// near i are looked at first: of two cells that are far apart nothing is left soon.
PiecePattern voronoi_pattern(const PiecesSettings& settings, const std::vector<BodySample>& samples) {
  const std::vector<Vec3> seeds = seeds_of(settings, samples);
  const SampleBox box = box_of(samples);
  const Vec3 middle = (box.low + box.high) / 2;
  const double radius = 1.5 * (box.high - box.low).norm();
  PiecePattern pattern;
  std::vector<std::size_t> others(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    throw_if_stop_is_due();
    std::iota(others.begin(), others.end(), std::size_t{0});
    std::ranges::stable_sort(others, {}, [&](std::size_t k) { return (seeds[k] - seeds[i]).squaredNorm(); });
    for (std::size_t j = i + 1; j < seeds.size(); ++j) {
      Wall wall{bisector(seeds[i], seeds[j])};
      std::vector<Vec3> left = square_in(wall.plane, middle, radius);
      for (const std::size_t k : others) {
        if (k == i || k == j || left.empty()) continue;
        const OrientedPlane bound = bisector(seeds[i], seeds[k]);
        if (std::ranges::none_of(left, [&](const Vec3& x) { return bound.height(x) > 0; })) continue;
        left = clipped(left, bound);
        wall.bounds.push_back(bound);
      }
      if (!left.empty()) pattern.walls.push_back(std::move(wall));
    }
  }
  pattern.cell = [seeds](const Vec3& x) { return nearest_seed(seeds, x); };
  return pattern;
}

} // namespace rend
