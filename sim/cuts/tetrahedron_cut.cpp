#include "sim/cuts/tetrahedron_cut.h"

#include "sim/base/check.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <map>
#include <utility>

namespace rend {
namespace {

constexpr double nearest_to_end = 0.25;  // share of an edge
constexpr double most_off_border = 1e-9; // sine of the angle between a move and a face of the border

double six_volumes(const std::vector<Vec3>& at, const std::array<std::uint32_t, 4>& p) {
  return (at[p[1]] - at[p[0]]).cross(at[p[2]] - at[p[0]]).dot(at[p[3]] - at[p[0]]);
}

} // namespace

int TetrahedronCutPlan::side_of(Slot vertex) const {
  const auto at = std::ranges::lower_bound(sides, vertex, {}, &std::pair<Slot, int>::first);
  CHECK(at != sides.end() && at->first == vertex);
  return at->second;
}

TetrahedronCut::TetrahedronCut(const CutState& state, Changed changed, std::span<const Dart> darts,
                               const CutSurface& surface)
    : state_(state), changed_(std::move(changed)), map_(state.map.map()), darts_(darts.begin(), darts.end()) {
  for (Dart d : darts_) {
    const Dart there = map_.alpha(0, d);
    const Slot slot = state_.map.vertex(there);
    if (corner_of_.insert(slot, static_cast<std::uint32_t>(corners_.size())) == corners_.size())
      corners_.push_back({there, slot, surface.side_of(slot)});
  }
  std::map<std::pair<std::size_t, std::size_t>, Dart> edges;
  for (Dart d : darts_) {
    const Dart across = map_.alpha(1, map_.alpha(0, d));
    const std::size_t b = corner_of_.find(state_.map.vertex(across)),
                      c = corner_of_.find(state_.map.vertex(map_.alpha(0, across)));
    if (b < c) edges.insert({{b, c}, across});
  }
  for (const auto& [ends, across] : edges) edges_.push_back({ends.first, ends.second, across});
}

std::optional<TetrahedronCutPlan> TetrahedronCut::plan() {
  const auto any = [](const LinkEdge&) { return true; };
  for (;;) {
    while (bend_nearest(nearest_to_end, any)) {
    }
    const auto whole = element_without_room();
    if (!whole) break;
    if (!give_way_in(*whole)) return {};
  }
  TetrahedronCutPlan plan;
  for (const LinkEdge& edge : edges_)
    if (crosses(edge)) plan.divisions.push_back({edge.across, share_of(edge)});
  for (const Corner& corner : corners_) {
    if (corner.moved) plan.moves.push_back({corner.dart, *corner.moved});
    plan.sides.push_back({corner.slot, (corner.side.height > 0) - (corner.side.height < 0)});
  }
  std::ranges::sort(plan.sides);
  return plan;
}

bool TetrahedronCut::crosses(const LinkEdge& edge) const {
  return corners_[edge.b].side.height * corners_[edge.c].side.height < 0;
}

double TetrahedronCut::share_of(const LinkEdge& edge) const {
  const auto [s_b, fixed_b] = corners_[edge.b].side;
  const auto [s_c, fixed_c] = corners_[edge.c].side;
  return std::clamp(s_b / (s_b - s_c), fixed_b ? nearest_to_end : 0, fixed_c ? 1 - nearest_to_end : 1);
}

// The end to which the cut bends, the nearer one if it is free. None: both are fixed.
std::optional<std::size_t> TetrahedronCut::free_end(const LinkEdge& edge, double share) const {
  const bool to_b = !corners_[edge.b].side.fixed && (share < 0.5 || corners_[edge.c].side.fixed);
  if (to_b) return edge.b;
  if (!corners_[edge.c].side.fixed) return edge.c;
  return {};
}

// Of all edges that are crossed, the one that is crossed closest to a free end; false: none closer than that.
bool TetrahedronCut::bend_nearest(double below, const std::function<bool(const LinkEdge&)>& among) {
  const LinkEdge* nearest = nullptr;
  for (const LinkEdge& edge : edges_) {
    if (!crosses(edge) || !among(edge)) continue;
    const double share = share_of(edge);
    const auto end = free_end(edge, share);
    if (!end) continue;
    const double away = *end == edge.b ? share : 1 - share;
    if (away >= below) continue;
    below = away;
    nearest = &edge;
  }
  if (!nearest) return false;
  const double share = share_of(*nearest);
  bend(*nearest, *free_end(*nearest, share), share);
  return true;
}

void TetrahedronCut::bend(const LinkEdge& edge, std::size_t end, double share) {
  Corner& corner = corners_[end];
  const Corner& far = corners_[end == edge.b ? edge.c : edge.b];
  const double along = end == edge.b ? share : 1 - share;
  corner.side.height = 0;
  const Vec3 here = state_.position[corner.slot].vec(), rest = state_.map.rest_of(corner.dart);
  const Point to{.position = here + along * (state_.position[far.slot].vec() - here),
                 .rest = rest + along * (state_.map.rest_of(far.dart) - rest),
                 .velocity = state_.velocity[corner.slot].vec()};
  corner.may_move = corner.may_move && along < 0.5 && may_move(corner, far.slot, to.rest);
  if (corner.may_move) corner.moved = to;
}

bool TetrahedronCut::may_move(const Corner& corner, Slot towards, const Vec3& to) const {
  if (state_.rigid || std::ranges::binary_search(state_.held, corner.slot)) return false;
  std::vector<Dart> around = darts_of(map_, Vertex, corner.dart);
  if (!keeps_border(around, towards, to)) return false;
  const std::size_t own = around.size();
  for (std::size_t n = 0; n < own; ++n)
    around.push_back(map_.alpha(1, map_.alpha(0, around[n]))); // opposite faces
  return !changed_(around);
}

// The vertex with these darts is inside, or moves along an edge of the border, in the planes of all faces
// there.
bool TetrahedronCut::keeps_border(std::span<const Dart> darts, Slot towards, const Vec3& to) const {
  const auto open = [&](Dart d) { return map_.is_free(3, d); };
  if (std::ranges::none_of(darts, open)) return true;
  const Vec3 from = state_.map.rest_of(darts.front());
  bool along_border = false;
  for (Dart d : darts) {
    if (!open(d)) continue;
    along_border = along_border || state_.map.vertex(map_.alpha(0, d)) == towards;
    const Vec3 b = state_.map.rest_of(map_.alpha(0, d)) - from,
               c = state_.map.rest_of(map_.alpha(0, map_.alpha(1, d))) - from, normal = b.cross(c);
    if (std::abs(normal.dot(to - from)) > most_off_border * normal.norm() * (to - from).norm()) return false;
  }
  return along_border;
}

// A corner of that element that has moved goes back; if none has, the cut bends to one of them.
bool TetrahedronCut::give_way_in(std::size_t whole) {
  const auto& points = wholes_[whole].point;
  const auto is_corner = [&](const Corner& corner) {
    return std::ranges::find(points, point_of_.find(corner.slot)) != points.end();
  };
  bool moved = false;
  for (Corner& corner : corners_) {
    if (!corner.moved || !is_corner(corner)) continue;
    corner.moved.reset();
    corner.may_move = false;
    moved = true;
  }
  return moved || bend_nearest(1, [&](const LinkEdge& edge) {
           return is_corner(corners_[edge.b]) && is_corner(corners_[edge.c]);
         });
}

// None: all parts are large enough.
std::optional<std::size_t> TetrahedronCut::element_without_room() {
  collect_elements();
  rest_were_ = rest_;
  now_were_ = now_;
  for (const Corner& corner : corners_) {
    if (!corner.moved) continue;
    const std::uint32_t p = point_of_.find(corner.slot);
    rest_[p] = corner.moved->rest;
    now_[p] = corner.moved->position;
  }
  divide_elements();
  for (const Tetrahedron& part : parts_)
    if (!has_room(part)) return part.whole;
  return {};
}

void TetrahedronCut::collect_elements() {
  for (auto* points : {&rest_, &now_}) points->clear();
  elements_.clear();
  wholes_.clear();
  point_of_.clear();
  element_of_.clear();
  for (const LinkEdge& edge : edges_)
    if (crosses(edge)) walk_two(map_, 2, 3, edge.across, [&](Dart d) { add_element(d); });
  for (const Corner& corner : corners_)
    if (corner.moved)
      for (Dart d : darts_of(map_, Vertex, corner.dart)) add_element(d);
}

void TetrahedronCut::add_element(Dart d) {
  const Slot slot = state_.map.slot(Volume, d);
  const auto index = static_cast<std::uint32_t>(wholes_.size());
  if (element_of_.insert(slot, index) != index) return;
  elements_.push_back(d);
  const Dart c = map_.alpha(0, map_.alpha(1, d)), apex = map_.alpha(0, map_.alpha(1, map_.alpha(2, d)));
  wholes_.push_back({{point_of(d), point_of(map_.alpha(0, d)), point_of(c), point_of(apex)}, index});
}

std::uint32_t TetrahedronCut::point_of(Dart d) {
  const Slot slot = state_.map.vertex(d);
  const auto index = static_cast<std::uint32_t>(rest_.size());
  const std::uint32_t there = point_of_.insert(slot, index);
  if (there != index) return there;
  rest_.push_back(state_.map.rest_of(d));
  now_.push_back(state_.position[slot].vec());
  return index;
}

// As the rule does, one edge after the other.
void TetrahedronCut::divide_elements() {
  parts_ = wholes_;
  for (const LinkEdge& edge : edges_) {
    if (!crosses(edge)) continue;
    const std::uint32_t b = point_of_.find(corners_[edge.b].slot), c = point_of_.find(corners_[edge.c].slot),
                        m = static_cast<std::uint32_t>(rest_.size());
    const double t = share_of(edge);
    for (auto* points : {&rest_, &now_}) points->push_back((1 - t) * (*points)[b] + t * (*points)[c]);
    const std::size_t count = parts_.size();
    for (std::size_t n = 0; n < count; ++n) {
      const auto at_b = std::ranges::find(parts_[n].point, b), at_c = std::ranges::find(parts_[n].point, c);
      if (at_b == parts_[n].point.end() || at_c == parts_[n].point.end()) continue;
      Tetrahedron other = parts_[n];
      *at_b = m;
      std::ranges::replace(other.point, c, m);
      parts_.push_back(other);
    }
  }
}

bool TetrahedronCut::has_room(const Tetrahedron& part) const {
  const auto& p = part.point;
  const Tetrahedron& whole = wholes_[part.whole];
  const auto turned = [&](const std::vector<Vec3>& at, const std::vector<Vec3>& were) {
    return six_volumes(at, p) * six_volumes(were, whole.point) <= 0;
  };
  if (turned(rest_, rest_were_) || turned(now_, now_were_)) return false;
  const ElementSizes& start = state_.start[state_.map.slot(Volume, elements_[part.whole])];
  return ElementSizes(rest_[p[0]], rest_[p[1]], rest_[p[2]], rest_[p[3]]).may_be_part(start, state_.least);
}

} // namespace rend
