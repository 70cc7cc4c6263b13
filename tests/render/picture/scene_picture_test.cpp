#include "render/picture/scene_picture.h"

#include "render/draw/camera.h"
#include "render/draw/hud.h"
#include "render/picture/scene_preset.h"
#include "render/picture/viewpoint.h"
#include "sim/build/build_scene.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <set>

namespace rend::scene_picture_test {
namespace {

using Eigen::Vector3f;

// A cloth that is pulled apart, with the given sheet, look and further elements of the scene.
struct Shown {
  std::unique_ptr<PresetNode> preset;
  std::unique_ptr<Scene> scene;
  std::unique_ptr<FrameBuilder> maker;

  explicit Shown(const std::string& sheet, const std::string& look = "", const std::string& more = "",
                 const std::string& moves = R"(<fix side="-x"/><drive side="+x" velocity="4 0 0"/>)") {
    preset =
        load_scene_text(R"(<scene name="shown"><body>)" + sheet +
                            R"(<place rotate="90 0 0"/><mass total="0.1"/><springs><stretch k="60"/>)"
                            R"(<shear kind="isotropic" k="43"/></springs>)" +
                            moves + R"(<tear criterion="global-border" threshold="2"/>)" + look + "</body>" +
                            R"(<time step="1e-3" integrator="rk4" duration="1"/>)" + more + "</scene>",
                        "shown.xml");
    scene = std::make_unique<Scene>(read_scene(*preset), SceneOptions{});
    maker = std::make_unique<FrameBuilder>(picture_settings(*preset), *scene, 1.5, 1.0, 31);
  }
  void steps(int count) {
    for (int n = 0; n < count; ++n) scene->step();
  }
  Frame frame() {
    maker->observe();
    return maker->draw(0, 0);
  }
};

constexpr const char* quads = R"(<sheet cells="6 6" size="1 1"/>)";
constexpr const char* moebius = R"(<sheet cells="24 3" size="3 0.4" close="twist"/>)";

Vector3f position(const Corner& c) {
  return Vector3f(c.position.data());
}
Vector3f normal(const Corner& c) {
  return Vector3f(c.normal.data());
}

std::array<int, 4> count_lines(const FrameBody& body) {
  std::array<int, 4> count{};
  for (std::size_t n = 0; n < body.corners.size(); n += 3)
    for (std::size_t k = 0; k < 3; ++k) ++count[body.corners[n].line[k]];
  return count;
}

std::set<std::array<std::uint8_t, 4>> colours(const FrameBody& body) {
  std::set<std::array<std::uint8_t, 4>> all;
  for (const Corner& corner : body.corners) all.insert(corner.colour);
  return all;
}

TEST(Picture, ShowsAQuadAsTwoTrianglesWithoutTheirDiagonal) {
  Shown shown(quads);
  const FrameBody body = shown.frame().bodies.at(0);
  ASSERT_EQ(body.corners.size(), 2 * 36 * 3);
  const auto [none, cell, border, torn] = count_lines(body);
  EXPECT_EQ(none, 2 * 36);      // the diagonal, from both sides
  EXPECT_EQ(cell, 4 * 36 - 24); // inner edges, from both sides
  EXPECT_EQ(border, 24);
  EXPECT_EQ(torn, 0);
}

TEST(Picture, MarksWhatTearingLaidBare) {
  Shown shown(quads);
  shown.steps(300);
  ASSERT_GT(shown.scene->tears(), 0U);
  const auto [none, cell, border, torn] = count_lines(shown.frame().bodies.at(0));
  EXPECT_EQ(torn, 2 * static_cast<int>(shown.scene->tears()));
  EXPECT_EQ(border, 24);
  EXPECT_EQ(none + cell + border + torn, 2 * 36 * 3);
}

TEST(Picture, DrawsTornEdgesAsThePresetSays) {
  EXPECT_EQ(Shown(quads).frame().bodies.at(0).torn.width, 0);
  EXPECT_EQ(Shown(quads, R"(<look edges="yes"/>)").frame().bodies.at(0).torn, TornLine{});
  EXPECT_EQ(Shown(quads, R"(<look torn="none"/>)").frame().bodies.at(0).torn.width, 0);
  const TornLine line = Shown(quads, R"(<look torn="#00ff33" torn-width="7"/>)").frame().bodies.at(0).torn;
  EXPECT_EQ(line.width, 7);
  EXPECT_EQ(line.colour, (std::array<float, 3>{0, 1, 0.2f * 0.2f}));
}

TEST(Picture, DrawsNoLineWhereCutsAloneTear) {
  const auto width = [](const std::string& laws_and_look) {
    const auto preset = load_scene_text(
        R"(<scene name="cut"><body><sheet pattern="triangles" cells="4 2" size="1 0.5"/><mass total="0.1"/>)"
        R"(<elasticity model="corotational" young="1e5" thickness="1e-3"/>)" +
            laws_and_look + R"(</body><time duration="1"/></scene>)",
        "cut.xml");
    Scene scene(read_scene(*preset), {});
    FrameBuilder maker(picture_settings(*preset), scene, 1.5, 1.0, 31);
    maker.observe();
    return maker.draw(0, 0).bodies.at(0).torn.width;
  };
  const std::string cut = R"(<tear criterion="vertex-stress" threshold="1e4" change="cut"/>)";
  const std::string split = R"(<tear criterion="vertex-stress" threshold="1e4" change="split-vertex"/>)";
  const std::string edges = R"(<look edges="yes"/>)";
  EXPECT_EQ(width(split), 0);
  EXPECT_EQ(width(cut + edges), 0);
  EXPECT_EQ(width(split + edges), TornLine{}.width);
  EXPECT_EQ(width(cut + split + edges), TornLine{}.width);
  EXPECT_EQ(width(cut + R"(<look torn="#00ff33"/>)"), TornLine{}.width);
}

TEST(Picture, TurnsNormalsToTheSideOfTheirTriangle) {
  for (const char* sheet : {quads, moebius}) {
    Shown shown(sheet);
    shown.steps(100);
    const FrameBody body = shown.frame().bodies.at(0);
    for (std::size_t n = 0; n < body.corners.size(); n += 3) {
      const Corner* c = &body.corners[n];
      const Vector3f flat =
          (position(c[1]) - position(c[0])).cross(position(c[2]) - position(c[0])).normalized();
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(normal(c[k]).norm(), 1, 1e-5);
        EXPECT_GT(normal(c[k]).dot(flat), 0) << n;
      }
    }
  }
}

TEST(Picture, GivesAMoebiusBandOneSide) {
  EXPECT_FALSE(Shown(moebius).frame().bodies.at(0).shades_back);
  EXPECT_TRUE(Shown(quads).frame().bodies.at(0).shades_back);
  EXPECT_TRUE(Shown(R"(<sheet cells="8 2" size="1 0.3" close="loop"/>)").frame().bodies.at(0).shades_back);
}

TEST(Picture, KeepsTheColourOfWhatStays) {
  Shown shown(quads, R"(<look by="fragment"/>)");
  const auto before = colours(shown.frame().bodies.at(0));
  EXPECT_EQ(before.size(), 1U);
  std::set<std::array<std::uint8_t, 4>> last = before;
  for (int n = 0; n < 10; ++n) {
    shown.steps(30);
    const auto now = colours(shown.frame().bodies.at(0));
    EXPECT_TRUE(std::includes(now.begin(), now.end(), last.begin(), last.end()));
    last = now;
  }
  EXPECT_GT(last.size(), 1U);
}

TEST(Picture, ScalesColoursToTheLargestSoFar) {
  Shown shown(quads, R"(<look by="strain"/>)");
  EXPECT_EQ(colours(shown.frame().bodies.at(0)).size(), 1U);
  shown.steps(50);
  EXPECT_GT(colours(shown.frame().bodies.at(0)).size(), 3U);
}

TEST(Picture, TakesColourAndSceneFromThePreset) {
  Shown shown(
      quads, R"(<look colour="#102030" edges="no"/>)",
      R"(<world><floor z="-2"/></world><image background="#ff0000"/><camera eye="0 -5 0" target="0 0 0"/>)");
  const Frame frame = shown.frame();
  EXPECT_EQ(frame.bodies.at(0).corners.at(0).colour, (std::array<std::uint8_t, 4>{16, 32, 48, 255}));
  EXPECT_FALSE(frame.bodies.at(0).edges);
  EXPECT_EQ(frame.floor->z, -2);
  EXPECT_EQ(frame.background, (std::array<float, 3>{1, 0, 0}));
  EXPECT_EQ(frame.camera.eye, Eigen::Vector3d(0, -5, 0));
}

// A bar of 4 × 2 × 2 boxes that records its initial borders, and whose halves a test may separate.
struct ShownBar {
  std::unique_ptr<PresetNode> preset;
  std::unique_ptr<Scene> scene;
  std::unique_ptr<FrameBuilder> maker;

  explicit ShownBar(const std::string& look, const std::string& pattern = "hexahedra") {
    preset = load_scene_text(R"(<scene name="bar"><body><bar pattern=")" + pattern +
                                 R"(" cells="4 2 2" size="4 2 2"/><mass total="1"/>)"
                                 R"(<springs><stretch k="60"/></springs><drive side="+x" velocity="4 0 0"/>)" +
                                 look + R"(</body><time step="1e-3" duration="1"/></scene>)",
                             "bar.xml");
    scene = std::make_unique<Scene>(read_scene(*preset), SceneOptions{});
    body().border = &body().map->add(InitialBorder(3));
    maker = std::make_unique<FrameBuilder>(picture_settings(*preset), *scene, 1.5, 1.0, 31);
  }
  Body& body() { return *scene->bodies()[0]; }
  void part() {
    body().map->edit([&](Edit& edit) {
      for (std::uint32_t d = 0; d < edit.map().capacity(); ++d) {
        const auto darts = darts_of(edit.map(), FaceOfVolume, Dart{d});
        if (std::all_of(darts.begin(), darts.end(), [&](Dart e) { return body().map->rest_of(e).x() == 2; }))
          unsew(edit, 3, Dart{d});
      }
    });
  }
  FrameBody frame() {
    maker->observe();
    return maker->draw(0, 0).bodies.at(0);
  }
};

TEST(Picture, OfABodyThatLostItsLastElementIsEmpty) {
  for (const char* by : {"", R"(<look by="fragment"/>)", R"(<look by="strain"/>)"}) {
    Shown sheet(quads, by);
    ShownBar solid(by);
    for (Scene* scene : {sheet.scene.get(), solid.scene.get()}) {
      Body& body = *scene->bodies()[0];
      body.map->edit([&](Edit& edit) {
        for (std::uint32_t d = 0; d < edit.map().capacity(); ++d)
          if (edit.map().alive(Dart{d})) remove_element_of(edit, Dart{d});
      });
      body.rebind();
      scene->step();
    }
    EXPECT_TRUE(sheet.frame().bodies.at(0).corners.empty());
    EXPECT_TRUE(solid.frame().corners.empty());
  }
}

TEST(PictureOfASolid, ShowsItsHullFromOutsideAlone) {
  for (const char* pattern : {"hexahedra", "tetrahedra", "prisms", "mixed"}) {
    ShownBar shown("", pattern);
    const FrameBody body = shown.frame();
    EXPECT_FALSE(body.two_sided);
    EXPECT_EQ(body.corners.size(), 2u * 40 * 3) << pattern; // 40 squares
    for (std::size_t n = 0; n < body.corners.size(); n += 3) {
      const Corner* c = &body.corners[n];
      const Vector3f flat =
          (position(c[1]) - position(c[0])).cross(position(c[2]) - position(c[0])).normalized();
      EXPECT_GT(flat.dot((position(c[0]) + position(c[1]) + position(c[2])) / 3 - Vector3f(2, 1, 1)), 0);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR((normal(c[k]) - flat).norm(), 0, 1e-5);
    }
    const auto count = std::count_if(body.corners.begin(), body.corners.end(), [](const Corner& c) {
      return c.line[0] == static_cast<int>(Line::Border) || c.line[0] == static_cast<int>(Line::Torn);
    });
    EXPECT_EQ(count, 0);
  }
}

TEST(PictureOfASolid, GivesWhatFractureLaidBareTheInsideColour) {
  ShownBar shown(R"(<look colour="#102030" inside="#a0b0c0"/>)");
  EXPECT_EQ(colours(shown.frame()).size(), 1u);
  shown.part();
  const FrameBody body = shown.frame();
  int inside = 0;
  for (const Corner& c : body.corners) {
    const bool bare = c.colour[0] == 0xa0;
    EXPECT_EQ(bare, position(c).x() == 2 && std::abs(normal(c).x()) > 0.5f);
    inside += bare;
  }
  EXPECT_EQ(inside, 2 * 4 * 2 * 3);
}

TEST(PictureOfASolid, GivesWhatFractureLaidBareAFinishOfItsOwn) {
  ShownBar shown(R"(<look finish="brittle" finish-inside="matte"/>)");
  shown.part();
  shown.maker->observe();
  const std::vector<FrameBody> bodies = shown.maker->draw(0, 0).bodies;
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0].finish.name, "brittle");
  EXPECT_EQ(bodies[1].finish.name, "matte");
  EXPECT_EQ(bodies[1].corners.size(), 2U * 4 * 2 * 3);
}

TEST(PictureOfASolid, ShowsFragmentsAndQuantitiesOnAllFaces) {
  ShownBar fragments(R"(<look by="fragment" inside="#a0b0c0"/>)");
  EXPECT_EQ(colours(fragments.frame()).size(), 1u);
  fragments.part();
  const auto two = colours(fragments.frame());
  EXPECT_EQ(two.size(), 2u);
  EXPECT_FALSE(two.contains({0xa0, 0xb0, 0xc0, 255}));
  for (const char* by : {"strain", "force"}) {
    ShownBar shown(R"(<look by=")" + std::string(by) + R"("/>)");
    for (int n = 0; n < 400; ++n) shown.scene->step();
    EXPECT_GT(colours(shown.frame()).size(), 3u) << by;
  }
}

// At 1/30 s a step ends after the frame's time: obstacles are drawn at that of the bodies.
TEST(Picture, ShowsObstaclesWhereTheyAreAtTheTimeOfTheBodies) {
  Shown shown(quads, "",
              R"(<world><box low="5 0 0" high="6 1 1" velocity="3 0 0"/><sphere centre="9 0 0" radius="1">)"
              R"(<key at="0" position="9 0 0"/><key at="1" position="9 4 0"/></sphere></world>)");
  shown.steps(34);
  shown.maker->observe();
  const Frame frame = shown.maker->draw(1, 1.0 / 30);
  const auto middle = [](const FrameBody& body) {
    Eigen::AlignedBox3f box;
    for (const Corner& corner : body.corners) box.extend(position(corner));
    return Vec3(box.center().cast<double>());
  };
  const double t = shown.scene->time();
  EXPECT_NEAR(t, 0.034, 1e-12);
  EXPECT_NEAR(middle(frame.obstacles.at(0)).y(), 4 * t * t * (3 - 2 * t), 1e-5);
  EXPECT_NEAR(middle(frame.obstacles.at(1)).x(), 5.5 + 3 * t, 1e-5);
}

TEST(Viewpoint, TurnsAroundItsTarget) {
  Shown shown(quads, "", R"(<camera eye="0 -5 1" target="0 0 1" turn="90"/>)");
  EXPECT_TRUE(shown.maker->camera(0).eye.isApprox(Eigen::Vector3d(0, -5, 1)));
  EXPECT_TRUE(shown.maker->camera(1).eye.isApprox(Eigen::Vector3d(5, 0, 1)));
  EXPECT_TRUE(shown.maker->camera(1).target.isApprox(Eigen::Vector3d(0, 0, 1)));
}

TEST(Viewpoint, KeepsTheBodiesInSight) {
  Shown shown(quads);
  for (int n = 0; n < 10; ++n) {
    const Eigen::Matrix4d clip = view_of(shown.maker->camera(0.1 * n), {}, 1.5).world_to_clip();
    const FrameBody body = shown.frame().bodies.at(0);
    for (const Corner& corner : body.corners) {
      const Eigen::Vector4d at = clip * position(corner).cast<double>().homogeneous();
      EXPECT_LT(std::max(std::abs(at.x()), std::abs(at.y())), at.w());
    }
    shown.steps(100);
  }
}

TEST(Viewpoint, LeavesRoomToFallOrSwingButNotBelowTheFloor) {
  const std::string one_side = R"(<fix near="0 0 1"/>)";
  EXPECT_NEAR(
      bounds_to_frame(*Shown(quads, "", "", R"(<fix near="0 0 1"/><fix near="1 0 1"/>)").scene, 1).min().z(),
      -0.15, 1e-9);
  const Shown flat(quads, "", R"(<world gravity="0 -9.81 0"/>)", one_side);
  EXPECT_NEAR(bounds_to_frame(*flat.scene, 1).min().y(), -0.9, 1e-9);
  const Shown floor(quads, "", R"(<world><floor z="-0.1"/></world>)", one_side);
  EXPECT_NEAR(bounds_to_frame(*floor.scene, 1).min().z(), -0.1, 1e-9);
}

// The HUD.

TEST(FrameBuilder, without_a_hud_nothing_is_written_over_the_picture) {
  Shown shown(quads);
  EXPECT_TRUE(shown.frame().hud.empty());
}

TEST(FrameBuilder, a_hud_tells_what_it_is_asked_for) {
  if (!hud_available()) GTEST_SKIP() << "built without the HUD";
  Shown shown(quads, R"(<look by="force" most="5"/>)", R"(<hud show="title energy legend time tears"/>)");
  shown.frame();
  const double at_start = shown.scene->kinetic_energy();
  shown.steps(200);
  const HudContent hud = shown.frame().hud;
  EXPECT_EQ(hud.title, "shown");
  ASSERT_EQ(hud.figures.size(), 3u);
  EXPECT_EQ(hud.figures[0], "0.200 s");
  EXPECT_EQ(hud.figures[1], std::to_string(shown.scene->tears()) + " tears");
  EXPECT_GT(shown.scene->tears(), 1u);
  ASSERT_EQ(hud.legends.size(), 1u);
  EXPECT_EQ(hud.legends[0].high, "5 N");
  ASSERT_EQ(hud.plots.size(), 1u);
  ASSERT_EQ(hud.plots[0].curves.size(), 4u);
  EXPECT_FLOAT_EQ(hud.plots[0].curves[2].values[0], 0); // of gravity, relative to the start
  EXPECT_EQ(hud.plots[0].frames, 31);
  EXPECT_EQ(
      hud.plots[0].curves[0].values,
      (std::vector<float>{static_cast<float>(at_start), static_cast<float>(shown.scene->kinetic_energy())}));
}

TEST(FrameBuilder, a_hud_of_nothing_is_empty) {
  Shown shown(quads, "", R"(<hud show="legend"/>)"); // plain colours have no scale
  EXPECT_TRUE(shown.frame().hud.empty());
}

// Other ways to draw a body.

double volume_of(const FrameBody& body) { // by the divergence theorem
  double sum = 0;
  for (std::size_t n = 0; n < body.corners.size(); n += 3)
    sum +=
        position(body.corners[n]).dot(position(body.corners[n + 1]).cross(position(body.corners[n + 2]))) / 6;
  return sum;
}

TEST(FrameBuilder, exploded_cells_are_all_there_whole_and_apart) {
  for (const char* pattern : {"hexahedra", "tetrahedra", "prisms", "mixed"}) {
    const auto preset = load_scene_text(
        fmt::format(R"(<scene name="bar"><body><bar cells="3 2 2" size="3 2 2" pattern="{}"/><mass total="1"/>)"
                    R"(<springs><stretch k="60"/></springs><look as="exploded" apart="0.5"/></body>)"
                    R"(<time duration="1"/></scene>)",
                    pattern),
        "bar.xml");
    Scene scene(read_scene(*preset), {});
    FrameBuilder maker(picture_settings(*preset), scene, 1.5, 1, 31);
    maker.observe();
    const Frame frame = maker.draw(0, 0);
    EXPECT_NEAR(volume_of(frame.bodies[0]), 12, 1e-4) << pattern; // no cell is lost or doubled
    Eigen::AlignedBox3f box;
    for (const Corner& corner : frame.bodies[0].corners) box.extend(position(corner));
    if (std::string(pattern) == "hexahedra") { // the centres of the outermost cells were 2 apart
      EXPECT_NEAR(box.sizes().x(), 3 + 0.5 * 2, 1e-5);
    }
  }
}

TEST(FrameBuilder, every_dart_has_a_dot_and_every_link_a_rod) {
  Shown shown(R"(<sheet cells="2 1" size="1 1"/>)", R"(<look as="darts"/>)");
  const Frame frame = shown.frame();
  // Two quads of 8 darts: a dot each; α0 4 a quad, α1 4 a quad, α2 2 between the quads.
  constexpr std::size_t dot = 6 * 7 * 7 * 2 * 3, rod = 8 * 3; // corners
  EXPECT_EQ(frame.bodies[0].corners.size(), 16 * dot + (8 + 8 + 2) * rod);
}

TEST(FrameBuilder, darts_of_a_large_body_are_refused) {
  EXPECT_THROW(Shown(R"(<sheet cells="60 60" size="1 1"/>)", R"(<look as="darts"/>)"), UserError);
}

} // namespace
} // namespace rend::scene_picture_test
