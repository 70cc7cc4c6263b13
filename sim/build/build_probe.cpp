#include "sim/build/build_probe.h"

#include "sim/base/wording.h"

#include <fmt/format.h>

namespace rend {
namespace {

Answer answer_of(const Body& body, const AnswerSettings& settings) {
  check_settings(settings);
  const SettingsSource& source = settings.source;
  Answer answer(settings);
  std::vector<std::string> names;
  for (const Probe& probe : body.probes) names.push_back(probe.name());
  while (answer.number < names.size() && names[answer.number] != answer.probe) ++answer.number;
  if (answer.number == names.size())
    source.fail("probe", fmt::format("the body has no probe {}", in_quotes(answer.probe)),
                names.empty() ? "<probe name=\"tip\" near=\"1 0 0\"/> is one"
                              : suggestion(answer.probe, names, "its probes"));
  if (answer.quantity.starts_with("reaction") && !body.probes[answer.number].on_support(body))
    source.fail("quantity",
                fmt::format("the vertices of probe '{}' are neither fixed nor driven, so there is no reaction",
                            answer.probe),
                "select fixed or driven vertices, or compare another quantity");
  if (answer.quantity.starts_with("stress") && !has_stress(body))
    source.fail("quantity", "the body has no elements with a stress",
                "add <elasticity>, which makes finite elements");
  return answer;
}

} // namespace

void build_probes(Body& body, const BodySettings& settings) {
  for (const ProbeSettings& probe : settings.probes) {
    check_name(probe);
    body.probes.emplace_back(*body.map, probe.name,
                             select_vertices(*body.map, body.groups, probe.where, "probe", probe.source));
  }
  for (const AnswerSettings& answer : settings.answers) body.answers.push_back(answer_of(body, answer));
}

} // namespace rend
