// No edge goes through a face: random heaps of bars, cubes and sheets, whose edges and faces are compared one
// by one after every few steps, by signs of volumes.
#include "sim/contact/crossing_guard.h"

#include "sim/contact/edge_face.h"
#include "sim/heaps.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <set>

namespace rend::crossing_guard_test {
namespace {

using heaps::crossings;
using heaps::goes_through;
using heaps::heap;
using testing::AllOf;
using testing::HasSubstr;

int heaps() { // as many as the time allows
  return std::getenv("REND_WHOLE") ? 200 : 8;
}

TEST(RandomHeaps, are_never_crossed) {
  for (int seed = 0; seed < heaps(); ++seed) {
    const auto scene = presets::load(
        heap(seed, R"(<world gravity="0 0 -9.81"><box low="-0.1 -0.1 0" high="0.7 0.7 0.3"/></world>)"));
    ASSERT_EQ(crossings(*scene.scene), 0);
    for (int n = 0; n < 4000; ++n) {
      scene->step();
      if (n % 5 != 0) continue;
      ASSERT_EQ(crossings(*scene.scene), 0) << "heap " << seed << ", step " << n;
    }
    ASSERT_EQ(scene->contacts()->guard()->figures().left, 0) << seed;
  }
}

// Without gravity, springs damp and contact takes: nothing gives.
TEST(RandomHeaps, keep_momentum_and_make_no_energy) {
  for (int seed = 0; seed < heaps(); ++seed) {
    const auto scene = presets::load(heap(seed, R"(<world gravity="0 0 0"/>)"));
    const Vec3 momentum = scene->momentum(); // about 20 kg m/s
    double least = scene->kinetic_energy() + scene->elastic_energy();
    for (int n = 0; n < 4000; ++n) {
      scene->step();
      const double now = scene->kinetic_energy() + scene->elastic_energy();
      ASSERT_LE(now, 1.002 * least) << "heap " << seed << ", step " << n;
      least = std::min(least, now);
    }
    ASSERT_LT((scene->momentum() - momentum).norm(), 1e-9) << seed;
  }
}

// How many edges of the faces of a box go through those of a body, and the other way around.
int crossings(const ContactBody& body, const Box& box) {
  const auto corner = [&](int n) {
    return Vec3(n & 1 ? box.high.x() : box.low.x(), n & 2 ? box.high.y() : box.low.y(),
                n & 4 ? box.high.z() : box.low.z());
  };
  constexpr std::array<std::array<int, 4>, 6> sides{
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  int count = 0;
  for (const auto& triangle : body.faces->triangles()) {
    TriangleCorners x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = body.from(triangle.vertex[k]);
    for (const auto& [a, b, c, d] : sides) {
      for (const TriangleCorners& y : {TriangleCorners{corner(a), corner(b), corner(c)}, //
                                       TriangleCorners{corner(a), corner(c), corner(d)}})
        for (std::size_t k = 0; k < 3; ++k)
          count += goes_through({x[k], x[(k + 1) % 3]}, y) + goes_through({y[k], y[(k + 1) % 3]}, x);
    }
  }
  return count;
}

// A sheet of one cell upon the end of a post that is thinner: they meet between all vertices of the sheet.
TEST(CrossingGuard, keeps_a_face_out_of_a_box_that_is_thinner) {
  for (const char* turn : {"7 20 0", "40 10 30", "85 3 45"}) {
    const auto scene = presets::load(
        fmt::format(R"(<scene><body name="sheet"><sheet pattern="quads" cells="1 1" size="1 1"/>)"
                    R"(<place rotate="{}" translate="-0.4 -0.4 0.7" velocity="0.1 0.3 -2"/><mass total="1"/>)"
                    R"(<springs><stretch k="2000" damping="0.1"/></springs>)"
                    R"(<contact with="obstacles" thickness="1e-6"/></body>)"
                    R"(<world gravity="0 0 -9.81"><box low="-0.03 -0.02 -2" high="0.02 0.04 0.31"/></world>)"
                    R"(<time step="2e-4" duration="1"/></scene>)",
                    turn));
    for (int n = 0; n < 3000; ++n) {
      scene->step();
      ASSERT_EQ(crossings(*scene->contacts()->bodies().front(), scene->world().boxes[0]), 0) << turn << n;
    }
    EXPECT_EQ(scene->contacts()->guard()->figures().left, 0);
  }
}

// A sheet of 1 mm that is held at its sides, and a small one that strikes it with 100 m/s: 2 cm a step.
TEST(CrossingGuard, keeps_a_thin_sheet_from_one_that_is_fast) {
  const auto sheet = [](const std::string& name, int cells, double size, const std::string& more) {
    return fmt::format(R"(<body name="{}"><sheet pattern="triangles" cells="{} {}" size="{} {}"/>)"
                       R"(<mass density="1000" thickness="0.001"/><elasticity model="corotational" young="1e7")"
                       R"( poisson="0.3" thickness="0.001" damping-stiffness="1e-5"/>{})"
                       R"(<contact with="fragments self" thickness="0.001"/></body>)",
                       name, cells, cells, size, size, more);
  };
  const std::string held = sheet("held", 8, 0.4,
                                 R"(<fix side="-x"/><fix side="+x"/><fix side="-y"/><fix side="+y"/>)"
                                 R"(<place translate="-0.2 -0.2 0"/>)");
  for (const char* turn : {"2 1 30", "87 2 30", "0 0 0", "45 45 0"}) {
    const auto scene = presets::load(
        "<scene>" + held +
        sheet("fast", 3, 0.12,
              fmt::format(R"(<place rotate="{}" translate="-0.04 -0.08 0.13" velocity="0 0 -100"/>)", turn)) +
        R"(<world gravity="0 0 0"/><time integrator="symplectic" step="2e-4" duration="1"/></scene>)");
    const auto highest_speed = [&] { // [m/s], downwards, of the fast one
      double most = 0;
      for (const Record& v : scene.body(1).map->velocity().values()) most = std::max(most, -v.z);
      return most;
    };
    for (int n = 0; n < 40; ++n) {
      scene->step();
      ASSERT_EQ(crossings(*scene.scene), 0) << turn << ", step " << n;
    }
    const auto& held_x = scene.body(0).map->position();
    double lowest = 0;
    for (const Record& x : held_x.values()) lowest = std::min(lowest, x.z);
    EXPECT_LT(lowest, -0.02) << turn << ": it was struck";
    EXPECT_LT(highest_speed(), 60) << turn << ": nothing of the other has gone on";
    EXPECT_EQ(scene->contacts()->guard()->figures().left, 0) << turn;
  }
}

// What the run says that ends when `preset` is advanced by 2000 steps; empty: it does not end.
std::string end_of(const std::string& preset) {
  const auto scene = presets::load(preset);
  try {
    for (int n = 0; n < 2000; ++n) {
      scene->step();
      EXPECT_EQ(crossings(*scene.scene), 0) << n;
    }
  } catch (const Unstable& end) {
    EXPECT_EQ(end.code, Exit::Unstable);
    EXPECT_EQ(crossings(*scene.scene), 0); // the state before
    return end.what();
  }
  return {};
}

// A sheet of two triangles that stands on its edge but for a tilt [degrees], and moves as prescribed.
std::string driven(const std::string& name, double y, double tilt, double speed) {
  return fmt::format(R"(<body name="{}"><sheet pattern="triangles" cells="1 1" size="1 1"/>)"
                     R"(<place rotate="{} 0 0" translate="-0.5 {} -0.5"/><mass total="1"/>)"
                     R"(<springs><stretch k="100"/></springs><drive all="yes" velocity="0 {} 0"/>)"
                     R"(<contact with="obstacles fragments" thickness="0.001"/></body>)",
                     name, 90 - tilt, y, speed);
}

TEST(CrossingGuard, stops_the_run_before_two_bodies_go_through_each_other_that_are_prescribed) {
  const std::string end =
      R"(<world gravity="0 0 0"><floor z="-9"/></world><time step="1e-3" duration="2"/></scene>)";
  EXPECT_THAT(end_of("<scene>" + driven("a", 0, 0, 0.5) + driven("b", 0.6, 20, -0.5) + end),
              AllOf(HasSubstr("body 'a'"), HasSubstr("through body 'b'"), HasSubstr("as prescribed")));
  EXPECT_EQ(end_of("<scene>" + driven("a", 0, 0, 0.5) + driven("b", 0.6, 20, 0.5) + end), "");
}

TEST(CrossingGuard, stops_the_run_before_a_box_goes_through_what_is_held) {
  const std::string held = "<scene>" + driven("a", 0, 0, 0);
  const std::string end = R"(</world><time step="1e-3" duration="2"/></scene>)";
  const std::string box = R"(<world gravity="0 0 0"><box low="-0.1 0.2 -0.1" high="0.1 0.4 0.1">)"
                          R"(<key at="0" position="0 0.3 0"/><key at="1" position="0 {} 0"/></box>)";
  EXPECT_THAT(end_of(held + fmt::format(fmt::runtime(box), -0.3) + end),
              AllOf(HasSubstr("body 'a'"), HasSubstr("through box 1"), HasSubstr("as prescribed")));
  EXPECT_EQ(end_of(held + fmt::format(fmt::runtime(box), 0.15) + end), "");
}

} // namespace
} // namespace rend::crossing_guard_test
