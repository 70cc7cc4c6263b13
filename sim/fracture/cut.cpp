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
// No slivers: where m lies within a quarter of the edge from one of its ends, or a part would be smaller than a
// twentieth of the smallest element at the start, the cut runs along the edge to that end:
// it bends. A vertex at whose elements something changed in this step waits for the next one: the plane that
// its criterion found belongs to elements that are not there any more. So does one beside such elements.
#include "sim/base/archive.h"
#include "sim/fracture/change.h"
#include "sim/fracture/element_scan.h"
#include "sim/fracture/touched_darts.h"
#include "sim/house_rules/house_rules.h"
#include "sim/rules/apply.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <array>
#include <limits>

namespace rend {
namespace {

constexpr double nearest_share = 0.25;     // of an edge, from its end
constexpr double smallest_part = 1.0 / 20; // of the smallest element at the start
constexpr std::size_t most_elements = 4;   // times as many as at the start
constexpr double most_along = 0.866;       // cos 30°: a cut this close to the border runs along it

constexpr const char* nothing_crosses = "the plane crosses no element at the vertex that leads into the body";
constexpr const char* waits = "another cut of the same step has changed an element at the vertex";
constexpr const char* full = "the body has four times as many elements as at the start";
constexpr const char* divides_none = "the elements at the edge that the plane crosses cannot be divided";

bool has_triangles_alone(const EmbeddedMap& map) {
  bool alone = true;
  for_each_face(map, [&](Dart d) { alone = alone && sides_of_face(map.map(), d) == 3; });
  return alone;
}

// Twice the area at rest of the triangle of d [m²].
double twice_area(const EmbeddedMap& map, Dart d) {
  const GMap& g = map.map();
  const Vec3 a = map.rest_of(d);
  return (map.rest_of(g.alpha(0, d)) - a).cross(map.rest_of(g.alpha(0, g.alpha(1, d))) - a).norm();
}

// One half of the plane.
struct Half {
  Dart edge = {};                // at the vertex, along which it is cut; none: after the division
  Dart across = {};              // of the edge that is divided, at the end from which the share counts
  double share = 0;              // 0: nothing is divided
  Vec3 direction = Vec3::Zero(); // in which the crack runs, a unit vector
};

// What the plane meets at one vertex, in the state before the edit.
class Crossing {
public:
  Crossing(const ForceView& view, std::span<const Dart> darts, const Vec3& normal, double least)
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
    if (leaves_room(across, t)) {
      all.push_back({.across = across, .share = t, .direction = direction_to(b + t * (c - b))});
      return;
    }
    const Dart edge = t < 0.5 ? d : other;
    if (map_.is_free(2, edge)) return; // it is open there
    all.push_back({.edge = edge, .direction = direction_to(t < 0.5 ? b : c)});
  }

  // For the parts of the triangles on both sides of an edge that is divided at that share.
  bool leaves_room(Dart across, double share) const {
    const double smaller = std::min(share, 1 - share);
    return smaller >= nearest_share && smaller * twice_area(view_.map, across) >= least_ &&
           smaller * twice_area(view_.map, map_.alpha(2, across)) >= least_;
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
  double least_; // twice the area [m²] of the smallest part
  Vec3 here_;
};

// Of one law.
class Cuts final : public ChangeMemory {
public:
  explicit Cuts(const CriterionRequest& request)
      : runner_(rule("divide-edge-of-triangles")),
        cut_edge_(static_cast<std::size_t>(runner_.rule().right.find("h"))) {
    double smallest = std::numeric_limits<double>::infinity();
    for_each_face(request.map, [&](Dart d) { smallest = std::min(smallest, twice_area(request.map, d)); });
    least_ = smallest_part * smallest;
    const std::size_t darts = most_elements * request.map.map().dart_count();
    runner_.context().most_darts = std::min(darts, most_darts(request.map));
    over_budget_ = darts <= runner_.context().most_darts ? full : beyond_budget;
  }

  bool apply(Edit& edit, const ForceView& view, const FoundPlace& found, std::span<const Dart> darts) {
    if (touched_.any_of(*edit.journal(), star_of(edit.map(), darts))) return refuse(waits);
    const std::vector<Half> halves = Crossing(view, darts, found.normal, least_).halves();
    if (halves.empty()) return refuse(nothing_crosses);
    const Edit::Savepoint before = edit.savepoint();
    std::vector<Dart> edges;
    for (const Half& half : halves) {
      edges.push_back(half.share > 0 ? divided(edit, half) : half.edge);
      if (edges.back() != Dart{}) continue;
      edit.rollback(before);
      return refuse(runner_.over_budget() ? over_budget_ : divides_none);
    }
    for (Dart d : edges) unsew(edit, 2, d);
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
  void make_anew(const CriterionRequest&) override {}
  void rebind(const Changes&) override {}
  void reserve_for_separations() override {}
  std::size_t bytes() const override { return 0; }

private:
  bool refuse(const char* why) {
    why_ = why;
    return false;
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
  double least_ = 0;                  // twice the area at rest of the smallest part [m²]
  TouchedDarts touched_;
  std::vector<Dart> star_; // scratch
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
              "the elements around the vertex are divided along the plane across the force, and parted there "
              "(sheets of triangles with <elasticity>)",
          .cell = Cell::Vertices,
          .apply = {},
          .grows = true,
          .of_law = of_law,
          .lacking = lacking};
}

} // namespace rend
