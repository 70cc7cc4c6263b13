// The cumulative criterion on vertices (thesis 7.4.2): the norm of the sum of the internal forces, with the
// plane normal to it.
#include "sim/fracture/criterion.h"
#include "sim/fracture/norms.h"

namespace rend {
namespace {

class CumulativeVertex final : public Criterion {
public:
  void find(const ForceView& view, double threshold, std::vector<Candidate>& candidates) override {
    const CellIndex& vertices = view.map.cells(Vertex);
    norm_.resize(vertices.slots());
    if (norms(view.force, vertices.slots(), norm_.data()) <= threshold) return;
    for (Slot v = 0; v < vertices.slots(); ++v)
      if (norm_[v] > threshold)
        candidates.push_back({norm_[v], vertices.first_dart(v), view.force[v].vec() / norm_[v]});
  }

  std::size_t bytes() const override { return norm_.capacity() * sizeof(double); }

private:
  std::vector<double> norm_; // |f| [N], one per vertex slot
};

} // namespace

CriterionType cumulative_vertex() {
  return {.name = "cumulative-vertex",
          .what = "the size of the sum of the internal forces on the vertex; splits along the plane across it",
          .unit = "N",
          .cell = [](std::string_view) { return Cell::Vertices; },
          .lacking = [](const CriterionRequest&) { return std::string(); },
          .make = [](const CriterionRequest&) -> std::unique_ptr<Criterion> {
            return std::make_unique<CumulativeVertex>();
          }};
}

} // namespace rend
