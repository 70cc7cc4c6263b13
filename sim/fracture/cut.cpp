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
// Vertices near the plane move onto it, so that there are no slivers (triangle_cut.h); not where there are
// springs in the plane: their strain differs from edge to edge, so that a vertex that moves would strain them.
//
// A crack goes on from its tip: a vertex at most two edges away from where one ends is not cut itself. So no
// bridges are left ahead of a crack, and its flanks do not fray.
//
// A vertex at whose elements something changed in this step waits for the next one: the plane that its
// criterion found belongs to elements that are not there any more. So does one beside such elements.
#include "sim/base/archive.h"
#include "sim/base/check.h"
#include "sim/fracture/change.h"
#include "sim/fracture/crack_plane.h"
#include "sim/fracture/element_scan.h"
#include "sim/fracture/touched_darts.h"
#include "sim/fracture/triangle_cut.h"
#include "sim/mechanics/hinge_law.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <optional>

namespace rend {
namespace {

constexpr std::size_t most_elements = 4; // times as many as at the start
constexpr double most_along = 0.866;     // cos 30°: a cut this close to the border runs along it

constexpr const char* nothing_crosses = "the plane crosses no element at the vertex that leads into the body";
constexpr const char* waits = "another cut of the same step has changed an element at the vertex";
constexpr const char* beside_tip = "a crack ends beside the vertex, and goes on from there";
constexpr const char* full = "the body has four times as many elements as at the start";
constexpr const char* divides_none = "the elements at the edge that the plane crosses cannot be divided";

bool has_triangles_alone(const EmbeddedMap& map) {
  bool alone = true;
  for_each_face(map, [&](Dart d) { alone = alone && sides_of_face(map.map(), d) == 3; });
  return alone;
}

// One half of the plane.
struct Half {
  CutWay way;
  Vec3 direction; // in which the crack runs, a unit vector
};

// What the plane meets at one vertex, in the state before the edit.
class Crossing {
public:
  Crossing(const ForceView& view, std::span<const Dart> darts, const Vec3& normal,
           const Column<StartTriangle>& start, bool rigid)
      : view_(view), map_(view.map.map()),
        cut_({view.map, start, view.position, view.velocity, view.held, rigid}), darts_(darts), normal_(normal),
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
    const Vec3 b = at(map_.alpha(0, d)), c = at(map_.alpha(0, map_.alpha(1, d)));
    const double s_b = (b - here_).dot(normal_), s_c = (c - here_).dot(normal_);
    if ((s_b >= 0) == (s_c >= 0)) return;
    if (const auto way = cut_.through(d, s_b / (s_b - s_c))) all.push_back({*way, direction_to(way->to)});
  }

  std::vector<Vec3> border_edges() const {
    std::vector<Vec3> edges;
    for (Dart d : darts_)
      if (map_.is_free(2, d)) edges.push_back(direction_to(at(map_.alpha(0, d))));
    return edges;
  }

  const ForceView& view_;
  const GMap& map_;
  TriangleCut cut_;
  std::span<const Dart> darts_; // of the vertex
  Vec3 normal_;
  Vec3 here_;
};

// Of one law.
class Cuts final : public ChangeMemory {
public:
  explicit Cuts(const CriterionRequest& request)
      : start_(find_start_triangles(request.map)), compression_(request.compression) {
    CHECK(start_); // ChangeType::prepare
    make_anew(request);
    const std::size_t darts = most_elements * request.map.map().dart_count();
    std::size_t& most = division_.runner().context().most_darts;
    most = std::min(darts, most_darts(request.map));
    over_budget_ = darts <= most ? full : beyond_budget;
  }

  bool apply(Edit& edit, const ForceView& view, const FoundPlace& found, std::span<const Dart> darts) {
    if (touched_.any_of(*edit.journal(), star_of(edit.map(), darts))) return refuse(waits);
    if (!is_tip(view.map, darts) && is_beside_tip(edit, view.map, darts)) return refuse(beside_tip);
    std::vector<Half> halves = Crossing(view, darts, plane_at(view, found, darts), *start_, rigid_).halves();
    if (halves.empty()) return refuse(nothing_crosses);
    if (!settle_moves(edit, halves)) return refuse(waits);
    const Edit::Savepoint before = edit.savepoint();
    std::vector<Dart> edges;
    for (const auto& [way, direction] : halves) {
      edges.push_back(way.share > 0 ? division_.divided(edit, way.across, way.share) : way.edge);
      if (edges.back() != Dart{}) continue;
      edit.rollback(before);
      return refuse(division_.runner().over_budget() ? over_budget_ : divides_none);
    }
    for (std::size_t n = 0; n < halves.size(); ++n) {
      if (halves[n].way.moved) edit.move(edit.map().alpha(0, edges[n]), *halves[n].way.moved);
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
    archive.table(refusals_, 5, "a cut was refused for more reasons than there are");
  }
  void make_anew(const CriterionRequest& request) override {
    plane_.emplace(request);
    rigid_ = std::ranges::any_of(request.interactions, [](const auto& each) {
      const bool triangles = each->law->particles() == 3 && dynamic_cast<const ElementLaw*>(each->law.get());
      return !triangles && each->law != hinge_law();
    });
  }
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
    for (const auto& [way, direction] : halves) {
      if (way.share == 0) continue;
      for (Dart side : {way.across, map.alpha(2, way.across)})
        for (Dart d : darts_of(map, Face, side)) changing_.insert(d.value);
    }
    std::erase_if(halves, [&](const Half& half) {
      if (!half.way.moved) return false;
      around_.clear();
      for (Dart d : darts_of(map, Vertex, map.alpha(0, half.way.edge))) collect(map, Face, d, around_);
      if (touched_.any_of(*edit.journal(), around_) ||
          std::ranges::any_of(around_, [&](Dart d) { return changing_.contains(d.value); }))
        return true;
      for (Dart d : around_) changing_.insert(d.value);
      moved_.insert(moved_.end(), around_.begin(), around_.end());
      return false;
    });
    return !halves.empty();
  }

  // Whether a crack ends at most two edges away from the vertex.
  bool is_beside_tip(const Edit& edit, const EmbeddedMap& map, std::span<const Dart> darts) {
    const auto ends_at = [&](Dart d, std::vector<Dart>& around) {
      around = darts_of(edit.map(), Vertex, edit.map().alpha(0, d));
      return !touched_.any_of(*edit.journal(), around) && is_tip(map, around);
    };
    std::vector<Dart> first, second;
    return std::ranges::any_of(darts, [&](Dart d) {
      return ends_at(d, first) || std::ranges::any_of(first, [&](Dart e) { return ends_at(e, second); });
    });
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

  EdgeDivision division_;
  const char* over_budget_ = nullptr; // why the map may not grow further
  const Column<StartTriangle>* start_;
  bool compression_;
  bool rigid_ = false; // no vertex moves: there are springs, whose strain is no value of the matter
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
          .prepare = add_start_triangles,
          .of_law = of_law,
          .lacking = lacking};
}

} // namespace rend
