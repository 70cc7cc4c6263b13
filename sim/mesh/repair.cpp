#include "sim/mesh/repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace rend {
namespace {

constexpr double no_length = 1e-12; // of a side, relative to the extent of its polygon

// Which point each one has become: the smallest of those that were merged.
class Merging {
public:
  explicit Merging(std::size_t points) : parent_(points) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t operator[](std::uint32_t point) {
    while (parent_[point] != point) point = parent_[point] = parent_[parent_[point]];
    return point;
  }
  bool merge(std::uint32_t a, std::uint32_t b) {
    a = (*this)[a];
    b = (*this)[b];
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

private:
  std::vector<std::uint32_t> parent_;
};

void merge_ends_of_sides(const PolygonMesh& mesh, Merging& merging, Repairs& repairs) {
  for (std::size_t p = 0; p < mesh.polygons(); ++p) {
    const double least = no_length * std::sqrt(extent_of(mesh, p).square);
    for (std::uint32_t s = mesh.first[p]; s < mesh.first[p + 1]; ++s) {
      const std::uint32_t a = mesh.corners[s];
      const std::uint32_t b = mesh.corners[s + 1 < mesh.first[p + 1] ? s + 1 : mesh.first[p]];
      if ((mesh.points[a] - mesh.points[b]).norm() <= least && merging.merge(a, b)) ++repairs.merged;
    }
  }
}

// The corners of a polygon as merged points, without those that repeat the one before.
std::vector<std::uint32_t> corners_of(const PolygonMesh& mesh, std::size_t p, Merging& merging) {
  std::vector<std::uint32_t> corners;
  for (std::uint32_t s = mesh.first[p]; s < mesh.first[p + 1]; ++s)
    if (const std::uint32_t c = merging[mesh.corners[s]]; corners.empty() || corners.back() != c)
      corners.push_back(c);
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  return corners;
}

} // namespace

Repairs repair(MeshFile& file) {
  PolygonMesh* mesh = std::get_if<PolygonMesh>(&file.mesh);
  if (!mesh)
    file.source.fail("holds a solid or a map, and only polygons of a sheet are repaired", "leave --repair out");
  Repairs repairs;
  repairs.polygons = mesh->polygons();
  Merging merging(mesh->points.size());
  merge_ends_of_sides(*mesh, merging, repairs);
  PolygonMesh kept;
  kept.points = mesh->points;
  kept.names = mesh->names;
  kept.first.push_back(0);
  std::vector<Origin> origins;
  std::set<std::vector<std::uint32_t>> known; // corners of polygons that are kept, increasing
  for (std::size_t p = 0; p < mesh->polygons(); ++p) {
    const std::vector<std::uint32_t> corners = corners_of(*mesh, p, merging);
    std::vector<std::uint32_t> sorted = corners;
    std::sort(sorted.begin(), sorted.end());
    const bool repeats = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
    kept.corners.insert(kept.corners.end(), corners.begin(), corners.end());
    kept.first.push_back(static_cast<std::uint32_t>(kept.corners.size()));
    const bool flat = corners.size() < 3 || repeats || !extent_of(kept, kept.polygons() - 1).has_area();
    if (flat || !known.insert(sorted).second) {
      kept.first.pop_back();
      kept.corners.resize(kept.first.back());
      ++(flat ? repairs.flat : repairs.copies);
      continue;
    }
    repairs.corners += mesh->first[p + 1] - mesh->first[p] - corners.size();
    origins.push_back(file.origins.at(p));
  }
  if (kept.polygons() == 0) file.source.fail("holds no polygon with an area");
  *mesh = std::move(kept);
  file.origins = std::move(origins);
  for (auto& [name, points] : file.groups) {
    for (std::uint32_t& p : points) p = merging[p];
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
  }
  return repairs;
}

std::string in_words(const Repairs& r) {
  if (r.merged + r.corners + r.flat + r.copies == 0)
    return fmt::format("repair: none of {} polygons needed it", r.polygons);
  return fmt::format(
      "repair: of {} polygons {} without area and {} copies of others are dropped; {} points are merged "
      "with others, and {} corners of other polygons dropped",
      r.polygons, r.flat, r.copies, r.merged, r.corners);
}

} // namespace rend
