// Prescribed motions against their formulas, in the time loop of a scene.
#include "sim/outside/constraint.h"

#include "sim/base/math.h"
#include "sim/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend::constraint_test {
namespace {

using testing::HasSubstr;

// A cloth of 4 × 4 quads in the xy plane, without gravity, with the given constraints.
presets::Loaded cloth(const std::string& prescribed, const std::string& integrator = "symplectic",
                      const std::string& world = R"(<world gravity="0 0 0"/>)") {
  return presets::load(R"(<scene><body><sheet cells="4 4" size="1 1"/><mass total="0.1"/>
    <springs><stretch k="60"/><shear k="40"/></springs><viscosity value="0.1" per="body"/>)" +
                       prescribed + "</body>" + world + R"(<time step="1e-3" integrator=")" + integrator +
                       R"(" duration="1"/></scene>)");
}

// Slots of the vertices whose rest position satisfies the condition.
template <class F> std::vector<Slot> vertices_where(const Body& body, F&& passes) {
  std::vector<Slot> all;
  for (Slot v = 0; v < body.map->cells(Vertex).slots(); ++v)
    if (passes(body.map->rest()[v].vec())) all.push_back(v);
  return all;
}
const auto at_right = [](const Vec3& x) { return x.x() == 1; };

Vec3 position(const Body& body, Slot v) {
  return body.map->position()[v];
}
Vec3 velocity(const Body& body, Slot v) {
  return body.map->velocity()[v];
}
Vec3 rest(const Body& body, Slot v) {
  return body.map->rest()[v];
}

const std::vector<std::string> every_scheme{"symplectic", "explicit", "verlet", "midpoint", "rk4"};

TEST(Drive, moves_with_its_velocity_then_holds) {
  for (const std::string& scheme : every_scheme) {
    SCOPED_TRACE(scheme);
    const auto scene = cloth(R"(<drive side="+x" velocity="0.3 -0.1 0.2" from="0.02" until="0.1"/>)", scheme);
    const std::vector<Slot> driven = vertices_where(scene.body(), at_right);
    ASSERT_EQ(driven.size(), 5u);
    for (int n = 1; n <= 150; ++n) {
      scene->step();
      const double t = scene->time(), moving = std::min(std::max(t - 0.02, 0.0), 0.08);
      for (Slot v : driven) {
        EXPECT_NEAR((position(scene.body(), v) - rest(scene.body(), v) - moving * Vec3(0.3, -0.1, 0.2)).norm(),
                    0, 1e-15);
        const bool moves = t > 0.0205 && t < 0.0995;
        const Vec3 speed = moves ? Vec3(0.3, -0.1, 0.2) : Vec3(0, 0, 0);
        if (t < 0.0195 || moves || t > 0.1005) { // the ends themselves are not tested, as they are rounded
          EXPECT_EQ(velocity(scene.body(), v), speed) << t;
        }
      }
    }
  }
}

TEST(Drive, reaches_its_displacement_at_the_end) {
  for (const std::string& scheme : every_scheme) {
    const auto scene =
        cloth(R"(<drive side="+x" displacement="0.1 0 -0.2" from="0.01" until="0.06"/>)", scheme);
    const std::vector<Slot> driven = vertices_where(scene.body(), at_right);
    for (int n = 1; n <= 100; ++n) {
      scene->step();
      const double share = std::min(std::max((scene->time() - 0.01) / 0.05, 0.0), 1.0);
      for (Slot v : driven)
        EXPECT_NEAR((position(scene.body(), v) - rest(scene.body(), v) - share * Vec3(0.1, 0, -0.2)).norm(), 0,
                    1e-15)
            << scheme;
    }
  }
}

TEST(Drive, imposes_a_gradient) {
  const auto scene =
      cloth(R"(<drive all="yes" gradient="0.1 0.2 0.3 -0.4 0.5 0.6 0.7 -0.8 0.9" until="0.05"/>)");
  Eigen::Matrix3d g;
  g << 0.1, 0.2, 0.3, -0.4, 0.5, 0.6, 0.7, -0.8, 0.9;
  for (int n = 1; n <= 80; ++n) {
    scene->step();
    const double share = std::min(scene->time() / 0.05, 1.0);
    for (Slot v : scene.body().constraints.vertices()) {
      const Vec3 x = rest(scene.body(), v);
      EXPECT_NEAR((position(scene.body(), v) - x - share * g * x).norm(), 0, 1e-15);
      const Vec3 speed = n < 50 ? Vec3(g * x / 0.05) : Vec3(0, 0, 0);
      if (n != 50) {
        EXPECT_NEAR((velocity(scene.body(), v) - speed).norm(), 0, 1e-13);
      }
    }
  }
  EXPECT_EQ(scene.body().constraints.vertices().size(), 25u);
}

TEST(Drive, turns_about_an_axis_through_its_centre) {
  const Vec3 axis = Vec3(1, -2, 2) / 3, centre(0.2, 0.1, -0.3);
  for (const std::string& scheme : every_scheme) {
    const auto scene = cloth(
        R"(<drive side="+x" rotate="2 -4 4 -250" centre="0.2 0.1 -0.3" from="0.02" until="0.1"/>)", scheme);
    const std::vector<Slot> driven = vertices_where(scene.body(), at_right);
    EXPECT_TRUE(scene.body().constraints.drives());
    for (int n = 1; n <= 150; ++n) {
      scene->step();
      const double t = scene->time(), angle = -250 * std::min(std::max(t - 0.02, 0.0), 0.08) * pi / 180;
      const bool moves = t > 0.0205 && t < 0.0995, rests = t < 0.0195 || t > 0.1005;
      const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
      for (Slot v : driven) {
        const Vec3 r = turn * (rest(scene.body(), v) - centre);
        EXPECT_NEAR((position(scene.body(), v) - centre - r).norm(), 0, 1e-15) << t;
        const Vec3 speed = moves ? Vec3((-250 * pi / 180 * axis).cross(r)) : Vec3(0, 0, 0);
        if (moves || rests) {
          EXPECT_NEAR((velocity(scene.body(), v) - speed).norm(), 0, 1e-14) << t;
        }
      }
    }
  }
}

// Finite differences of the closed form, in the middle of the motion.
TEST(Motion, has_the_derivatives_of_its_place) {
  Motion motion;
  motion.velocity = Vec3(0.1, 0.2, -0.3);
  motion.axis = Vec3(0.6, 0, 0.8);
  motion.rate = 100;
  motion.centre = Vec3(0, 1, 2);
  motion.until = 3;
  const Vec3 x(1, 2, 3);
  const double h = 1e-4, t = 1.2;
  const Vec3 before = motion.offset(x, motion.at(t - h)), at = motion.offset(x, motion.at(t)),
             after = motion.offset(x, motion.at(t + h));
  EXPECT_NEAR(((after - before) / (2 * h) - motion.velocity_at(x, motion.at(t))).norm(), 0, 1e-7);
  EXPECT_NEAR(((after - 2 * at + before) / (h * h) - motion.acceleration_at(x, motion.at(t))).norm(), 0, 1e-6);
}

TEST(Drive, without_an_end_puts_its_vertices_there_at_once) {
  const auto scene = cloth(R"(<drive side="+x" displacement="0.1 0 0" from="0.01"/>)");
  const Slot v = vertices_where(scene.body(), at_right).front();
  for (int n = 1; n <= 30; ++n) {
    scene->step();
    EXPECT_NEAR(position(scene.body(), v).x(), n >= 10 ? 1.1 : 1.0, 1e-15) << n;
  }
}

TEST(Drive, that_ends_where_it_starts_waits_until_then) {
  const auto scene = cloth(R"(<drive side="+x" displacement="0.1 0 0" from="0.01" until="0.01"/>)");
  const Slot v = vertices_where(scene.body(), at_right).front();
  EXPECT_EQ(position(scene.body(), v).x(), 1); // it was moved at the start already
  for (int n = 1; n <= 30; ++n) {
    scene->step();
    EXPECT_NEAR(position(scene.body(), v).x(), n >= 10 ? 1.1 : 1.0, 1e-15) << n;
  }
}

// Whether a step ends exactly at `until` must not matter.
TEST(Drive, lets_go_with_the_speed_it_has) {
  for (const char* until : {"0.1", "0.1004", "0.09999999999", "0.10000000001"}) {
    const auto scene =
        presets::load(std::string(R"(<scene><body><sheet cells="2 2" size="1 1"/><mass total="0.1"/>
        <drive all="yes" velocity="0 0 2" then="free" until=")") +
                      until + R"("/></body><time step="1e-3" duration="1"/></scene>)");
    for (int n = 0; n < 200; ++n) scene->step();
    const double free = 0.2 - std::stod(until);
    for (Slot v = 0; v < 9; ++v) {
      EXPECT_NEAR(velocity(scene.body(), v).z(), 2 - 9.81 * free, 0.011) << until;
      EXPECT_NEAR(position(scene.body(), v).z(), 2 * 0.2 - 9.81 * free * free / 2, 0.004) << until;
    }
  }
}

TEST(Drive, holds_for_ever_unless_it_lets_go) {
  const auto hold = cloth(R"(<drive near="1 1 0" velocity="0 0 1" until="0.01"/>)", "rk4", "");
  const auto free = cloth(R"(<drive near="1 1 0" velocity="0 0 1" until="0.01" then="free"/>)", "rk4", "");
  for (int n = 0; n < 500; ++n) {
    hold->step();
    free->step();
  }
  const Slot v = vertices_where(hold.body(), [](const Vec3& x) { return x == Vec3(1, 1, 0); }).front();
  EXPECT_NEAR(position(hold.body(), v).z(), 0.01, 1e-15);
  EXPECT_LT(position(free.body(), v).z(), -0.5);
}

TEST(Fix, keeps_vertices_where_they_are_at_rest) {
  const auto scene = cloth(R"(<fix near="0.1 0.9 3"/><fix box="0.6 -1 -1 2 0.1 1"/>)", "verlet", "");
  const std::vector<Slot> fixed = vertices_where(
      scene.body(), [](const Vec3& x) { return x == Vec3(0, 1, 0) || (x.x() >= 0.6 && x.y() == 0); });
  ASSERT_EQ(scene.body().constraints.vertices(), fixed);
  EXPECT_FALSE(scene.body().constraints.drives());
  for (int n = 0; n < 300; ++n) scene->step();
  for (Slot v = 0; v < 25; ++v) {
    const bool is = std::find(fixed.begin(), fixed.end(), v) != fixed.end();
    EXPECT_EQ(position(scene.body(), v) == rest(scene.body(), v), is);
    EXPECT_EQ(velocity(scene.body(), v) == Vec3(0, 0, 0), is);
  }
}

TEST(Fix, holds_the_named_axes_alone) {
  const auto scene = cloth(R"(<fix side="+x" axes="xz"/><fix side="-x" axes="z"/>)", "symplectic",
                           R"(<world gravity="1 -3 -9.81"/>)");
  for (int n = 0; n < 100; ++n) scene->step();
  for (Slot v : vertices_where(scene.body(), at_right)) {
    EXPECT_EQ(position(scene.body(), v).x(), 1);
    EXPECT_EQ(position(scene.body(), v).z(), 0);
    EXPECT_LT(position(scene.body(), v).y(), rest(scene.body(), v).y() - 0.005);
  }
  for (Slot v : vertices_where(scene.body(), [](const Vec3& x) { return x.x() == 0; })) {
    EXPECT_NE(position(scene.body(), v).x(), 0);
    EXPECT_EQ(position(scene.body(), v).z(), 0);
  }
}

TEST(Fix, and_drive_share_a_vertex_by_axes) {
  const auto scene = cloth(R"(<fix side="+x" axes="yz"/><drive side="+x" axes="x" velocity="0.5 7 7"/>)");
  for (int n = 0; n < 100; ++n) scene->step();
  for (Slot v : vertices_where(scene.body(), at_right))
    EXPECT_NEAR((position(scene.body(), v) - rest(scene.body(), v) - Vec3(0.05, 0, 0)).norm(), 0, 1e-15);
}

TEST(Constraints, hold_every_fragment_of_a_split_vertex) {
  const auto scene = cloth(R"(<fix side="-x"/><tear criterion="global-border" threshold="1e9"/>)", "rk4", "");
  const std::size_t before = scene.body().constraints.vertices().size();
  scene.body().map->edit([](Edit& edit) {
    for (std::uint32_t d = 0; d < edit.map().capacity(); ++d) unsew(edit, 2, Dart{d});
  });
  scene.body().rebind();
  for (int n = 0; n < 100; ++n) scene->step();
  const std::vector<Slot>& held = scene.body().constraints.vertices();
  EXPECT_EQ(before, 5u);
  EXPECT_EQ(held.size(), 8u);
  EXPECT_TRUE(std::is_sorted(held.begin(), held.end()));
  std::size_t found = 0;
  const EmbeddedMap& map = *scene.body().map;
  for (Slot v = 0; v < map.cells(Vertex).slots(); ++v) {
    if (!map.cells(Vertex).alive(v)) continue;
    const Vec3 x = rest(scene.body(), v);
    if (x.x() != 0) continue;
    ++found;
    EXPECT_EQ(position(scene.body(), v), x);
  }
  EXPECT_EQ(found, held.size());
}

std::string constraint_refusal(const std::string& prescribed) {
  try {
    cloth(prescribed);
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::BadInput);
    return std::string(error.what()) + " | " + error.hint;
  }
  return "not refused";
}

TEST(Constraints, are_refused_where_they_mean_nothing) {
  EXPECT_THAT(constraint_refusal(R"(<drive side="+x" velocity="1 0 0" displacement="1 0 0"/>)"),
              HasSubstr("several of velocity"));
  EXPECT_THAT(constraint_refusal(R"(<drive side="+x"/>)"), HasSubstr("one of velocity"));
  EXPECT_THAT(constraint_refusal(R"(<drive side="+x" rotate="0 0 0 90"/>)"), HasSubstr("no direction"));
  EXPECT_THAT(constraint_refusal(R"(<drive side="+x" velocity="1 0 0" rotate="0 0 1 90"/>)"),
              HasSubstr("several of velocity"));
  EXPECT_THAT(constraint_refusal(R"(<drive side="+x" velocity="1 0 0" centre="0 0 1"/>)"),
              HasSubstr("no use without rotate"));
  EXPECT_THAT(constraint_refusal(R"(<drive side="+x" velocity="1 0 0" from="2" until="1"/>)"),
              HasSubstr("ends before"));
  EXPECT_THAT(constraint_refusal(R"(<fix side="+x" near="0 0 0"/>)"), HasSubstr("has 2 selectors"));
  EXPECT_THAT(constraint_refusal(R"(<fix/>)"), HasSubstr("give one of near, box, side, group, all"));
  EXPECT_THAT(constraint_refusal(R"(<fix box="2 2 2 3 3 3"/>)"), HasSubstr("from (0, 0, 0) to (1, 1, 0)"));
  std::string many;
  for (int n = 0; n < 64; ++n) many += R"(<fix near="0 0 0"/>)";
  EXPECT_EQ(constraint_refusal(many), "not refused");
  EXPECT_THAT(constraint_refusal(many + R"(<fix near="1 0 0"/>)"), HasSubstr("at most 64"));
}

} // namespace
} // namespace rend::constraint_test
