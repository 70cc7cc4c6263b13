// The rules that rend knows by itself, each in a file of its own. A preset may use them by name, or write
// others. To add one: a file with a function that returns its RuleSettings, and its name in house_settings()
// (house_rules.cpp). `rend rule check` checks them when the program is built.
#pragma once

#include "sim/rules/rule.h"

#include <string_view>
#include <vector>

namespace rend {

// All of them, checked and compiled when first asked for.
const std::vector<Rule>& house_rules();
const Rule* find_house_rule(std::string_view name); // null: there is none
const Rule& rule(std::string_view name);            // CHECK: there is one

// As they are written.
std::vector<RuleSettings> house_settings();

// Construction.
RuleSettings create_vertex();
RuleSettings extrude_vertex();
RuleSettings extrude_edge();
RuleSettings extrude_face();
RuleSettings extrude_side();
RuleSettings extrude_border();
RuleSettings extrude_sheet();
RuleSettings extrude_away();
RuleSettings create_triangle();
RuleSettings create_quad();
RuleSettings create_tetrahedron();
RuleSettings duplicate();
RuleSettings move();
RuleSettings move_quad_corner();
RuleSettings shape_quad();
RuleSettings turn();
// Sewing.
RuleSettings sew_edges();
RuleSettings sew_faces();
RuleSettings unsew_edge();
RuleSettings unsew_face();
RuleSettings part_faces();
RuleSettings part_volumes();
// Refinement.
RuleSettings insert_vertex_border();
RuleSettings insert_vertex();
RuleSettings insert_edge();
RuleSettings star_face();
RuleSettings star_face_both_sides();
RuleSettings star_volume();
RuleSettings halve_quad();
RuleSettings halve_triangles();
RuleSettings divide_edge_of_triangles();
RuleSettings quarter_faces();
RuleSettings divide_volumes();
RuleSettings halve_tetrahedra();
RuleSettings divide_edge_of_tetrahedra();
RuleSettings sponge();
RuleSettings cut_face_corner();
RuleSettings cut_volume_corner();
RuleSettings divide_bipyramid();
RuleSettings catmull_clark();
RuleSettings flip_edge();
// Removal.
RuleSettings remove_isolated_face();
RuleSettings remove_inner_face();
RuleSettings remove_isolated_volume();
RuleSettings collapse_edge();

} // namespace rend
