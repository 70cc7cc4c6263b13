// Cuts in sheets of triangles. The plane through the vertex v with normal n crosses the edge bc opposite to v,
// of each element at it, at
//
//   m = (1 − t) b + t c,   t = s_b / (s_b − s_c),   s = (x − v)·n,   if s_b and s_c have different signs
//
// That edge is divided at m (divide-edge-of-triangles), and the two elements on either side of v m are
// separated. Where m comes too close to b or c, see triangle_cut.h.
//
// Inside the matter both halves of the plane are cut. At a vertex on the border, the tip of a crack among them,
// the half that leads furthest away from the border's two edges: so a crack does not turn back along its wake.
// Where the place says what is ahead, the half that leads closest to that.
//
// A crack goes on from its tip: a vertex at most two edges away from where one ends is not cut itself. So no
// bridges are left ahead of a crack, and its flanks do not fray.
#include "sim/base/check.h"
#include "sim/cuts/cutter.h"
#include "sim/cuts/triangle_cut.h"
#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {
namespace {

constexpr double most_along_border = 0.866; // cos 30°: a cut this close to the border runs along it

// One half of the plane.
struct Half {
  CutWay way;
  Vec3 direction; // in which the crack runs, a unit vector
};

// What the plane meets at one vertex, in the state before the edit.
class Crossing {
public:
  Crossing(const CutPlace& place, const CutState& state)
      : place_(place), map_(place.map.map()), cut_(state), darts_(place.darts), normal_(place.normal),
        here_(at(darts_.front())) {}

  // Those to be cut.
  std::vector<Half> halves() const {
    std::vector<Half> all;
    for (Dart d : darts_)
      if (d < map_.alpha(1, d)) add_half(d, all);
    const std::vector<Vec3> border = border_edges();
    if (border.empty() || all.empty()) return all;
    if (!place_.ahead.isZero(0))
      return {*std::ranges::max_element(all, {},
                                        [&](const Half& half) { return half.direction.dot(place_.ahead); })};
    const auto along = [&](const Half& half) {
      double most = -1;
      for (const Vec3& edge : border) most = std::max(most, edge.dot(half.direction));
      return most;
    };
    const Half best = *std::ranges::min_element(all, {}, along);
    return along(best) < most_along_border ? std::vector{best} : std::vector<Half>{};
  }

private:
  Vec3 at(Dart d) const { return place_.position[place_.map.vertex(d)].vec(); }
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

  const CutPlace& place_;
  const GMap& map_;
  TriangleCut cut_;
  std::span<const Dart> darts_; // of the vertex
  Vec3 normal_;
  Vec3 here_;
};

class SheetCutter final : public Cutter {
public:
  explicit SheetCutter(const EmbeddedMap& map) : start_(find_start_elements(map)) { CHECK(start_); }
  RuleRunner& runner() override { return division_.runner(); }

  // At the vertex, and beyond the edges opposite to it.
  std::span<const Dart> around(const GMap& map, std::span<const Dart> darts) override {
    star_.clear();
    for (Dart d : darts) {
      if (d > map.alpha(1, d)) continue;
      collect(map, Face, d, star_);
      const Dart across = map.alpha(1, map.alpha(0, d));
      if (!map.is_free(2, across)) collect(map, Face, map.alpha(2, across), star_);
    }
    return star_;
  }

  const char* cut(Edit& edit, const CutPlace& place, TouchedDarts& touched) override {
    if (const char* why = wait_for_tip(edit, place, touched)) return why;
    std::vector<Half> halves = Crossing(place, state_at(place, *start_)).halves();
    if (halves.empty()) return CutRefusal::nothing_crosses;
    if (!settle_moves(edit, halves, touched)) return CutRefusal::waits;
    const Edit::Savepoint before = edit.savepoint();
    std::vector<Dart> edges;
    for (const auto& [way, direction] : halves) {
      edges.push_back(way.share > 0 ? division_.divided(edit, way.across, way.share) : way.edge);
      if (edges.back() != Dart{}) continue;
      edit.rollback(before);
      return CutRefusal::divides_none;
    }
    for (std::size_t n = 0; n < halves.size(); ++n) {
      if (halves[n].way.moved) edit.move(edit.map().alpha(0, edges[n]), *halves[n].way.moved);
      unsew(edit, 2, edges[n]);
    }
    touched.add(moved_);
    return nullptr;
  }

private:
  // Why the vertex is not cut if a crack ends at most two edges away, or another cut of the step came as close.
  static const char* wait_for_tip(const Edit& edit, const CutPlace& place, TouchedDarts& touched) {
    if (is_tip(place.map, place.darts)) return nullptr;
    const GMap& map = edit.map();
    std::vector<Dart> around, first, second;
    for (Dart d : place.darts) around.push_back(map.alpha(0, d));
    const auto look = [&](std::span<const Dart> ends, std::vector<Dart>& further) -> const char* {
      for (Dart d : ends) {
        if (map.alpha(2, d) < d) continue; // the same edge
        further = darts_of(map, Vertex, d);
        if (touched.any_of(*edit.journal(), further)) return CutRefusal::waits;
        if (is_tip(place.map, further)) return CutRefusal::beside_tip;
      }
      return nullptr;
    };
    if (const char* why = look(around, first)) return why;
    for (Dart d : around) {
      first = darts_of(map, Vertex, d);
      for (Dart& e : first) e = map.alpha(0, e);
      if (const char* why = look(first, second)) return why;
    }
    return nullptr;
  }

  // A vertex moves only if no element around it changes otherwise: the half waits. False: so does the vertex.
  bool settle_moves(const Edit& edit, std::vector<Half>& halves, TouchedDarts& touched) {
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
      if (touched.any_of(*edit.journal(), around_) ||
          std::ranges::any_of(around_, [&](Dart d) { return changing_.contains(d.value); }))
        return true;
      for (Dart d : around_) changing_.insert(d.value);
      moved_.insert(moved_.end(), around_.begin(), around_.end());
      return false;
    });
    return !halves.empty();
  }

  EdgeDivision division_;
  const Column<StartElement>* start_;
  IndexSet changing_;                // scratch: darts of the elements that a cut divides, or moves a corner of
  std::vector<Dart> around_, moved_; // scratch: darts of elements at one vertex that moves, at all of them
  std::vector<Dart> star_;           // scratch
};

} // namespace

std::unique_ptr<Cutter> sheet_cutter(const EmbeddedMap& map) {
  return std::make_unique<SheetCutter>(map);
}

} // namespace rend
