// Springs in solids: their number and places, and that folding does not change forces.
#include "sim/mechanics/shear_volume.h"

#include "sim/elements.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace rend::shear_volume_test {
namespace {

using namespace elements;

struct SolidSpring {
  std::string element, kind, where;
};

std::unique_ptr<Interaction> spring(EmbeddedMap& map, const SolidSpring& wanted, bool surface,
                                    std::vector<std::string>& notes) {
  SpringSettings settings;
  settings.k = 7;
  settings.damping = 0.3;
  for (const InteractionType& each : all_interactions())
    if (each.element == wanted.element && each.kind == wanted.kind && each.where == wanted.where)
      return each.make(map, {settings, wanted.element, {}, notes, surface});
  return nullptr;
}

const std::vector<SolidSpring> all_kinds{{"stretch", "", ""},
                                         {"shear", "isotropic", "face"},
                                         {"shear", "anisotropic", "face"},
                                         {"shear", "isotropic", "volume"},
                                         {"shear", "anisotropic", "volume"}};

struct SpringsOn {
  bool fold = true;
  bool surface = false; // alone
};

std::unique_ptr<Body> solid_of_springs(BarPattern pattern, const std::vector<SolidSpring>& springs,
                                       const SpringsOn& on) {
  auto made = std::make_unique<Body>();
  made->map = solid_from(warped_bar(pattern, 3, 2, 2, 0.1, 3));
  made->mass = &made->map->add(CornerMass{}.on(*made->map));
  for (const SolidSpring& each : springs)
    if (auto added = spring(*made->map, each, on.surface, made->notes))
      made->interactions.push_back(std::move(added));
  ProgramOptions options;
  options.fold = on.fold;
  made->program = std::make_unique<Program>(*made->map, made->interactions, *made->mass, made->drag, options);
  meshes::shake(*made, 0.2, 5);
  return made;
}

std::size_t live(const Body& body, std::size_t n) {
  return body.program->folded()[n].rows().live_count();
}

std::vector<Record> forces_of(const Body& body) {
  std::vector<Record> forces(body.program->vertices());
  body.program->forces(meshes::positions(body), meshes::velocities(body), forces.data());
  return forces;
}

TEST(SolidSprings, are_as_many_as_edges_and_diagonals) { // 3 × 2 × 2 boxes
  const auto folded = solid_of_springs(BarPattern::Hexahedra, all_kinds, {.fold = true});
  const auto unfolded = solid_of_springs(BarPattern::Hexahedra, all_kinds, {.fold = false});
  const std::size_t boxes = 12, edges = 3 * 9 + 2 * 12 + 2 * 12, faces = 4 * 4 + 3 * 6 + 3 * 6;
  EXPECT_EQ(live(*folded, 0), edges);
  EXPECT_EQ(live(*unfolded, 0), boxes * 24);
  for (std::size_t shear : {1u, 2u}) {
    EXPECT_EQ(live(*folded, shear), 2 * faces);
    EXPECT_EQ(live(*unfolded, shear), boxes * 12);
  }
  for (std::size_t shear : {3u, 4u}) {
    EXPECT_EQ(live(*folded, shear), 4 * boxes);
    EXPECT_EQ(live(*unfolded, shear), 4 * boxes);
  }
}

TEST(SolidSprings, of_volumes_are_the_diagonals_through_the_middle) {
  for (std::size_t kind : {3u, 4u}) {
    const auto body = solid_of_springs(BarPattern::Hexahedra, {all_kinds[kind]}, {.fold = true});
    const PackedRows& rows = body->program->folded()[0].rows();
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
    rows.for_each([&](std::size_t, std::size_t row) {
      const std::uint32_t i = rows.index(0)[row], j = rows.index(1)[row];
      const Vec3 apart = body->map->rest()[j].vec() - body->map->rest()[i].vec();
      EXPECT_GT(apart.norm(), std::sqrt(3.0) - 0.5); // at most √2 + 0.35 across a face
      EXPECT_GT(apart.cwiseAbs().minCoeff(), 0.7);   // one box along each axis
      EXPECT_NEAR(rows.value(2, row), apart.norm(), 1e-15);
      pairs.insert(std::minmax(i, j));
    });
    EXPECT_EQ(pairs.size(), 48u); // each once
  }
}

TEST(SolidSprings, give_the_same_forces_folded_or_not) {
  for (BarPattern pattern : {BarPattern::Hexahedra, BarPattern::Prisms, BarPattern::Mixed}) {
    const auto folded = solid_of_springs(pattern, all_kinds, {.fold = true});
    const auto unfolded = solid_of_springs(pattern, all_kinds, {.fold = false});
    EXPECT_LT(meshes::difference(forces_of(*folded), forces_of(*unfolded)), 1e-13);
    EXPECT_GT(meshes::largest(forces_of(*folded)), 1);
  }
}

// the same k: they differ only in the element that owns them
TEST(SolidSprings, of_one_sort_in_both_kinds_of_shear_pull_alike) {
  for (const char* where : {"face", "volume"}) {
    const auto one = solid_of_springs(BarPattern::Hexahedra, {{"shear", "isotropic", where}}, {.fold = true});
    const auto other =
        solid_of_springs(BarPattern::Hexahedra, {{"shear", "anisotropic", where}}, {.fold = true});
    EXPECT_LT(meshes::difference(forces_of(*one), forces_of(*other)), 1e-13) << where;
  }
}

TEST(SolidSprings, on_the_surface_leave_the_inside_alone) {
  const auto body = solid_of_springs(BarPattern::Hexahedra, {all_kinds[0], all_kinds[1], all_kinds[2]},
                                     {.fold = false, .surface = true});
  EXPECT_EQ(live(*body, 0), 4u * 32); // 2 (3·2 + 3·2 + 2·2) sides of boxes outside
  EXPECT_EQ(live(*body, 1), 2u * 32);
  EXPECT_EQ(live(*body, 2), 2u * 32);
}

TEST(SolidSprings, of_volumes_are_left_out_where_there_is_no_hexahedron) {
  const auto body = solid_of_springs(BarPattern::Tetrahedra, {all_kinds[3], all_kinds[4]}, {.fold = true});
  EXPECT_TRUE(body->interactions.empty());
  ASSERT_EQ(body->notes.size(), 2u);
  EXPECT_NE(body->notes[0].find("no cell is a hexahedron"), std::string::npos);
}

} // namespace
} // namespace rend::shear_volume_test
