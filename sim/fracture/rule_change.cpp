#include "sim/fracture/rule_change.h"

#include "sim/base/check.h"
#include "sim/rules/apply.h"
#include "sim/topology/walk.h"

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

// One hook's orbit after the other, from its smallest dart.
bool apply_in(RuleRunner& runner, Edit& edit, std::span<const Dart> cell) {
  std::vector<Dart> darts(cell.begin(), cell.end()), orbit;
  std::sort(darts.begin(), darts.end());
  IndexSet tried;
  const Orbit hook = runner.rule().hook_orbit();
  for (Dart d : darts) {
    if (tried.contains(d.value)) continue;
    if (runner.apply(edit, d)) return true;
    orbit.clear();
    collect(edit.map(), hook, d, orbit);
    for (Dart e : orbit) tried.insert(e.value);
  }
  return false;
}

} // namespace

std::string misfit_of(const Rule& rule, int dimension) {
  if (rule.plan.hooks.size() != 1)
    return fmt::format("has {} hooks, but a <tear> finds the darts of one only", rule.plan.hooks.size());
  if (!cell_of(rule.hook_orbit(), dimension))
    return "changes a whole component, but a <tear> acts on single cells";
  if (dimension == 2 && rule.plan.links_volumes) return "links volumes, but this body is a sheet";
  if (const std::string name = rule.quantity_of_law(); !name.empty())
    return "asks for " + name + ", which its expressions do not know yet";
  return {};
}

std::shared_ptr<const ChangeType> change_by(std::shared_ptr<const Rule> rule, int dimension) {
  CHECK_NOTE(misfit_of(*rule, dimension).empty(), rule->name());
  auto change = std::make_shared<ChangeType>();
  change->name = rule->name();
  change->what = rule->settings.about;
  change->cell = *cell_of(rule->hook_orbit(), dimension);
  change->grows = true;
  const auto runner = std::make_shared<RuleRunner>(*rule);
  change->apply = [rule, runner](Edit& edit, const ForceView&, const Vec3&, std::span<const Dart> darts) {
    runner->context().sides.reset();
    return apply_in(*runner, edit, darts);
  };
  return change;
}

} // namespace rend
