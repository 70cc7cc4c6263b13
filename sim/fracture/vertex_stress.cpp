// The criterion of stress at vertices (thesis 7.2; Koschier et al. 2014): the largest eigenvalue of the
// mass-weighted average of its elements' σ, with the plane normal to its eigenvector. With a grain (grain.h) it
// is the largest stress over strength, and its plane.
//
// λmax of an average is at most the largest λmax of its terms: only vertices of elements that exceed the
// threshold themselves are evaluated; with a grain, the threshold times the least strength.
#include "sim/fracture/element_scan.h"
#include "sim/topology/walk.h"

#include <optional>

namespace rend {
namespace {

class VertexStressCriterion final : public Criterion {
public:
  explicit VertexStressCriterion(const CriterionRequest& request)
      : scan_(request, ElementScan::Quantity::Stress), compression_{request.compression},
        stress_(request.map, scan_.continuum(), request.mass), grain_(Grain::of(request.grain)) {}

  void find(const ForceView& view, double threshold, std::vector<Candidate>& candidates) override {
    stress_.clear();
    seen_.clear();
    const CellIndex& vertices = view.map.cells(Vertex);
    scan_.each_above(view, grain_ ? threshold * grain_->ratio() : threshold, [&](Dart element) {
      scan_.continuum().each_of(element, view.position, nullptr, [&](const auto&, const CurrentUnit& now) {
        for (std::size_t n = 0; n < static_cast<std::size_t>(now.particles); ++n) {
          if (!seen_.insert(now.vertex[n])) continue;
          const Dart d = vertices.first_dart(now.vertex[n]);
          const auto [value, direction] = largest(view, d, stress_.at(now.vertex[n], view.position), threshold);
          if (value > threshold) candidates.push_back({value, d, direction});
        }
      });
    });
  }

  void rebind(const Changes& changes) override { scan_.rebind(changes); }
  void reserve_for_separations() override { scan_.reserve_for_separations(); }
  std::size_t bytes() const override { return scan_.bytes() + stress_.bytes(); }

private:
  // Where it is below the threshold, it may be less exact.
  Principal largest(const ForceView& view, Dart vertex, const Eigen::Matrix3d& stress, double threshold) {
    const Principal plain = largest_principal(stress, compression_);
    if (!grain_ || plain.value <= threshold * grain_->ratio()) return plain;
    darts_.clear();
    collect(view.map.map(), Vertex, vertex, darts_);
    const Grain::Plane plane = grain_->weakest(stress, view.map, view.position, darts_);
    return {plane.value, plane.normal};
  }

  ElementScan scan_;
  Compression compression_;
  VertexStress stress_;
  std::optional<Grain> grain_;
  IndexSet seen_;           // vertex slots
  std::vector<Dart> darts_; // scratch: of one vertex
};

} // namespace

CriterionType vertex_stress_criterion() {
  return {.name = "vertex-stress",
          .what = "the largest principal value of the mean stress of the elements at the vertex; splits along "
                  "the plane across it",
          .unit = "Pa",
          .cell = [](std::string_view) { return Cell::Vertices; },
          .lacking = [](const CriterionRequest& request) { return lacking_for_stress(request); },
          .make = [](const CriterionRequest& request) -> std::unique_ptr<Criterion> {
            return std::make_unique<VertexStressCriterion>(request);
          },
          .takes_compression = true,
          .takes_grain = true};
}

} // namespace rend
