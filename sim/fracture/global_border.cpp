// The global criterion on edges (thesis 7.5): |(f_A + f_B)·n|, with f the sum of all internal forces on a vertex.
//
// |f_A| + |f_B| bounds it, and rules most edges out before any normal is formed.
#include "sim/base/simd.h"
#include "sim/fracture/border.h"
#include "sim/fracture/criterion.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

// |f| of every vertex; returns the largest.
REND_CLONES double norms(const Record* force, std::size_t count, double* norm) {
  Double4 largest{};
  std::size_t v = 0;
  for (; v + 4 <= count; v += 4) {
    const Double4 a = load(force[v]), b = load(force[v + 1]), c = load(force[v + 2]), d = load(force[v + 3]);
    const Double4 n = square_root(sums_of(a * a, b * b, c * c, d * d));
    __builtin_memcpy(norm + v, &n, sizeof n);
    largest = n > largest ? n : largest;
  }
  for (; v < count; ++v) {
    const Record& f = force[v];
    norm[v] = std::sqrt(f.x * f.x + f.y * f.y + f.z * f.z);
    largest[0] = std::max(largest[0], norm[v]);
  }
  return std::max(std::max(largest[0], largest[1]), std::max(largest[2], largest[3]));
}

class GlobalBorder final : public Criterion {
public:
  explicit GlobalBorder(EmbeddedMap& map) : borders_(bind_borders(map, false)) {}

  void find(const ForceView& view, double threshold, std::vector<Candidate>& candidates) override {
    const std::size_t vertices = view.map.cells(Vertex).slots();
    norm_.resize(vertices);
    if (2 * norms(view.force, vertices, norm_.data()) <= threshold)
      return; // an edge needs one end above half of it
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
  void reserve_for_separations() override { borders_.reserve_for_separations(); }
  std::size_t bytes() const override { return borders_.rows().bytes() + norm_.capacity() * sizeof(double); }

private:
  Binder borders_;
  std::vector<double> norm_; // |f| [N], one per vertex slot
};

} // namespace

CriterionType global_border() {
  return {"global-border",
          "|sum of the internal forces of the shared vertices, across the border|",
          "N",
          false,
          [](const CriterionRequest&) { return Cell::Borders; },
          [](const CriterionRequest&) { return std::string(); },
          [](const CriterionRequest& request) -> std::unique_ptr<Criterion> {
            return std::make_unique<GlobalBorder>(request.map);
          }};
}

} // namespace rend
