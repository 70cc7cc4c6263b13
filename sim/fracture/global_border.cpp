// The global criterion on edges and faces (thesis 7.5): |(Σ f_k)·n|, with f_k the sum of all internal forces on
// the k-th shared vertex.
//
// Σ |f_k| is an upper bound, which rules out most borders before a normal is computed.
#include "sim/fracture/border.h"
#include "sim/fracture/criterion.h"
#include "sim/fracture/norms.h"

#include <cmath>

namespace rend {
namespace {

class GlobalBorder final : public Criterion {
public:
  explicit GlobalBorder(EmbeddedMap& map) : borders_(map, Borders::Carry::Vertices) {}

  void find(const ForceView& view, double threshold, std::vector<Candidate>& candidates) override {
    const std::size_t vertices = view.map.cells(Vertex).slots();
    norm_.resize(vertices);
    const double largest = norms(view.force, vertices, norm_.data());
    if (borders_.of_sheet()) {
      if (2 * largest <= threshold) return; // one end of an edge must exceed half the threshold
      const std::uint32_t *a = borders_.vertex(0), *b = borders_.vertex(1);
      borders_.rows().for_each([&](std::size_t key, std::size_t row) {
        if (norm_[a[row]] + norm_[b[row]] > threshold) measure(view, key, row, threshold, candidates);
      });
    } else {
      borders_.rows().for_each([&](std::size_t key, std::size_t row) {
        double bound = 0;
        for (std::size_t k = 0; k < borders_.vertices(key); ++k) bound += norm_[borders_.vertex(k)[row]];
        if (bound > threshold) measure(view, key, row, threshold, candidates);
      });
    }
  }

  void rebind(const Changes& changes) override { borders_.rebind(changes); }
  void reserve_for_separations() override { borders_.reserve_for_separations(); }
  std::size_t bytes() const override { return borders_.bytes() + norm_.capacity() * sizeof(double); }

private:
  void measure(const ForceView& view, std::size_t key, std::size_t row, double threshold,
               std::vector<Candidate>& candidates) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < borders_.vertices(key); ++k) sum += view.force[borders_.vertex(k)[row]].vec();
    if (sum.squaredNorm() <= threshold * threshold) return;
    const Dart d = borders_.dart(key);
    const double value = std::abs(sum.dot(across_border(view.map, view.position, d)));
    if (value > threshold) candidates.push_back({value, d});
  }

  Borders borders_;
  std::vector<double> norm_; // |f| [N], one per vertex slot
};

} // namespace

CriterionType global_border() {
  return {.name = "global-border",
          .what = "|sum of the internal forces of the shared vertices, across the border|",
          .unit = "N",
          .cell = [](std::string_view) { return Cell::Borders; },
          .lacking = [](const CriterionRequest& request) { return lacking_for_borders(request.map); },
          .make = [](const CriterionRequest& request) -> std::unique_ptr<Criterion> {
            return std::make_unique<GlobalBorder>(request.map);
          }};
}

} // namespace rend
