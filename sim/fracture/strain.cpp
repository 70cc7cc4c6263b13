// The criterion of strain: the elongation l/l0 − 1 of each spring of one kind, on the same cells as the atomic
// criterion on springs; or, if no kind is given, the largest principal strain of each continuum element.
#include "sim/fracture/element_scan.h"
#include "sim/fracture/single_springs.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

class SpringStrain final : public Criterion {
public:
  explicit SpringStrain(const CriterionRequest& request)
      : springs_(request), cell_(cell_of_kind(request.kind)), compression_(request.compression) {}

  void find(const ForceView& view, double threshold, std::vector<Candidate>& candidates) override {
    const std::size_t first = candidates.size();
    springs_.each_longer(view, threshold, [&](const CurrentUnit& spring) {
      const double ratio = elongation_of(spring), value = compression_ ? std::abs(ratio) : ratio;
      if (value > threshold) candidates.push_back({value, cell_of(view.map, cell_, spring)});
    });
    keep_largest(candidates, first);
  }

private:
  SingleSprings springs_;
  Cell cell_;
  bool compression_;
};

std::string lacking(const CriterionRequest& request) {
  if (request.kind.empty()) {
    if (lacking_for_stress(request).empty()) return {};
    if (const std::string springs = lacking_for_springs(request); springs.starts_with("measures springs of"))
      return springs;
    return "measures springs or finite elements, but this body has neither <springs> nor <elasticity>";
  }
  if (turns(request))
    return "measures elongations, which an angular bend does not have; use atomic-spring, which measures its "
           "moment";
  return lacking_for_springs(request);
}

} // namespace

CriterionType strain() {
  return {.name = "strain",
          .what = "the relative elongation of each spring of the given kind; without a kind, the largest "
                  "principal strain of each element",
          .unit = "",
          .cell = [](std::string_view kind) { return kind.empty() ? Cell::Elements : cell_of_kind(kind); },
          .lacking = &lacking,
          .make = [](const CriterionRequest& request) -> std::unique_ptr<Criterion> {
            if (request.kind.empty()) return largest_of_elements(request, ElementScan::Quantity::Strain);
            return std::make_unique<SpringStrain>(request);
          },
          .kinds = {"", "stretch", "shear", "bend"},
          .takes_compression = true,
          .without_meaning = &springs_without_meaning};
}

} // namespace rend
