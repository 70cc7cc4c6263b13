// The global criterion on edges (thesis 7.5): |(f_A + f_B)·n|, with f the sum of all internal forces on a vertex.
//
// |f_A| + |f_B| bounds it, and rules most edges out before any normal is formed.
#include "sim/fracture/border.h"
#include "sim/fracture/criterion.h"

#include <cmath>

namespace rend {
namespace {

class GlobalBorder final : public Criterion {
public:
  explicit GlobalBorder(EmbeddedMap& map) : borders_(bind_borders(map, false)) {}

  void find(const ForceView& view, double threshold, std::vector<Candidate>& candidates) override {
    const std::size_t vertices = view.map.cells(Vertex).slots();
    norm_.resize(vertices);
    bool any = false; // above half the threshold: an edge needs one end there
    for (std::size_t v = 0; v < vertices; ++v) {
      const Record& f = view.force[v];
      norm_[v] = std::sqrt(f.x * f.x + f.y * f.y + f.z * f.z);
      any = any || 2 * norm_[v] > threshold;
    }
    if (!any) return;
    const PackedRows& rows = borders_.rows();
    const std::uint32_t *a = rows.index(0), *b = rows.index(1);
    rows.for_each([&](std::size_t key, std::size_t row) {
      if (norm_[a[row]] + norm_[b[row]] <= threshold) return;
      const Dart d = view.map.cells(EdgeOfVolume).first_dart(borders_.owner_of(key));
      const Vec3 sum = view.force[a[row]].vec() + view.force[b[row]].vec();
      const double value = std::abs(sum.dot(across_border(view.map, view.position, d)));
      if (value > threshold) candidates.push_back({value, d});
    });
  }

  void rebind(const Changes& changes) override { borders_.rebind(changes); }
  std::size_t bytes() const override { return borders_.rows().bytes() + norm_.capacity() * sizeof(double); }

private:
  Binder borders_;
  std::vector<double> norm_; // |f| [N], one per vertex slot
};

} // namespace

CriterionType global_border() {
  return {"global-border", "|sum of the internal forces of the shared vertices, across the border|", "N", Cell::Borders,
          false, "separate",
          [](EmbeddedMap& map) -> std::unique_ptr<Criterion> { return std::make_unique<GlobalBorder>(map); }};
}

} // namespace rend
