#include "sim/house_rules/house_rules.h"

#include "sim/base/check.h"

namespace rend {

std::vector<RuleSettings> house_settings() {
  return {create_vertex(),
          extrude_vertex(),
          extrude_edge(),
          extrude_face(),
          extrude_side(),
          extrude_border(),
          extrude_sheet(),
          extrude_away(),
          create_triangle(),
          create_quad(),
          create_tetrahedron(),
          duplicate(),
          move(),
          move_quad_corner(),
          shape_quad(),
          turn(),
          sew_edges(),
          sew_faces(),
          unsew_edge(),
          unsew_face(),
          part_faces(),
          part_volumes(),
          insert_vertex_border(),
          insert_vertex(),
          insert_edge(),
          star_face(),
          star_face_both_sides(),
          star_volume(),
          halve_quad(),
          halve_triangles(),
          divide_edge_of_triangles(),
          quarter_faces(),
          divide_volumes(),
          halve_tetrahedra(),
          divide_edge_of_tetrahedra(),
          sponge(),
          cut_face_corner(),
          cut_volume_corner(),
          divide_bipyramid(),
          catmull_clark(),
          flip_edge(),
          remove_isolated_face(),
          remove_inner_face(),
          remove_isolated_volume(),
          collapse_edge()};
}

const std::vector<Rule>& house_rules() {
  static const std::vector<Rule> rules = [] {
    std::vector<Rule> made;
    for (RuleSettings& settings : house_settings()) made.emplace_back(std::move(settings));
    return made;
  }();
  return rules;
}

const Rule* find_house_rule(std::string_view name) {
  for (const Rule& each : house_rules())
    if (each.name() == name) return &each;
  return nullptr;
}

const Rule& rule(std::string_view name) {
  const Rule* found = find_house_rule(name);
  CHECK_NOTE(found, std::string(name));
  return *found;
}

} // namespace rend
