// Cut: a crack that is free of the mesh (O'Brien & Hodgins 1999; Pfaff et al. 2014). The elements at a vertex
// are divided where a plane through it crosses them, and separated there: triangles of sheets
// (sheet_cutter.cpp), tetrahedra of solids (solid_cutter.cpp). A division displaces no matter: in linear
// elements neither strain nor elastic energy changes.
//
// The plane is that of crack_plane.h, whatever the criterion; where nothing pulls, that of the criterion. At
// the tip of a crack in a sheet that is torn out of its plane it is that of tearing_mode.h.
//
// Vertices near the plane move onto it, so that there are no slivers; not in a body with springs (other than
// those that bend at edges): their strain differs from edge to edge, so that a vertex that moves would strain
// them.
//
// A vertex at whose elements something changed in this step waits for the next one: the plane that its
// criterion found belongs to elements that are not there any more. So does one beside such elements.
#include "sim/base/archive.h"
#include "sim/cuts/cutter.h"
#include "sim/cuts/triangle_cut.h"
#include "sim/fracture/change.h"
#include "sim/fracture/crack_plane.h"
#include "sim/fracture/element_scan.h"
#include "sim/fracture/tearing_mode.h"
#include "sim/mechanics/hinge_law.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <optional>

namespace rend {
namespace {

constexpr std::size_t most_elements = 4; // times as many as at the start

bool has_simplices_alone(const EmbeddedMap& map) {
  bool alone = true;
  map.map().for_each_dart([&](Dart d) {
    const auto place = element_at(map.map(), d);
    alone = alone && place && (place->kind == ElementKind::Triangle || place->kind == ElementKind::Tetrahedron);
  });
  return alone;
}

std::unique_ptr<Cutter> cutter_of(const EmbeddedMap& map) {
  return map.dimension() == 2 ? sheet_cutter(map) : solid_cutter(map);
}

// Of one law.
class Cuts final : public ChangeMemory {
public:
  explicit Cuts(const CriterionRequest& request)
      : cutter_(cutter_of(request.map)), compression_(request.compression) {
    make_anew(request);
    cutter_->leave(request.least_part);
    const std::size_t darts = most_elements * request.map.map().dart_count();
    std::size_t& most = cutter_->runner().context().most_darts;
    most = std::min(darts, most_darts(request.map));
    over_budget_ = darts <= most ? CutRefusal::full : beyond_budget;
  }

  bool apply(Edit& edit, const ForceView& view, const FoundPlace& found, std::span<const Dart> darts) {
    why_ = touched_.any_of(*edit.journal(), cutter_->around(edit.map(), darts))
               ? CutRefusal::waits
               : cutter_->cut(edit, place(view, found, darts), touched_);
    if (why_ == CutRefusal::divides_none && cutter_->runner().over_budget()) why_ = over_budget_;
    return !why_;
  }

  void begin(const ForceView&) override { touched_.clear(); }
  void settle_candidate(bool made, const char* otherwise) override {
    if (!made) ++refusals_[why_ ? why_ : otherwise];
    why_ = nullptr;
  }
  const Refusals& refusals() const override { return refusals_; }
  void store(Archive& archive) override {
    archive.table(refusals_, 9, "a cut was refused for more reasons than there are");
  }
  void make_anew(const CriterionRequest& request) override {
    plane_.emplace(request);
    if (request.map.dimension() == 2) tearing_.emplace(request);
    const int corners = request.map.dimension() + 1;
    cutter_->let_move(std::ranges::all_of(request.interactions, [&](const auto& each) {
      const bool simplices =
          each->law->particles() == corners && dynamic_cast<const ElementLaw*>(each->law.get());
      return simplices || each->law == hinge_law();
    }));
  }
  void rebind(const Changes&) override {}
  void reserve_for_separations() override {}
  std::size_t bytes() const override { return 0; }

private:
  CutPlace place(const ForceView& view, const FoundPlace& found, std::span<const Dart> darts) {
    CutPlace place{view.map, view.position, view.velocity, view.held, darts};
    const bool tip = tearing_ && !compression_ && is_tip(view.map, darts);
    if (const auto torn = tip ? tearing_->at(view, darts) : std::nullopt) {
      place.normal = torn->normal;
      place.ahead = torn->ahead;
    } else {
      place.normal = plane_at(view, found, darts);
    }
    return place;
  }
  // A law that breaks under compression asks for the plane across that.
  Vec3 plane_at(const ForceView& view, const FoundPlace& found, std::span<const Dart> darts) {
    const Vec3 across_tension = compression_ ? Vec3::Zero() : plane_->at(view, darts);
    return across_tension.isZero(0) ? found.normal : across_tension;
  }

  std::unique_ptr<Cutter> cutter_;
  const char* over_budget_ = nullptr; // why the map may not grow further
  bool compression_;
  std::optional<CrackPlane> plane_;
  std::optional<TearingMode> tearing_; // in sheets
  TouchedDarts touched_;
  const char* why_ = nullptr; // the last call was refused
  Refusals refusals_;
};

std::string lacking(const CriterionRequest& request) {
  if (!has_simplices_alone(request.map))
    return "goes through triangles and tetrahedra alone, and this body has other elements";
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
              "(triangles of sheets and tetrahedra of solids, with <elasticity>)",
          .cell = Cell::Vertices,
          .apply = {},
          .grows = true,
          .has_least_part = true,
          .prepare = add_start_elements,
          .of_law = of_law,
          .lacking = lacking};
}

} // namespace rend
