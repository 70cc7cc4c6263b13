#include "sim/build/slit.h"

#include "sim/base/reach.h"
#include "sim/cuts/triangle_cut.h"
#include "sim/house_rules/house_rules.h"
#include "sim/mechanics/interaction.h"
#include "sim/embedding/selector.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace rend {
namespace {

constexpr double slack = 1e-9; // of a triangle, in barycentric coordinates
constexpr int most_dashes = 10'000;

// A point of the sheet, in the triangle of a dart.
struct Found {
  Dart corner;         // of the vertex with the largest weight
  double away = 0;     // [m], from the plane of the triangle
  double largest = 0;  // weights
  double smallest = 0; // the one that counts from the edge on the other side
  Dart edge;           // opposite to the corner with the smallest weight
  double share = 0;    // along it
};

// The cutter of a sheet's slits: divides elements first, and opens all edges at the end.
class Slits {
public:
  explicit Slits(EmbeddedMap& map) : map_(map), g_(map.map()) {
    add_start_elements(map_);
    start_ = find_start_elements(map_);
  }

  // False: all of it lies outside.
  bool cut(const std::vector<Vec3>& points, const std::optional<std::vector<double>>& dash,
           const SettingsSource& source) {
    if (!march(points, source)) return false;
    if (dash)
      cut_dashes(*dash, source);
    else
      cut_edges([](double) { return true; });
    return true;
  }

  void open() {
    map_.edit([&](Edit& edit) {
      std::vector<Dart> darts;
      g_.for_each_dart([&](Dart d) {
        if (edges_.contains(ends_of(d))) darts.push_back(d);
      });
      for (Dart d : darts)
        if (!g_.is_free(2, d)) unsew(edit, 2, d);
    });
  }

private:
  using Edge = std::pair<Slot, Slot>; // the smaller one first
  struct Passed {
    Slot vertex;
    double at; // [m], along the line from its first point
  };
  struct Stretch {
    double begin, end; // [m], along the line
  };

  // Leaves the way in path_. False: all of it lies outside.
  bool march(const std::vector<Vec3>& points, const SettingsSource& source) {
    path_.clear();
    Dart here = start(points[0], points[1]);
    if (here == Dart{}) return false;
    double before = 0;
    for (std::size_t n = 1; n < points.size(); ++n) {
      from_ = points[n - 1];
      way_ = (points[n] - from_).normalized();
      before_ = before;
      before += (points[n] - from_).norm();
      if (n == 1) pass(here);
      pin(here);
      const Slot from = map_.vertex(here);
      const Dart goal = vertex_at(points[n]);
      if (goal == Dart{} && n + 1 < points.size()) refuse_gap(source);
      here = march(map_.cells(Vertex).first_dart(from), points[n], goal);
      if (goal != Dart{} && map_.vertex(here) != map_.vertex(goal)) refuse_gap(source);
    }
    return true;
  }

  void pass(Dart d) { path_.push_back({map_.vertex(d), before_ + (at(d) - from_).dot(way_)}); }

  // What is cut and what is left, in turn. All ends become vertices first, which divides edges of the way.
  void cut_dashes(const std::vector<double>& lengths, const SettingsSource& source) {
    std::vector<Stretch> dashes;
    double end = 0, last = path_.front().at;
    for (std::size_t n = 0; end < path_.back().at; ++n) {
      const double length = lengths[n % lengths.size()], begin = std::exchange(end, end + length);
      if (end <= path_.front().at) continue;
      const double here = end < path_.back().at ? path_[vertex_along(end)].at : path_.back().at;
      const double within = std::min(end, path_.back().at) - std::max(begin, path_.front().at);
      if (within > length / 2 && here <= last)
        source.fail("dash", fmt::format("the elements are too large for a length of {:g} m", length),
                    "take smaller cells");
      if (n % 2 == 0) dashes.push_back({last, here});
      last = here;
    }
    cut_edges([&](double middle) {
      const auto dash = std::ranges::upper_bound(dashes, middle, {}, &Stretch::end);
      return dash != dashes.end() && dash->begin < middle;
    });
  }

  // Of the way, by their middles.
  template <class Chosen> void cut_edges(const Chosen& chosen) {
    for (std::size_t n = 0; n + 1 < path_.size(); ++n)
      if (chosen((path_[n].at + path_[n + 1].at) / 2))
        edges_.insert(std::minmax(path_[n].vertex, path_[n + 1].vertex));
  }

  // A place in path_: of a vertex within a quarter of an edge, or one that is created, or else the nearest.
  std::size_t vertex_along(double goal) {
    std::size_t n = 0;
    while (n + 2 < path_.size() && path_[n + 1].at < goal) ++n;
    const double share = (goal - path_[n].at) / (path_[n + 1].at - path_[n].at);
    if (std::min(share, 1 - share) > 0.25)
      for (Dart d : darts_of(g_, Vertex, map_.cells(Vertex).first_dart(path_[n].vertex)))
        if (map_.vertex(g_.alpha(0, d)) == path_[n + 1].vertex && cutter().leaves_room(d, share))
          if (const Dart born = divide(d, share); born != Dart{}) {
            pin(born);
            return n + 1;
          }
    return share < 0.5 ? n : n + 1;
  }

  Vec3 at(Dart d) const { return map_.rest_of(d); }
  Edge ends_of(Dart d) const { return std::minmax(map_.vertex(d), map_.vertex(g_.alpha(0, d))); }
  TriangleCut cutter() const {
    const Record* x = map_.position().values().data();
    return TriangleCut({map_, *start_, x, map_.velocity().values().data(), pinned_, false});
  }
  [[noreturn]] static void refuse_gap(const SettingsSource& source) {
    source.fail("along", "the slit leaves its body between two of its points",
                "write a slit for each part within the body");
  }
  void pin(Dart d) {
    const Slot v = map_.vertex(d);
    const auto place = std::ranges::lower_bound(pinned_, v);
    if (place == pinned_.end() || *place != v) pinned_.insert(place, v);
  }

  // The vertex at the first point; of one outside, where the way to the next point enters.
  Dart start(const Vec3& first, const Vec3& next) {
    if (const Dart d = vertex_at(first); d != Dart{}) return d;
    double least = std::numeric_limits<double>::infinity();
    const Vec3 way = next - first;
    g_.for_each_dart([&](Dart d) {
      if (!g_.is_free(2, d) || g_.alpha(0, d) < d) return;
      const Vec3 a = at(d), edge = at(g_.alpha(0, d)) - a;
      const Vec3 across = way.cross(edge);
      if (!(across.squaredNorm() > 0)) return;
      const double s = (a - first).cross(edge).dot(across) / across.squaredNorm();
      const double t = (a - first).cross(way).dot(across) / across.squaredNorm();
      const double gap = std::abs((a - first).dot(across.normalized()));
      if (s >= 0 && s <= 1 && t >= 0 && t <= 1 && gap <= edge.norm() / 2) least = std::min(least, s);
    });
    if (std::isinf(least)) return {};
    return vertex_at(first + least * way);
  }

  // Null: the point is not on the sheet.
  Dart vertex_at(const Vec3& point) {
    const std::optional<Found> found = find(point);
    if (!found) return {};
    if (found->largest >= 1 - slack) return found->corner;
    const Point to{point, point, Vec3::Zero()};
    if (found->largest > 0.5 && cutter().may_move(found->corner, to)) {
      map_.edit([&](Edit& edit) { edit.move(found->corner, to); });
      return found->corner;
    }
    const bool on_edge = found->smallest < slack, border = g_.is_free(2, found->edge);
    if (found->largest > (on_edge && border ? 0.75 : 0.9)) return found->corner;
    const bool fixed = border || is_cut(ends_of(found->edge));
    if (on_edge || found->smallest < 0.1 || (!fixed && reaches(found->edge, point))) {
      const Dart born = divide(found->edge, found->share);
      if (born == Dart{}) return found->corner;
      if (!on_edge && !fixed && (found->smallest >= 0.1 || cutter().may_move(born, to)))
        map_.edit([&](Edit& edit) { edit.move(born, to); });
      return born;
    }
    Dart born;
    map_.edit([&](Edit& edit) { born = apply(rule("star-face"), edit, found->corner).dart("c"); });
    map_.edit([&](Edit& edit) { edit.move(born, to); });
    return born;
  }

  // Whether the two parts of the triangle beyond an edge could meet at that point instead of on the edge.
  bool reaches(Dart edge, const Vec3& point) const {
    constexpr double least = 0.1; // of that triangle
    const Vec3 a = at(edge), b = at(g_.alpha(0, edge)), c = at(g_.alpha(0, g_.alpha(1, g_.alpha(2, edge))));
    const Vec3 normal = (b - a).cross(c - a);
    return std::min((point - a).cross(c - a).dot(normal), (b - point).cross(c - point).dot(normal)) >=
           least * normal.squaredNorm();
  }

  // The nearest of the triangles above which the point lies.
  std::optional<Found> find(const Vec3& point) const {
    std::optional<Found> nearest;
    for_each_face(map_, [&](Dart d) {
      const Dart e = g_.alpha(1, g_.alpha(0, d)), f = g_.alpha(1, d);
      const std::array<Dart, 3> corner{d, e, g_.alpha(0, f)};
      const Vec3 a = at(corner[0]), u = at(corner[1]) - a, v = at(corner[2]) - a, normal = u.cross(v);
      const double whole = normal.squaredNorm();
      std::array<double, 3> weight{};
      weight[1] = (point - a).cross(v).dot(normal) / whole;
      weight[2] = u.cross(point - a).dot(normal) / whole;
      weight[0] = 1 - weight[1] - weight[2];
      const auto least = std::ranges::min_element(weight), most = std::ranges::max_element(weight);
      const double away = std::abs((point - a).dot(normal) / std::sqrt(whole));
      if (*least < -slack || away > std::sqrt(std::sqrt(whole)) || (nearest && nearest->away <= away)) return;
      const auto apex = static_cast<std::size_t>(least - weight.begin());
      // From the corner behind the apex to the one before it.
      const std::size_t one = (apex + 1) % 3, two = (apex + 2) % 3;
      nearest = Found{.corner = corner[static_cast<std::size_t>(most - weight.begin())],
                      .away = away,
                      .largest = *most,
                      .smallest = std::max(*least, 0.0),
                      .edge = corner[one],
                      .share = weight[two] / (weight[one] + weight[two])};
    });
    return nearest;
  }

  // From a vertex straight on to a point, until the goal is reached or the sheet ends. Returns where it ended.
  Dart march(Dart here, const Vec3& point, Dart goal) {
    const Slot last = goal == Dart{} ? ~Slot{0} : map_.vertex(goal);
    double left = std::numeric_limits<double>::infinity();
    while (map_.vertex(here) != last) {
      const double now = (point - at(here)).norm();
      if (!(now < left)) return here;
      left = now;
      const Dart next = step(here, point, last);
      if (next == Dart{}) return here;
      here = next;
    }
    return here;
  }

  // To the next vertex. Null: there is none in that direction.
  Dart step(Dart here, const Vec3& point, Slot goal) {
    const std::vector<Dart> around = darts_of(g_, Vertex, here);
    for (Dart d : around)
      if (map_.vertex(g_.alpha(0, d)) == goal) return along(d);
    Dart corner;
    double share = 0, best = -slack;
    for (Dart d : around) {
      if (g_.alpha(1, d) < d) continue;
      const Vec3 b = at(g_.alpha(0, d)) - at(d), c = at(g_.alpha(0, g_.alpha(1, d))) - at(d),
                 way = point - at(d);
      const double bb = b.dot(b), bc = b.dot(c), cc = c.dot(c), bw = b.dot(way), cw = c.dot(way);
      const double beta = bw * cc - cw * bc, gamma = cw * bb - bw * bc; // way = (β b + γ c) / (bb cc − bc²)
      if (!(beta + gamma > 0)) continue;
      const double t = gamma / (beta + gamma), inside = std::min(t, 1 - t);
      if (inside <= best) continue;
      best = inside;
      corner = d;
      share = std::clamp(t, 0.0, 1.0);
    }
    if (corner == Dart{}) return {};
    if (share < slack) return along(corner);
    if (share > 1 - slack) return along(g_.alpha(1, corner));
    std::optional<CutWay> way = cutter().through(corner, share);
    const bool on = way && (way->share > 0 || (point - way->to).norm() < (point - at(here)).norm());
    if (!on) way = CutWay{.across = g_.alpha(1, g_.alpha(0, corner)), .share = std::clamp(share, 0.1, 0.9)};
    if (way->share == 0) {
      if (way->moved) map_.edit([&](Edit& edit) { edit.move(g_.alpha(0, way->edge), *way->moved); });
      return along(way->edge);
    }
    const Slot from = map_.vertex(here);
    const Dart born = divide(way->across, way->share);
    if (born == Dart{}) return {};
    for (Dart d : darts_of(g_, Vertex, born))
      if (map_.vertex(g_.alpha(0, d)) == from) return along(g_.alpha(0, d));
    return {};
  }

  bool is_cut(const Edge& edge) const {
    const auto same = [&](const Passed& a, const Passed& b) {
      return Edge(std::minmax(a.vertex, b.vertex)) == edge;
    };
    return edges_.contains(edge) || std::ranges::adjacent_find(path_, same) != path_.end();
  }

  // The other end of an edge, which is on the way.
  Dart along(Dart d) {
    pass(g_.alpha(0, d));
    pin(g_.alpha(0, d));
    return g_.alpha(0, d);
  }

  // The vertex that is born; of an edge that is cut or on the way, both parts are.
  Dart divide(Dart edge, double share) {
    const Edge ends = ends_of(edge);
    const Slot first = map_.vertex(edge);
    Dart born;
    map_.edit([&](Edit& edit) { born = division_.divided(edit, edge, share); });
    if (born != Dart{} && edges_.erase(ends) > 0)
      for (Slot end : {ends.first, ends.second}) edges_.insert(std::minmax(map_.vertex(born), end));
    for (std::size_t n = 0; born != Dart{} && n + 1 < path_.size(); ++n) {
      const Passed a = path_[n], b = path_[n + 1];
      if (Edge(std::minmax(a.vertex, b.vertex)) != ends) continue;
      const double part = a.vertex == first ? share : 1 - share;
      path_.insert(path_.begin() + static_cast<std::ptrdiff_t>(++n),
                   {map_.vertex(born), a.at + part * (b.at - a.at)});
    }
    return born;
  }

  EmbeddedMap& map_;
  const GMap& g_;
  const Column<StartElement>* start_ = nullptr;
  EdgeDivision division_;
  std::vector<Slot> pinned_; // vertices of slits, increasing
  std::set<Edge> edges_;     // that are cut
  std::vector<Passed> path_; // of the slit that is being cut, whose edges are not in edges_ yet
  Vec3 from_, way_;          // [m], and a unit vector: the line on which it is now
  double before_ = 0;        // [m], the length of those before
};

double length_of(const std::vector<Vec3>& points) {
  double sum = 0;
  for (std::size_t n = 1; n < points.size(); ++n) sum += (points[n] - points[n - 1]).norm();
  return sum;
}

std::vector<Vec3> points_of(const SlitSettings& slit) {
  check_settings(slit);
  const std::vector<double>& x = slit.along;
  if (x.size() % 3 != 0 || x.size() < 6)
    slit.source.fail("along", fmt::format("{} numbers are no points of a slit", x.size()),
                     "x y z of two points or more");
  std::vector<Vec3> points;
  for (std::size_t n = 0; n < x.size(); n += 3) {
    points.emplace_back(x[n], x[n + 1], x[n + 2]);
    if (points.size() > 1 && points.back() == points[points.size() - 2])
      slit.source.fail("along", "two points of the slit are the same", "a slit has a length");
  }
  if (slit.dash && (slit.dash->empty() || slit.dash->size() % 2 != 0))
    slit.source.fail("dash", "a length to cut has none to leave after it", "dash=\"0.02 0.01\"");
  if (slit.dash && length_of(points) > most_dashes * *std::ranges::min_element(*slit.dash))
    slit.source.fail("dash", fmt::format("the slit may have more than {} parts", most_dashes),
                     "lengths are in metres");
  return points;
}

} // namespace

template <> const Fields<SlitSettings>& fields_of() {
  using S = SlitSettings;
  static const Fields<S> fields{
      field(&S::along,
            within(numbers("along", 0, "m", "points x y z of the shape, one after another"), farthest)
                .is_required()),
      field(&S::dash, numbers("dash", 0, "m",
                              "lengths that are cut and left in turn: a perforation; without it, all is cut")
                          .above(0))};
  return fields;
}

void cut_slits(EmbeddedMap& map, std::span<const SlitSettings> slits) {
  if (slits.empty()) return;
  bool triangles = map.dimension() == 2;
  for_each_face(map, [&](Dart d) { triangles = triangles && sides_of_face(map.map(), d) == 3; });
  if (!triangles)
    slits.front().source.fail("", "slits go through sheets of triangles, and this body is none",
                              "pattern=\"triangles\" or \"crossed\" of <sheet>");
  Slits all(map);
  for (const SlitSettings& slit : slits) {
    if (!all.cut(points_of(slit), slit.dash, slit.source))
      slit.source.fail(
          "along", "the slit lies outside of its body",
          "its points are those of the shape, before it is placed; the first and the last may lie outside");
  }
  all.open();
}

} // namespace rend
