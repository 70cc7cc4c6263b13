#include "sim/build/build_scene.h"

#include "sim/base/wall_clock.h"
#include "sim/build/build_body.h"
#include "sim/build/read_body.h"
#include "sim/build/read_settings.h"
#include "sim/build/read_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
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

// Reads each picture once.
class Masks {
public:
  Masks(const MaskReader& read, std::filesystem::path folder) : read_(read), folder_(std::move(folder)) {}

  void give(BodySettings& body) {
    give(body.mass.of_expression, body.mass.density_by_place, body.mass.source);
    for (LawSettings& law : body.tears)
      give(law.strength.of_expression, strength_expression(law.strength, false).value_or(""), law.source);
  }

private:
  void give(ExpressionSettings& expression, const std::string& text, const SettingsSource& source) {
    if (expression.picture.empty() || !read_ || !asks_for_picture(text)) return;
    const std::filesystem::path path = (folder_ / expression.picture).lexically_normal();
    std::shared_ptr<const Mask>& mask = known_[path];
    try {
      if (!mask) mask = read_(path);
    } catch (const UserError& error) { // which names the file
      throw UserError(error.code, source.place("picture"), error.what(),
                      error.code == Exit::NoInput ? "its name is relative to the folder of the preset"
                                                  : error.hint);
    }
    expression.mask = mask;
  }

  const MaskReader& read_;
  std::filesystem::path folder_; // of the preset
  std::map<std::filesystem::path, std::shared_ptr<const Mask>> known_;
};

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

SceneDefinition read_scene(const PresetNode& preset, const ScenePictures& pictures) {
  const double start = wall_clock();
  SceneDefinition scene;
  scene.name = preset.text("name");
  scene.world = read_world(preset.child("world"));
  const RuleBook rules = read_rules(preset);
  Masks masks(pictures.read_mask, std::filesystem::path(preset.place().file).parent_path());
  for (const PresetNode* node : preset.all("body")) {
    BodySettings body = read_body(*node);
    body.rules = rules;
    if (auto* mesh = std::get_if<MeshSettings>(&body.shape))
      mesh->texture_coordinates = pictures.is_textured && pictures.is_textured(*node);
    masks.give(body);
    add_body(scene, body);
  }
  scene.time = read_settings<TimeSettings>(*preset.child("time"));
  duration_of(scene.time); // which is missed before the scene is made
  scene.build_seconds = wall_clock() - start;
  return scene;
}

} // namespace rend
