// Divisions of cells by the rules of sim/rules, which say what their new darts come from.
#pragma once

#include "sim/embedding/embedded_map.h"
#include "sim/house_rules/house_rules.h"
#include "sim/random_meshes.h"
#include "sim/rules/apply.h"
#include "sim/topology/walk.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace rend::divided {

// Equal weights for one dart of each vertex of orbit(d), by positions from before.
inline std::vector<Parent> mean_of(const Edit& edit, Orbit orbit, Dart d) {
  std::vector<Parent> all;
  for (const Dart e : darts_of(edit.map(), orbit, d)) {
    bool known = false;
    for (const Parent& other : all) known = known || same_cell(edit.map(), Vertex, other.dart, e);
    if (!known) all.push_back({e, 1});
  }
  for (Parent& parent : all) parent.weight = 1 / static_cast<double>(all.size());
  return all;
}

// Applies the rule, and records for its new darts: the element and the side in which they lie, as those of dart
// `a` of their instance; and, of the darts of `vertices[n]`, that they are at the mean of the vertices of
// `orbits[n]`.
inline Applied apply_with_parents(const Rule& rule, Edit& edit, Dart hook, const std::string& vertices,
                                  const std::vector<Orbit>& orbits, const std::string& on_side,
                                  const std::string& created) {
  const GMap& map = edit.map();
  std::vector<std::vector<std::vector<Parent>>> means(vertices.size()); // [node][dart]
  for (std::size_t n = 0; n < vertices.size(); ++n) {
    means[n].resize(map.capacity());
    map.for_each_dart([&](Dart d) { means[n][d.value] = mean_of(edit, orbits[n], d); });
  }
  Applied done = apply(rule, edit, hook);
  if (!done.ok) return done;
  const std::vector<Dart> from = done.darts("a");
  for (std::size_t n = 0; n < vertices.size(); ++n) {
    const std::vector<Dart> darts = done.darts(std::string(1, vertices[n]));
    for (std::size_t k = 0; k < from.size(); ++k) edit.inherit(darts[k], Vertex, means[n][from[k].value]);
  }
  for (const char node : created) {
    const std::vector<Dart> darts = done.darts(std::string(1, node));
    for (std::size_t k = 0; k < from.size(); ++k) {
      const std::array<Parent, 1> parent{Parent{from[k], 1}};
      edit.inherit(darts[k], element_orbit(map.dimension()), parent);
      if (on_side.find(node) != std::string::npos) edit.inherit(darts[k], EdgeOfFace, parent);
    }
  }
  return done;
}

inline bool subdivided(Edit& edit, Dart d) {
  return apply_with_parents(rule("quarter-faces"), edit, d, "bcd", {Edge, Edge, FaceOfVolume}, "b", "bcd").ok;
}
inline bool triangulated(Edit& edit, Dart d) {
  return apply_with_parents(rule("star-face"), edit, d, "bc", {SingleDart, FaceOfVolume}, "", "bc").ok;
}
inline bool triangulated_both_sides(Edit& edit, Dart d) {
  return apply_with_parents(rule("star-face-both-sides"), edit, d, "bc", {SingleDart, Face}, "", "bc").ok;
}
inline bool vertex_inserted(Edit& edit, Dart d) {
  return apply_with_parents(rule("insert-vertex"), edit, d, "c", {Edge}, "c", "c").ok;
}

struct Division {
  std::string name;
  std::function<void(Edit&, meshes::Noise&)> change;
};

inline Dart any(const GMap& map, meshes::Noise& noise) {
  const std::vector<Dart> darts = assets::all_darts(map);
  return darts[noise.below(darts.size())];
}

inline const std::vector<Division>& divisions() {
  static const std::vector<Division> all{
      {"subdivide", [](Edit& edit, meshes::Noise&) { ASSERT_TRUE(subdivided(edit, Dart{0u})); }},
      {"triangulate a face",
       [](Edit& edit, meshes::Noise& n) { ASSERT_TRUE(triangulated(edit, any(edit.map(), n))); }},
      {"insert a vertex",
       [](Edit& edit, meshes::Noise& n) { ASSERT_TRUE(vertex_inserted(edit, any(edit.map(), n))); }},
      {"several", [](Edit& edit, meshes::Noise& n) {
         for (int k = 0; k < 3; ++k) {
           ASSERT_TRUE(vertex_inserted(edit, any(edit.map(), n)));
           ASSERT_TRUE(triangulated(edit, any(edit.map(), n)));
         }
       }}};
  return all;
}

inline PolygonMesh flat(PolygonMesh mesh) {
  for (Vec3& x : mesh.points) x.z() = 0;
  return mesh;
}

} // namespace rend::divided
