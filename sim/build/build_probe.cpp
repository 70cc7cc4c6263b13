#include "sim/build/build_probe.h"

#include "sim/build/selector.h"

#include <fmt/format.h>

namespace rend {
namespace {

const ElementType& probe_type() {
  static const ElementType type = [] {
    ElementType t{"probe",
                  "measures the selected vertices: their mean position and displacement, and the force that "
                  "supports those that are fixed or driven, and the mean stress of the elements there",
                  {text("name", "of letters, digits, - and _; must differ").is_required()},
                  {}};
    add_selector(t.attributes);
    return t;
  }();
  return type;
}

const ElementType& answer_type() {
  static const ElementType type{
      "answer",
      "what a probe should measure; `rend run` compares, and ends with 1 where it does not hold",
      {text("probe", "its name").is_required(),
       word("quantity", probe_quantities(),
            "position; displacement (d: its length); force of the support (reaction: its size); mean stress of "
            "the elements there")
           .is_required(),
       number_or("at", {"end"}, "s", "when: at the first step from then on").at_least(0).otherwise("end"),
       number("value", "m, N or Pa", "the known answer").is_required(),
       number("tolerance", "", "error / |value| that still holds; the error itself where the value is 0")
           .at_least(0)
           .otherwise("0.01"),
       text("source", "where the answer comes from")},
      {}};
  return type;
}

void check_name(const PresetNode& node) {
  const std::string& name = node.text("name");
  const auto fits = [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  for (char c : name)
    if (!fits(static_cast<unsigned char>(c)))
      node.fail("name", "the name of a probe holds " + in_quotes(std::string(1, c)),
                "letters, digits, - and _ do");
  if (name.empty()) node.fail("name", "the name of the probe is empty", "letters, digits, - and _ do");
}

Answer answer_of(const Body& body, const PresetNode& node) {
  Answer answer;
  std::vector<std::string> names;
  for (const Probe& probe : body.probes) names.push_back(probe.name());
  const std::string& wanted = node.text("probe");
  while (answer.probe < names.size() && names[answer.probe] != wanted) ++answer.probe;
  if (answer.probe == names.size())
    node.fail("probe", fmt::format("the body has no probe {}", in_quotes(wanted)),
              names.empty() ? "<probe name=\"tip\" near=\"1 0 0\"/> is one"
                            : suggestion(wanted, names, "its probes"));
  answer.quantity = node.text("quantity");
  if (answer.quantity.starts_with("reaction") && !body.probes[answer.probe].on_support(body))
    node.fail("quantity", fmt::format("nothing supports the vertices of probe '{}'", wanted),
              "a reaction needs fixed or driven vertices");
  if (answer.quantity.starts_with("stress") && !has_stress(body))
    node.fail("quantity", "no element of the body knows its stress", "<elasticity> makes finite elements");
  if (!node.is_word("at")) answer.at = node.number("at");
  answer.value = node.number("value");
  answer.tolerance = node.number("tolerance");
  if (node.has("source")) answer.source = node.text("source");
  answer.place = node.place("at");
  return answer;
}

} // namespace

std::vector<ChildType> probe_types() {
  return {{&probe_type(), 0, -1}, {&answer_type(), 0, -1}};
}

void build_probes(Body& body, const PresetNode& node) {
  for (const PresetNode* probe : node.all("probe")) {
    check_name(*probe);
    body.probes.emplace_back(*body.map, probe->text("name"), select_vertices(body, *probe));
  }
  for (const PresetNode* answer : node.all("answer")) body.answers.push_back(answer_of(body, *answer));
}

} // namespace rend
