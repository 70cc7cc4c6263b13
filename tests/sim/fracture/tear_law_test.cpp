// Tearing laws in scenes: when they are evaluated, what they refuse, and where sheets tear.
#include "sim/presets.h"
#include "sim/topology/count.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace rend::tear_law_test {
namespace {

std::string pulled(const std::string& sheet, const std::string& laws, const std::string& speed = "0.5") {
  return R"(<scene name="pulled"><body name="sheet">)" + sheet + R"(<mass total="0.1"/>
         <springs><stretch k="60"/><shear kind="isotropic" k="43"/></springs>
         <fix side="-x"/><drive side="+x" velocity=")" +
         speed + R"( 0 0"/>)" + laws + "</body>" +
         R"(<world gravity="0 0 0"/><time step="5e-4" integrator="verlet" duration="1"/></scene>)";
}
const std::string strip = R"(<sheet pattern="quads" cells="8 4" size="2 1"/>)";

void run(Scene& scene, int steps) {
  for (int n = 0; n < steps; ++n) scene.step();
}

TEST(ForceLaw, tears_a_sheet_pulled_apart_across_the_pull) {
  // In quasi-static motion forces at a vertex cancel: the global criterion detects only a quick pull.
  const std::array<std::array<std::string, 3>, 2> pulls{
      {{"global-border", "1", "8"}, {"atomic-border", "1", "0.5"}}};
  for (const auto& [criterion, threshold, speed] : pulls) {
    presets::Loaded scene = presets::load(
        pulled(strip, R"(<tear criterion=")" + criterion + R"(" threshold=")" + threshold + R"("/>)", speed));
    Body& body = scene.body();
    run(*scene.scene, 2000);
    EXPECT_GT(scene->tears(), 3u) << criterion;
    EXPECT_GT(count_cells(body.map->map(), Component), 1u) << criterion;
    ASSERT_GE(body.events.size(), 4u);
    for (std::size_t n = 0; n < 4; ++n) { // as many as there are rows; then it recoils
      const Dart d = body.events[n].dart;
      const Vec3 a = body.map->rest_of(d), b = body.map->rest_of(body.map->map().alpha(0, d));
      EXPECT_LT(std::abs(a.x() - b.x()), 1e-9) << criterion;
    }
    // Each end is still connected to its own side.
    EXPECT_LT((body.map->position_of(Dart{0u}) - Vec3(0, 0, 0)).norm(), 1e-12);
  }
}

TEST(ForceLaw, looks_from_its_beginning_to_its_end_alone) {
  const std::string law = R"(<tear criterion="global-border" threshold="1e-6" from="0.1" until="0.105"/>)";
  presets::Loaded scene = presets::load(pulled(strip, law));
  run(*scene.scene, 200);
  EXPECT_EQ(scene->tears(), 0u);
  run(*scene.scene, 100);
  ASSERT_GT(scene->tears(), 0u);
  for (const TearEvent& e : scene.body().events) {
    EXPECT_GE(e.time, 0.1);
    EXPECT_LE(e.time, 0.105);
    EXPECT_EQ(e.step, static_cast<long>(std::lround(e.time / 5e-4)));
  }
}

TEST(ForceLaw, makes_no_more_changes_a_step_than_it_may) {
  const std::string law = R"(<tear criterion="global-border" threshold="0.01" max-per-step="2"/>)";
  presets::Loaded scene = presets::load(pulled(strip, law));
  std::size_t before = 0;
  bool two = false;
  for (int n = 0; n < 200; ++n) {
    scene->step();
    EXPECT_LE(scene->tears(), before + 2);
    two = two || scene->tears() == before + 2;
    before = scene->tears();
  }
  EXPECT_TRUE(two);
}

TEST(ForceLaw, says_which_of_several_made_a_change) {
  presets::Loaded scene = presets::load(pulled(strip, R"(<tear criterion="atomic-border" threshold="1e9"/>
                                                         <tear criterion="global-border" threshold="0.5"/>)"));
  run(*scene.scene, 600);
  ASSERT_GT(scene->tears(), 0u);
  for (const TearEvent& e : scene.body().events) EXPECT_EQ(e.law, 1);
}

TEST(ForceLaw, tells_where_it_tore) {
  presets::Loaded scene = presets::load(pulled(strip, R"(<tear criterion="global-border" threshold="0.5"/>)"));
  Body& body = scene.body();
  std::size_t seen = 0;
  for (int n = 0; n < 600; ++n) {
    const VertexColumn before = body.map->position();
    const CellIndex vertices = body.map->cells(Vertex);
    scene->step();
    for (; seen < body.events.size(); ++seen) {
      const TearEvent& e = body.events[seen];
      const Vec3 a = before[vertices.slot(e.dart)], b = before[vertices.slot(body.map->map().alpha(0, e.dart))];
      EXPECT_EQ(e.place, Vec3(0.5 * (a + b)));
      EXPECT_EQ(e.step, n);
      EXPECT_GT(e.value, 0.5);
    }
  }
  EXPECT_GT(seen, 0u);
}

TEST(ForceLaw, tears_a_moebius_band) {
  for (const std::string criterion : {"global-border", "atomic-border"}) {
    presets::Loaded scene =
        presets::load(pulled(R"(<sheet pattern="mixed" cells="12 3" size="2 0.4" close="twist"/>)",
                             R"(<tear criterion=")" + criterion + R"(" threshold="0.4"/>)"));
    run(*scene.scene, 1500);
    EXPECT_GT(scene->tears(), 3u) << criterion;
    for (const Record& x : scene.body().map->position().values()) EXPECT_TRUE(x.vec().allFinite());
  }
}

// Two edges tear in one step, and the first deletion removes one side of the second: mirror images tear alike,
// independent of dart numbers.
TEST(ForceLaw, deletes_what_is_left_of_an_edge_in_mirror_images_alike) {
  const auto ends = [](double fixed, double moved) {
    const auto box = [](double x) {
      return fmt::format(R"(<drive box="{} -.1 -1 {} .1 1")", x - 0.1, x + 0.1);
    };
    const presets::Loaded scene = presets::load(
        R"(<scene><body><sheet cells="3 1" size="3 1"/><mass total="1"/><springs><stretch k="20"/></springs>)" +
        box(fixed) + R"( displacement="0 -2 0"/>)" + box(moved) + R"( displacement="0 -1 0"/>)" +
        R"(<tear criterion="atomic-spring" kind="stretch" threshold="15" change="delete-edge"/></body>
           <world gravity="0 0 0"/><time step="1e-3" duration="0.01"/></scene>)");
    scene->step();
    return std::pair(scene->tears(), scene.body().map->use(FaceOfVolume).count());
  };
  EXPECT_EQ(ends(0, 1), std::pair(std::size_t{2}, std::size_t{1}));
  EXPECT_EQ(ends(3, 2), std::pair(std::size_t{2}, std::size_t{1}));
}

TEST(ForceLaw, refuses_what_does_not_fit) {
  const auto refused = [](const std::string& law, const std::string& springs = "") {
    std::string xml = pulled(strip, law);
    if (!springs.empty()) xml.replace(xml.find("<springs>"), 9, springs);
    try {
      presets::load(xml);
    } catch (const UserError& error) {
      return std::string(error.what()) + " hint: " + error.hint;
    }
    return std::string("accepted");
  };
  EXPECT_NE(refused(R"(<tear criterion="sideways" threshold="1"/>)").find("global-border"), std::string::npos);
  EXPECT_NE(refused(R"(<tear criterion="global-border" threshold="1" change="melt"/>)").find("separate"),
            std::string::npos);
  EXPECT_NE(
      refused(R"(<tear criterion="global-border" threshold="1" from="2" until="1"/>)").find("ends before"),
      std::string::npos);
  EXPECT_NE(refused(R"(<tear criterion="atomic-border" threshold="1"/>)", R"(<springs cumulated="yes">)")
                .find("cumulated"),
            std::string::npos);
}

} // namespace
} // namespace rend::tear_law_test
