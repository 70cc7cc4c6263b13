// Cuts in solids of tetrahedra. The surface in which the vertex v is cut (cut_surface.h) crosses edges between
// other vertices of its elements: these are divided there with all tetrahedra around them, also those beyond
// (divide-edge-of-tetrahedra), or one of their ends comes to lie on the surface (tetrahedron_cut.h). So each
// tetrahedron at v has its other vertices on one side, and those that lie on the surface: one with all three of
// them there is on the side of its centre. Every face at v between tetrahedra on different sides is separated.
#include "sim/base/check.h"
#include "sim/cuts/cutter.h"
#include "sim/cuts/tetrahedron_cut.h"
#include "sim/house_rules/house_rules.h"
#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {
namespace {

// On which sides the tetrahedra at a vertex are, once edges are divided.
class StarSides {
public:
  StarSides(const Edit& edit, const CutPlace& place, const CutSurface& surface, const TetrahedronCutPlan& plan)
      : edit_(edit), map_(edit.map()), place_(place), surface_(surface), plan_(plan),
        darts_(darts_of(map_, Vertex, place.darts.front())) {
    for (Dart d : darts_) {
      if (side_.find(d.value) != IndexMap::none) continue;
      corner_.clear();
      collect(map_, VertexOfVolume, d, corner_);
      const std::uint32_t side = above(corner_) ? 1 : 0;
      for (Dart e : corner_) side_.assign(e.value, side);
    }
  }

  // A dart of each face between different sides, or two.
  std::vector<Dart> faces_between() const {
    std::vector<Dart> faces;
    for (Dart d : darts_)
      if (!map_.is_free(3, d) && side_.find(d.value) != side_.find(map_.alpha(3, d).value)) faces.push_back(d);
    return faces;
  }

private:
  struct End {
    int side;
    Vec3 position; // [m]
  };

  bool above(std::span<const Dart> corner) const {
    int sides = 0;
    Vec3 sum = Vec3::Zero();
    for (Dart d : corner) { // two at each edge
      const End end = other_end(d);
      sides += end.side;
      sum += end.position / 6;
    }
    return sides != 0 ? sides > 0 : surface_.height(sum) > 0;
  }

  // Old edges keep darts from before, new ones lead to vertices on the surface.
  End other_end(Dart d) const {
    const Dart there = map_.alpha(0, d);
    std::optional<Dart> old;
    walk_two(map_, 2, 3, there, [&](Dart e) {
      if (!old && !edit_.is_new(e)) old = e;
    });
    if (!old) return {0, edit_.point(there).position};
    const Slot slot = place_.map.vertex(*old);
    return {plan_.side_of(slot), place_.position[slot].vec()};
  }

  const Edit& edit_;
  const GMap& map_;
  const CutPlace& place_;
  const CutSurface& surface_;
  const TetrahedronCutPlan& plan_;
  std::vector<Dart> darts_, corner_;
  IndexMap side_; // dart → 1: its tetrahedron is above the surface, 0: below
};

class SolidCutter final : public Cutter {
public:
  explicit SolidCutter(const EmbeddedMap& map)
      : start_(find_start_elements(map)), division_(rule("divide-edge-of-tetrahedra")) {
    CHECK(start_);
  }
  RuleRunner& runner() override { return division_; }

  // At the vertex, and around the edges opposite to it.
  std::span<const Dart> around(const GMap& map, std::span<const Dart> darts) override {
    around_.assign(darts.begin(), darts.end());
    for (Dart d : darts) {
      const Dart across = map.alpha(1, map.alpha(0, d));
      if (across < map.alpha(0, across)) collect(map, Edge, across, around_);
    }
    return around_;
  }

  const char* cut(Edit& edit, const CutPlace& place, TouchedDarts& touched) override {
    const CutSurface surface(place.map, place.position, place.darts.front(), CrackFront(place.map, place.darts),
                             place.normal);
    if (!surface.understood()) return CutRefusal::fronts_meet;
    if (surface.along_border()) return CutRefusal::nothing_crosses;
    const auto changed = [&](std::span<const Dart> some) { return touched.any_of(*edit.journal(), some); };
    const auto plan = TetrahedronCut(state_at(place, *start_), changed, place.darts, surface).plan();
    if (!plan) return CutRefusal::no_room;
    const Edit::Savepoint before = edit.savepoint();
    const char* why = divide(edit, plan->divisions) ? nullptr : CutRefusal::divides_none;
    std::vector<Dart> faces;
    if (!why) faces = StarSides(edit, place, surface, *plan).faces_between();
    if (!why && faces.empty()) why = CutRefusal::nothing_crosses;
    if (why) {
      edit.rollback(before);
      return why;
    }
    for (const auto& [dart, to] : plan->moves) move(edit, dart, to, touched);
    for (Dart d : faces)
      if (!edit.map().is_free(3, d)) unsew(edit, 3, d);
    return nullptr;
  }

private:
  bool divide(Edit& edit, std::span<const TetrahedronCutPlan::Division> divisions) {
    return std::ranges::all_of(divisions, [&](const auto& each) {
      division_.context().wheres = {scalar_value(each.share)};
      return division_.apply(edit, each.across);
    });
  }

  // Also what will have been separated of it.
  void move(Edit& edit, Dart vertex, const Point& to, TouchedDarts& touched) {
    for (Dart d : darts_of(edit.map(), Vertex, vertex))
      if (d == smallest_dart(edit.map(), VertexOfVolume, d)) edit.move(d, to);
    note_elements(edit.map(), vertex, touched);
  }

  // All that have a corner at the vertex of d.
  void note_elements(const GMap& map, Dart d, TouchedDarts& touched) {
    for (Dart e : darts_of(map, Vertex, d)) {
      around_.clear();
      collect(map, Volume, e, around_);
      touched.add(around_);
    }
  }

  const Column<StartElement>* start_;
  RuleRunner division_;
  std::vector<Dart> around_; // scratch
};

} // namespace

std::unique_ptr<Cutter> solid_cutter(const EmbeddedMap& map) {
  return std::make_unique<SolidCutter>(map);
}

} // namespace rend
