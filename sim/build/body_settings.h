// All that makes a body, as a preset says it or a program fills it in.
//
//   BodySettings cloth;
//   cloth.shape = SheetShape{.nx = 20, .ny = 20, .size = {{1, 1}}};
//   cloth.mass.total = 0.1;
//   cloth.springs = SpringsSettings{.springs = {{.type = find_interaction("stretch"), .k = 60}}};
//   cloth.motions = {FixSettings{.where = {.side = "+y"}}};
//   SceneDefinition scene;
//   add_body(scene, cloth);
//
// Each part is a struct of settings beside the code that uses it, with its fields, units and defaults
// (sim/base/settings.h). Selectors and names are those of a preset.
#pragma once

#include "sim/body/answer.h"
#include "sim/body/probe.h"
#include "sim/build/construction.h"
#include "sim/build/shape.h"
#include "sim/fracture/tear_law.h"
#include "sim/mechanics/elasticity.h"
#include "sim/mechanics/mass.h"
#include "sim/mechanics/springs.h"
#include "sim/outside/constraint.h"
#include "sim/outside/contact_settings.h"
#include "sim/outside/load.h"

#include <optional>
#include <string>
#include <vector>

namespace rend {

struct BodySettings {
  std::string name = "body"; // to tell bodies apart
  ShapeSettings shape = SheetShape{};
  std::vector<ApplySettings> applies = {};   // rules that construct, before the body is placed
  std::vector<SlitSettings> slits = {};      // likewise, after them
  std::optional<PiecesSettings> pieces = {}; // likewise, after those
  Placement place = {};
  MassSettings mass = {};
  std::optional<SpringsSettings> springs = {};
  std::optional<ElasticitySettings> elasticity = {};
  std::optional<ViscositySettings> viscosity = {};
  std::vector<MotionSettings> motions = {}; // where several prescribe the same, the last counts
  std::vector<LoadSettings> loads = {};
  std::vector<LawSettings> tears = {};
  std::optional<ContactSettings> contact = {};
  std::vector<ProbeSettings> probes = {};
  std::vector<AnswerSettings> answers = {};
  RuleBook rules = {}; // that applies and tears may name, besides the house's
  SettingsSource source = {};
};
template <> const Fields<BodySettings>& fields_of(); // those of its own

} // namespace rend
