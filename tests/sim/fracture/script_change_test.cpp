// The four changes of a law, as rules and scripts: on random cells of all kinds of meshes, and in whole runs,
// they give the same states as the functions.
#include "sim/fracture/rule_change.h"
#include "sim/house_rules/house_scripts.h"
#include "sim/mesh/bar.h"
#include "sim/mesh/cells.h"
#include "tests/sim/assets.h"
#include "tests/sim/fracture/torn_bodies.h"
#include "tests/sim/presets.h"

#include <gtest/gtest.h>

namespace rend::script_change_test {
namespace {

struct Twin {
  const char *change, *in_sheets, *in_solids;
  const char* by(int dimension) const { return dimension == 2 ? in_sheets : in_solids; }
};
constexpr Twin twins[] = {{"separate", "unsew-edge", "unsew-face"},
                          {"delete-element", "delete-face", "delete-volume"},
                          {"split-vertex", "split-vertex-of-sheet", "split-vertex-of-solid"},
                          {"delete-edge", "delete-faces-at-edge", "delete-volumes-at-edge"}};

std::vector<std::unique_ptr<EmbeddedMap>> meshes_of(int dimension) {
  std::vector<std::unique_ptr<EmbeddedMap>> made;
  if (dimension == 3) {
    for (BarPattern pattern :
         {BarPattern::Hexahedra, BarPattern::Tetrahedra, BarPattern::Prisms, BarPattern::Mixed})
      made.push_back(solid_from(solids::bar(pattern, 3, 3, 3)));
    return made;
  }
  for (SheetPattern pattern : {SheetPattern::Quads, SheetPattern::Triangles})
    made.push_back(sheet_from(meshes::sheet(pattern, 6, 6)));
  made.push_back(sheet_from(meshes::bricks(7, 5)));
  return made;
}

// The same links, slots and values at the same darts. Only the order in which removed darts are remembered
// may differ.
void expect_same(const EmbeddedMap& one, const EmbeddedMap& other) {
  ASSERT_EQ(assets::links(one.map()), assets::links(other.map()));
  std::size_t differing = 0;
  one.map().for_each_dart([&](Dart d) {
    for (std::uint8_t mask = 0; mask < orbit_kinds; ++mask) {
      Orbit orbit;
      orbit.mask = mask;
      differing += one.uses(orbit) && one.slot(orbit, d) != other.slot(orbit, d);
    }
    differing += one.position_of(d) != other.position_of(d) || one.rest_of(d) != other.rest_of(d);
  });
  ASSERT_EQ(differing, 0u);
}

// One change at a random cell; whether it was made.
bool change_at(Body& body, const ChangeType& type, Dart d, const Vec3& normal) {
  const ForceView view = body.view();
  const Orbit cell = orbit_of(type.cell, body.map->dimension());
  const std::vector<Dart> darts = darts_of(body.map->map(), cell, smallest_dart(body.map->map(), cell, d));
  bool made = false;
  body.map->edit([&](Edit& edit) { made = type.apply(edit, view, normal, darts); });
  body.rebind();
  return made;
}

TEST(ScriptChange, is_the_function_at_random_cells_of_all_meshes) {
  for (int dimension : {2, 3})
    for (const Twin& twin : twins) {
      const ChangeType& function = *find_change(twin.change);
      const auto script = change_by(*find_house_rule_or_script(twin.by(dimension)), dimension);
      // Of a sheet, edges are borders.
      EXPECT_EQ(script->cell, function.cell == Cell::Edges && dimension == 2 ? Cell::Borders : function.cell);
      EXPECT_EQ(script->grows, false);
      auto ones = meshes_of(dimension), others = meshes_of(dimension);
      int made = 0, refused = 0;
      for (std::size_t n = 0; n < ones.size(); ++n) {
        SCOPED_TRACE(std::string(twin.change) + " " + std::to_string(dimension) + " " + std::to_string(n));
        const auto one = torn::body(std::move(ones[n])), other = torn::body(std::move(others[n]));
        meshes::Noise noise(17 + static_cast<unsigned>(n));
        for (int k = 0; k < 60 && one->map->map().dart_count() > 0; ++k) {
          Dart d{static_cast<std::uint32_t>(noise.below(one->map->map().capacity()))};
          while (!one->map->map().alive(d))
            d = Dart{static_cast<std::uint32_t>(noise.below(one->map->map().capacity()))};
          const Vec3 normal = noise.vector().normalized();
          const bool by_function = change_at(*one, function, d, normal);
          ASSERT_EQ(change_at(*other, *script, d, normal), by_function);
          ASSERT_NO_FATAL_FAILURE(expect_same(*one->map, *other->map));
          (by_function ? made : refused) += 1;
        }
      }
      EXPECT_GT(made, 50);
      EXPECT_EQ(refused > 5, function.cell == Cell::Borders || function.cell == Cell::Vertices);
    }
}

// Preset in, state hash and events out.
std::pair<std::uint64_t, std::size_t> run(const std::string& preset, int steps) {
  auto scene = presets::load(preset);
  for (int n = 0; n < steps; ++n) scene->step();
  return {scene->hash(), scene.body().events.size()};
}

TEST(ScriptChange, gives_the_state_hashes_of_the_functions_in_sheets) {
  for (const Twin& twin : twins)
    for (const char* pattern : {"quads", "triangles"}) {
      const auto tear = [&](const std::string& what) {
        return run(
            presets::cloth(pattern, 10, "<tear criterion=\"atomic-border\" threshold=\"0.5\" " + what + "/>"),
            300);
      };
      const auto by_function = tear(std::string("change=\"") + twin.change + "\"");
      EXPECT_GT(by_function.second, 1u) << twin.change;
      EXPECT_EQ(tear(std::string("rule=\"") + twin.in_sheets + "\""), by_function) << twin.change;
    }
}

TEST(ScriptChange, gives_the_state_hashes_of_the_functions_in_solids) {
  for (const Twin& twin : twins)
    for (const char* pattern : {"hexahedra", "tetrahedra"}) {
      const auto tear = [&](const std::string& what) {
        return run(std::string(R"(<scene><body><bar pattern=")") + pattern +
                       R"(" cells="6 3 3" size="0.6 0.3 0.3"/>
            <mass density="1000"/><elasticity model="corotational" young="2e5" poisson="0.3" damping-mass="5"/>
            <drive side="-x" velocity="-0.5 0 0"/><drive side="+x" velocity="0.5 0 0.2"/>
            <tear criterion="atomic-element" threshold="1.2e4" )" +
                       what + R"(/></body><world gravity="0 0 0"/><time step="1e-4" duration="1"/></scene>)",
                   1200);
      };
      const auto by_function = tear(std::string("change=\"") + twin.change + "\"");
      EXPECT_GT(by_function.second, 1u) << twin.change;
      EXPECT_EQ(tear(std::string("rule=\"") + twin.in_solids + "\""), by_function) << twin.change;
    }
}

} // namespace
} // namespace rend::script_change_test
