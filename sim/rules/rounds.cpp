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
    if (runner_.hooks() == 0) {
      visit({});
      return result_;
    }
    const Orbit orbit = runner_.hook_orbit();
    for (std::uint32_t n = 0; n < darts_; ++n) {
      throw_if_stop_is_due();
      if (!edit_.map().alive(Dart{n}) || used_[n] || seen_[n]) continue;
      orbit_.clear();
      collect(edit_.map(), orbit, Dart{n}, orbit_);
      bool chosen = true;
      for (Dart d : orbit_) {
        if (d.value < darts_) seen_[d.value] = true;
        chosen = chosen && !used(d) && (!selected_ || selected_(d));
      }
      if (chosen) visit_with_partners(Dart{n});
    }
    return result_;
  }

private:
  bool used(Dart d) const { return d.value >= darts_ || used_[d.value]; }
  void use(const std::vector<Dart>& darts) {
    for (Dart d : darts)
      if (d.value < darts_) used_[d.value] = true;
  }

  void visit_with_partners(Dart d) {
    if (!partners_) return void(visit(d));
    for (Dart e : partners_(d))
      if (edit_.map().alive(e) && visit({d, e})) return;
  }

  bool visit(const Hooks& hooks) {
    return runner_.rule() ? visit(*runner_.rule(), hooks) : visit_by_script(hooks);
  }

  bool visit(RuleRunner& rule, const Hooks& hooks) {
    if (!rule.matches(edit_, hooks)) return refuse();
    const std::vector<Dart>& matched = rule.match().darts;
    if (std::any_of(matched.begin(), matched.end(), [&](Dart d) { return used(d); })) return false;
    if (!rule.rewrite(edit_)) return refuse();
    ++result_.applied;
    use(matched);
    use(rule.darts()); // a removed dart's number may have been taken again
    return true;
  }

  bool visit_by_script(const Hooks& hooks) {
    if (!runner_.apply(edit_, hooks)) return refuse();
    ++result_.applied;
    use(runner_.script()->used());
    return true;
  }

  bool refuse() {
    ++result_.refused;
    if (result_.reason.empty()) result_.reason = runner_.sentence();
    return false;
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
