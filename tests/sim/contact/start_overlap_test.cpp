// What starts inside something is refused with its name, depth and place, or leaves it without gaining energy.
#include "sim/contact/start_overlap.h"

#include "sim/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend::start_overlap_test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

std::string bar(const std::string& name, const std::string& at, const std::string& contact,
                const std::string& size = "0.4 0.2 0.2", const std::string& more = "") {
  return "<body name=\"" + name + "\"><bar cells=\"4 2 2\" size=\"" + size + "\"/><place translate=\"" + at +
         R"("/><mass total="10"/><elasticity model="corotational" young="1e5" poisson="0.3"/>)" + more +
         "<contact " + contact + "/></body>";
}

std::string sheet(const std::string& name, const std::string& place, const std::string& contact) {
  return "<body name=\"" + name + R"("><sheet cells="4 4" size="1 1" pattern="triangles"/><place )" + place +
         R"(/><mass total="0.1"/><springs><stretch k="60"/></springs><contact )" + contact + "/></body>";
}

std::string scene(const std::string& bodies, const std::string& world = R"(<floor z="0"/>)",
                  const std::string& gravity = "0 0 -9.81") {
  return "<scene>" + bodies + "<world gravity=\"" + gravity + "\">" + world +
         R"(</world><time step="5e-4" duration="2"/></scene>)";
}

std::string refusal(const std::string& text) {
  try {
    presets::load(text);
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::BadInput);
    return error.what();
  }
  return {};
}

const std::string nothing, apart = R"(<floor z="-9"/>)", both = R"(with="fragments")";
const std::string sphere = R"(<sphere centre="0.2 0.1 0" radius="0.1"/>)";

TEST(StartOverlap, is_refused_with_name_depth_and_place) {
  EXPECT_THAT(refusal(scene(bar("a", "0 0 -0.1", ""))),
              AllOf(HasSubstr("body 'a' starts 0.1 m inside the floor"), HasSubstr(", -0.1) m")));
  EXPECT_THAT(refusal(scene(bar("a", "0 0 0.05", ""), sphere)), HasSubstr("0.05 m inside sphere 1"));
  EXPECT_THAT(refusal(scene(bar("a", "0 0 -0.08", ""), R"(<box low="0 -1 -1" high="1 1 0"/>)")),
              HasSubstr("0.08 m inside box 1"));
  EXPECT_THAT(refusal(scene(bar("a", "0 0 0", both) + bar("b", "0.35 0 0.03", both), apart)),
              HasSubstr("0.05 m inside body 'b'"));
}

// Neither vertices nor faces of the bar are in a small sphere in its middle; no vertex of crossed bars is in
// the other; and a sheet has no inside.
TEST(StartOverlap, is_found_where_no_vertex_is_inside) {
  EXPECT_THAT(
      refusal(scene(bar("a", "-0.2 -0.1 -0.1", ""), R"(<sphere centre="0.05 0.05 0.05" radius="0.02"/>)")),
      HasSubstr("0.07 m inside sphere 1"));
  EXPECT_THAT(refusal(scene(bar("a", "-1.25 -0.1 -0.1", both, "2 0.2 0.2") +
                                bar("b", "-0.13 -1.5 -0.13", both, "0.26 2 0.26"),
                            apart)),
              HasSubstr("inside body 'b'"));
  EXPECT_THAT(refusal(scene(sheet("a", "translate=\"0.03 0.07 0\"", both) +
                                sheet("b", "rotate=\"90 0 0\" translate=\"0.1 0.5 -0.4\"", both),
                            apart)),
              HasSubstr("inside body 'b'"));
  EXPECT_THAT(refusal(scene(sheet("a", "", ""), R"(<sphere centre="0.4 0.6 0.01" radius="0.03"/>)")),
              HasSubstr("0.02 m inside sphere 1"));
}

TEST(StartOverlap, what_touches_is_not_inside) {
  const std::vector<std::string> legal{
      scene(bar("a", "0 0 0", "")),
      scene(bar("a", "0 0 -1e-10", "")),
      scene(bar("a", "0 0 0.1", ""), sphere),
      scene(bar("a", "0 0 0", ""), R"(<box low="0 0 -1" high="0.4 0.2 0"/>)"),
      scene(bar("a", "0 0 0", ""), R"(<box low="0.4 -1 -1" high="1 1 1"/>)"),
      scene(bar("a", "0 0 0", both) + bar("b", "0.4 0 0", both), apart),       // face to face
      scene(bar("a", "0 0 0", both) + bar("b", "0.13 0.03 0.2", both), apart), // one on the other
      scene(bar("a", "0 0 0", both) + bar("b", "0.4 0.2 0.2", both), apart),   // corner to corner
      scene(bar("a", "0 0 0", both) + bar("b", "-0.4 0.05 -0.1", both, "0.4 0.1 0.4"), apart),
      scene(sheet("a", nothing, both) + sheet("b", nothing, both), apart), // in one place: no side yet
      scene(sheet("a", nothing, both) + sheet("b", "rotate=\"90 0 0\"", both), apart),
      scene(sheet("a", nothing, both) + bar("b", "0.3 0.3 0", both), apart),
      scene(bar("a", "0 0 0", "with=\"floor\"") + bar("b", "0.1 0 0", "with=\"floor\"")) // in no contact
  };
  for (const std::string& text : legal) EXPECT_EQ(refusal(text), "") << text;
}

TEST(StartOverlap, does_not_ask_what_is_prescribed) {
  EXPECT_EQ(refusal(scene(bar("a", "0 0 -0.1", "", "0.4 0.2 0.2", R"(<fix all="yes"/>)"))), "");
  EXPECT_THAT(refusal(scene(bar("a", "0 0 -0.1", "", "0.4 0.2 0.2", R"(<fix side="-x"/>)"))),
              HasSubstr("inside the floor"));
}

double kinetic_and_elastic(const presets::Loaded& s) {
  return s->kinetic_energy() + s->elastic_energy();
}

// At the start nothing but the weight lifted; later nothing but what gravity gives back.
TEST(StartOverlap, pushed_out_of_the_floor_it_gains_the_weight_lifted_alone) {
  const auto s = presets::load(scene(bar("a", "0 0 -0.1", R"(overlap="push")")));
  EXPECT_TRUE(start_overlaps(s->world(), s->bodies()).empty());
  EXPECT_LT(kinetic_and_elastic(s), 1e-20);
  const double middle = 0.102 + 0.1 - 0.1; // lifted by the depth and the thickness
  EXPECT_NEAR(s->gravity_energy(), 10 * 9.81 * middle, 1e-9);
  EXPECT_THAT(s.body().notes, Contains(HasSubstr("inside the floor, and was moved by (0, 0, 0.102) m")));
  const double start = s->gravity_energy();
  while (s->time() < 1) {
    s->step();
    ASSERT_LE(kinetic_and_elastic(s) + s->gravity_energy(), start + 1e-3 * 10 * 9.81 * 0.102) << s->time();
  }
}

TEST(StartOverlap, pushed_out_of_each_other_bodies_stay_at_rest) {
  const auto s = presets::load(scene(bar("a", "0 0 0", R"(with="fragments" overlap="push")") +
                                         bar("b", "0.37 0.05 0.02", R"(with="fragments" overlap="push")"),
                                     apart, "0 0 0"));
  Vec3 centre = Vec3::Zero();
  for (const auto& body : s->bodies()) {
    Vec3 low = Vec3::Constant(1e9), high = -low;
    for (const Record& x : body->map->position().values()) {
      low = low.cwiseMin(x.vec());
      high = high.cwiseMax(x.vec());
    }
    centre += 0.25 * (low + high);
  }
  EXPECT_LT((centre - 0.5 * (Vec3(0.2, 0.1, 0.1) + Vec3(0.57, 0.15, 0.12))).norm(), 1e-14)
      << "the centre of mass";
  while (s->time() < 0.2) s->step();
  EXPECT_LT(kinetic_and_elastic(s), 1e-20);
}

TEST(StartOverlap, pushed_out_of_a_sphere_a_box_and_a_sheet) {
  for (const std::string& world :
       {sphere, std::string(R"(<box low="0 -1 -1" high="1 1 0"/><sphere centre="0 0 0.3" radius="0.05"/>)")}) {
    const auto s = presets::load(scene(bar("a", "0.1 0 -0.08", R"(overlap="push")"), world, "0 0 0"));
    EXPECT_TRUE(start_overlaps(s->world(), s->bodies()).empty());
    while (s->time() < 0.2) s->step();
    EXPECT_LT(kinetic_and_elastic(s), 1e-20);
  }
  const std::string push = R"(with="fragments" overlap="push")";
  const auto s = presets::load(scene(sheet("a", "translate=\"0.03 0.07 0\"", both) +
                                         sheet("b", "rotate=\"90 0 0\" translate=\"0.1 0.5 -0.1\"", push),
                                     apart, "0 0 0"));
  EXPECT_TRUE(start_overlaps(s->world(), s->bodies()).empty());
}

TEST(StartOverlap, what_is_held_cannot_be_pushed) {
  EXPECT_THAT(refusal(scene(bar("a", "0 0 -0.1", R"(overlap="push")", "0.4 0.2 0.2", R"(<fix side="-x"/>)"))),
              HasSubstr("0.1 m inside the floor"));
  EXPECT_THAT(refusal(scene(bar("a", "0 0 0.1", R"(overlap="push")"),
                            R"(<floor z="0.15"/><box low="-1 -1 0.2" high="1 1 9"/>)")),
              HasSubstr("inside"));
}

// The distance that contact keeps, 2 mm, is reached gradually, at 0.04 m/s at first: what rests on the floor
// is not thrown up, and gains the weight lifted and at most the energy of twice that speed.
TEST(StartOverlap, what_touches_the_floor_is_lifted_without_being_thrown) {
  const auto s = presets::load(scene(bar("a", "0 0 0", "")));
  const double start = s->gravity_energy();
  while (s->time() < 0.5) {
    s->step();
    ASSERT_LE(kinetic_and_elastic(s) + s->gravity_energy(), start + 10 * 9.81 * 0.002 + 0.5 * 10 * 0.08 * 0.08)
        << s->time();
  }
}

} // namespace
} // namespace rend::start_overlap_test
