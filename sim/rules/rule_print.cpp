#include "sim/base/markup.h"
#include "sim/rules/rule.h"

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

} // namespace

std::string Rule::print() const {
  Element rule("", "rule");
  rule.add("name", settings.name);
  rule.add_if("about", settings.about);
  rule.add("left", left.print());
  rule.add("right", right.print());
  if (settings.may_fold) rule.add("may-fold", "yes");
  std::string parts;
  for (const RuleWhereSettings& where : settings.wheres) {
    Element element("  ", "where");
    element.add("name", where.name);
    element.add("value", where.value);
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
  static constexpr const char* at[] = {"hook", "all", "any"};
  for (const When& when : whens) {
    Element element("  ", "when");
    element.add("test", when.test.print());
    if (when.at != RuleWhenSettings::At::Hook) element.add("at", at[static_cast<std::size_t>(when.at)]);
    element.add_if("otherwise", when.otherwise);
    parts += element.end("/>");
  }
  return parts.empty() ? rule.end("/>") : rule.end(">") + parts + "</rule>\n";
}

} // namespace rend
