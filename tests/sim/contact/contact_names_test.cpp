// Contact by pairs: what counts for a thing that is named, and what passes through what.
#include "sim/contact/contact_names.h"

#include "sim/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace rend::contact_names_test {
namespace {

std::string sheet(const std::string& name, const std::string& place, const std::string& contact) {
  return "<body name=\"" + name + R"("><sheet cells="2 2" size="0.4 0.4"/><place translate=")" + place +
         R"("/><mass total="0.1"/><springs><stretch k="60"/><shear k="40"/></springs>)" + contact + "</body>";
}

std::string time_of(const std::string& integrator) {
  return "<time step=\"1e-3\" duration=\"9\" integrator=\"" + integrator + "\"/></scene>";
}

double mean_height(const presets::Loaded& scene, std::size_t b) {
  double sum = 0;
  for (Slot v = 0; v < 9; ++v) sum += scene.body(b).map->position()[v].z;
  return sum / 9;
}

double highest(const presets::Loaded& scene, std::size_t b) {
  double most = -1;
  for (Slot v = 0; v < 9; ++v) most = std::max(most, scene.body(b).map->position()[v].z);
  return most;
}

// Gravity is that of a slope of 1 in 2.
const std::string slope = R"(gravity="4 0 -8")";

double travelled(const presets::Loaded& scene, std::size_t b) {
  const Body& body = scene.body(b);
  return body.map->position()[0].x - body.map->rest()[0].x;
}

TEST(ContactNames, on_a_slope_the_body_that_names_it_holds_and_the_other_slides) {
  for (const char* integrator : {"symplectic", "verlet", "implicit"}) {
    const auto scene = presets::load(
        "<scene>" +
        sheet("holds", "0 0 0.002", R"(<contact friction="0.2"/><contact with="slope" friction="0.9"/>)") +
        sheet("slides", "0 2 0.002", R"(<contact friction="0.2"/>)") + "<world " + slope +
        R"(><floor z="0" name="slope"/></world>)" + time_of(integrator));
    for (int n = 0; n < 500; ++n) scene->step();
    EXPECT_LT(travelled(scene, 0), 1e-3) << integrator;
    EXPECT_NEAR(travelled(scene, 1), 0.5 * (4 - 0.2 * 8) * 0.25, 5e-3) << integrator;
  }
}

TEST(ContactNames, of_a_pair_count_before_the_obstacles_own_and_that_before_the_bodys) {
  for (const char* integrator : {"symplectic", "implicit"}) {
    const auto scene = presets::load(
        "<scene>" + sheet("holds", "0 0 0.002", R"(<contact friction="0.1"/>)") +
        sheet("slides", "0 2 0.002", R"(<contact friction="0.9"/><contact with="ramp" friction="0.2"/>)") +
        "<world " + slope + R"(><box name="ramp" low="-1 -1 -1" high="9 9 0" friction="0.9"/></world>)" +
        time_of(integrator));
    for (int n = 0; n < 500; ++n) scene->step();
    EXPECT_LT(travelled(scene, 0), 1e-3) << integrator;
    EXPECT_NEAR(travelled(scene, 1), 0.5 * (4 - 0.2 * 8) * 0.25, 5e-3) << integrator;
  }
}

presets::Loaded two(const std::string& of_a, const std::string& of_b, const std::string& b_at = "0 0 1") {
  return presets::load("<scene>" + sheet("a", "0 0 0", of_a) + sheet("b", b_at, of_b) +
                       R"(<world gravity="0 0 0"/>)" + time_of("symplectic"));
}

const ContactTerms& terms(const presets::Loaded& scene, std::size_t of, std::size_t with) {
  return scene.body(of).contact_table.bodies[with];
}

TEST(ContactNames, two_bodies_take_the_larger_of_their_coefficients_and_a_named_one_before_it) {
  const std::string a = R"(<contact with="fragments" friction="0.2" restitution="0.6"/>)",
                    b = R"(<contact with="fragments" friction="0.5" restitution="0.1"/>)";
  const auto general = two(a, b), named = two(a + R"(<contact with="b" friction="0.1"/>)", b),
             agreed = two(a + R"(<contact with="b" friction="0.1"/>)",
                          b + R"(<contact with="a" friction="0.1" restitution="0.3"/>)");
  for (const std::size_t from : {0u, 1u}) {
    EXPECT_EQ(terms(general, from, 1 - from).friction, 0.5);
    EXPECT_EQ(terms(general, from, 1 - from).restitution, 0.6);
    EXPECT_EQ(terms(named, from, 1 - from).friction, 0.1);
    EXPECT_EQ(terms(named, from, 1 - from).restitution, 0.6);
    EXPECT_EQ(terms(agreed, from, 1 - from).friction, 0.1);
    EXPECT_EQ(terms(agreed, from, 1 - from).restitution, 0.3);
  }
  EXPECT_EQ(terms(named, 0, 0).friction, 0.2) << "its own fragments";
}

TEST(ContactNames, what_excludes_a_sphere_falls_through_it_and_the_other_does_not) {
  for (const char* integrator : {"symplectic", "implicit"}) {
    const auto scene = presets::load("<scene>" + sheet("passes", "-0.2 -0.2 0.3", R"(<contact not="ball"/>)") +
                                     sheet("rests", "-0.2 -0.2 0.4", "<contact/>") +
                                     R"(<world><sphere name="ball" centre="0 0 0" radius="0.2"/></world>)" +
                                     time_of(integrator));
    for (int n = 0; n < 300; ++n) scene->step();
    EXPECT_LT(highest(scene, 0), -0.1);
    EXPECT_GT(highest(scene, 1), 0.2);
    const ContactWork none = scene.body(0).work_meter->work().contact;
    EXPECT_FALSE(none.touched);
    EXPECT_TRUE(std::isinf(none.gap)) << "it was in no contact at all";
    EXPECT_FALSE(scene.body(0).work_meter->touched(1));
    EXPECT_TRUE(scene.body(1).work_meter->touched(1));
  }
}

TEST(ContactNames, bodies_that_exclude_each_other_pass_and_are_not_searched_for_pairs) {
  const std::string falls = R"(<drive all="yes" velocity="0 0 -1" until="0.0015" then="free"/>)",
                    fragments = R"(<contact with="fragments"/>)";
  const auto with = two(fragments, falls + fragments, "0 0 0.1"),
             without = two(fragments, falls + R"(<contact with="fragments" not="a"/>)", "0 0 0.1");
  for (int n = 0; n < 200; ++n) {
    with->step();
    without->step();
  }
  EXPECT_GT(mean_height(with, 1), mean_height(with, 0));
  EXPECT_LT(highest(without, 1), -0.09);
  EXPECT_GT(with->contacts()->fragments()->searches(), 0);
  EXPECT_EQ(without->contacts()->fragments()->searches(), 0);
  EXPECT_EQ(without->contacts()->fragments()->pairs(), 0u);
}

// Three bodies, two of which exclude each other: the pairs are those of the third alone.
TEST(ContactNames, what_is_excluded_has_no_pairs_beside_what_is_not) {
  const auto pairs = [](const std::string& contact_of_b) {
    const auto scene = presets::load("<scene>" + sheet("a", "0 0 0", R"(<contact with="fragments"/>)") +
                                     sheet("b", "0 0 0.0025", contact_of_b) +
                                     sheet("c", "5 0 0", R"(<contact with="fragments"/>)") +
                                     R"(<world gravity="0 0 0"/>)" + time_of("symplectic"));
    scene->step();
    return scene->contacts()->fragments()->pairs();
  };
  EXPECT_GT(pairs(R"(<contact with="fragments"/>)"), 0u);
  EXPECT_EQ(pairs(R"(<contact with="fragments" not="a"/>)"), 0u);
}

TEST(ContactNames, what_is_excluded_may_be_where_the_body_starts) {
  const std::string world = R"(<world><floor z="0.1" name="ground"/>
      <sphere name="ball" centre="0.2 0.2 0" radius="0.1"/></world>)";
  const auto scene = presets::load("<scene>" + sheet("a", "0 0 0", R"(<contact not="ball ground b"/>)") +
                                   sheet("b", "0.1 0.1 0", "") + world + time_of("symplectic"));
  for (int n = 0; n < 10; ++n) scene->step();
  EXPECT_FALSE(scene.body().floor_contact);
  EXPECT_NEAR(scene.body().map->position()[0].z, -0.5 * 9.81 * 1e-4, 1e-4);
  EXPECT_THROW(presets::load("<scene>" + sheet("a", "0 0 0", "<contact/>") + world + time_of("symplectic")),
               UserError);
}

// As a program fills it in.
TEST(ContactNames, settings_of_a_program_name_pairs_as_well) {
  BodySettings settings;
  settings.shape = SheetShape{.nx = 2, .ny = 2, .size = {{1, 1}}};
  settings.place.translate = {0, 0, 1};
  settings.mass.total = 0.1;
  settings.contact = ContactSettings{.friction = 0.3, .pairs = {{.with = {"ground"}, .friction = 0.7}}};
  SceneDefinition scene;
  scene.world.floor = Floor{.name = "ground"};
  scene.time = {.step = 1e-3, .duration = 1};
  add_body(scene, settings);
  const Scene made(std::move(scene), {});
  EXPECT_EQ(made.bodies()[0]->contact_table.obstacles[0].friction, 0.7);
}

} // namespace
} // namespace rend::contact_names_test
