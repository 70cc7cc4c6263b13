// Loads: totals on irregular meshes and after separations, distributions from textbooks, and motions with
// closed forms.
#include "sim/outside/load.h"

#include "sim/base/math.h"
#include "sim/mesh/bar.h"
#include "sim/presets.h"
#include "sim/random_meshes.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace rend::load_test {
namespace {

using Kind = LoadSettings::Kind;
using testing::HasSubstr;

CellMesh warped_bar(BarPattern pattern, unsigned seed) {
  CellMesh mesh = bar_cells({pattern, 3, 2, 2, Vec3(3, 2, 2)});
  meshes::Noise noise(seed);
  for (Vec3& x : mesh.points) x += 0.08 * noise.vector();
  return mesh;
}
std::unique_ptr<EmbeddedMap> solid(BarPattern pattern, unsigned seed) {
  return solid_from(warped_bar(pattern, seed));
}

// Sheets and solids without regular cells.
std::vector<std::unique_ptr<EmbeddedMap>> bodies() {
  std::vector<std::unique_ptr<EmbeddedMap>> all;
  for (const meshes::Named& each : meshes::irregular()) all.push_back(sheet_from(each.mesh));
  unsigned seed = 7;
  for (BarPattern pattern :
       {BarPattern::Hexahedra, BarPattern::Tetrahedra, BarPattern::Prisms, BarPattern::Mixed})
    all.push_back(solid(pattern, seed++));
  return all;
}

std::vector<Slot> all_vertices(const EmbeddedMap& map) {
  std::vector<Slot> all;
  for (Slot v = 0; v < map.cells(Vertex).slots(); ++v)
    if (map.cells(Vertex).alive(v)) all.push_back(v);
  return all;
}

template <class F> std::vector<Slot> vertices_where(const EmbeddedMap& map, F&& passes) {
  std::vector<Slot> all = all_vertices(map);
  std::erase_if(all, [&](Slot v) { return !passes(map.rest()[v].vec()); });
  return all;
}

void shake(EmbeddedMap& map, double amount, unsigned seed) {
  meshes::Noise noise(seed);
  for (Slot v : all_vertices(map)) map.position()[v] = Record(map.rest()[v].vec() + amount * noise.vector());
}

struct Total {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero(); // about the origin
};

Total total(const EmbeddedMap& map, Loads& loads, double time = 0) {
  const Record* f = loads.evaluate(map, time, map.position().values().data(), map.velocity().values().data());
  Total sum;
  for (Slot v : all_vertices(map)) {
    sum.force += f[v].vec();
    sum.moment += map.position()[v].vec().cross(f[v].vec());
  }
  return sum;
}

Loads one(EmbeddedMap& map, const LoadSettings& settings, const std::vector<Slot>& vertices) {
  Loads loads;
  loads.add({map, settings,
             settings.kind() == Kind::Pressure ? Patch::faces(map, "load", vertices)
                                               : Patch::boundary(map, "load", vertices)});
  return loads;
}

LoadSettings force(const Vec3& amount, bool with_body = false) {
  LoadSettings settings;
  settings.force = amount;
  if (with_body) settings.follows = LoadSettings::Follows::Body;
  return settings;
}
LoadSettings moment(const Vec3& amount, bool with_body = false) {
  LoadSettings settings = force(amount, with_body);
  settings.moment.swap(settings.force);
  return settings;
}
LoadSettings pressure(double p) {
  LoadSettings settings;
  settings.pressure = p;
  return settings;
}

void separate_at_random(EmbeddedMap& map, unsigned seed) {
  meshes::Noise noise(seed);
  map.edit([&](Edit& edit) {
    for (std::uint32_t d = 0; d < edit.map().capacity(); ++d)
      if (noise() > 0.3) unsew(edit, edit.map().dimension(), Dart{d});
  });
}

// ∫ N_i x_ξ × x_η over the square, by the midpoint rule on many small squares.
TEST(CornerAreas, of_a_quad_are_the_integrals_of_its_shape_functions) {
  meshes::Noise noise(3);
  const std::array<Vec3, 4> square{Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)};
  std::vector<Vec3> x, area(4), expected(4, Vec3(0, 0, 0));
  for (const Vec3& c : square) x.push_back(c + 0.4 * noise.vector());
  constexpr int n = 200;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double s = (2 * i + 1.0) / n - 1, t = (2 * j + 1.0) / n - 1;
      Vec3 along = Vec3::Zero(), across = Vec3::Zero();
      for (std::size_t c = 0; c < 4; ++c) {
        along += 0.25 * square[c].x() * (1 + square[c].y() * t) * x[c];
        across += 0.25 * square[c].y() * (1 + square[c].x() * s) * x[c];
      }
      for (std::size_t c = 0; c < 4; ++c)
        expected[c] +=
            0.25 * (1 + square[c].x() * s) * (1 + square[c].y() * t) * along.cross(across) * 4 / (n * n);
    }
  }
  corner_areas(x, area);
  for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR((area[c] - expected[c]).norm(), 0, 1e-5);
}

TEST(CornerAreas, sum_up_to_the_vector_area_and_are_equal_on_regular_polygons) {
  meshes::Noise noise(4);
  for (std::size_t sides = 3; sides <= 7; ++sides) {
    std::vector<Vec3> x, area(sides);
    for (std::size_t i = 0; i < sides; ++i) {
      const double angle = 360.0 * static_cast<double>(i) / static_cast<double>(sides);
      x.push_back(Vec3(cosine_of_degrees(angle), sine_of_degrees(angle), 0));
    }
    const double whole = 0.5 * static_cast<double>(sides) * sine_of_degrees(360.0 / static_cast<double>(sides));
    corner_areas(x, area);
    for (const Vec3& a : area)
      EXPECT_NEAR((a - Vec3(0, 0, whole / static_cast<double>(sides))).norm(), 0, 1e-15);
    Vec3 sum = Vec3::Zero(), expected = Vec3::Zero();
    for (Vec3& p : x) p += 0.3 * noise.vector();
    corner_areas(x, area);
    for (std::size_t i = 0; i < sides; ++i) {
      sum += area[i];
      expected += 0.5 * x[i].cross(x[(i + 1) % sides]);
    }
    EXPECT_NEAR((sum - expected).norm(), 0, 1e-15);
  }
}

TEST(Load, gives_each_end_of_an_edge_half_of_it) {
  const auto map = sheet_from(meshes::sheet(SheetPattern::Quads, 2, 3));
  Loads loads = one(*map, force(Vec3(0, 0, 6)), vertices_where(*map, [](const Vec3& x) { return x.x() == 2; }));
  const Record* f = loads.evaluate(*map, 0, map->position().values().data(), map->velocity().values().data());
  for (Slot v : all_vertices(*map)) {
    const Vec3 x = map->rest()[v];
    const double expected = x.x() < 2 ? 0 : x.y() == 0 || x.y() == 3 ? 1 : 2;
    EXPECT_NEAR(f[v].z, expected, 1e-15);
  }
}

TEST(Load, on_a_rectangle_of_quads_is_a_quarter_for_each_corner) {
  const auto map = solid_from(bar_cells({BarPattern::Hexahedra, 1, 2, 2, Vec3(1, 2, 4)}));
  Loads loads =
      one(*map, force(Vec3(16, 0, 0)), vertices_where(*map, [](const Vec3& x) { return x.x() == 1; }));
  const Record* f = loads.evaluate(*map, 0, map->position().values().data(), map->velocity().values().data());
  for (Slot v : all_vertices(*map)) {
    const Vec3 x = map->rest()[v];
    const double shared = (x.y() == 1 ? 2 : 1) * (x.z() == 2 ? 2 : 1);
    EXPECT_NEAR(f[v].x, x.x() == 1 ? shared : 0, 1e-15);
  }
}

TEST(Load, is_shared_equally_where_no_edge_is_selected) {
  const auto map = sheet_from(meshes::sheet(SheetPattern::Mixed, 4, 4));
  const std::vector<Slot> chosen =
      vertices_where(*map, [](const Vec3& x) { return (x - Vec3(2, 2, 0)).norm() < 0.8 || x.norm() == 0; });
  ASSERT_GE(chosen.size(), 4u);
  Loads loads = one(*map, force(Vec3(0, 0, 1)), chosen);
  const Record* f = loads.evaluate(*map, 0, map->position().values().data(), map->velocity().values().data());
  for (Slot v : all_vertices(*map)) {
    const bool is = std::find(chosen.begin(), chosen.end(), v) != chosen.end();
    EXPECT_NEAR(f[v].z, is ? 1 / static_cast<double>(chosen.size()) : 0, 1e-16);
  }
}

TEST(Load, has_the_total_asked_for_wherever_it_is_and_after_any_separation) {
  const Vec3 f(1, -2, 3), m(-0.5, 0.25, 2);
  for (auto& map : bodies()) {
    for (unsigned some = 0; some < 2; ++some) {
      const auto chosen = vertices_where(*map, [&](const Vec3& x) { return some == 0 || x.x() > 0.9; });
      Loads pull = one(*map, force(f), chosen), turn = one(*map, moment(m), chosen);
      for (unsigned round = 0; round < 3; ++round) {
        if (round > 0) separate_at_random(*map, round);
        shake(*map, 0.3, round);
        pull.rebind(*map);
        turn.rebind(*map);
        EXPECT_NEAR((total(*map, pull).force - f).norm(), 0, 1e-13);
        const Total turned = total(*map, turn);
        EXPECT_NEAR(turned.force.norm(), 0, 1e-13);
        EXPECT_NEAR((turned.moment - m).norm(), 0, 1e-12);
      }
    }
  }
}

TEST(Load, that_follows_the_body_turns_with_it) {
  const Vec3 f(1, -2, 3), m(-0.5, 0.25, 2), shift(3, 1, 4);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.5, Vec3(1, 2, -2) / 3).toRotationMatrix();
  for (auto& map : bodies()) {
    const auto chosen = vertices_where(*map, [](const Vec3& x) { return x.x() > 0.9; });
    Loads pull = one(*map, force(f, true), chosen), twist = one(*map, moment(m, true), chosen);
    for (Slot v : all_vertices(*map)) map->position()[v] = Record(turn * map->rest()[v].vec() + shift);
    EXPECT_NEAR((total(*map, pull).force - turn * f).norm(), 0, 1e-12);
    EXPECT_NEAR((total(*map, twist).moment - turn * m).norm(), 0, 1e-12);
  }
}

TEST(Load, on_a_flat_face_turns_with_it_though_it_has_no_depth) {
  const auto map = solid_from(bar_cells({BarPattern::Hexahedra, 2, 1, 1, Vec3(2, 1, 1)}));
  const auto end = vertices_where(*map, [](const Vec3& x) { return x.x() == 2; });
  Loads pull = one(*map, force(Vec3(5, 0, 0), true), end);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.7, Vec3(0, 0.6, 0.8)).toRotationMatrix();
  for (Slot v : end) map->position()[v] = Record(turn * map->rest()[v].vec());
  EXPECT_NEAR((total(*map, pull).force - turn * Vec3(5, 0, 0)).norm(), 0, 1e-13);
}

// Linear over the cross-section, as a bending stress: the force is proportional to the distance from the
// middle.
TEST(Load, as_a_moment_pulls_on_one_side_and_pushes_on_the_other) {
  const auto map = solid_from(bar_cells({BarPattern::Hexahedra, 1, 4, 1, Vec3(1, 2, 0.3)}));
  Loads turn = one(*map, moment(Vec3(0, 0, 3)), vertices_where(*map, [](const Vec3& x) { return x.x() == 1; }));
  const Record* f = turn.evaluate(*map, 0, map->position().values().data(), map->velocity().values().data());
  for (Slot v : all_vertices(*map)) {
    const Vec3 x = map->rest()[v];
    const double share = x.x() < 1 ? 0 : (x.y() == 0 || x.y() == 2 ? 1 : 2);
    EXPECT_NEAR((f[v].vec() - Vec3(-share * (x.y() - 1) / 2, 0, 0)).norm(), 0, 1e-12) << x.transpose(); // Σ = 3
  }
}

TEST(Load, as_a_moment_about_a_line_is_had_across_it_alone) {
  const auto map = sheet_from(meshes::sheet(SheetPattern::Quads, 3, 3));
  const auto side = vertices_where(*map, [](const Vec3& x) { return x.x() == 3; });
  EXPECT_TRUE(Load(*map, moment(Vec3(1, 0, 2)), Patch::boundary(*map, "a", side)).possible(*map));
  EXPECT_FALSE(Load(*map, moment(Vec3(0, 1, 0)), Patch::boundary(*map, "b", side)).possible(*map));
  Loads turn = one(*map, moment(Vec3(1, 0, 2)), side);
  const Total sum = total(*map, turn);
  EXPECT_NEAR(sum.force.norm(), 0, 1e-14);
  EXPECT_NEAR((sum.moment - Vec3(1, 0, 2)).norm(), 0, 1e-13);
}

TEST(Pressure, on_a_closed_surface_has_no_total) {
  for (BarPattern pattern :
       {BarPattern::Hexahedra, BarPattern::Tetrahedra, BarPattern::Prisms, BarPattern::Mixed}) {
    const auto map = solid(pattern, 5);
    Loads press = one(*map, pressure(10), all_vertices(*map));
    shake(*map, 0.2, 3);
    EXPECT_NEAR(total(*map, press).force.norm(), 0, 1e-12);
    map->position().values() = map->rest().values();
    const Record* f = press.evaluate(*map, 0, map->position().values().data(), map->velocity().values().data());
    double work = 0; // Σ f · x = −3 p V, by the divergence theorem
    for (Slot v : all_vertices(*map)) work += f[v].vec().dot(map->position()[v].vec());
    CellMesh mesh = warped_bar(pattern, 5);
    double volume = 0;
    for (std::size_t c = 0; c < mesh.cells(); ++c) volume += std::abs(signed_volume(mesh, c));
    EXPECT_NEAR(work, -30 * volume, 1e-11);
  }
}

TEST(Pressure, acts_inwards_on_a_sheet_from_where_its_cells_are_counterclockwise) {
  for (SheetPattern pattern : {SheetPattern::Quads, SheetPattern::Triangles, SheetPattern::Mixed}) {
    const auto map = sheet_from(meshes::sheet(pattern, 4, 3));
    Loads press = one(*map, pressure(2), all_vertices(*map));
    EXPECT_NEAR((total(*map, press).force - Vec3(0, 0, -24)).norm(), 0, 1e-13);
    separate_at_random(*map, 2);
    press.rebind(*map);
    EXPECT_NEAR((total(*map, press).force - Vec3(0, 0, -24)).norm(), 0, 1e-13);
  }
}

TEST(Load, grows_between_from_and_until) {
  LoadSettings settings;
  settings.from = 1;
  EXPECT_EQ(settings.share(0.5), 0);
  EXPECT_EQ(settings.share(1), 1);
  settings.until = 3;
  EXPECT_EQ(settings.share(1), 0);
  EXPECT_EQ(settings.share(1.5), 0.25);
  EXPECT_EQ(settings.share(7), 1);
}

const std::string square = R"(<sheet pattern="mixed" cells="3 3" size="1 1"/><mass total="0.5"/>)";
std::string scene_of(const std::string& in_body, const std::string& scheme) {
  return "<scene><body>" + square + in_body + R"(</body><time step="0.01" duration="1" integrator=")" + scheme +
         R"("/></scene>)";
}

// Distribution by vertex mass would be rigid; on a single triangle equal shares are.
TEST(Load, accelerates_a_body_as_its_mass_says) {
  for (const char* scheme : {"verlet", "rk4", "midpoint"}) {
    const auto scene = presets::load(
        R"(<scene><body><sheet pattern="triangles" cells="1 1" size="1 1"/><mass total="0.5"/>
        <load near="0 0 0" force="1 2 3"/><load near="1 1 0" force="1 2 3"/>
        <load near="1 0 0" force="0.5 1 1.5"/><load near="0 1 0" force="0.5 1 1.5"/></body>
        <time step="0.01" duration="1" integrator=")" +
        std::string(scheme) + R"("/></scene>)");
    for (int n = 0; n < 100; ++n) scene->step();
    const Vec3 expected = 0.5 * (Vec3(3, 6, 9) / 0.5 + Vec3(0, 0, -9.81));
    for (Slot v = 0; v < 4; ++v)
      EXPECT_NEAR((scene.body().map->position()[v].vec() - scene.body().map->rest()[v].vec() - expected).norm(),
                  0, 1e-12)
          << scheme;
  }
}

// Velocity under a ramp F t/T: F t²/(2 m T). The trapezoidal rule and better ones are exact, if they evaluate
// the load at both ends.
TEST(Load, that_grows_is_taken_at_the_time_of_each_stage) {
  for (const char* scheme : {"verlet", "rk4", "midpoint"}) {
    const auto scene = presets::load(scene_of(R"(<load all="yes" force="0 4 0" until="2"/>)", scheme));
    for (int n = 0; n < 100; ++n) scene->step();
    EXPECT_NEAR(scene->momentum().y(), 1, 1e-13) << scheme;
  }
}

TEST(Load, keeps_its_total_in_a_body_that_tears) {
  const auto scene = presets::load(scene_of(
      R"(<springs><stretch k="60"/><shear k="40"/></springs><load side="+x" force="3 0 0"/>
      <load near="0 0 0" force="-3 0 0"/><tear criterion="global-border" threshold="0.05"/>)",
      "symplectic"));
  for (int n = 0; n < 60; ++n) scene->step();
  EXPECT_GT(scene->tears(), 3u);
  EXPECT_NEAR(scene->momentum().x(), 0, 1e-13);
  EXPECT_NEAR(scene->momentum().z(), -9.81 * 0.5 * 0.6, 1e-12);
}

std::string load_refusal(const std::string& load) {
  try {
    presets::load(scene_of(load, "rk4"));
  } catch (const UserError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(Load, is_refused_where_it_means_nothing) {
  EXPECT_THAT(load_refusal(R"(<load side="+x"/>)"), HasSubstr("one of force, moment, pressure"));
  EXPECT_THAT(load_refusal(R"(<load side="+x" force="1 0 0" pressure="2"/>)"),
              HasSubstr("of force, moment, pressure"));
  EXPECT_THAT(load_refusal(R"(<load side="+x" pressure="2"/>)"), HasSubstr("no face has all"));
  EXPECT_THAT(load_refusal(R"(<load all="yes" pressure="2" follows="body"/>)"), HasSubstr("along the normals"));
  EXPECT_THAT(load_refusal(R"(<load side="+x" moment="0 1 0"/>)"), HasSubstr("straight line"));
  EXPECT_THAT(load_refusal(R"(<load side="+x" force="0 1 0" from="2" until="1"/>)"),
              HasSubstr("before it starts"));
  EXPECT_EQ(load_refusal(R"(<load side="+x" moment="0 0 1"/>)"), "not refused");
}

} // namespace
} // namespace rend::load_test
