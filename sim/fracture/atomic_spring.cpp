// The atomic criterion on springs of one kind (thesis 7.4.1): the force of each spring, for angular bending the
// moment.
//
// A stretch spring belongs to its edge, a shear spring to its element, a bending spring to the border between
// its elements: the cell is measured by the largest of its springs.
#include "sim/fracture/single_springs.h"

namespace rend {
namespace {

class AtomicSpring final : public Criterion {
public:
  explicit AtomicSpring(const CriterionRequest& request)
      : springs_(request), cell_(cell_of_kind(request.kind)) {}

  void find(const ForceView& view, double threshold, std::vector<Candidate>& candidates) override {
    const std::size_t first = candidates.size();
    springs_.each_above(view, threshold, [&](const CurrentUnit& spring) {
      const double value = force_of(spring);
      if (value > threshold) candidates.push_back({value, cell_of(view.map, cell_, spring)});
    });
    keep_largest(candidates, first);
  }

private:
  SingleSprings springs_;
  Cell cell_;
};

} // namespace

CriterionType atomic_spring() {
  return {
      .name = "atomic-spring",
      .what = "the force of each single spring of the given kind; of an angular bend, its moment [N.m]",
      .unit = "N",
      .cell = &cell_of_kind,
      .lacking = [](const CriterionRequest& request) { return lacking_for_springs(request); },
      .make = [](const CriterionRequest& request) -> std::unique_ptr<Criterion> {
        return std::make_unique<AtomicSpring>(request);
      },
      .kinds = {"stretch", "shear", "bend"},
      .unit_there = [](const CriterionRequest& request) { return std::string(turns(request) ? "N.m" : "N"); },
      .without_meaning = &springs_without_meaning};
}

} // namespace rend
