// Interactions of kinds of cells that a body comes to have: nothing before, all of it afterwards, and in stored
// states.
#include "sim/base/archive.h"
#include "sim/presets.h"
#include "sim/rows/continuum.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend::awaited_interactions_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// A sheet that is pulled apart. `law` is XML of a law.
std::string pulled(const std::string& pattern, const std::string& matter, const std::string& law,
                   const std::string& time = R"(step="2e-4")") {
  return R"xml(<scene><rule name="merge" about="two triangles at their common edge become a quad"
      left="a*(0) b(0) c(_) d(_) a-2-b a-1-c b-1-d a|3 b|3 c|3 d|3" right="c(_) d(_) c-1-d c|3 d|3">
      <when test="size(a, face) == 3 and size(b, face) == 3"/></rule>
    <body><sheet pattern=")xml" +
         pattern + R"xml(" cells="6 4" size="0.6 0.4"/><mass density="1000" thickness="1e-3"/>)xml" + matter +
         R"xml(<drive side="-x" velocity="-0.3 0 0"/><drive side="+x" velocity="0.3 0 0"/>)xml" + law +
         R"xml(</body><world gravity="0 0 0"/><time )xml" + time + R"xml( duration="1"/></scene>)xml";
}

const std::string elastic = R"(<elasticity young="2e5" thickness="1e-3" damping-mass="20"/>)";
const std::string springs =
    R"(<springs><stretch k="60"/><shear kind="isotropic" k="40"/><bend kind="angular" k="1e-4"/></springs>)";

std::string star(const std::string& criterion) {
  return "<tear criterion=" + criterion + R"( rule="star-face" max-per-step="2"/>)";
}
// Divides quads alone: no element becomes smaller than half of one.
std::string halved(const std::string& criterion) {
  return "<tear criterion=" + criterion + R"( rule="halve-quad" max-per-step="2"/>)";
}
const std::string by_strain = R"("strain" threshold="0.01")",
                  by_length = R"("strain" kind="stretch" threshold="0.01")";

std::vector<std::string> columns_of(const Body& body) {
  std::vector<std::string> names;
  for (const auto& column : body.map->columns()) names.push_back(column->name());
  return names;
}

void step_until_torn(Scene& scene) {
  for (int n = 0; n < 1000 && scene.tears() == 0; ++n) scene.step();
  ASSERT_GT(scene.tears(), 0u);
}

TEST(AwaitedInteractions, are_none_where_no_law_makes_cells) {
  const auto plain = presets::load(pulled("quads", elastic, R"(<tear criterion="strain" threshold="0.01"/>)"));
  EXPECT_THAT(plain.body().awaited.names(), IsEmpty());
  EXPECT_THAT(presets::load(pulled("quads", elastic, "")).body().awaited.names(), IsEmpty());
  // unsewing makes no cell of another kind
  const auto parted = presets::load(
      pulled("quads", elastic, R"(<tear criterion="strain" threshold="0.01" rule="unsew-edge"/>)"));
  EXPECT_THAT(parted.body().awaited.names(), IsEmpty());
}

TEST(AwaitedInteractions, have_neither_arrays_nor_rows_before_the_first_cell_is_there) {
  const auto scene = presets::load(pulled("quads", elastic, star(by_strain)));
  const Body& body = scene.body();
  EXPECT_THAT(body.awaited.names(), ElementsAre("co-rotational triangle"));
  EXPECT_THAT(columns_of(body), Not(Contains("co-rotational triangle")));
  EXPECT_EQ(body.program->rows().size(), 1u);
  step_until_torn(*scene.scene);
  EXPECT_THAT(body.awaited.names(), IsEmpty());
  EXPECT_THAT(columns_of(body), Contains("co-rotational triangle"));
  ASSERT_EQ(body.program->rows().size(), 2u);
  EXPECT_EQ(body.program->rows()[1].rows().live_count(), 4 * scene->tears());
}

TEST(AwaitedInteractions, of_springs_come_with_the_first_quad_and_the_first_inner_edge) {
  const auto scene = presets::load(
      pulled("triangles", springs,
             R"(<tear criterion="strain" kind="stretch" threshold="0.01" rule="merge" until="0.5"/>)"));
  const Body& body = scene.body();
  EXPECT_THAT(body.awaited.names(), ElementsAre("shear isotropic"));
  step_until_torn(*scene.scene);
  EXPECT_THAT(body.awaited.names(), IsEmpty());
  EXPECT_EQ(body.interactions.back()->name, "shear isotropic");
  EXPECT_EQ(body.program->rows().back().rows().live_count(), 2 * scene->tears());
}

// What divided elements of constant strain carry does not change with the division: the same displacement, and
// the same stress. That of a warped or unevenly strained quad is its mean.
TEST(AwaitedInteractions, of_divided_elements_carry_the_stress_of_the_whole) {
  for (const char* model : {"linear", "corotational", "mass-tensor"}) {
    const auto scene = presets::load(
        R"(<scene><body><sheet pattern="quads" cells="6 4" size="0.6 0.4"/>
          <mass density="1000" thickness="1e-3"/><elasticity young="2e5" thickness="1e-3" model=")" +
        std::string(model) + R"("/><fix all="yes" axes="z"/>
          <drive all="yes" axes="xy" gradient="2e-3 1e-3 0 5e-4 1e-3 0 0 0 0"/>
          <tear criterion="strain" threshold="1e-4" rule="star-face" until="1e-4"/>
          </body><world gravity="0 0 0"/><time step="2e-4" duration="1"/></scene>)");
    const double before = scene->elastic_energy();
    const auto stress = [&] {
      std::vector<Eigen::Matrix3d> all;
      const Body& body = scene.body();
      Continuum(*body.map, body.interactions)
          .each(body.map->position().values().data(), nullptr,
                [&](const Continuum::Part& part, const CurrentUnit& now) {
                  all.push_back(stress_of(part, now));
                });
      return all;
    };
    const std::vector<Eigen::Matrix3d> whole = stress();
    scene->step();
    EXPECT_EQ(scene->tears(), 24u) << model;
    ASSERT_EQ(stress().size(), 96u) << model;
    for (const Eigen::Matrix3d& part : stress())
      EXPECT_LT((part - whole[0]).norm(), 1e-10 * whole[0].norm()) << model;
    EXPECT_NEAR(scene->elastic_energy(), before, 1e-10 * before) << model;
  }
}

std::vector<std::uint8_t> stored(Scene& scene) {
  Archive archive;
  scene.store(archive);
  return archive.bytes();
}
void restore(Scene& scene, const std::vector<std::uint8_t>& bytes) {
  Archive archive{std::span<const std::uint8_t>(bytes)};
  scene.store(archive);
  archive.end();
}

class StoredNewKinds : public testing::TestWithParam<std::string> {};

TEST_P(StoredNewKinds, go_on_to_the_bit) {
  const auto one = presets::load(GetParam()), other = presets::load(GetParam());
  step_until_torn(*one.scene);
  for (int part = 0; part < 3; ++part) {
    for (int n = 0; n < 5; ++n) one->step();
    const auto bytes = stored(*one.scene);
    restore(*other.scene, bytes);
    EXPECT_TRUE(stored(*other.scene) == bytes);
    EXPECT_TRUE(one.body().program->same_as(*other.body().program));
    for (int n = 0; n < 5; ++n) {
      one->step();
      other->step();
    }
    EXPECT_EQ(one->hash(), other->hash());
    EXPECT_EQ(one->tears(), other->tears());
    EXPECT_EQ(one->elastic_energy(), other->elastic_energy());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, StoredNewKinds,
    testing::Values(
        pulled("quads", elastic, star(by_strain)),
        pulled("quads", elastic, halved(R"("vertex-stress" threshold="2000")")),
        pulled("quads", elastic, halved(R"("atomic-border" threshold="0.02")")),
        pulled("quads", springs, halved(by_length)),
        pulled("triangles", springs,
               R"(<tear criterion="strain" kind="stretch" threshold="0.01" rule="merge" max-per-step="2"/>)"),
        pulled("triangles", elastic,
               R"(<tear criterion="strain" threshold="0.01" rule="merge" max-per-step="2"/>)",
               R"(step="2e-3" integrator="implicit")")));

// Stored states may be forged: no such number of an interaction is taken.
TEST(StoredNewKinds, with_interactions_that_are_not_there_are_refused) {
  const auto one = presets::load(pulled("quads", elastic, star(by_strain)));
  step_until_torn(*one.scene);
  Archive archive;
  AwaitedInteractions forged;
  std::vector<std::uint32_t> arrived{7};
  archive.list(arrived, 8, "");
  Archive reading{std::span<const std::uint8_t>(archive.bytes())};
  const auto other = presets::load(pulled("quads", elastic, star(by_strain)));
  Body& body = other.body();
  EXPECT_THROW(body.awaited.store(reading, *body.map, body.interactions), ArchiveError);
}

} // namespace
} // namespace rend::awaited_interactions_test
