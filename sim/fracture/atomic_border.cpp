// The atomic criterion on edges and faces (thesis 7.4): |(f_1 − f_2)·n|, with f_i the force that element i
// applies to the shared vertices. |f_1 − f_2| bounds it.
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
    const Record* corner = view.corner;
    if (view.corner_buffer) {
      if (!mark_suspects(view, threshold)) return;
      view.program.corner_forces_at(mark_, view.position, view.velocity, view.corner_buffer);
      corner = view.corner_buffer;
    }
    borders_.rows().for_each([&](std::size_t key, std::size_t row) {
      if (corner != view.corner && !suspect(view, key, row, threshold)) return;
      measure(view, corner, key, row, threshold, candidates);
    });
  }

  void rebind(const Changes& changes) override { borders_.rebind(changes); }
  void reserve_for_separations() override { borders_.reserve_for_separations(); }
  std::size_t bytes() const override { return borders_.bytes() + mark_.capacity(); }

private:
  // Whether the sum of the magnitudes of all single forces on its vertices, an upper bound of |f_1 − f_2|,
  // exceeds the threshold.
  bool suspect(const ForceView& view, std::size_t key, std::size_t row, double threshold) const {
    double sum = 0;
    for (std::size_t k = 0; k < borders_.vertices(key); ++k) sum += view.force[borders_.vertex(k)[row]].w;
    return !(sum * (1 + 1e-9) <= threshold);
  }

  // Marks the vertices of borders that may exceed the threshold; false: there are none.
  bool mark_suspects(const ForceView& view, double threshold) {
    const std::size_t vertices = view.map.cells(Vertex).slots();
    mark_.assign(vertices, 0);
    bool any = false;
    borders_.rows().for_each([&](std::size_t key, std::size_t row) {
      if (!suspect(view, key, row, threshold)) return;
      any = true;
      for (std::size_t k = 0; k < borders_.vertices(key); ++k) mark_[borders_.vertex(k)[row]] = 1;
    });
    return any;
  }

  void measure(const ForceView& view, const Record* corner, std::size_t key, std::size_t row, double threshold,
               std::vector<Candidate>& candidates) const {
    Double4 f1{}, f2{};
    for (std::size_t k = 0; k < borders_.vertices(key); ++k) {
      f1 += load(corner[borders_.corner(k, 0)[row]]);
      f2 += load(corner[borders_.corner(k, 1)[row]]);
    }
    const Double4 f = f1 - f2, ff = f * f;
    if (ff[0] + ff[1] + ff[2] <= threshold * threshold) return;
    const Dart d = borders_.dart(key);
    const double value = std::abs(Vec3(f[0], f[1], f[2]).dot(across_border(view.map, view.position, d)));
    if (value > threshold) candidates.push_back({value, d});
  }

  Borders borders_;
  std::vector<std::uint8_t> mark_; // one per vertex slot
};

} // namespace

CriterionType atomic_border() {
  return {.name = "atomic-border",
          .what = "|difference of the forces that the two elements apply, across the border|",
          .unit = "N",
          .elementary = true,
          .cell = [](std::string_view) { return Cell::Borders; },
          .lacking = [](const CriterionRequest& request) { return lacking_for_borders(request.map); },
          .make = [](const CriterionRequest& request) -> std::unique_ptr<Criterion> {
            return std::make_unique<AtomicBorder>(request.map);
          },
          .by_sums = true};
}

} // namespace rend
