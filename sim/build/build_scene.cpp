#include "sim/build/build_scene.h"

#include "sim/base/wall_clock.h"
#include "sim/build/build_body.h"
#include "sim/build/build_world.h"
#include "sim/build/scene_types.h"

#include <fmt/format.h>

#include <set>

namespace rend {
namespace {

void build_bodies(SceneDefinition& scene, const PresetNode& preset) {
  std::set<std::string> names;
  for (const PresetNode* node : preset.all("body")) {
    if (!names.insert(node->text("name")).second)
      throw UserError(Exit::BadInput, node->place(),
                      fmt::format("two bodies are called '{}'", node->text("name")),
                      "give each a name of its own");
    scene.bodies.push_back(build_body(*node, scene.world));
    Body& body = *scene.bodies.back();
    if (scene.world.wind) body.loads.set(WindLoad(*body.map, *scene.world.wind));
  }
}

void check_probes(const PresetNode& preset) {
  std::set<std::string> names;
  for (const PresetNode* body : preset.all("body"))
    for (const PresetNode* probe : body->all("probe"))
      if (!names.insert(probe->text("name")).second)
        probe->fail("name", fmt::format("two probes are called '{}'", probe->text("name")),
                    "give each a name of its own, also in different bodies");
}

TimeSettings time_settings(const PresetNode& time) {
  TimeSettings out;
  out.scheme = find_scheme(time.text("integrator"));
  if (!time.is_word("step")) out.step = time.number("step");
  if (time.given("tolerance")) out.tolerance = time.number("tolerance");
  out.duration = duration_of(time);
  out.step_place = time.place("step");
  out.integrator_place = time.place("integrator");
  out.tolerance_place = time.place("tolerance");
  return out;
}

} // namespace

SceneDefinition read_scene(const PresetNode& preset) {
  const double start = wall_clock();
  SceneDefinition scene;
  scene.name = preset.text("name");
  scene.world = build_world(preset.child("world"));
  build_bodies(scene, preset);
  check_probes(preset);
  scene.time = time_settings(*preset.child("time"));
  scene.build_seconds = wall_clock() - start;
  return scene;
}

} // namespace rend
