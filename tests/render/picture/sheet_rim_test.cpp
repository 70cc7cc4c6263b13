// A sheet that is drawn with a thickness is a closed slab.
#include "render/clip/picture_check.h"
#include "render/picture/scene_picture.h"
#include "render/picture/scene_preset.h"
#include "sim/build/build_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace rend::sheet_rim_test {
namespace {

constexpr double thickness = 0.02; // [m]

struct Shown {
  std::unique_ptr<PresetNode> preset;
  std::unique_ptr<Scene> scene;
  std::unique_ptr<FrameBuilder> maker;

  explicit Shown(const std::string& sheet, const std::string& look = "", const std::string& moves = "") {
    preset = load_scene_text(fmt::format(R"(<scene name="thick"><body>{}<mass total="0.1"/>
            <elasticity model="corotational" young="1e4" poisson="0.3" thickness="1e-3"/>{}
            <look thickness="{}" {}/></body>
            <world gravity="0 0 0"/><time step="auto" duration="1"/></scene>)",
                                         sheet, moves, thickness, look),
                             "thick.xml");
    scene = std::make_unique<Scene>(read_scene(*preset), SceneOptions{});
    maker = std::make_unique<FrameBuilder>(picture_settings(*preset), *scene, 1.5, 1.0, 31);
  }
  std::vector<FrameBody> bodies() {
    maker->observe();
    return maker->draw(0, 0).bodies;
  }
  // Front, back and rim, counter-clockwise as seen from outside.
  std::vector<Corner> slab() {
    std::vector<Corner> all;
    for (FrameBody& body : bodies()) {
      for (std::size_t n = 0; n < body.corners.size() && body.sides == SheetSides::Back; n += 3)
        std::swap(body.corners[n + 1], body.corners[n + 2]);
      all.insert(all.end(), body.corners.begin(), body.corners.end());
    }
    return all;
  }
};

Eigen::Vector3d place(const Corner& corner) {
  return Eigen::Vector3f(corner.position.data()).cast<double>();
}

// By the divergence theorem [m³].
double volume(const std::vector<Corner>& corners) {
  double six = 0;
  for (std::size_t n = 0; n < corners.size(); n += 3)
    six += place(corners[n]).dot(place(corners[n + 1]).cross(place(corners[n + 2])));
  return six / 6;
}

// The sum of the areas of all triangles as vectors, over that of their sizes: 0 for a closed surface.
double openness(const std::vector<Corner>& corners) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double size = 0;
  for (std::size_t n = 0; n < corners.size(); n += 3) {
    const Eigen::Vector3d a = place(corners[n]);
    const Eigen::Vector3d area = (place(corners[n + 1]) - a).cross(place(corners[n + 2]) - a) / 2;
    sum += area;
    size += area.norm();
  }
  return sum.norm() / size;
}

// How many sides of triangles have no opposite one.
std::size_t open_sides(const std::vector<Corner>& corners) {
  std::map<std::array<std::array<float, 3>, 2>, int> sides;
  for (std::size_t n = 0; n < corners.size(); n += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto &from = corners[n + k].position, &to = corners[n + (k + 1) % 3].position;
      if (from == to) continue;
      ++sides[{from, to}];
      --sides[{to, from}];
    }
  return static_cast<std::size_t>(
      std::count_if(sides.begin(), sides.end(), [](const auto& side) { return side.second > 0; }));
}

TEST(SheetRim, ClosesTheSlabThatASheetIsDrawnAs) {
  for (const char* pattern : {"quads", "triangles", "crossed"}) {
    Shown shown(fmt::format(R"(<sheet pattern="{}" cells="6 4" size="1.5 1"/>)", pattern));
    const std::vector<Corner> slab = shown.slab();
    EXPECT_EQ(open_sides(slab), 0U) << pattern;
    EXPECT_LT(openness(slab), 1e-6) << pattern;
    // The rim adds half of an octagon all around, up to the corners of the sheet.
    const double r = thickness / 2, rim = std::sqrt(2.0) * r * r;
    EXPECT_NEAR(volume(slab), 1.5 * thickness + 5 * rim, 8 * rim * r + 1e-6 * thickness) << pattern;
  }
}

// Of a mass that says how thick the sheet is: 1.5 m in size, so that it is seen from 5 mm on.
TEST(SheetRim, IsThatOfTheMassWhereItCanBeSeen) {
  const auto bodies = [](double thick, const std::string& look) {
    const auto preset =
        load_scene_text(fmt::format(R"(<scene name="thick"><body><sheet cells="6 4" size="1.5 1"/>
            <mass density="300" thickness="{}"/><springs><stretch k="60"/></springs>{}</body>
            <time step="1e-3" duration="1"/></scene>)",
                                    thick, look),
                        "thick.xml");
    Scene scene(read_scene(*preset), SceneOptions{});
    FrameBuilder maker(picture_settings(*preset), scene, 1.5, 1, 31);
    maker.observe();
    return maker.draw(0, 0).bodies;
  };
  EXPECT_EQ(bodies(0.004, "").size(), 1U);
  const std::vector<FrameBody> slab = bodies(0.006, "");
  ASSERT_EQ(slab.size(), 3U) << "front, back and rim";
  EXPECT_FLOAT_EQ(slab[0].corners[0].position[2] - slab[1].corners[0].position[2], 0.006f);
  for (const char* look : {R"(<look as="wires"/>)", R"(<look smooth="2"/>)", R"(<look as="exploded"/>)"})
    EXPECT_EQ(bodies(0.006, look).size(), 1U) << look;
}

TEST(SheetRim, ClosesABandWithOneSide) {
  Shown shown(R"(<sheet cells="24 3" size="3 0.4" close="twist"/>)");
  EXPECT_EQ(open_sides(shown.slab()), 0U);
}

TEST(SheetRim, IsRoughAndLighterWhereTheSheetIsTorn) {
  Shown shown(R"(<sheet pattern="quads" cells="6 4" size="1.5 1"/>)", R"(colour="#204060")",
              R"(<fix side="-x"/><drive side="+x" velocity="0.5 0 0"/>
                 <tear criterion="vertex-stress" threshold="400" change="split-vertex"/>)");
  while (shown.scene->tears() == 0 && shown.scene->time() < 1) shown.scene->step();
  const FrameBody rim = shown.bodies().at(2);
  std::set<float> ridge; // heights between front and back
  for (const Corner& corner : rim.corners) {
    if (corner.colour[0] == 0x20) continue;
    EXPECT_EQ(corner.colour[0], (0x20 + 0xff) / 2);
    if (std::abs(corner.position[2]) < 0.3 * thickness) ridge.insert(corner.position[2]);
  }
  EXPECT_GT(ridge.size(), 10U);
}

TEST(SheetRim, TakesThePlaceOfLinesAlongEdges) {
  Shown shown(R"(<sheet cells="6 4" size="1.5 1"/>)");
  const std::vector<FrameBody> bodies = shown.bodies();
  ASSERT_EQ(bodies.size(), 3U);
  EXPECT_EQ(bodies[0].sides, SheetSides::Front);
  EXPECT_EQ(bodies[1].sides, SheetSides::Back);
  EXPECT_FALSE(bodies[2].two_sided);
  for (const FrameBody& body : bodies) {
    EXPECT_EQ(body.torn.width, 0);
    for (const Corner& corner : body.corners)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_TRUE(corner.line[k] == static_cast<int>(Line::None) ||
                    corner.line[k] == static_cast<int>(Line::Cell));
  }
}

TEST(SheetRim, IsOfSheetsShownByTheirSurface) {
  for (const char* as : {"wires", "exploded", "darts"}) {
    Shown shown(R"(<sheet cells="2 2" size="1 1"/>)", fmt::format(R"(as="{}")", as));
    EXPECT_THROW(check_looks(picture_settings(*shown.preset), *shown.scene), UserError) << as;
  }
}

} // namespace
} // namespace rend::sheet_rim_test
