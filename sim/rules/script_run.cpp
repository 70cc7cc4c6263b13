#include "sim/rules/script_run.h"

#include "sim/base/check.h"
#include "sim/base/wording.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace rend {

namespace {

constexpr int last_stage = std::numeric_limits<int>::max(); // nothing comes further than the budget

} // namespace

struct ScriptRunner::Step {
  Step(const Script::Step& step_, const ScriptStepSettings& settings_, std::size_t number_)
      : step(step_), settings(settings_), number(number_), runner(step_.what) {}

  const Script::Step& step;
  const ScriptStepSettings& settings;
  std::size_t number; // from 1
  RuleOrScriptRunner runner;
  Match match;        // of the scope: the hook and a cell
  std::string reason; // of the first refusal while the step runs
  Refusal refusal;    // the same
};

ScriptRunner::ScriptRunner(const Script& script, RuleContext context)
    : script_(script), context_(std::move(context)), scope_(script.scope) {
  for (std::size_t n = 0; n < script.steps.size(); ++n)
    steps_.push_back(std::make_unique<Step>(script.steps[n], script.settings.steps[n], n + 1));
}

ScriptRunner::ScriptRunner(ScriptRunner&&) noexcept = default;
ScriptRunner::~ScriptRunner() = default;

bool ScriptRunner::apply(Edit& edit, const Hooks& hooks) {
  const Edit::Savepoint start = edit.savepoint();
  created_before_ = start.map.created;
  reason_.clear();
  used_.clear();
  matched_.clear();
  applied_ = 0;
  refusal_ = {};
  over_budget_ = false;
  if (!begin(edit, hooks)) return false;
  for (const auto& step : steps_) {
    if (run(edit, *step)) continue;
    edit.rollback(start);
    return false;
  }
  if (applied_ > 0) return true;
  reason_ = "no step applies anywhere";
  refusal_ = {1, reason_};
  for (const auto& step : steps_)
    if (!step->reason.empty()) {
      reason_ += ": " + step->reason;
      refusal_.reason += ": " + step->refusal.reason;
      break;
    }
  return false;
}

bool ScriptRunner::begin(Edit& edit, const Hooks& hooks) {
  CHECK_NOTE(hooks.size() == (script_.has_hook() ? 1 : 0), script_.name());
  of_.clear();
  is_of_.clear();
  added_.clear();
  made_.clear();
  marks_.clear();
  scope_.context() = {context_.wheres, context_.quantities, {}, context_.most_darts, &marks_};
  if (!script_.has_hook()) return true;
  hook_ = hooks[0];
  if (!edit.map().alive(hook_)) {
    reason_ = fmt::format("there is no dart {}", hook_.value);
    refusal_ = {1, "its dart is gone"};
    return false;
  }
  if (!script_.scope.whens.empty() && !scope_.matches(edit, hook_)) {
    reason_ = scope_.mismatch().sentence(script_.scope);
    refusal_ = {1, scope_.mismatch().in_general(script_.scope)};
    return false;
  }
  of_.push_back(hook_);
  grow(edit);
  return true;
}

// What is of the hook from now on.
void ScriptRunner::grow(const Edit& edit) {
  const std::vector<Dart>& created = edit.journal()->created;
  for (; created_before_ < created.size(); ++created_before_) made_.insert(created[created_before_].value);
  std::vector<Dart> from;
  from.swap(of_);
  from.insert(from.end(), added_.begin(), added_.end());
  added_.clear();
  is_of_.clear();
  const Orbit orbit = script_.has_hook() ? script_.hook_orbit() : SingleDart;
  for (Dart d : from) {
    if (!edit.map().alive(d) || is_of_.contains(d.value)) continue;
    const std::size_t first = of_.size();
    collect(edit.map(), orbit, d, of_);
    for (std::size_t n = first; n < of_.size(); ++n) is_of_.insert(of_[n].value);
  }
  if (script_.has_hook() && !of_.empty() && !edit.map().alive(hook_)) hook_ = of_.front();
}

bool ScriptRunner::run(Edit& edit, Step& step) {
  using AtLeast = ScriptStepSettings::AtLeast;
  step.reason.clear();
  step.refusal = {};
  step.runner.context() = {{}, context_.quantities, {}, context_.most_darts, &marks_};
  moved_.clear();
  const std::size_t before = applied_;
  const auto refuse = [&](const std::string& what, const std::string& where = {}) {
    const std::string name = fmt::format("step {}, {}, {}", step.number, in_quotes(step.settings.apply), what);
    const auto why = [](const std::string& reason) { return reason.empty() ? reason : ": " + reason; };
    reason_ = name + where + why(step.reason);
    refusal_ = {static_cast<int>(step.number) + 1, name + why(step.refusal.reason)};
    return false;
  };
  scope_.context().sides.reset(); // the map has changed
  try {
    find_cells(edit, step);
    for (std::size_t n = 0; n + 1 < first_.size(); ++n) {
      const bool done = apply_at(edit, step, n) || step.settings.at_least != AtLeast::All;
      if (step.runner.over_budget()) return refuse_growth(step);
      if (done) continue;
      return refuse("does not apply",
                    step.step.cell ? fmt::format(" at dart {}", cells_[first_[n]].value) : std::string());
    }
  } catch (const ExpressionError& error) { // of its test, or of an argument
    step.reason = error.flaw;
    step.refusal.reason =
        Mismatch{.kind = Mismatch::Kind::Expression, .text = error.flaw}.in_general(step.step.scope);
    return refuse("has no value");
  }
  if (step.settings.at_least == AtLeast::One && applied_ == before) return refuse("applies nowhere");
  settle(edit);
  grow(edit);
  return true;
}

bool ScriptRunner::refuse_growth(const Step& step) {
  reason_ = fmt::format("step {}, {}, lets the map grow beyond {} darts", step.number,
                        in_quotes(step.settings.apply), context_.most_darts);
  refusal_ = {last_stage, beyond_budget};
  over_budget_ = true;
  return false;
}

// The chosen ones; of a step that is done once, one without darts.
void ScriptRunner::find_cells(const Edit& edit, Step& step) {
  using Which = ScriptStepSettings::Which;
  const Which which = step.settings.which;
  cells_.clear();
  first_.assign(1, 0);
  values_.clear();
  if (!step.step.cell) {
    if (is_chosen(edit, step, {})) choose(edit, step, {});
    return;
  }
  thread_local IndexSet seen;
  thread_local std::vector<Dart> orbit;
  seen.clear();
  for (Dart d : of_) {
    if (seen.contains(d.value)) continue;
    orbit.clear();
    collect(edit.map(), *step.step.cell, d, orbit);
    bool old = false;
    for (Dart e : orbit) {
      seen.insert(e.value);
      old = old || !made_.contains(e.value);
      if (is_of_.contains(e.value)) cells_.push_back(e);
    }
    const auto begin = cells_.begin() + static_cast<std::ptrdiff_t>(first_.back());
    if ((which == Which::All || old == (which == Which::Old)) && is_chosen(edit, step, {begin, cells_.end()}))
      choose(edit, step, {begin, cells_.end()});
    else
      cells_.resize(first_.back());
  }
}

bool ScriptRunner::is_chosen(const Edit& edit, Step& step, std::span<const Dart> cell) const {
  using At = RuleWhenSettings::At;
  if (step.step.scope.whens.empty()) return true;
  const auto holds = [&](Dart d) {
    return look(edit, step, d) &&
           RuleValues(step.step.scope, edit, step.match, scope_.context()).holds(step.step.scope.whens[0]);
  };
  if (cell.empty()) return holds({});
  if (step.settings.at == At::Hook) return holds(cell[0]);
  return step.settings.at == At::All ? std::all_of(cell.begin(), cell.end(), holds)
                                     : std::any_of(cell.begin(), cell.end(), holds);
}

// False: the hook is gone.
bool ScriptRunner::look(const Edit& edit, Step& step, Dart cell) const {
  const bool hook = script_.has_hook(), has_cell = step.step.cell.has_value();
  const Hooks hooks = hook && has_cell ? Hooks{hook_, cell}
                      : hook           ? Hooks(hook_)
                      : has_cell       ? Hooks(cell)
                                       : Hooks();
  return !find_match(step.step.scope, edit.map(), hooks, step.match);
}

// The last cell in cells_; with the values of the arguments there, of which those that do not vary are the
// same as at the first one.
void ScriptRunner::choose(const Edit& edit, Step& step, std::span<const Dart> cell) {
  const bool first = first_.size() == 1;
  first_.push_back(cells_.size());
  const std::vector<Script::Argument>& arguments = step.step.arguments;
  if (arguments.empty()) return;
  const std::size_t base = values_.size() - (first ? 0 : arguments.size());
  if (!look(edit, step, cell.empty() ? Dart{} : cell[0])) throw ExpressionError(1, "its hook is gone");
  const RuleValues scope(step.step.scope, edit, step.match, scope_.context());
  for (std::size_t n = 0; n < arguments.size(); ++n)
    values_.push_back(first || arguments[n].varies ? scope.value(arguments[n].value, 0) : values_[base + n]);
}

bool ScriptRunner::apply_at(Edit& edit, Step& step, std::size_t cell) {
  left_.clear();
  for (std::size_t n = first_[cell]; n < first_[cell + 1]; ++n)
    if (edit.map().alive(cells_[n])) left_.push_back(cells_[n]);
  if (left_.empty() && step.step.cell) return true;
  const std::vector<Script::Argument>& arguments = step.step.arguments;
  if (!arguments.empty()) {
    std::vector<Value>& values = step.runner.context().wheres;
    values.clear();
    for (const Rule::Where& where : step.step.what.wheres()) values.push_back(where.value);
    for (std::size_t n = 0; n < arguments.size(); ++n)
      values[arguments[n].number] = values_[cell * arguments.size() + n];
  }
  const bool done = step.step.cell ? step.runner.apply_at_first(edit, left_) : step.runner.apply(edit, {});
  if (done) {
    note(step);
  } else if (step.reason.empty()) {
    step.reason = step.runner.sentence();
    step.refusal = step.runner.refusal();
  }
  return done;
}

// Darts that are new have the marks of this step alone, whatever their numbers had.
void ScriptRunner::mark(Step& step) {
  const std::string& name = step.settings.mark;
  const auto set = [&](const std::vector<Dart>& darts) {
    for (Dart d : darts)
      if (!name.empty()) marks_.set(d, name);
  };
  if (const ScriptRunner* script = step.runner.script()) return set(script->used_);
  const RuleRunner& rule = *step.runner.rule();
  const std::vector<int>& before = rule.rule().before;
  for (std::size_t n = 0; n < rule.darts().size(); ++n)
    if (before[n % before.size()] < 0) marks_.forget(rule.darts()[n]);
  set(rule.match().darts);
  set(rule.darts());
}

void ScriptRunner::note(Step& step) {
  ++applied_;
  mark(step);
  if (const ScriptRunner* script = step.runner.script()) {
    used_.insert(used_.end(), script->used_.begin(), script->used_.end());
    matched_.insert(matched_.end(), script->matched_.begin(), script->matched_.end());
    const auto is_of_hook = [&](Dart d) { return is_of_.contains(d.value) || script->made_.contains(d.value); };
    if (std::all_of(script->matched_.begin(), script->matched_.end(), is_of_hook))
      added_.insert(added_.end(), script->of_.begin(), script->of_.end());
    return;
  }
  const RuleRunner& rule = *step.runner.rule();
  const std::vector<Dart>&matched = rule.match().darts, &left = rule.darts();
  used_.insert(used_.end(), matched.begin(), matched.end());
  matched_.insert(matched_.end(), matched.begin(), matched.end());
  used_.insert(used_.end(), left.begin(), left.end());
  moved_.insert(moved_.end(), rule.moved().begin(), rule.moved().end());
  if (!rule.rule().creates()) return;
  if (!std::all_of(matched.begin(), matched.end(), [&](Dart d) { return is_of_.contains(d.value); })) return;
  added_.insert(added_.end(), left.begin(), left.end());
  for (Dart d : left) is_of_.insert(d.value);
}

// An edit knows the old place of a vertex that it moves, and one dart of it. What follows reads the new place,
// and may part the vertex.
void ScriptRunner::settle(Edit& edit) {
  thread_local std::vector<Dart> vertex;
  for (const auto& [d, point] : moved_) {
    if (!edit.map().alive(d)) continue;
    vertex.clear();
    collect(edit.map(), Vertex, d, vertex);
    const std::uint32_t given = edit.add_point(point);
    for (Dart e : vertex) {
      edit.give(e, given);
      edit.move(e, point);
    }
  }
}

RuleOrScriptRunner::RuleOrScriptRunner(const RuleOrScript& what, RuleContext context) : hooks_(what.hooks()) {
  if (hooks_ > 0) hook_ = what.hook_orbit();
  if (what.rule)
    rule_ = std::make_unique<RuleRunner>(*what.rule, std::move(context));
  else
    script_ = std::make_unique<ScriptRunner>(*what.script, std::move(context));
}

namespace {

// How far a rule came: it does not match, a condition does not hold, no value, no shape, no room.
int stage_of(Mismatch::Kind kind) {
  switch (kind) {
  case Mismatch::Kind::None:
    return 0;
  case Mismatch::Kind::Condition:
    return 2;
  case Mismatch::Kind::Expression:
    return 3;
  case Mismatch::Kind::Shape:
    return 4;
  case Mismatch::Kind::Budget:
    return last_stage;
  default:
    return 1;
  }
}

} // namespace

Refusal RuleOrScriptRunner::refusal() const {
  if (script_) return script_->refusal();
  return {stage_of(rule_->mismatch().kind), rule_->mismatch().in_general(rule_->rule())};
}

void RuleOrScriptRunner::keep_furthest(Refusal& furthest) const {
  const int stage = script_ ? script_->refusal().stage : stage_of(rule_->mismatch().kind);
  if (stage > furthest.stage) furthest = refusal();
}

bool RuleOrScriptRunner::apply_at_first(Edit& edit, std::span<const Dart> darts, Refusal* furthest,
                                        const std::function<std::string()>& fault) {
  over_budget_ = false;
  if (hooks_ == 2) {
    for (Dart d : darts) {
      if (!rule_->may_begin(edit, 0, d)) continue;
      for (Dart e : darts) {
        if (d == e) continue;
        if (apply(edit, {d, e})) return true;
        if (over_budget()) return false;
      }
    }
    return false;
  }
  tried_.clear();
  for (Dart d : darts) {
    if (tried_.contains(d.value)) continue;
    const Edit::Savepoint before = edit.savepoint();
    const bool applied = apply(edit, d);
    const std::string why = applied && fault ? fault() : std::string();
    if (applied && why.empty()) return true;
    if (applied) edit.rollback(before);
    if (applied && furthest) *furthest = {last_stage, why};
    if (!applied && furthest) keep_furthest(*furthest);
    if (over_budget()) return false;
    orbit_.clear();
    collect(edit.map(), hook_, d, orbit_);
    for (Dart e : orbit_) tried_.insert(e.value);
  }
  return false;
}

std::string RuleOrScriptRunner::sentence() const {
  return rule_ ? rule_->mismatch().sentence(rule_->rule()) : script_->reason();
}

} // namespace rend
