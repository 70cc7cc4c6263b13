// The atomic criterion on vertices (thesis 7.4.1): the largest single force on the vertex, of a spring or
// hinge, or of a continuum element on its corner there, with the plane normal to that force.
//
// The tensors of a mass-tensor body are no physical forces (a translated body has them, though their sum is 0),
// so its linear elements are used. The kernel determines which elements exceed the threshold, and only those
// are evaluated one by one.
#include "sim/fracture/single_springs.h"
#include "sim/rows/continuum.h"
#include "sim/rows/kernels.h"

#include <algorithm>

namespace rend {
namespace {

class AtomicVertex final : public Criterion {
public:
  explicit AtomicVertex(const CriterionRequest& request)
      : springs_(request), continuum_(request.map, request.interactions) {
    const Orbit corner = corner_orbit(request.map.dimension());
    request.map.use(corner);
    for (const Continuum::Part& part : continuum_.parts()) {
      rows_.push_back(Binder::of(request.map, *part.interaction, Folding::Off, corner));
      rows_.back().bind();
    }
  }

  void find(const ForceView& view, double threshold, std::vector<Candidate>& candidates) override {
    largest_.clear();
    const auto look = [&](const CurrentUnit& unit) {
      auto force = unit.forces();
      gather_at_corners(view, unit, force);
      for (std::size_t n = 0; n < static_cast<std::size_t>(unit.particles); ++n) {
        const double value = force[n].norm();
        if (value > threshold) keep(view.map, unit.vertex[n], value, force[n], candidates);
      }
    };
    springs_.each_above(view, threshold, look);
    for (std::size_t n = 0; n < rows_.size(); ++n)
      each_above(view, n, threshold, [&](Dart d) {
        continuum_.each_of(d, view.position, view.velocity, [&](const auto& part, const CurrentUnit& element) {
          if (&part == &continuum_.parts()[n]) look(element);
        });
      });
  }

  void rebind(const Changes& changes) override {
    for (Binder& binder : rows_) binder.rebind(changes);
  }
  void reserve_for_separations() override {
    for (Binder& binder : rows_) binder.reserve_for_separations();
  }
  std::size_t bytes() const override {
    std::size_t sum = corner_.capacity() * sizeof(Record);
    for (const Binder& binder : rows_) sum += binder.rows().bytes();
    return sum;
  }

private:
  // On a triangle, a hinge acts twice on the same outer vertex.
  static void gather_at_corners(const ForceView& view, const CurrentUnit& unit,
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

  // Calls f(smallest dart) for the elements of a part with a force above the threshold, up to rounding.
  template <class F> void each_above(const ForceView& view, std::size_t part, double threshold, F&& f) {
    const Binder& binder = rows_[part];
    const ForceLaw& law = *continuum_.parts()[part].law;
    const PackedRows& rows = binder.rows();
    corner_.assign(view.map.cells(view.mass.orbit()).slots(), Record());
    kernel_of(law).corner_forces({.law = law,
                                  .rows = rows,
                                  .position = view.position,
                                  .velocity = view.velocity,
                                  .rest = view.map.rest().values().data(),
                                  .force = corner_.data(),
                                  .low = 0,
                                  .high = static_cast<std::uint32_t>(view.map.cells(Vertex).slots()),
                                  .first = 0,
                                  .last = rows.blocks(),
                                  .damped = binder.interaction()->damped});
    const int corners = law.particles();
    const double square = threshold * threshold * (1 - 1e-9);
    rows.for_each([&](std::size_t key, std::size_t row) {
      double most = 0;
      for (int n = 0; n < corners; ++n) {
        const Record& g = corner_[rows.index(corners + n)[row]];
        most = std::max(most, g.x * g.x + g.y * g.y + g.z * g.z);
      }
      if (most > square) f(view.map.cells(binder.pattern().owner).first_dart(binder.owner_of(key)));
    });
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
  std::vector<Binder> rows_;   // one per part, with corners
  std::vector<Record> corner_; // [N], one per corner slot: of one part
  IndexMap largest_;           // vertex slot → index of the candidate
};

} // namespace

CriterionType atomic_vertex() {
  return {.name = "atomic-vertex",
          .what = "the largest single force that a spring or an element applies to the vertex; splits along "
                  "the plane across it",
          .unit = "N",
          .cell = [](std::string_view) { return Cell::Vertices; },
          .lacking = [](const CriterionRequest&) { return std::string(); },
          .make = [](const CriterionRequest& request) -> std::unique_ptr<Criterion> {
            CriterionRequest any = request;
            any.kind.clear();
            return std::make_unique<AtomicVertex>(any);
          }};
}

} // namespace rend
