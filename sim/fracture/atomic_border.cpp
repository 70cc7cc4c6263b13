// The atomic criterion on edges and faces (thesis 7.4): |(f_1 − f_2)·n|, with f_i the force that element i applies to the
// shared vertices. |f_1 − f_2| bounds it.
#include "sim/base/simd.h"
#include "sim/fracture/border.h"
#include "sim/fracture/criterion.h"

#include <cmath>

namespace rend {
namespace {

class AtomicBorder final : public Criterion {
public:
  explicit AtomicBorder(EmbeddedMap& map) : borders_(map, Borders::Carry::Corners) {}

  void find(const ForceView& view, double threshold, std::vector<Candidate>& candidates) override {
    if (borders_.of_sheet())
      look<2>(view, threshold, candidates);
    else
      look<0>(view, threshold, candidates);
  }

  void rebind(const Changes& changes) override { borders_.rebind(changes); }
  void reserve_for_separations() override { borders_.reserve_for_separations(); }
  std::size_t bytes() const override { return borders_.bytes(); }

private:
  // Vertices: of each border, if known.
  template <std::size_t Vertices>
  void look(const ForceView& view, double threshold, std::vector<Candidate>& candidates) const {
    const PackedRows& rows = borders_.rows();
    const double square = threshold * threshold;
    rows.for_each([&](std::size_t key, std::size_t row) {
      const std::size_t vertices = Vertices > 0 ? Vertices : borders_.vertices(key);
      Double4 f1{}, f2{};
      for (std::size_t k = 0; k < vertices; ++k) {
        f1 += load(view.corner[rows.index(static_cast<int>(2 * k))[row]]);
        f2 += load(view.corner[rows.index(static_cast<int>(2 * k + 1))[row]]);
      }
      const Double4 f = f1 - f2, ff = f * f;
      if (ff[0] + ff[1] + ff[2] <= square) return;
      const Dart d = borders_.dart(key);
      const double value = std::abs(Vec3(f[0], f[1], f[2]).dot(across_border(view.map, view.position, d)));
      if (value > threshold) candidates.push_back({value, d});
    });
  }

  Borders borders_;
};

} // namespace

CriterionType atomic_border() {
  return {"atomic-border",
          "|difference of the forces that the two elements apply, across the border|",
          "N",
          true,
          [](const CriterionRequest&) { return Cell::Borders; },
          [](const CriterionRequest& request) { return lacking_for_borders(request.map); },
          [](const CriterionRequest& request) -> std::unique_ptr<Criterion> {
            return std::make_unique<AtomicBorder>(request.map);
          }};
}

} // namespace rend
