#include "sim/fracture/rule_change.h"

#include "sim/base/check.h"
#include "sim/rules/script_run.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

// The cell that a hook's orbit is a part of, α of the body's dimension aside; nullopt: a whole component. A
// hook that is a single dart belongs to an element, whose darts are tried one after another.
std::optional<Cell> cell_of(Orbit hook, int dimension) {
  const auto has = [&](std::initializer_list<int> links) {
    return std::all_of(links.begin(), links.end(), [&](int i) { return hook.has(i); });
  };
  if (dimension == 2) {
    if (has({0, 1, 2})) return std::nullopt;
    if (has({1, 2})) return Cell::Vertices;
    if (has({0, 1})) return Cell::Elements;
    if (hook.has(0)) return Cell::Borders;
    return hook.has(1) || hook.has(2) ? Cell::Vertices : Cell::Elements;
  }
  if (has({0, 1, 2})) return hook.has(3) ? std::nullopt : std::optional(Cell::Elements);
  if (has({0, 1})) return Cell::Borders;
  if (hook.has(0)) return Cell::Edges;
  return hook.has(1) ? Cell::Vertices : Cell::Elements;
}

// What a law tells: misfit_of() refuses what it cannot.
class LawQuantities final : public RuleQuantities {
public:
  double stress(Dart) const override { CHECK(false); }
  double strain(Dart) const override { CHECK(false); }
};

struct Acting {
  explicit Acting(const RuleOrScript& what_) : what(what_), runner(what) {}
  RuleOrScript what;
  RuleOrScriptRunner runner;
  LawQuantities quantities;
  std::vector<Dart> darts; // scratch
};

} // namespace

std::string misfit_of(const RuleOrScript& what, int dimension) {
  if (what.hooks() != 1)
    return fmt::format("has {} hooks, but a <tear> finds the darts of one only", what.hooks());
  if (!cell_of(what.hook_orbit(), dimension))
    return "changes a whole component, but a <tear> acts on single cells";
  if (dimension == 2 && what.links_volumes()) return "links volumes, but this body is a sheet";
  for (const std::string& name : what.quantities_of_law())
    if (name != "across") return "asks for " + name + ", which its expressions do not know yet";
  return {};
}

std::shared_ptr<const ChangeType> change_by(const RuleOrScript& what, int dimension) {
  CHECK_NOTE(misfit_of(what, dimension).empty(), what.name());
  auto change = std::make_shared<ChangeType>();
  change->name = what.name();
  change->what = what.about();
  change->cell = *cell_of(what.hook_orbit(), dimension);
  change->grows = what.grows();
  const auto acting = std::make_shared<Acting>(what);
  change->apply = [acting](Edit& edit, const ForceView&, const Vec3& normal, std::span<const Dart> darts) {
    acting->quantities.across = normal;
    acting->runner.context() = {{}, &acting->quantities, {}};
    acting->darts.assign(darts.begin(), darts.end());
    std::sort(acting->darts.begin(), acting->darts.end());
    return acting->runner.apply_at_first(edit, acting->darts);
  };
  return change;
}

} // namespace rend
