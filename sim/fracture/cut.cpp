// Cut: a crack that is free of the mesh, in sheets of triangles (O'Brien & Hodgins 1999; Pfaff et al. 2014). A
// plane through the vertex v with normal n crosses the edge bc opposite to v, of each element at it, at
//
//   m = (1 − t) b + t c,   t = s_b / (s_b − s_c),   s = (x − v)·n,   if s_b and s_c have different signs
//
// That edge is divided at m (divide-edge-of-triangles), and the two elements on either side of v m are
// separated. A division displaces no matter: in linear triangles neither strain nor elastic energy changes.
//
// Inside the matter both halves of the plane are cut. At a vertex on the border, the tip of a crack among them,
// the half that leads furthest away from the border's two edges: so a crack does not turn back along its wake.
//
// The plane is that of crack_plane.h, whatever the criterion; where nothing pulls, that of the criterion.
//
// No slivers. Where m lies within a quarter of the edge from one of its ends, or a part would be too small or
// thin (Limits), the cut runs along the edge to that end, which moves to m, within the matter: its rest
// position is that of m, its position where m is; it keeps its velocity, and the elements around it their
// masses. An end on a border or with a prescribed motion stays where it is, and so does one around which an
// element would become too small or thin, or tilt. Then the edge is divided nearer to its end, if no part
// becomes too small or thin; or else the cut bends to that end.
//
// A vertex at whose elements something changed in this step waits for the next one: the plane that its
// criterion found belongs to elements that are not there any more. So does one beside such elements.
#include "sim/base/archive.h"
#include "sim/fracture/change.h"
#include "sim/fracture/crack_plane.h"
#include "sim/fracture/element_scan.h"
#include "sim/fracture/touched_darts.h"
#include "sim/house_rules/house_rules.h"
#include "sim/rules/apply.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

namespace rend {
namespace {

constexpr double nearest_share = 0.25;     // of an edge, from its end
constexpr double smallest_part = 1.0 / 20; // of the smallest element at the start
constexpr std::size_t most_elements = 4;   // times as many as at the start
constexpr double most_along = 0.866;       // cos 30°: a cut this close to the border runs along it
constexpr double least_sine = 1.0 / 5;     // of an element's least angle, over that of the start
constexpr double least_cosine = 0.9;       // between an element's normals before and after a corner moves

constexpr const char* nothing_crosses = "the plane crosses no element at the vertex that leads into the body";
constexpr const char* waits = "another cut of the same step has changed an element at the vertex";
constexpr const char* full = "the body has four times as many elements as at the start";
constexpr const char* divides_none = "the elements at the edge that the plane crosses cannot be divided";

bool has_triangles_alone(const EmbeddedMap& map) {
  bool alone = true;
  for_each_face(map, [&](Dart d) { alone = alone && sides_of_face(map.map(), d) == 3; });
  return alone;
}

// Of the triangle of d at rest, first the corner of d.
struct Corners {
  Vec3 a, b, c; // [m]
  Corners(const EmbeddedMap& map, Dart d)
      : a(map.rest_of(d)), b(map.rest_of(map.map().alpha(0, d))),
        c(map.rest_of(map.map().alpha(0, map.map().alpha(1, d)))) {}
  Corners(const Vec3& a_, const Vec3& b_, const Vec3& c_) : a(a_), b(b_), c(c_) {}

  Vec3 normal() const { return (b - a).cross(c - a); } // [m²], as long as twice the area
  double sine() const {                                // of the least angle
    const double u = (b - a).norm(), v = (c - b).norm(), w = (a - c).norm();
    return normal().norm() * std::min({u, v, w}) / (u * v * w);
  }
};

// The smallest parts that cuts may leave.
struct Limits {
  double twice_area = std::numeric_limits<double>::infinity(); // at rest [m²]
  double sine = 1;                                             // of an angle at rest
};

Limits limits_of(const EmbeddedMap& map) {
  Limits least;
  for_each_face(map, [&](Dart d) {
    const Corners corners(map, d);
    least.twice_area = std::min(least.twice_area, smallest_part * corners.normal().norm());
    least.sine = std::min(least.sine, least_sine * corners.sine());
  });
  return least;
}

// One half of the plane.
struct Half {
  Dart edge = {};                  // at the vertex, along which it is cut; none: after the division
  Dart across = {};                // of the edge that is divided, at the end from which the share counts
  double share = 0;                // 0: nothing is divided
  std::optional<Point> moved = {}; // where the other end of the edge moves; none: it stays
  Vec3 direction = Vec3::Zero();   // in which the crack runs, a unit vector
};

// What the plane meets at one vertex, in the state before the edit.
class Crossing {
public:
  Crossing(const ForceView& view, std::span<const Dart> darts, const Vec3& normal, const Limits& least)
      : view_(view), map_(view.map.map()), darts_(darts), normal_(normal), least_(least),
        here_(at(darts.front())) {}

  // Those to be cut.
  std::vector<Half> halves() const {
    std::vector<Half> all;
    for (Dart d : darts_)
      if (d < map_.alpha(1, d)) add_half(d, all);
    const std::vector<Vec3> border = border_edges();
    if (border.empty() || all.empty()) return all;
    const auto along = [&](const Half& half) {
      double most = -1;
      for (const Vec3& edge : border) most = std::max(most, edge.dot(half.direction));
      return most;
    };
    const Half best = *std::ranges::min_element(all, {}, along);
    return along(best) < most_along ? std::vector{best} : std::vector<Half>{};
  }

private:
  Vec3 at(Dart d) const { return view_.position[view_.map.vertex(d)].vec(); }
  Vec3 direction_to(const Vec3& point) const { return (point - here_).normalized(); }

  // By the corner of d, in its triangle v b c.
  void add_half(Dart d, std::vector<Half>& all) const {
    const Dart other = map_.alpha(1, d), across = map_.alpha(1, map_.alpha(0, d));
    const Vec3 b = at(map_.alpha(0, d)), c = at(map_.alpha(0, other));
    const double s_b = (b - here_).dot(normal_), s_c = (c - here_).dot(normal_);
    if ((s_b >= 0) == (s_c >= 0)) return;
    const double t = s_b / (s_b - s_c);
    const Half divided{.across = across, .share = t, .direction = direction_to(b + t * (c - b))};
    const bool room = leaves_room(across, t), near = std::min(t, 1 - t) < nearest_share;
    if (room && !near) return all.push_back(divided);
    const Dart edge = t < 0.5 ? d : other;
    const bool open = map_.is_free(2, edge);
    const Dart end = map_.alpha(0, edge), far = map_.alpha(0, t < 0.5 ? other : d);
    const Point to = between(end, far, std::min(t, 1 - t));
    if (!open && may_move(end, to))
      return all.push_back({.edge = edge, .moved = to, .direction = direction_to(to.position)});
    if (room) return all.push_back(divided);
    if (!open) all.push_back({.edge = edge, .direction = direction_to(at(end))});
  }

  // At a share of the way from a to b, with the velocity of a.
  Point between(Dart a, Dart b, double share) const {
    const Vec3 rest = view_.map.rest_of(a);
    return {.position = at(a) + share * (at(b) - at(a)),
            .rest = rest + share * (view_.map.rest_of(b) - rest),
            .velocity = view_.velocity[view_.map.vertex(a)].vec()};
  }

  bool may_move(Dart end, const Point& to) const {
    if (std::ranges::binary_search(view_.held, view_.map.vertex(end))) return false;
    const std::vector<Dart> around = darts_of(map_, Vertex, end);
    return std::ranges::all_of(around, [&](Dart d) { return !map_.is_free(2, d) && keeps_shape(d, to); });
  }

  // The triangle of d, if the vertex of d moves.
  bool keeps_shape(Dart d, const Point& to) const {
    const Corners rest(view_.map, d), rest_then(to.rest, rest.b, rest.c);
    const Vec3 b = at(map_.alpha(0, d)), c = at(map_.alpha(0, map_.alpha(1, d)));
    const Vec3 normal = Corners(at(d), b, c).normal(), then = Corners(to.position, b, c).normal();
    return rest_then.normal().dot(rest.normal()) > 0 && keeps(rest_then) &&
           then.dot(normal) >= least_cosine * then.norm() * normal.norm();
  }

  // For the parts of the triangles on both sides of an edge that is divided at that share.
  bool leaves_room(Dart across, double share) const {
    return leaves_room_in(Corners(view_.map, across), share) &&
           leaves_room_in(Corners(view_.map, map_.alpha(2, across)), share);
  }
  bool leaves_room_in(const Corners& whole, double share) const { // divided from a to b
    const Vec3 m = whole.a + share * (whole.b - whole.a);
    return keeps(Corners(whole.a, m, whole.c)) && keeps(Corners(m, whole.b, whole.c));
  }
  bool keeps(const Corners& rest) const {
    return rest.normal().norm() >= least_.twice_area && rest.sine() >= least_.sine;
  }

  std::vector<Vec3> border_edges() const {
    std::vector<Vec3> edges;
    for (Dart d : darts_)
      if (map_.is_free(2, d)) edges.push_back(direction_to(at(map_.alpha(0, d))));
    return edges;
  }

  const ForceView& view_;
  const GMap& map_;
  std::span<const Dart> darts_; // of the vertex
  Vec3 normal_;
  const Limits& least_;
  Vec3 here_;
};

// Of one law.
class Cuts final : public ChangeMemory {
public:
  explicit Cuts(const CriterionRequest& request)
      : runner_(rule("divide-edge-of-triangles")),
        cut_edge_(static_cast<std::size_t>(runner_.rule().right.find("h"))), least_(limits_of(request.map)),
        compression_(request.compression) {
    make_anew(request);
    const std::size_t darts = most_elements * request.map.map().dart_count();
    runner_.context().most_darts = std::min(darts, most_darts(request.map));
    over_budget_ = darts <= runner_.context().most_darts ? full : beyond_budget;
  }

  bool apply(Edit& edit, const ForceView& view, const FoundPlace& found, std::span<const Dart> darts) {
    if (touched_.any_of(*edit.journal(), star_of(edit.map(), darts))) return refuse(waits);
    std::vector<Half> halves = Crossing(view, darts, plane_at(view, found, darts), least_).halves();
    if (halves.empty()) return refuse(nothing_crosses);
    if (!settle_moves(edit, halves)) return refuse(waits);
    const Edit::Savepoint before = edit.savepoint();
    std::vector<Dart> edges;
    for (const Half& half : halves) {
      edges.push_back(half.share > 0 ? divided(edit, half) : half.edge);
      if (edges.back() != Dart{}) continue;
      edit.rollback(before);
      return refuse(runner_.over_budget() ? over_budget_ : divides_none);
    }
    for (std::size_t n = 0; n < halves.size(); ++n) {
      if (halves[n].moved) edit.move(edit.map().alpha(0, edges[n]), *halves[n].moved);
      unsew(edit, 2, edges[n]);
    }
    touched_.add(moved_);
    return true;
  }

  void begin(const ForceView&) override { touched_.clear(); }
  void settle_candidate(bool made) override {
    if (!made && why_) ++refusals_[why_];
    why_ = nullptr;
  }
  const Refusals& refusals() const override { return refusals_; }
  void store(Archive& archive) override {
    archive.table(refusals_, 4, "a cut was refused for more reasons than there are");
  }
  void make_anew(const CriterionRequest& request) override { plane_.emplace(request); }
  void rebind(const Changes&) override {}
  void reserve_for_separations() override {}
  std::size_t bytes() const override { return 0; }

private:
  bool refuse(const char* why) {
    why_ = why;
    return false;
  }

  // A law that breaks under compression asks for the plane across that.
  Vec3 plane_at(const ForceView& view, const FoundPlace& found, std::span<const Dart> darts) {
    const Vec3 across_tension = compression_ ? Vec3::Zero() : plane_->at(view, darts);
    return across_tension.isZero(0) ? found.normal : across_tension;
  }

  // A vertex moves only if no element around it changes otherwise: the half waits. False: so does the vertex.
  bool settle_moves(const Edit& edit, std::vector<Half>& halves) {
    const GMap& map = edit.map();
    changing_.clear();
    moved_.clear();
    for (const Half& half : halves) {
      if (half.share == 0) continue;
      for (Dart side : {half.across, map.alpha(2, half.across)})
        for (Dart d : darts_of(map, Face, side)) changing_.insert(d.value);
    }
    std::erase_if(halves, [&](const Half& half) {
      if (!half.moved) return false;
      around_.clear();
      for (Dart d : darts_of(map, Vertex, map.alpha(0, half.edge))) collect(map, Face, d, around_);
      if (touched_.any_of(*edit.journal(), around_) ||
          std::ranges::any_of(around_, [&](Dart d) { return changing_.contains(d.value); }))
        return true;
      for (Dart d : around_) changing_.insert(d.value);
      moved_.insert(moved_.end(), around_.begin(), around_.end());
      return false;
    });
    return !halves.empty();
  }

  // The darts of all elements that a cut there may divide: at the vertex, and beyond the edges opposite to it.
  std::span<const Dart> star_of(const GMap& map, std::span<const Dart> darts) {
    star_.clear();
    for (Dart d : darts) {
      if (d > map.alpha(1, d)) continue;
      collect(map, Face, d, star_);
      const Dart across = map.alpha(1, map.alpha(0, d));
      if (!map.is_free(2, across)) collect(map, Face, map.alpha(2, across), star_);
    }
    return star_;
  }

  // The edge from the vertex that was born, at it; none: the edge could not be divided.
  Dart divided(Edit& edit, const Half& half) {
    runner_.context().wheres = {scalar_value(half.share)};
    if (!runner_.apply(edit, half.across)) return {};
    return runner_.darts()[cut_edge_]; // of the first instance, the hook's own side
  }

  RuleRunner runner_;
  std::size_t cut_edge_;              // the node of its right graph on the new edge to the vertex
  const char* over_budget_ = nullptr; // why the map may not grow further
  Limits least_;
  bool compression_;
  std::optional<CrackPlane> plane_;
  TouchedDarts touched_;
  IndexSet changing_;                // scratch: darts of the elements that a cut divides, or moves a corner of
  std::vector<Dart> around_, moved_; // scratch: darts of elements at one vertex that moves, at all of them
  std::vector<Dart> star_;           // scratch
  const char* why_ = nullptr;
  Refusals refusals_;
};

std::string lacking(const CriterionRequest& request) {
  if (request.map.dimension() != 2) return "goes through sheets so far, and this body is a solid";
  if (!has_triangles_alone(request.map))
    return "goes through triangles alone, and this body has other elements";
  if (!lacking_for_stress(request).empty()) return "divides elements of <elasticity>, and this body has none";
  return {};
}

std::shared_ptr<const ChangeType> of_law(const CriterionRequest& request) {
  auto change = std::make_shared<ChangeType>(cut());
  const auto cuts = std::make_shared<Cuts>(request);
  change->apply = [cuts](Edit& edit, const ForceView& view, const FoundPlace& found,
                         std::span<const Dart> darts) { return cuts->apply(edit, view, found, darts); };
  change->memory = cuts;
  return change;
}

} // namespace

ChangeType cut() {
  return {.name = "cut",
          .what =
              "the elements around the vertex are divided along the plane across the tension, and parted there "
              "(sheets of triangles with <elasticity>)",
          .cell = Cell::Vertices,
          .apply = {},
          .grows = true,
          .of_law = of_law,
          .lacking = lacking};
}

} // namespace rend
