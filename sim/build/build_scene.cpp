#include "sim/build/build_scene.h"

#include "sim/base/wall_clock.h"
#include "sim/build/build_body.h"
#include "sim/build/read_body.h"
#include "sim/build/read_settings.h"
#include "sim/build/read_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace rend {
namespace {

bool has_body(const SceneDefinition& scene, const std::string& name) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [&](const auto& body) { return body->name == name; });
}

std::set<std::string> probes_of(const SceneDefinition& scene) {
  std::set<std::string> names;
  for (const auto& body : scene.bodies)
    for (const Probe& probe : body->probes) names.insert(probe.name());
  return names;
}

} // namespace

Body& add_body(SceneDefinition& scene, const BodySettings& settings) {
  if (has_body(scene, settings.name))
    settings.source.fail("", fmt::format("two bodies are called '{}'", settings.name),
                         "give each a name of its own");
  auto body = build_body(settings, scene.world);
  std::set<std::string> probes = probes_of(scene);
  for (const ProbeSettings& probe : settings.probes)
    if (!probes.insert(probe.name).second)
      probe.source.fail("name", fmt::format("two probes are called '{}'", probe.name),
                        "give each a name of its own, also in different bodies");
  scene.bodies.push_back(std::move(body));
  return *scene.bodies.back();
}

SceneDefinition read_scene(const PresetNode& preset, const TextureChoice& is_textured) {
  const double start = wall_clock();
  SceneDefinition scene;
  scene.name = preset.text("name");
  scene.world = read_world(preset.child("world"));
  const RuleBook rules = read_rules(preset);
  for (const PresetNode* node : preset.all("body")) {
    BodySettings body = read_body(*node);
    body.rules = rules;
    if (auto* mesh = std::get_if<MeshSettings>(&body.shape))
      mesh->texture_coordinates = is_textured && is_textured(*node);
    add_body(scene, body);
  }
  scene.time = read_settings<TimeSettings>(*preset.child("time"));
  duration_of(scene.time); // which is missed before the scene is made
  scene.build_seconds = wall_clock() - start;
  return scene;
}

} // namespace rend
