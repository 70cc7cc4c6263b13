// Where pictures lie on bodies, against formulas of the presets' own numbers, and that tears leave them there.
#include "render/picture/texture_map.h"

#include "render/files/png.h"
#include "render/picture/scene_picture.h"
#include "render/picture/scene_preset.h"
#include "sim/build/build_scene.h"
#include "sim/scene/scene.h"
#include "sim/topology/walk.h"
#include "tests/render/needs.h"
#include "tests/render/pictures.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>

namespace rend::texture_map_test {
namespace {

// A scene in a folder with a picture twice as wide as high, wide.png, one of 30 x 20, other.png, and mesh.obj.
struct Shown {
  explicit Shown(const std::string& body, const std::string& time = R"(<time duration="1"/>)",
                 const std::string& mesh = "") {
    std::ofstream(folder / "mesh.obj") << mesh;
    write_png(folder / "wide.png", test::pattern(20, 10));
    write_png(folder / "other.png", test::pattern(30, 20));
    preset = load_scene_text(R"(<scene name="shown"><body>)" + body + "</body>" + time + "</scene>",
                             (folder / "shown.xml").string());
    scene = std::make_unique<Scene>(read_scene(*preset, scene_pictures()), SceneOptions{});
    maker = std::make_unique<FrameBuilder>(picture_settings(*preset), *scene, 1.5, 1.0, 31);
  }
  Body& body() const { return *scene->bodies()[0]; }
  std::vector<FrameBody> bodies() const {
    maker->observe();
    return maker->draw(0, 0).bodies;
  }

  test::Folder folder;
  std::unique_ptr<PresetNode> preset;
  std::unique_ptr<Scene> scene;
  std::unique_ptr<FrameBuilder> maker;
};

const std::string matter = R"(<mass total="0.1"/><springs><stretch k="60"/></springs>)";

using Found = std::array<double, 2>;

// Of each corner at the start, its position and its place in the picture.
template <class F> void each_corner(const FrameBody& body, F&& f) {
  ASSERT_EQ(body.texture_points.size(), body.corners.size());
  ASSERT_FALSE(body.corners.empty());
  for (std::size_t n = 0; n < body.corners.size(); ++n) {
    const auto& x = body.corners[n].position;
    f(n, Vec3(x[0], x[1], x[2]), Found{body.texture_points[n][0], body.texture_points[n][1]});
  }
}

TEST(TextureMap, spreads_a_picture_over_a_sheet_however_it_is_placed) {
  NEEDS_PNG;
  for (const char* pattern : {"quads", "triangles", "crossed", "mixed"}) {
    const Shown shown(fmt::format(R"(<sheet pattern="{}" cells="4 3" size="2 1"/>)", pattern) +
                      R"(<place scale="3" rotate="90 0 0" translate="1 2 3"/>)" + matter +
                      R"(<look texture="wide.png"/>)");
    const FrameBody body = shown.bodies().at(0);
    EXPECT_TRUE(body.texture.front);
    EXPECT_FALSE(body.texture.back);
    EXPECT_EQ(body.texture.wrap, Wrap::Clamp);
    each_corner(body, [](std::size_t, const Vec3& x, const Found& at) { // y of the sheet is z of the world now
      EXPECT_NEAR(at[0], (x.x() - 1) / 6, 1e-6);
      EXPECT_NEAR(at[1], (x.z() - 3) / 3, 1e-6);
    });
  }
}

TEST(TextureMap, follows_the_lattice_of_bent_sheets) {
  NEEDS_PNG;
  const Shown patch(R"(<sheet cells="5 4" corners="0 0 0  2 0 0.3  1.7 1 0  0 1.5 -0.4"/>)" + matter +
                    R"(<look texture="wide.png"/>)");
  int corners = 0;
  each_corner(patch.bodies().at(0), [&](std::size_t, const Vec3& x, const Found& at) {
    const double s = std::round(5 * at[0]) / 5, t = std::round(4 * at[1]) / 4;
    EXPECT_NEAR(at[0], s, 1e-6);
    EXPECT_NEAR(at[1], t, 1e-6);
    const Vec3 there = (1 - s) * (1 - t) * Vec3(0, 0, 0) + s * (1 - t) * Vec3(2, 0, 0.3) +
                       s * t * Vec3(1.7, 1, 0) + (1 - s) * t * Vec3(0, 1.5, -0.4);
    EXPECT_LT((there - x).norm(), 1e-6);
    ++corners;
  });
  EXPECT_EQ(corners, 5 * 4 * 6);
  for (const char* close : {"loop", "twist"}) {
    const Shown band(fmt::format(R"(<sheet cells="24 2" size="3 0.4" close="{}"/>)", close) + matter +
                     R"(<look texture="wide.png"/>)");
    const FrameBody body = band.bodies().at(0);
    std::map<std::pair<int, int>, int> cells; // triangles in each cell of 24 x 2
    for (std::size_t n = 0; n < body.corners.size(); n += 3) {
      double low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9};
      for (std::size_t k = n; k < n + 3; ++k)
        for (std::size_t c = 0; c < 2; ++c) {
          const double cell = static_cast<double>(body.texture_points[k][c]) * (c == 0 ? 24 : 2);
          EXPECT_NEAR(cell, std::round(cell), 1e-3) << close;
          low[c] = std::min(low[c], std::round(cell));
          high[c] = std::max(high[c], std::round(cell));
        }
      EXPECT_EQ(high[0] - low[0], 1) << close << ": a face at the seam goes on, and not back to the start";
      EXPECT_EQ(high[1] - low[1], 1) << close;
      ++cells[{static_cast<int>(low[0]), static_cast<int>(low[1])}];
    }
    EXPECT_EQ(cells.size(), 48U) << close;
    for (const auto& [cell, count] : cells) {
      EXPECT_EQ(count, 2);
      EXPECT_TRUE(cell.first >= 0 && cell.first < 24 && cell.second >= 0 && cell.second < 2);
    }
  }
}

TEST(TextureMap, scales_and_turns_a_picture_about_its_middle_without_shearing_it) {
  NEEDS_PNG;
  const Shown shown(R"(<sheet cells="4 3" size="2 1"/>)" + matter +
                    R"(<look texture="wide.png" scale="0.5 0.25" rotate="90"/>)");
  const FrameBody body = shown.bodies().at(0);
  EXPECT_EQ(body.texture.wrap, Wrap::Repeat);
  each_corner(body, [](std::size_t, const Vec3& x, const Found& at) {
    // 1 m wide, which is upwards now, and 0.25 m high, which is to the left
    EXPECT_NEAR(at[0], (x.y() - 0.5) / 1 + 0.5, 1e-6);
    EXPECT_NEAR(at[1], -(x.x() - 1) / 0.25 + 0.5, 1e-6);
  });
  const Shown mirrored(R"(<sheet cells="1 1" size="2 1"/>)" + matter +
                       R"(<look texture="wide.png" wrap="mirror"/>)");
  EXPECT_EQ(mirrored.bodies().at(0).texture.wrap, Wrap::Mirror);
}

TEST(TextureMap, projects_a_picture_on_the_sides_of_a_solid_upright_for_who_looks_at_them) {
  NEEDS_PNG;
  const Shown shown(R"(<bar cells="2 2 2" size="2 1 0.5"/><place translate="5 6 7"/>)" + matter +
                    R"(<look texture="wide.png"/>)");
  const std::vector<FrameBody> bodies = shown.bodies();
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_TRUE(bodies[1].corners.empty()) << "nothing is broken";
  const FrameBody& body = bodies[0];
  EXPECT_EQ(body.texture.wrap, Wrap::Repeat);
  const Vec3 middle(6, 6.5, 7.25);
  int seen = 0;
  each_corner(body, [&](std::size_t n, const Vec3& x, const Found& at) {
    const Vec3 normal = [&] {
      const std::size_t first = n - n % 3;
      const auto point = [&](std::size_t k) {
        const auto& p = body.corners[first + k].position;
        return Vec3(p[0], p[1], p[2]);
      };
      return (point(1) - point(0)).cross(point(2) - point(0)).normalized();
    }();
    const Vec3 up = std::abs(normal.z()) > 0.5 ? Vec3::UnitY() : Vec3::UnitZ(), right = up.cross(normal);
    EXPECT_NEAR(at[0], right.dot(x - middle) / 2 + 0.5, 1e-6); // 2 m wide, 1 m high
    EXPECT_NEAR(at[1], up.dot(x - middle) / 1 + 0.5, 1e-6);
    ++seen;
  });
  EXPECT_EQ(seen, 24 * 6);
}

// A face at 45 degrees takes z, whatever rounding says; a triangle of it as well.
TEST(TextureMap, chooses_the_same_plane_for_all_parts_of_a_face) {
  NEEDS_PNG;
  const Shown shown(R"(<bar cells="1 1 1" size="1 1 1"/><place rotate="0 0 0"/>)" + matter);
  LookSettings look;
  const TextureMap map(shown.body(), look, 1);
  for (const double noise : {-1e-12, 0.0, 1e-12}) {
    EXPECT_EQ(map.chart(Vec3::Zero(), Vec3(1 + noise, 0, 1)).axis, 2);
    EXPECT_EQ(map.chart(Vec3::Zero(), Vec3(1 + noise, -1, 0.3)).axis, 0);
    EXPECT_EQ(map.chart(Vec3::Zero(), Vec3(0.2, -1 - noise, 1)).axis, 2);
  }
  EXPECT_EQ(map.chart(Vec3::Zero(), Vec3(0.2, -3, 1)).axis, 1);
  EXPECT_EQ(map.chart(Vec3::Zero(), Vec3(0.2, -3, 1)).side, -1);
}

TEST(TextureMap, shows_colours_by_a_quantity_in_place_of_the_picture) {
  NEEDS_PNG;
  const Shown shown(R"(<sheet cells="2 2" size="1 1"/>)" + matter +
                    R"(<look by="strain" texture="wide.png"/>)");
  EXPECT_FALSE(shown.bodies().at(0).texture.any());
  EXPECT_TRUE(shown.bodies().at(0).texture_points.empty());
}

TEST(TextureMap, fits_the_picture_of_the_back_by_its_own_proportions) {
  NEEDS_PNG;
  const std::string looks = R"(<look texture="wide.png" texture-back="other.png"/>)";
  const Shown sheet(R"(<sheet cells="2 2" size="1 1"/>)" + matter + looks);
  EXPECT_EQ(sheet.bodies().at(0).texture.back_height, 1) << "both are spread over the sheet";
  EXPECT_TRUE(sheet.bodies().at(0).texture.back);
}

// The corners of faces, by the smallest dart of the face and the rest positions of its corners.
struct Kept {
  std::array<Record, 3> rest;
  std::array<TexturePoint, 3> point;
};
std::map<std::uint32_t, Kept> corners_by_face(const Shown& shown) {
  const FrameBody body = shown.bodies().at(0);
  std::map<std::uint32_t, Kept> all;
  const EmbeddedMap& map = *shown.body().map;
  std::size_t n = 0;
  shown.body().boundary().sheet().for_each_triangle([&](const BoundaryTriangle& triangle) {
    Kept& kept = all[triangle.first.value];
    for (std::size_t k = 0; k < 3; ++k) {
      kept.rest[k] = map.rest()[triangle.vertex[k]];
      kept.point[k] = body.texture_points.at(n++);
    }
  });
  EXPECT_EQ(n, body.texture_points.size());
  return all;
}

bool same_bits(const Record& a, const Record& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

// Cuts divide triangles, move vertices and part the sheet.
TEST(TextureMap, keeps_the_bits_of_corners_through_cuts_and_puts_new_ones_between) {
  NEEDS_PNG;
  const Shown shown(
      R"(<sheet pattern="triangles" cells="8 6" size="0.4 0.3"/>)"
      R"(<place scale="2" rotate="30 20 70" translate="1 2 3"/>)"
      R"(<mass total="0.1"/><elasticity model="corotational" young="1e5" thickness="1e-3" damping-mass="5"/>)"
      R"(<fix side="-x"/><drive side="+x" velocity="0.5 0.2 0"/>)"
      R"(<tear criterion="vertex-stress" threshold="8e3" change="cut"/><look texture="wide.png"/>)",
      R"(<time step="auto" duration="1"/>)");
  const std::map<std::uint32_t, Kept> before = corners_by_face(shown);
  for (int n = 0; n < 4000 && shown.scene->tears() < 12; ++n) shown.scene->step();
  ASSERT_GE(shown.scene->tears(), 12U);
  const std::map<std::uint32_t, Kept> after = corners_by_face(shown);
  EXPECT_GT(after.size(), before.size()) << "faces were divided";

  struct Point {
    Vec3 rest;
    TexturePoint at;
  };
  std::vector<Point> old; // the corners from the start
  for (const auto& [face, kept] : before)
    for (std::size_t k = 0; k < 3; ++k) old.push_back({kept.rest[k].vec(), kept.point[k]});
  std::size_t same = 0, moved = 0;
  for (const auto& [face, kept] : after) {
    const auto was = before.find(face);
    for (std::size_t k = 0; k < 3; ++k) {
      const bool corner_kept = was != before.end() && same_bits(kept.rest[k], was->second.rest[k]);
      same += corner_kept;
      if (corner_kept) {
        EXPECT_EQ(kept.point[k], was->second.point[k]);
        continue;
      }
      ++moved;
      // it lies in a triangle of the start, whose corners say where it is in the picture
      const Vec3 x = kept.rest[k].vec();
      bool found = false;
      for (std::size_t n = 0; n < old.size() && !found; n += 3) {
        Eigen::Matrix3d sides;
        sides << old[n + 1].rest - old[n].rest, old[n + 2].rest - old[n].rest,
            (old[n + 1].rest - old[n].rest).cross(old[n + 2].rest - old[n].rest);
        const Vec3 share = sides.inverse() * (x - old[n].rest);
        if (share.x() < -1e-9 || share.y() < -1e-9 || share.x() + share.y() > 1 + 1e-9) continue;
        found = true;
        for (std::size_t c = 0; c < 2; ++c)
          EXPECT_NEAR(kept.point[k][c],
                      (1 - share.x() - share.y()) * old[n].at[c] + share.x() * old[n + 1].at[c] +
                          share.y() * old[n + 2].at[c],
                      1e-6);
      }
      EXPECT_TRUE(found);
    }
  }
  EXPECT_GT(same, 200U);
  EXPECT_GT(moved, 10U);
}

// A strip of 4 x 1 m in the xz plane, a quad and two triangles; between the quad and the triangles is a seam.
constexpr const char* strip = R"(v 0 0 0
v 2 0 0
v 4 0 0
v 0 0 1
v 2 0 1
v 4 0 1
vt 0 0.5
vt 0.4 0.5
vt 0.4 1
vt 0 1
vt 0.7 0
vt 1.1 0
vt 1.1 0.3
vt 0.7 0.3
f 1/1 2/2 5/3 4/4
f 2/5 3/6 6/7
f 2/5 6/7 5/-1
)";
Found place_in_strip(double x, double z, bool left) {
  return left ? Found{0.2 * x, 0.5 + 0.5 * z} : Found{0.7 + 0.2 * (x - 2), 0.3 * z};
}

TEST(TextureMap, lays_a_picture_by_the_texture_coordinates_of_the_mesh) {
  NEEDS_PNG;
  const std::string mesh = R"(<mesh file="mesh.obj"/><place translate="5 6 7"/>)" + matter,
                    time = R"(<time duration="1"/>)";
  const auto expect_at = [](const Shown& shown, auto&& then) { // then(plain place): where it lies in the end
    const FrameBody body = shown.bodies().at(0);
    EXPECT_EQ(body.texture.wrap, Wrap::Repeat);
    EXPECT_EQ(body.corners.size(), 12U);
    each_corner(body, [&](std::size_t n, const Vec3& x, const Found& at) {
      double middle = 0; // of the triangle
      for (std::size_t k = n - n % 3; k < n - n % 3 + 3; ++k)
        middle += static_cast<double>(body.corners[k].position[0]) - 7;
      const Found expected = then(place_in_strip(x.x() - 5, x.z() - 7, middle < 0));
      EXPECT_NEAR(at[0], expected[0], 1e-6);
      EXPECT_NEAR(at[1], expected[1], 1e-6);
    });
  };
  const auto plain = [](const Found& place) { return place; };
  expect_at(Shown(mesh + R"(<look texture="wide.png"/>)", time, strip), plain);
  expect_at(Shown(mesh + R"(<look texture="wide.png" thickness="1e-4"/>)", time, strip), plain);
  // about the middle, in a picture of 2 x 1 that is now 4 wide, upwards, and 0.5 high, to the left
  expect_at(Shown(mesh + R"(<look texture="wide.png" scale="2 0.5" rotate="90"/>)", time, strip),
            [](const Found& place) {
              return Found{0.5 + (place[1] - 0.5) / 4, 0.5 - 2 * (place[0] - 0.5) / 0.5};
            });
  const Shown both(mesh + R"(<look texture="wide.png" texture-back="other.png"/>)", time, strip);
  EXPECT_EQ(both.bodies().at(0).texture.back_height, 1) << "both have the same texture coordinates";
}

TEST(TextureMap, keeps_texture_coordinates_only_where_a_picture_lies) {
  NEEDS_PNG;
  const std::string mesh = R"(<mesh file="mesh.obj"/>)" + matter, time = R"(<time duration="1"/>)";
  EXPECT_FALSE(find_texture_coordinates(*Shown(mesh, time, strip).body().map));
  EXPECT_FALSE(find_texture_coordinates(*Shown(mesh + R"(<look back="#ffffff"/>)", time, strip).body().map));
  EXPECT_TRUE(
      find_texture_coordinates(*Shown(mesh + R"(<look texture-back="wide.png"/>)", time, strip).body().map));
  const std::string some = std::string(strip) + "v 0 0 -1\nv 2 0 -1\nf 1 7 8 2\n";
  const Shown partial(mesh + R"(<look texture="wide.png"/>)", time, some);
  EXPECT_FALSE(find_texture_coordinates(*partial.body().map));
  ASSERT_EQ(partial.body().notes.size(), 1U);
  EXPECT_NE(
      partial.body().notes[0].find("10 corners of polygons have texture coordinates (vt), and 4 have none"),
      std::string::npos)
      << partial.body().notes[0];
  EXPECT_TRUE(Shown(mesh, time, some).body().notes.empty()) << "nobody asked";
}

// A tear runs from one side of the strip to the other, and a quad that a rule divides is drawn as triangles.
TEST(TextureMap, keeps_texture_coordinates_of_a_sheet_that_tears_and_is_subdivided) {
  NEEDS_PNG;
  const Shown shown(R"(<mesh file="mesh.obj"/><apply rule="star-face"/><apply rule="insert-vertex"/>)" +
                        matter +
                        R"(<fix side="-x"/><drive side="+x" velocity="1 0 0"/>)"
                        R"(<tear criterion="global-border" threshold="0.1"/><look texture="wide.png"/>)",
                    R"(<time step="1e-3" duration="1"/>)", strip);
  for (int n = 0; n < 900 && shown.scene->tears() == 0; ++n) shown.scene->step();
  ASSERT_GT(shown.scene->tears(), 0U);
  const FrameBody body = shown.bodies().at(0);
  ASSERT_EQ(body.texture_points.size(), body.corners.size());
  ASSERT_GT(body.corners.size(), 12U);
  const EmbeddedMap& map = *shown.body().map;
  const auto& rest = map.rest();
  std::size_t n = 0;
  shown.body().boundary().sheet().for_each_triangle([&](const BoundaryTriangle& triangle) {
    double middle = 0; // of the face: some of its triangles lie in the seam
    for (const Dart d : darts_of(map.map(), FaceOfVolume, triangle.first)) middle += map.rest_of(d).x() - 2;
    for (const Slot v : triangle.vertex) {
      const Found expected = place_in_strip(rest[v].x, rest[v].z, middle < 0);
      EXPECT_NEAR(body.texture_points[n][0], expected[0], 1e-6);
      EXPECT_NEAR(body.texture_points[n][1], expected[1], 1e-6);
      ++n;
    }
  });
}

// One picture of roughness without any of colours: it lies as that would.
TEST(TextureMap, lays_roughness_where_a_texture_would_lie) {
  NEEDS_PNG;
  for (const std::string shape :
       {R"(<sheet cells="2 2" size="2 1"/>)", R"(<bar cells="2 2 2" size="2 1 1"/>)"}) {
    const Shown coloured(shape + matter + R"(<look texture="wide.png"/>)");
    const Shown rough(shape + matter + R"(<look roughness="wide.png"/>)");
    const FrameBody expected = coloured.bodies().at(0), body = rough.bodies().at(0);
    EXPECT_EQ(body.texture_points, expected.texture_points);
    EXPECT_FALSE(body.texture.front);
    EXPECT_TRUE(body.texture.roughness);
  }
}

TEST(TextureMap, puts_a_picture_of_its_own_on_what_breaks_open) {
  NEEDS_PNG;
  const Shown shown(R"(<bar cells="6 1 1" size="3 0.5 0.5"/><mass total="1"/>)"
                    R"(<springs><stretch k="100"/><shear kind="isotropic" where="volume" k="50"/></springs>)"
                    R"(<fix side="-x"/><drive side="+x" velocity="2 0 0"/>)"
                    R"(<tear criterion="atomic-border" threshold="10" change="separate" max-per-step="1"/>)"
                    R"(<look texture="wide.png" texture-inside="other.png" roughness-inside="wide.png"
                             finish="brittle" finish-inside="matte"/>)",
                    R"(<time step="1e-3" duration="1"/>)");
  const std::size_t whole = shown.bodies().at(0).corners.size();
  for (int n = 0; n < 900 && shown.scene->tears() == 0; ++n) shown.scene->step();
  ASSERT_GT(shown.scene->tears(), 0U);
  const std::vector<FrameBody> bodies = shown.bodies();
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0].corners.size(), whole);
  ASSERT_GE(bodies[1].corners.size(), 12U);
  ASSERT_EQ(bodies[1].texture_points.size(), bodies[1].corners.size());
  EXPECT_NE(bodies[0].texture.front, bodies[1].texture.front);
  EXPECT_FALSE(bodies[0].texture.roughness);
  ASSERT_TRUE(bodies[1].texture.roughness);
  EXPECT_EQ(bodies[1].texture.roughness->levels[0].channels, 1);
  EXPECT_EQ(bodies[0].finish.name, "brittle");
  EXPECT_EQ(bodies[1].finish.name, "matte");
  for (const TexturePoint& at : bodies[1].texture_points) { // corners of 0.5 m in a picture of 3 m x 2 m
    EXPECT_NEAR(std::abs(at[0] - 0.5), 0.25 / 3, 1e-6);
    EXPECT_NEAR(std::abs(at[1] - 0.5), 0.25 / 2, 1e-6);
  }
}

} // namespace
} // namespace rend::texture_map_test
