#include "sim/rules/rules.h"

namespace rend {

const std::vector<const Rule*>& all_rules() {
  static const std::vector<const Rule*> rules{&create_vertex,
                                              &create_edge,
                                              &extrude_edge,
                                              &create_triangle,
                                              &create_quad,
                                              &sew_edges,
                                              &sew_faces,
                                              &insert_vertex_border,
                                              &insert_vertex,
                                              &triangulate_face,
                                              &triangulate_face_both_sides,
                                              &subdivide,
                                              &unsew_edge,
                                              &unsew_face,
                                              &remove_isolated_face,
                                              &remove_inner_face,
                                              &remove_isolated_volume};
  return rules;
}

} // namespace rend
