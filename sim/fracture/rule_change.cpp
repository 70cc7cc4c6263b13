#include "sim/fracture/rule_change.h"

#include "sim/base/archive.h"
#include "sim/base/check.h"
#include "sim/fracture/element_scan.h"
#include "sim/fracture/law_quantities.h"
#include "sim/fracture/made_elements.h"
#include "sim/rules/script_run.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

bool holds(Orbit hook, std::initializer_list<int> links) {
  return std::all_of(links.begin(), links.end(), [&](int i) { return hook.has(i); });
}

// The hook stands for a whole component of a body of that dimension.
bool is_component(Orbit hook, int dimension) {
  return holds(hook, {0, 1, 2}) && (dimension == 2 || hook.has(3));
}

// The cell that a hook's orbit is a part of, α of the body's dimension aside. A hook that is a single dart
// belongs to an element, whose darts are tried one after another; a whole component is changed by any of its
// elements.
Cell cell_of(Orbit hook, int dimension) {
  if (is_component(hook, dimension)) return Cell::Elements;
  if (dimension == 2) {
    if (holds(hook, {1, 2})) return Cell::Vertices;
    if (holds(hook, {0, 1})) return Cell::Elements;
    if (hook.has(0)) return Cell::Borders;
    return hook.has(1) || hook.has(2) ? Cell::Vertices : Cell::Elements;
  }
  if (holds(hook, {0, 1, 2})) return Cell::Elements;
  if (holds(hook, {0, 1})) return Cell::Borders;
  if (hook.has(0)) return Cell::Edges;
  return hook.has(1) ? Cell::Vertices : Cell::Elements;
}

// A rule or a script of one law.
class ByRule final : public ChangeMemory {
public:
  ByRule(const RuleOrScript& what, int dimension, const CriterionRequest* request, const MapBudget& budget)
      : what_(what), runner_(what_), budget_(budget), elements_(what_, dimension, request) {
    if (request && asks_for_tensors(what)) quantities_.emplace(*request);
    if (!quantities_) quantities_.emplace();
  }

  bool apply(Edit& edit, const FoundPlace& found, std::span<const Dart> darts) {
    tried_ = true;
    const bool whole = is_component(what_.hook_orbit(), edit.map().dimension());
    if (whole && changed_components_.contains(darts.front().value)) return false;
    const bool made = apply_at(edit, found, darts);
    if (made && whole) note_component(edit, darts);
    return made;
  }

  void begin(const ForceView& view) override {
    quantities_->begin(view);
    most_darts_ = most_darts(view.map, budget_);
    elements_.begin();
    changed_components_.clear();
  }
  void settle_candidate(bool made, const char* otherwise) override {
    if (!made && furthest_.stage > 0) count(furthest_.reason);
    if (!made && !tried_) count(otherwise);
    furthest_ = {};
    tried_ = false;
  }
  const Refusals& refusals() const override { return refusals_; }
  void store(Archive& archive) override {
    archive.table(refusals_, most_reasons + 1, "a rule was refused for more reasons than there are");
  }
  void make_anew(const CriterionRequest& request) override {
    if (asks_for_tensors(what_)) quantities_.emplace(request);
  }
  void rebind(const Changes& changes) override { quantities_->rebind(changes); }
  void reserve_for_separations() override { quantities_->reserve_for_separations(); }
  std::size_t bytes() const override { return quantities_->bytes(); }

  static bool asks_for_tensors(const RuleOrScript& what) {
    const std::vector<std::string> names = what.quantities_of_law();
    return std::any_of(names.begin(), names.end(),
                       [](const std::string& name) { return name == "stress" || name == "strain"; });
  }

private:
  bool apply_at(Edit& edit, const FoundPlace& found, std::span<const Dart> darts) {
    quantities_->across = found.normal;
    quantities_->value = found.value;
    quantities_->before_change(edit);
    runner_.context() = {{}, &*quantities_, {}, most_darts_};
    darts_.assign(darts.begin(), darts.end());
    std::sort(darts_.begin(), darts_.end());
    if (elements_.unchanged()) return runner_.apply_at_first(edit, darts_, &furthest_);
    return runner_.apply_at_first(edit, darts_, &furthest_, [&] { return elements_.fault(edit, runner_); });
  }

  // A rule of a whole component is applied once a step, however many of its elements exceed the threshold.
  void note_component(const Edit& edit, std::span<const Dart> darts) {
    for (Dart d : darts) {
      if (!edit.map().alive(d) || changed_components_.contains(d.value)) continue;
      for (Dart e : darts_of(edit.map(), Component, d)) changed_components_.insert(e.value);
    }
  }

  void count(const std::string& reason) {
    const bool known = refusals_.size() < most_reasons || refusals_.contains(reason);
    ++refusals_[known ? reason : "other reasons"];
  }

  static constexpr std::size_t most_reasons = 20;
  RuleOrScript what_;
  RuleOrScriptRunner runner_;
  MapBudget budget_;
  std::size_t most_darts_ = budget_.darts; // of the body as it is
  std::optional<LawQuantities> quantities_;
  MadeElements elements_;
  IndexSet changed_components_; // darts of those that this step has changed already
  std::vector<Dart> darts_;     // scratch
  Refusal furthest_;            // at the places of one candidate
  bool tried_ = false;          // at a place of it
  Refusals refusals_;
};

} // namespace

std::string misfit_of(const RuleOrScript& what, int dimension) {
  if (what.hooks() != 1)
    return fmt::format("has {} hooks, but a <tear> finds the darts of one only", what.hooks());
  if (dimension == 2 && !what.fits_sheets())
    return "changes what lies between volumes, but this body is a sheet";
  return {};
}

std::string misfit_of(const RuleOrScript& what, const CriterionRequest& request) {
  if (std::string misfit = misfit_of(what, request.map.dimension()); !misfit.empty()) return misfit;
  if (ByRule::asks_for_tensors(what) && !lacking_for_stress(request).empty())
    return "asks for stress or strain, but this body has no <elasticity>";
  return {};
}

std::shared_ptr<const ChangeType> change_by(const RuleOrScript& what, int dimension,
                                            const CriterionRequest* request, const MapBudget& budget) {
  CHECK_NOTE((request ? misfit_of(what, *request) : misfit_of(what, dimension)).empty(), what.name());
  auto change = std::make_shared<ChangeType>();
  change->name = what.name();
  change->what = what.about();
  change->cell = cell_of(what.hook_orbit(), dimension);
  change->grows = what.grows();
  const auto by_rule = std::make_shared<ByRule>(what, dimension, request, budget);
  change->apply = [by_rule](Edit& edit, const ForceView&, const FoundPlace& found,
                            std::span<const Dart> darts) { return by_rule->apply(edit, found, darts); };
  change->memory = by_rule;
  return change;
}

} // namespace rend
