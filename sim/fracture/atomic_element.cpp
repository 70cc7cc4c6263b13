// The atomic criterion on elements of a continuum (thesis 7.1): the largest eigenvalue of σ = C B u, in world space.
#include "sim/fracture/element_scan.h"

namespace rend {
namespace {

class AtomicElement final : public Criterion {
public:
  explicit AtomicElement(const CriterionRequest& request)
      : scan_(request, ElementScan::Of::Stress), compression_(request.compression) {}

  void find(const ForceView& view, double threshold, std::vector<Candidate>& candidates) override {
    scan_.each_above(view, threshold, [&](Dart d) {
      scan_.continuum().each_of(
          d, view.position, nullptr, [&](const Continuum::Part& part, const UnitNow& now) {
            const double value = largest_principal(stress_of(part, now), compression_).value;
            if (value > threshold) candidates.push_back({value, d});
          });
    });
  }

  void rebind(const Changes& changes) override { scan_.rebind(changes); }
  void reserve_for_separations() override { scan_.reserve_for_separations(); }
  std::size_t bytes() const override { return scan_.bytes(); }

private:
  ElementScan scan_;
  bool compression_;
};

} // namespace

CriterionType atomic_element() {
  return {"atomic-element",
          "the largest principal stress of each element",
          "Pa",
          false,
          [](const CriterionRequest&) { return Cell::Elements; },
          [](const CriterionRequest& request) { return lacking_for_stress(request); },
          [](const CriterionRequest& request) -> std::unique_ptr<Criterion> {
            return std::make_unique<AtomicElement>(request);
          },
          false,
          false,
          true};
}

} // namespace rend
