#include "sim/rules/rounds.h"

#include "sim/base/check.h"
#include "sim/base/stop_request.h"
#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {
namespace {

class Round {
public:
  Round(RuleOrScriptRunner& runner, Edit& edit, const std::function<bool(Dart)>& selected,
        const Partners& partners)
      : runner_(runner), edit_(edit), selected_(selected), partners_(partners), darts_(edit.map().capacity()),
        used_(darts_), seen_(darts_) {}

  RoundResult run() {
    runner_.context().sides.reset();
    if (!fits()) return result_;
    const Edit::Savepoint start = edit_.savepoint();
    if (runner_.hooks() == 0)
      count(visit({}));
    else
      visit_orbits([this](const Hooks& hooks) { return visit(hooks); }, &result_.skipped);
    if (result_.over_budget) edit_.rollback(start);
    return result_;
  }

private:
  // What came of a place: from what counts least, if there are several hooks to try, to what counts most.
  enum class Visited { NotTried, Refused, Skipped, Applied };
  using Visit = std::function<Visited(const Hooks&)>;

  // `skipped`: counts places; null: nobody asks.
  void visit_orbits(const Visit& visit, std::size_t* skipped) {
    const Orbit orbit = runner_.hook_orbit();
    for (std::uint32_t n = 0; n < darts_ && !result_.over_budget; ++n) {
      throw_if_stop_is_due();
      if (!edit_.map().alive(Dart{n}) || seen_[n] || (used_[n] && !skipped)) continue;
      orbit_.clear();
      collect(edit_.map(), orbit, Dart{n}, orbit_);
      bool chosen = true, changed = false;
      for (Dart d : orbit_) {
        if (d.value < darts_) seen_[d.value] = true;
        changed = changed || used(d);
        chosen = chosen && (d.value >= darts_ || !selected_ || selected_(d));
      }
      if (chosen && !changed)
        visit_with_partners(Dart{n}, visit);
      else if (chosen && skipped)
        *skipped += fits_changed(Dart{n});
    }
  }

  // Whether the rule would apply at a place that has changed in this round.
  bool fits_changed(Dart d) {
    if (!runner_.rule()) return true;
    if (!partners_) return runner_.rule()->matches(edit_, d);
    const std::vector<Dart> near = partners_(d);
    return std::ranges::any_of(near, [&](Dart e) {
      return edit_.map().alive(e) && runner_.rule()->matches(edit_, {d, e});
    });
  }

  // Whether the map may have the darts that it would have after the round. They are counted only where there
  // could be too many if the rule matched everywhere: each dart is of one orbit.
  bool fits() {
    const RuleRunner* rule = runner_.rule();
    if (!rule || runner_.hooks() == 0 || rule->rule().growth() <= 0) return true;
    const auto growth = static_cast<std::size_t>(rule->rule().growth());
    const std::size_t now = edit_.map().dart_count(), most = rule->context().most_darts;
    if (now + now * growth <= most) return true;
    std::size_t places = 0, instances = 0;
    const auto count_match = [&](const Hooks& hooks) {
      if (!matches_unused(*runner_.rule(), hooks)) return Visited::Refused;
      ++places;
      instances += rule->match().instances;
      use(rule->match().darts);
      return Visited::Applied;
    };
    visit_orbits(count_match, nullptr);
    used_.assign(darts_, false);
    seen_.assign(darts_, false);
    result_ = {};
    const std::size_t then = now + instances * growth;
    if (then > most) result_ = {.reason = {}, .over_budget = true, .places = places, .darts = then};
    return then <= most;
  }

  bool used(Dart d) const { return d.value >= darts_ || used_[d.value]; }
  void use(const std::vector<Dart>& darts) {
    for (Dart d : darts)
      if (d.value < darts_) used_[d.value] = true;
  }

  void visit_with_partners(Dart d, const Visit& visit) {
    if (!partners_) return count(visit(d));
    Visited best = Visited::NotTried;
    for (Dart e : partners_(d)) {
      if (edit_.map().alive(e)) best = std::max(best, visit({d, e}));
      if (best == Visited::Applied) break;
    }
    count(best);
  }

  void count(Visited what) {
    result_.applied += what == Visited::Applied;
    result_.skipped += what == Visited::Skipped;
    result_.refused += what == Visited::Refused;
  }

  bool matches_unused(RuleRunner& rule, const Hooks& hooks) {
    const auto is_used = [this](Dart d) { return used(d); };
    return rule.matches(edit_, hooks) &&
           std::none_of(rule.match().darts.begin(), rule.match().darts.end(), is_used);
  }

  Visited visit(const Hooks& hooks) {
    return runner_.rule() ? visit(*runner_.rule(), hooks) : visit_by_script(hooks);
  }

  Visited visit(RuleRunner& rule, const Hooks& hooks) {
    if (!matches_unused(rule, hooks)) return rule.mismatch() ? refuse() : Visited::Skipped;
    if (!rule.rewrite(edit_)) {
      result_.over_budget = rule.over_budget();
      return refuse();
    }
    use(rule.match().darts);
    use(rule.darts()); // a removed dart's number may have been taken again
    return Visited::Applied;
  }

  Visited visit_by_script(const Hooks& hooks) {
    if (!runner_.apply(edit_, hooks)) {
      result_.over_budget = runner_.over_budget();
      return refuse();
    }
    use(runner_.script()->used());
    return Visited::Applied;
  }

  Visited refuse() {
    if (result_.reason.empty()) result_.reason = runner_.sentence();
    return Visited::Refused;
  }

  RuleOrScriptRunner& runner_;
  Edit& edit_;
  const std::function<bool(Dart)>& selected_;
  const Partners& partners_;
  std::size_t darts_;             // when the round began
  std::vector<bool> used_, seen_; // by dart
  std::vector<Dart> orbit_;
  RoundResult result_;
};

} // namespace

RoundResult apply_round(EmbeddedMap& map, RuleOrScriptRunner& runner, const std::function<bool(Dart)>& selected,
                        const Partners& partners) {
  CHECK(runner.hooks() <= (partners ? 2 : 1));
  RoundResult result;
  map.edit([&](Edit& edit) { result = Round(runner, edit, selected, partners).run(); });
  return result;
}

} // namespace rend
