// Pieces: how many there are, of what size, how smooth their walls are, and how a body breaks into them.
#include "sim/build/pieces.h"
#include "sim/font/font.h"
#include "sim/fracture/piece.h"
#include "sim/mechanics/mass.h"
#include "sim/presets.h"
#include "sim/topology/count.h"
#include "sim/topology/walk.h"
#include "tests/test_paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace rend::pieces_test {
namespace {

struct Shape {
  std::string name, xml;
  double measure; // [m³], of sheets [m²]
  bool convex = true;
};

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all{
      {"sheet", R"(<sheet pattern="triangles" cells="24 18" size="1.2 0.9"/>)", 1.08},
      {"crossed", R"(<sheet pattern="crossed" cells="16 12" size="1.2 0.9"/>)", 1.08},
      {"an L",
       R"(<sheet pattern="quads" cells="2 2" size="1.2 1.2"/>)"
       R"(<apply rule="delete-face" box="0.599 0.599 -1  1.3 1.3 1"/><subdivide times="4"/>)"
       R"(<apply rule="split-into-triangles"/>)",
       1.08, false},
      {"block", R"(<bar pattern="tetrahedra" cells="12 8 6" size="1.2 0.8 0.6"/>)", 0.576},
      {"plate", R"(<bar pattern="tetrahedra" cells="24 18 2" size="1.2 0.9 0.08"/>)", 0.0864},
      {"a U",
       R"(<bar cells="3 1 3" size="0.9 0.3 0.9"/>)"
       R"(<apply rule="delete-volume" box="0.299 -1 0.599  0.601 1 1"/><subdivide times="2"/>)"
       R"(<apply rule="split-into-tetrahedra"/>)",
       0.9 * 0.3 * 0.9 - 0.3 * 0.3 * 0.3, false}};
  return all;
}

std::string scene(const Shape& shape, const std::string& pieces, const std::string& more = "",
                  double duration = 1) {
  const bool is_sheet = shape.xml.starts_with("<sheet") ||
                        (shape.xml.starts_with("<outline") && shape.xml.find("depth") == std::string::npos);
  const std::string thickness = is_sheet ? R"( thickness="0.01")" : "";
  return "<scene><body>" + shape.xml + pieces + R"(<mass density="1000")" + thickness +
         R"(/><elasticity model="corotational" young="1e6" poisson="0.25")" + thickness + "/>" + more +
         R"(</body><world gravity="0 0 0"/><time integrator="symplectic" step="auto" duration=")" +
         std::to_string(duration) + R"("/></scene>)";
}

std::string pieces(int count, const std::string& more = R"(seed="7")") {
  return "<pieces count=\"" + std::to_string(count) + "\" " + more + "/>";
}

double size_of(const EmbeddedMap& map, Dart element) {
  return map.dimension() == 2 ? rest_area(map, element) : rest_volume(map, element);
}

template <class F> void for_each_element(const EmbeddedMap& map, F&& f) {
  const CellIndex& elements = map.cells(element_orbit(map.dimension()));
  for (Slot e = 0; e < elements.slots(); ++e)
    if (elements.alive(e)) f(e, elements.first_dart(e));
}

std::map<std::uint32_t, double> sizes_of_pieces(const EmbeddedMap& map) {
  const PieceColumn& of = *find_pieces(map);
  std::map<std::uint32_t, double> sizes;
  for_each_element(map, [&](Slot e, Dart d) { sizes[of[e]] += size_of(map, d); });
  return sizes;
}

bool is_wall(const EmbeddedMap& map, Dart d) {
  const PieceColumn& of = *find_pieces(map);
  const Dart there = map.map().alpha(map.dimension(), d);
  return of[map.slot(of.orbit(), d)] != of[map.slot(of.orbit(), there)];
}

// As nothing else in this test or in what it tests does it: by taking the body apart.
std::size_t fragments_apart(EmbeddedMap& map) {
  map.edit([&](Edit& edit) {
    std::vector<Dart> darts;
    map.map().for_each_dart([&](Dart d) {
      if (is_wall(map, d)) darts.push_back(d);
    });
    for (Dart d : darts)
      if (!map.map().is_free(map.dimension(), d)) unsew(edit, map.dimension(), d);
  });
  return count_cells(map.map()).fragments;
}

TEST(Pieces, are_as_many_as_asked_for_connected_and_of_similar_size) {
  for (const Shape& shape : shapes())
    for (const int count : {7, 20, 100}) {
      SCOPED_TRACE(shape.name + " in " + std::to_string(count));
      const auto loaded = presets::load(scene(shape, pieces(count)));
      EmbeddedMap& map = *loaded.body().map;
      EXPECT_EQ(validate(map), std::nullopt);
      const auto sizes = sizes_of_pieces(map);
      double least = 1e9, most = 0, sum = 0;
      for (const auto& [piece, size] : sizes) {
        least = std::min(least, size);
        most = std::max(most, size);
        sum += size;
      }
      EXPECT_EQ(sizes.size(), static_cast<std::size_t>(count));
      EXPECT_NEAR(sum, shape.measure, 1e-12 * shape.measure);
      EXPECT_LE(most, 3.2 * least);
      EXPECT_EQ(fragments_apart(map), static_cast<std::size_t>(count));
    }
}

// Shapes with curved borders, holes, thin walls and sharp corners.
std::vector<Shape> curved_shapes() {
  std::vector<Shape> all;
  for (const std::string name : {"heart", "star", "disc", "ring"})
    all.push_back({name, R"(<outline shape=")" + name + R"(" size="1" cell="0.05" depth="0.15"/>)", 0, false});
  if (has_font()) all.push_back({"a letter", R"(<outline text="R" size="1" cell="0.04"/>)", 0, false});
  all.push_back({"a bar", R"(<bar pattern="tetrahedra" cells="24 4 4" size="2.4 0.4 0.4"/>)", 0});
  all.push_back({"a tube",
                 R"(<tube cells="16 12" size="0.4 0.4 0.8" wall="0.05"/><apply rule="split-into-tetrahedra"/>)",
                 0, false});
  all.push_back({"a sheet", R"(<sheet pattern="crossed" cells="30 20" size="1.5 1"/>)", 0});
  all.push_back({"a bowl",
                 R"(<mesh file=")" + std::string(test::source_root) + R"(/presets/showcase/meshes/bowl.msh"/>)",
                 0, false});
  return all;
}

double whole_of(const EmbeddedMap& map) {
  double sum = 0;
  for_each_element(map, [&](Slot, Dart d) { sum += size_of(map, d); });
  return sum;
}

TEST(Pieces, of_curved_and_thin_shapes_are_as_many_as_asked_for_and_connected) {
  for (const Shape& shape : curved_shapes()) {
    const auto uncut = presets::load(scene(shape, ""));
    const double whole = whole_of(*uncut.body().map);
    for (const int count : {7, 20, 100}) {
      SCOPED_TRACE(shape.name + " in " + std::to_string(count));
      const auto loaded = presets::load(scene(shape, pieces(count)));
      EmbeddedMap& map = *loaded.body().map;
      EXPECT_EQ(validate(map), std::nullopt);
      double least = 1e9, most = 0;
      const auto sizes = sizes_of_pieces(map);
      for (const auto& [piece, size] : sizes) {
        least = std::min(least, size);
        most = std::max(most, size);
      }
      EXPECT_EQ(sizes.size(), static_cast<std::size_t>(count));
      EXPECT_NEAR(whole_of(map), whole, 0.01 * whole);
      EXPECT_LE(most, 3.4 * least);
      EXPECT_EQ(fragments_apart(map), static_cast<std::size_t>(count));
    }
  }
}

TEST(Pieces, of_every_pattern_are_as_many_as_asked_for) {
  for (const Shape& shape : shapes())
    for (const std::string pattern : {"radial", "slabs", "bricks"})
      for (const int count : {2, 7, 33}) {
        SCOPED_TRACE(shape.name + " in " + std::to_string(count) + ", " + pattern);
        const std::string at = pattern == "radial" ? R"(" at="0.3 0.3 0.3)" : "";
        const auto loaded = presets::load(scene(shape, pieces(count, "pattern=\"" + pattern + at + "\"")));
        EmbeddedMap& map = *loaded.body().map;
        double least = 1e9, most = 0;
        for (const auto& [piece, size] : sizes_of_pieces(map)) {
          least = std::min(least, size);
          most = std::max(most, size);
        }
        EXPECT_LE(most, 3.4 * least);
        EXPECT_EQ(fragments_apart(map), static_cast<std::size_t>(count));
      }
}

// How far the corners of walls are from the planes of the pattern, which is made anew of the body without
// pieces.
TEST(Pieces, have_walls_in_the_planes_between_their_seeds) {
  for (const Shape& shape : shapes()) {
    if (!shape.convex) continue; // some are divided again there
    SCOPED_TRACE(shape.name);
    const auto whole = presets::load(scene(shape, ""));
    const PiecesSettings settings{.count = 20, .seed = 7};
    const auto samples = samples_of(*whole.body().map, 200 * 20);
    const PiecePattern pattern = voronoi_pattern(settings, samples);
    const auto loaded = presets::load(scene(shape, pieces(20)));
    const EmbeddedMap& map = *loaded.body().map;
    double exact = 0, all = 0, farthest_off = 0; // [m], of edges
    map.map().for_each_dart([&](Dart d) {
      if (!is_wall(map, d)) return;
      const Vec3 a = map.rest_of(d), b = map.rest_of(map.map().alpha(0, d));
      double off = 1e9;
      for (const Wall& wall : pattern.walls)
        off = std::min(off, std::max(std::abs(wall.plane.height(a)), std::abs(wall.plane.height(b))));
      (off < 1e-9 ? exact : all) += (b - a).norm();
      farthest_off = std::max(farthest_off, off);
    });
    all += exact;
    EXPECT_GE(exact, 0.87 * all);
    EXPECT_LE(farthest_off, 0.05); // cells have sides of 0.05 m, in the block of 0.1 m
  }
}

std::string pulled(const std::string& law) {
  return R"(<drive all="yes" gradient="0.02 0 0  0 0.02 0  0 0 0.02" until="0.001" then="free"/><tear )" + law +
         "/>";
}

TEST(Pieces, are_the_same_bytes_on_any_number_of_threads_and_each_time) {
  for (const Shape& shape : shapes()) {
    const std::string law = R"(criterion="vertex-stress" threshold="6e4" change="split-vertex")";
    const std::string text = scene(shape, pieces(20), pulled(law), 0.01);
    const auto one = presets::load(text), two = presets::load(text, {.threads = 2}),
               again = presets::load(text);
    for (int n = 0; n < 20; ++n)
      for (const auto* each : {&one, &two, &again}) (*each)->step();
    EXPECT_GT(one.scene->tears(), 0u) << shape.name;
    EXPECT_EQ(one.scene->hash(), two.scene->hash()) << shape.name;
    EXPECT_EQ(one.scene->hash(), again.scene->hash()) << shape.name;
    EXPECT_EQ(find_pieces(*one.body().map)->values(), find_pieces(*two.body().map)->values());
  }
}

// What is held stretched until it has broken: where walls are weak enough, all of them break, and nothing else.
TEST(Pieces, come_apart_along_all_walls_and_nowhere_else) {
  for (const std::string law : {R"(criterion="vertex-stress" threshold="2e5" change="split-vertex")",
                                R"(criterion="vertex-stress" threshold="2e5" change="cut")",
                                R"(criterion="vertex-stress" threshold="2e5" change="separate")",
                                R"(criterion="atomic-border" threshold="1e5")"})
    for (const std::size_t n : {std::size_t{0}, std::size_t{3}}) {
      const Shape& shape = shapes()[n];
      SCOPED_TRACE(shape.name + ", " + law);
      const std::string strength = law.find("border") == std::string::npos ? "0.05" : "1e-5";
      const auto loaded = presets::load(
          scene(shape, pieces(20, "seed=\"7\" strength=\"" + strength + "\""), pulled(law), 0.003));
      const auto sizes = sizes_of_pieces(*loaded.body().map);
      while (loaded->time() < 0.0015) loaded->step();
      const EmbeddedMap& map = *loaded.body().map;
      std::map<std::uint32_t, double> fragments;
      std::map<std::uint32_t, std::uint32_t> piece_of;
      const std::vector<std::uint32_t> label = label_fragments(map.map());
      for_each_element(map, [&](Slot e, Dart d) {
        fragments[label[d.value]] += size_of(map, d);
        piece_of[label[d.value]] = (*find_pieces(map))[e];
      });
      EXPECT_EQ(fragments.size(), 20u);
      for (const auto& [fragment, size] : fragments)
        EXPECT_NEAR(size, sizes.at(piece_of.at(fragment)), 1e-12 * shape.measure);
    }
}

TEST(Pieces, are_held_by_walls_that_a_law_does_not_know) {
  for (const std::string law : {R"(criterion="atomic-element" threshold="2e5" change="delete-element")",
                                R"(criterion="vertex-stress" threshold="2e5" change="delete-edge")",
                                R"(criterion="atomic-element" threshold="2e5" change="split-vertex")"}) {
    const auto loaded = presets::load(scene(shapes()[3], pieces(20, R"(strength="0.05")"), pulled(law), 0.003));
    while (loaded->time() < 0.0015) loaded->step();
    EXPECT_EQ(loaded.scene->tears(), 0u) << law;
  }
}

// From 2 m: at 6.26 m/s.
TEST(Pieces, of_a_block_that_falls_are_its_large_fragments) {
  const auto loaded = presets::load(
      R"(<scene><body><bar pattern="tetrahedra" cells="8 5 5" size="0.8 0.5 0.5"/><pieces count="12" seed="7"/>
      <place rotate="20 30 10" translate="0 0 0.402" velocity="0 0 -6.26"/><mass density="2000"/>
      <elasticity model="corotational" young="2e7" poisson="0.25" damping-mass="1" damping-stiffness="5e-6"/>
      <tear criterion="vertex-stress" threshold="4e5" change="split-vertex"/>
      <contact with="floor fragments" thickness="0.004" friction="0.5"/></body>
      <world gravity="0 0 -9.81"><floor z="0"/></world>
      <time integrator="symplectic" step="auto" duration="0.05"/></scene>)");
  while (loaded->time() < 0.04) loaded->step();
  const EmbeddedMap& map = *loaded.body().map;
  std::map<std::uint32_t, double> fragments;
  const std::vector<std::uint32_t> label = label_fragments(map.map());
  for_each_element(map, [&](Slot, Dart d) { fragments[label[d.value]] += size_of(map, d) / 0.2; });
  const auto large = std::ranges::count_if(fragments, [](const auto& each) { return each.second > 0.01; });
  EXPECT_GE(large, 4);
  EXPECT_LE(large, 12);
}

std::string refusal(const std::string& shape, const std::string& pieces) {
  try {
    presets::load(scene({"", shape, 1}, pieces));
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::BadInput);
    const std::string what = error.what();
    return what.substr(what.find(' ') + 1); // after its place
  }
  return "";
}

TEST(Pieces, are_refused_where_they_cannot_be) {
  const std::string sheet = R"(<sheet pattern="triangles" cells="4 4" size="1 1"/>)";
  EXPECT_EQ(refusal(R"(<bar cells="2 2 2" size="1 1 1"/>)", pieces(4)),
            "pieces are cut out of triangles and tetrahedra, and this body has other elements");
  EXPECT_EQ(refusal(sheet, pieces(40)), "the 32 elements of this body make no 40 pieces");
  EXPECT_EQ(refusal(sheet, pieces(4, R"(pattern="radial")")),
            "pattern=\"radial\" needs a point, where its rays meet");
  EXPECT_EQ(refusal(sheet, pieces(4, R"(pattern="radial" at="3 0 0")")),
            "the rays would meet outside of the body");
}

} // namespace
} // namespace rend::pieces_test
