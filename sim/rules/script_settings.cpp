#include "sim/rules/script_settings.h"

namespace rend {

template <> const Fields<ScriptStepSettings>& fields_of() {
  using S = ScriptStepSettings;
  static const Fields<S> fields{
      field(&S::each, text("each", "the cells of the hook's orbit that it is applied to, by name and orbit, "
                                   "such as e*(0,2); without it: once, to the hook")),
      field(&S::test, text("where", "a condition on the cell, such as length(e) > 1; default: none")),
      field(&S::at, word("at", {"hook", "all", "any"},
                         "where the test must hold: at the cell's first dart, or "
                         "at all or any of its darts")),
      field(&S::apply, text("apply", "a rule or a script").is_required()),
      field(&S::which, word("which", {"all", "old", "new"},
                            "cells with darts from before the script (old), or those that it has made (new)")),
      field(&S::at_least,
            word("at-least", {"all", "one", "none"},
                 "at how many of these cells it must apply; otherwise the whole script is undone")),
      field(&S::mark,
            text("mark", "a name: darts that this step has matched or made are marked(e, NAME) in the "
                         "expressions of the script, and of its rules, from then on"))};
  return fields;
}

template <> const Fields<ScriptSettings>& fields_of() {
  using S = ScriptSettings;
  static const Fields<S> fields{
      field(&S::name, text("name", "for <apply>, <tear> and other scripts").is_required()),
      field(&S::about, text("about", "one line")),
      field(&S::hook, text("hook", "what it is applied to, as in the left graph of a rule: a*(0,1)"))};
  return fields;
}

} // namespace rend
