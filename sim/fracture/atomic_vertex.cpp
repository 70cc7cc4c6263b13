// The atomic criterion on vertices (thesis 7.4.1): the largest single force on it, of any spring or hinge, or of an
// element of the continuum on its corner there, with the plane across that force.
//
// Tensors of a mass-tensor body are no forces of their own (a body that is moved as a whole feels them, though their sum
// is 0): its linear elements count.
#include "sim/fracture/single_springs.h"
#include "sim/program/continuum.h"

namespace rend {
namespace {

class AtomicVertex final : public Criterion {
public:
  explicit AtomicVertex(const CriterionRequest& request)
      : springs_(request), continuum_(request.map, request.interactions) {}

  void find(const ForceView& view, double threshold, std::vector<Candidate>& candidates) override {
    largest_.clear();
    const auto look = [&](const UnitNow& unit) {
      auto force = unit.forces();
      gather_at_corners(view, unit, force);
      for (std::size_t n = 0; n < static_cast<std::size_t>(unit.particles); ++n) {
        const double value = force[n].norm();
        if (value > threshold) keep(view.map, unit.vertex[n], value, force[n], candidates);
      }
    };
    springs_.each_above(view, threshold, look);
    continuum_.each(view.position, view.velocity, [&](const auto&, const UnitNow& element) { look(element); });
  }

private:
  // A hinge takes hold of a triangle's outer vertex twice.
  static void gather_at_corners(const ForceView& view, const UnitNow& unit,
                                std::array<Vec3, most_particles>& force) {
    const CellIndex& corners = view.map.cells(view.mass.orbit());
    for (std::size_t n = 1; n < static_cast<std::size_t>(unit.particles); ++n) {
      for (std::size_t m = 0; m < n; ++m) {
        if (unit.vertex[m] != unit.vertex[n] || corners.slot(unit.corner[m]) != corners.slot(unit.corner[n]))
          continue;
        force[m] += force[n];
        force[n].setZero();
        break;
      }
    }
  }

  void keep(const EmbeddedMap& map, Slot vertex, double value, const Vec3& force,
            std::vector<Candidate>& candidates) {
    const auto next = static_cast<std::uint32_t>(candidates.size());
    const std::uint32_t place = largest_.insert(vertex, next);
    if (place == next)
      candidates.push_back({value, map.cells(Vertex).first_dart(vertex), force / value});
    else if (value > candidates[place].value)
      candidates[place] = {value, candidates[place].dart, force / value};
  }

  SingleSprings springs_;
  Continuum continuum_;
  IndexMap largest_; // vertex slot → place among the candidates
};

} // namespace

CriterionType atomic_vertex() {
  return {"atomic-vertex",
          "the largest single force on the vertex, of a spring or an element; the plane across it",
          "N",
          false,
          [](const CriterionRequest&) { return Cell::Vertices; },
          [](const CriterionRequest&) { return std::string(); },
          [](const CriterionRequest& request) -> std::unique_ptr<Criterion> {
            CriterionRequest any = request;
            any.kind.clear();
            return std::make_unique<AtomicVertex>(any);
          }};
}

} // namespace rend
