// Scenes for tests, from the text of a preset.
#pragma once

#include "sim/build/build_scene.h"
#include "sim/build/rule_book.h"
#include "sim/build/scene_types.h"
#include "sim/preset/preset_reader.h"
#include "sim/scene/scene.h"

#include <memory>
#include <string>
#include <utility>

namespace rend::presets {

// The part of the table that the simulation reads.
inline const ElementType& scene_type() {
  static const ElementType type{"scene",
                                "a scene",
                                {text("name", "").otherwise("test")},
                                {{&rules_type(), 0, -1},
                                 {&rule_type(), 0, -1},
                                 {&script_type(), 0, -1},
                                 {&body_type(), 1, -1},
                                 {&world_type(), 0, 1},
                                 {&time_type(), 1, 1}}};
  return type;
}

// A scene, with the preset that it refers to.
struct Loaded {
  std::unique_ptr<PresetNode> preset;
  std::unique_ptr<Scene> scene;
  Scene* operator->() const { return scene.get(); }
  Body& body(std::size_t n = 0) const { return *scene->bodies()[n]; }
};

inline Loaded load(const std::string& xml, const SceneOptions& options = {},
                   const ScenePictures& pictures = {}) {
  Loaded loaded;
  loaded.preset = read_preset_text(xml, "test.xml", scene_type());
  loaded.scene = std::make_unique<Scene>(read_scene(*loaded.preset, pictures), options);
  return loaded;
}

// The cloth of the thesis's fig. 7.17 and table 7.1: two fixed corners. `tear` is XML of tearing laws.
inline std::string cloth(const std::string& pattern, int cells, const std::string& tear = "",
                         const std::string& time = R"(<time step="1e-3" integrator="rk4" duration="1"/>)",
                         const std::string& bend = R"(<bend kind="provot" k="10"/>)",
                         const std::string& more = R"(<fix near="0 0 1"/><fix near="1 0 1"/>)") {
  const std::string n = std::to_string(cells);
  return R"(<scene name="cloth"><body name="cloth"><sheet pattern=")" + pattern + R"(" cells=")" + n + " " + n +
         R"(" size="1 1"/><place rotate="90 0 0"/><mass total="0.1"/>)" +
         R"(<springs><stretch k="60"/><shear kind="isotropic" k="43"/>)" + bend + "</springs>" +
         R"(<viscosity value="0.1" per="body"/>)" + more + tear + "</body>" + time + "</scene>";
}

} // namespace rend::presets
