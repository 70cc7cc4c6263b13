#include "sim/rules/rule_settings.h"

namespace rend {

template <> const Fields<RuleSetSettings>& fields_of() {
  using S = RuleSetSettings;
  static const Fields<S> fields{
      field(&S::node, text("node", "of the right graph").is_required()),
      field(&S::position, text("position", "an expression [m]: where the node's vertex is, or goes")),
      field(&S::rest, text("rest", "at rest; default: as position, of the rest positions")),
      field(&S::velocity, text("velocity", "[m/s]; default: as position, of the velocities"))};
  return fields;
}

template <> const Fields<RuleWhenSettings>& fields_of() {
  using S = RuleWhenSettings;
  static const Fields<S> fields{
      field(&S::test, text("test", "an expression that is true or false").is_required()),
      field(&S::at, word("at", {"hook", "all", "any"}, "at the hook, or at all or any darts of its orbit")),
      field(&S::otherwise, text("otherwise", "what is said where it does not hold"))};
  return fields;
}

template <> const Fields<RuleWhereSettings>& fields_of() {
  using S = RuleWhereSettings;
  static const Fields<S> fields{
      field(&S::name,
            text("name", "for expressions, and for <apply>, which may give it a value").is_required()),
      field(&S::value, text("value", "an expression of numbers").is_required())};
  return fields;
}

template <> const Fields<RuleLetSettings>& fields_of() {
  using S = RuleLetSettings;
  static const Fields<S> fields{
      field(&S::name, text("name", "for the expressions of this rule that follow").is_required()),
      field(&S::value, text("value", "an expression: a number, a point or a condition, such as mean(a, face)")
                           .is_required())};
  return fields;
}

template <> const Fields<RuleSettings>& fields_of() {
  using S = RuleSettings;
  static const Fields<S> fields{
      field(&S::name, text("name", "for <apply> and <tear>").is_required()),
      field(&S::about, text("about", "one line")),
      field(&S::left, text("left", "what is matched: nodes a*(0,1), arcs a-2-b, free links a|3")),
      field(&S::right, text("right", "what takes its place")),
      field(&S::may_fold,
            flag("may-fold",
                 "darts of the left graph may coincide, as those of an edge that is sewn to itself"))};
  return fields;
}

} // namespace rend
