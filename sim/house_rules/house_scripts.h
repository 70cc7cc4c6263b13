// The scripts that rend knows by itself, each in a file of its own. To add one: a file with a function that
// returns its ScriptSettings, and its name in house_script_settings() (house_scripts.cpp), after those that
// it applies.
#pragma once

#include "sim/house_rules/house_rules.h"
#include "sim/rules/script.h"

#include <optional>
#include <string_view>
#include <vector>

namespace rend {

// All of them, checked when first asked for.
const std::vector<Script>& house_scripts();
const Script* find_house_script(std::string_view name); // null: there is none
const Script& script(std::string_view name);            // CHECK: there is one

std::optional<RuleOrScript> find_house_rule_or_script(std::string_view name);

// As they are written.
std::vector<ScriptSettings> house_script_settings();

// Refinement.
ScriptSettings split_into_triangles();
ScriptSettings split_into_tetrahedra();
ScriptSettings divide_tetrahedra();
// Construction.
ScriptSettings extrude_hull();
// Fracture.
ScriptSettings delete_face();
ScriptSettings delete_volume();
ScriptSettings delete_faces_at_edge();
ScriptSettings delete_volumes_at_edge();
ScriptSettings split_vertex_of_sheet();
ScriptSettings split_vertex_of_solid();

} // namespace rend
