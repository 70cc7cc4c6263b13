// The atomic criterion on edges (thesis 7.3): |(f_1 − f_2)·n|, with f_i the force that element i applies to the two
// shared vertices. |f_1 − f_2| bounds it.
#include "sim/base/simd.h"
#include "sim/fracture/border.h"
#include "sim/fracture/criterion.h"

#include <cmath>

namespace rend {
namespace {

class AtomicBorder final : public Criterion {
public:
  explicit AtomicBorder(EmbeddedMap& map) : borders_(bind_borders(map, true)) {}

  void find(const ForceView& view, double threshold, std::vector<Candidate>& candidates) override {
    const PackedRows& rows = borders_.rows();
    const std::uint32_t *a1 = rows.index(2), *b1 = rows.index(3), *a2 = rows.index(4), *b2 = rows.index(5);
    const double square = threshold * threshold;
    rows.for_each([&](std::size_t key, std::size_t row) {
      const Double4 f = (load(view.corner[a1[row]]) + load(view.corner[b1[row]])) -
                        (load(view.corner[a2[row]]) + load(view.corner[b2[row]]));
      const Double4 ff = f * f;
      if (ff[0] + ff[1] + ff[2] <= square) return;
      const Vec3 difference(f[0], f[1], f[2]);
      const Dart d = view.map.cells(EdgeOfVolume).first_dart(borders_.owner_of(key));
      const double value = std::abs(difference.dot(across_border(view.map, view.position, d)));
      if (value > threshold) candidates.push_back({value, d});
    });
  }

  void rebind(const Changes& changes) override { borders_.rebind(changes); }
  void reserve_for_separations() override { borders_.reserve_for_separations(); }
  std::size_t bytes() const override { return borders_.rows().bytes(); }

private:
  Binder borders_;
};

} // namespace

CriterionType atomic_border() {
  return {"atomic-border",
          "|difference of the forces that the two elements apply, across the border|",
          "N",
          true,
          [](const CriterionRequest&) { return Cell::Borders; },
          [](const CriterionRequest&) { return std::string(); },
          [](const CriterionRequest& request) -> std::unique_ptr<Criterion> {
            return std::make_unique<AtomicBorder>(request.map);
          }};
}

} // namespace rend
