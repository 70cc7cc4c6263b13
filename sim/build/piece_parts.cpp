#include "sim/build/piece_parts.h"

#include "sim/base/stop_request.h"

#include "sim/mechanics/element_quality.h"
#include "sim/mechanics/mass.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <limits>
#include <string_view>

namespace rend {
namespace {

constexpr double most_uneven = 3; // largest piece to smallest
constexpr std::uint32_t no_part = ~std::uint32_t{0};

} // namespace

bool PieceParts::settle(std::size_t count) {
  find();
  for (std::size_t rounds = 0;;) {
    throw_if_stop_is_due();
    while (alive_ > count)
      if (!join_smallest()) return false;
    write();
    if (alive_ == count) {
      if (is_even() || ++rounds > count || !join_smallest()) break;
      write();
    }
    const std::size_t before = alive_;
    if (!divide_largest()) return false;
    find();
    if (alive_ <= before) return false;
  }
  find();
  write();
  return alive_ == count;
}

void PieceParts::find() {
  const CellIndex& elements = map_.cells(pieces_.orbit());
  part_of_.assign(elements.slots(), no_part);
  parts_.clear();
  into_.clear();
  for (Slot e = 0; e < elements.slots(); ++e) {
    if (!elements.alive(e) || part_of_[e] != no_part) continue;
    into_.push_back(static_cast<std::uint32_t>(parts_.size()));
    parts_.emplace_back();
    flood(e, into_.back());
  }
  alive_ = parts_.size();
  add_borders();
}

// All elements of the same cell that are connected with the first.
void PieceParts::flood(Slot first, std::uint32_t part) {
  const CellIndex& elements = map_.cells(pieces_.orbit());
  const GMap& g = map_.map();
  const int dimension = map_.dimension();
  std::vector<Slot> found{first};
  part_of_[first] = part;
  while (!found.empty()) {
    const Dart d = elements.first_dart(found.back());
    const std::uint32_t cell = pieces_[found.back()];
    found.pop_back();
    parts_[part].size += dimension == 2 ? rest_area(map_, d) : rest_volume(map_, d);
    for (Dart e : darts_of(g, pieces_.orbit(), d)) {
      const Slot next = element(g.alpha(dimension, e));
      if (part_of_[next] != no_part || pieces_[next] != cell) continue;
      part_of_[next] = part;
      found.push_back(next);
    }
  }
}

void PieceParts::add_borders() {
  const GMap& g = map_.map();
  g.for_each_dart([&](Dart d) {
    const std::uint32_t part = part_of_[element(d)], other = part_of_[element(g.alpha(map_.dimension(), d))];
    if (part != other) parts_[part].borders[other] += measure_of(d);
  });
}

// The share of one dart in the length of an edge, or the area of a face.
double PieceParts::measure_of(Dart d) const {
  const GMap& g = map_.map();
  const Vec3 a = map_.rest_of(d), edge = map_.rest_of(g.alpha(0, d)) - a;
  if (map_.dimension() == 2) return edge.norm() / 2;
  return edge.cross(map_.rest_of(g.follow(d, std::string_view("10"))) - a).norm() / 12;
}

// False: none that has a neighbour is left.
bool PieceParts::join_smallest() {
  std::uint32_t smallest = no_part;
  for (std::uint32_t p = 0; p < parts_.size(); ++p)
    if (into_[p] == p && !parts_[p].borders.empty() &&
        (smallest == no_part || parts_[p].size < parts_[smallest].size))
      smallest = p;
  if (smallest == no_part) return false;
  double most = 0;
  std::uint32_t to = parts_[smallest].borders.begin()->first;
  for (const auto& [other, border] : parts_[smallest].borders) {
    if (border / parts_[other].size <= most) continue;
    most = border / parts_[other].size;
    to = other;
  }
  join(smallest, to);
  return true;
}

void PieceParts::join(std::uint32_t part, std::uint32_t to) {
  for (const auto& [other, border] : parts_[part].borders) {
    parts_[other].borders.erase(part);
    if (other == to) continue;
    parts_[to].borders[other] += border;
    parts_[other].borders[to] += border;
  }
  parts_[to].size += parts_[part].size;
  parts_[part] = {};
  into_[part] = to;
  --alive_;
}

void PieceParts::write() {
  for (Slot e = 0; e < part_of_.size(); ++e) {
    std::uint32_t part = part_of_[e];
    while (part != no_part && into_[part] != part) part = into_[part];
    pieces_[e] = part;
  }
}

bool PieceParts::is_even() const {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Part& part : parts_) {
    if (part.size == 0) continue;
    least = std::min(least, part.size);
    most = std::max(most, part.size);
  }
  return most <= most_uneven * least;
}

// By a plane through its middle, across the longest side of its box.
bool PieceParts::divide_largest() {
  const auto largest =
      static_cast<std::uint32_t>(std::ranges::max_element(parts_, {}, &Part::size) - parts_.begin());
  const CellIndex& elements = map_.cells(pieces_.orbit());
  const auto each = [&](const auto& f) {
    for (Slot e = 0; e < elements.slots(); ++e)
      if (elements.alive(e) && pieces_[e] == largest) f(e, element_centre(map_, elements.first_dart(e)));
  };
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low, sum = Vec3::Zero();
  double size = 0;
  each([&](Slot e, const Vec3& middle) {
    const Dart d = elements.first_dart(e);
    const double own = map_.dimension() == 2 ? rest_area(map_, d) : rest_volume(map_, d);
    low = low.cwiseMin(middle);
    high = high.cwiseMax(middle);
    sum += own * middle;
    size += own;
  });
  if (!(size > 0)) return false;
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const Wall wall{OrientedPlane::through(sum / size, Vec3::Unit(axis))};
  cutter_.cut(wall, [&](Dart d) { return pieces_[element(d)] == largest; });
  const auto above = static_cast<std::uint32_t>(parts_.size());
  each([&](Slot e, const Vec3& middle) {
    if (wall.plane.height(middle) > 0) pieces_[e] = above;
  });
  return true;
}

} // namespace rend
