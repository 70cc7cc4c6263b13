#include "sim/house_rules/house_scripts.h"

#include "sim/base/check.h"

namespace rend {
namespace {

// Those of the house live for ever: nobody owns them.
template <class T> std::shared_ptr<const T> unowned(const T& each) {
  return {std::shared_ptr<const T>(), &each};
}

std::optional<RuleOrScript> find_in(const std::vector<Script>& scripts, std::string_view name) {
  if (const Rule* rule = find_house_rule(name)) return RuleOrScript(unowned(*rule));
  for (const Script& each : scripts)
    if (each.name() == name) return RuleOrScript(unowned(each));
  return {};
}

} // namespace

std::vector<ScriptSettings> house_script_settings() {
  return {split_into_triangles(),  split_into_tetrahedra(), divide_tetrahedra(),    extrude_hull(),
          delete_face(),           delete_volume(),         delete_faces_at_edge(), delete_volumes_at_edge(),
          split_vertex_of_sheet(), split_vertex_of_solid()};
}

const std::vector<Script>& house_scripts() {
  static const std::vector<Script> scripts = [] {
    std::vector<ScriptSettings> settings = house_script_settings();
    std::vector<Script> made;
    made.reserve(settings.size()); // later ones refer to earlier ones
    for (ScriptSettings& each : settings)
      made.emplace_back(std::move(each), [&](const ScriptStepSettings& step) {
        const auto found = find_in(made, step.apply);
        CHECK_NOTE(found, step.apply);
        return *found;
      });
    return made;
  }();
  return scripts;
}

const Script* find_house_script(std::string_view name) {
  for (const Script& each : house_scripts())
    if (each.name() == name) return &each;
  return nullptr;
}

const Script& script(std::string_view name) {
  const Script* found = find_house_script(name);
  CHECK_NOTE(found, std::string(name));
  return *found;
}

std::optional<RuleOrScript> find_house_rule_or_script(std::string_view name) {
  return find_in(house_scripts(), name);
}

} // namespace rend
