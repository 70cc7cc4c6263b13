#include "sim/base/markup.h"
#include "sim/rules/script.h"

namespace rend {
namespace {

class Element {
public:
  Element(std::string_view indent, std::string_view name)
      : text_(std::string(indent) + "<" + std::string(name)) {}
  void add(std::string_view name, const std::string& value) {
    text_ += " " + std::string(name) + "=\"" + in_markup(value, MarkupQuotes::Double) + "\"";
  }
  void add_if(std::string_view name, const std::string& value) {
    if (!value.empty()) add(name, value);
  }
  std::string end(std::string_view with) const { return text_ + std::string(with) + "\n"; }

private:
  std::string text_;
};

std::string normal(const std::optional<Expression>& expression) {
  return expression ? expression->print() : std::string();
}

constexpr const char* at_words[] = {"hook", "all", "any"};
constexpr const char* which_words[] = {"all", "old", "new"};
constexpr const char* at_least_words[] = {"all", "one", "none"};

template <class E> std::string word(const char* const (&words)[3], E which) {
  return which == E{} ? std::string() : words[static_cast<std::size_t>(which)]; // the first is the default
}

std::string arguments_of(const RuleSettings& settings) {
  std::string parts;
  for (const RuleWhereSettings& where : settings.wheres) {
    Element element("  ", "where");
    element.add("name", where.name);
    element.add("value", where.value);
    parts += element.end("/>");
  }
  return parts;
}

std::string conditions_of(const Rule& rule) {
  std::string parts;
  for (const Rule::When& when : rule.whens) {
    Element element("  ", "when");
    element.add("test", when.test.print());
    element.add_if("at", word(at_words, when.at));
    element.add_if("otherwise", when.otherwise);
    parts += element.end("/>");
  }
  return parts;
}

std::string step_of(const ScriptStepSettings& settings, const Script::Step& step) {
  Element element("  ", "for");
  if (step.cell) element.add("each", RuleGraph::parse(RuleSide::Left, settings.each).print());
  element.add_if("which", word(which_words, settings.which));
  if (!step.scope.whens.empty()) element.add("where", step.scope.whens[0].test.print());
  element.add_if("at", word(at_words, settings.at));
  element.add("apply", settings.apply);
  element.add_if("at-least", word(at_least_words, settings.at_least));
  element.add_if("mark", settings.mark);
  for (const Script::Argument& argument : step.arguments)
    element.add(step.what.wheres()[argument.number].name, argument.value.print());
  return element.end("/>");
}

} // namespace

std::string Rule::print() const {
  Element rule("", "rule");
  rule.add("name", settings.name);
  rule.add_if("about", settings.about);
  rule.add("left", left.print());
  rule.add("right", right.print());
  if (settings.may_fold) rule.add("may-fold", "yes");
  std::string parts = arguments_of(settings);
  for (const Let& let : lets) {
    Element element("  ", "let");
    element.add("name", let.name);
    element.add("value", let.value.print());
    parts += element.end("/>");
  }
  for (const Set& set : sets) {
    Element element("  ", "set");
    element.add("node", right[set.node].name);
    element.add_if("position", normal(set.position));
    element.add_if("rest", normal(set.rest));
    element.add_if("velocity", normal(set.velocity));
    parts += element.end("/>");
  }
  parts += conditions_of(*this);
  return parts.empty() ? rule.end("/>") : rule.end(">") + parts + "</rule>\n";
}

std::string Script::print() const {
  Element script("", "script");
  script.add("name", settings.name);
  script.add_if("about", settings.about);
  script.add_if("hook", scope.left.print());
  std::string parts = arguments_of(scope.settings) + conditions_of(scope);
  for (std::size_t n = 0; n < steps.size(); ++n) parts += step_of(settings.steps[n], steps[n]);
  return script.end(">") + parts + "</script>\n";
}

} // namespace rend
