// Bodies that rules construct, against the generators of sim/mesh, which know no rules.
#include "sim/build/construction.h"

#include "sim/topology/count.h"
#include "sim/topology/isomorphism.h"
#include "sim/topology/validate.h"
#include "tests/sim/presets.h"

#include <gtest/gtest.h>

namespace rend {
namespace {

// A scene of one body with that shape, rules of its own before it.
presets::Loaded body_of(const std::string& shape, const std::string& rules = "", const std::string& more = "") {
  return presets::load("<scene>" + rules + "<body>" + shape +
                       R"(<mass total="1"/><springs><stretch k="60"/></springs>)" + more +
                       R"(</body><time step="1e-4" duration="0.01"/></scene>)");
}

void expect_same_shape(const EmbeddedMap& one, const EmbeddedMap& other) {
  EXPECT_TRUE(isomorphism(one.map(), other.map(), [&](Dart a, Dart b) {
    return (one.position_of(a) - other.position_of(b)).norm() < 1e-12;
  }));
}

// What the message says, and its code: 0 if nothing is wrong.
std::pair<int, std::string> refusal_of(const std::string& shape, const std::string& rules = "") {
  try {
    body_of(shape, rules);
  } catch (const UserError& error) {
    return {static_cast<int>(error.code), error.what()};
  }
  return {};
}

bool says(const std::pair<int, std::string>& refusal, const std::string& words) {
  return refusal.first == 65 && refusal.second.find(words) != std::string::npos;
}

TEST(Construction, a_bar_from_one_vertex_is_the_generators_bar) {
  const auto by_rules = body_of(R"(<create dimension="3"/>
      <apply rule="create-vertex" p="point(0, -0.075, -0.075)" /
                                > <apply rule = "extrude-vertex" v = "point(0.15, 0, 0)" />
                                <apply rule = "extrude-edge" v = "point(0, 0.15, 0)" />
                                <apply rule = "extrude-face" v = "point(0, 0, 0.15)" />
                                <apply rule = "extrude-side" side = "+x" times = "3" v = "point(0.15, 0, 0)" />
                                <subdivide times = "1" />) ");
      const auto generated = body_of(R"(<bar pattern="hexahedra" cells="8 2 2" size="0.6 0.15 0.15"/>)");
  const auto origin = [](const EmbeddedMap& map) {
    Vec3 low = Vec3::Constant(1e9);
    map.map().for_each_dart([&](Dart d) { low = low.cwiseMin(map.position_of(d)); });
    return low;
  };
  const EmbeddedMap &one = *by_rules.body().map, &other = *generated.body().map;
  const Vec3 a = origin(one), b = origin(other);
  EXPECT_TRUE(isomorphism(one.map(), other.map(), [&](Dart d, Dart e) {
    return ((one.position_of(d) - a) - (other.position_of(e) - b)).norm() < 1e-12;
  }));
}

TEST(Construction, a_quad_divided_three_times_is_a_sheet_of_eight_by_eight) {
  const auto by_rules = body_of(R"(<sheet cells="1 1" size="1 1"/><subdivide times="3"/>)");
  const auto generated = body_of(R"(<sheet cells="8 8" size="1 1"/>)");
  expect_same_shape(*by_rules.body().map, *generated.body().map);
}

TEST(Construction, place_and_mass_come_after_the_rules) {
  const std::string place = R"(<place scale="2" rotate="0 0 90" translate="1 2 3"/>)";
  const auto by_rules = body_of(R"(<sheet cells="1 1" size="1 1"/><subdivide times="2"/>)" + place);
  const auto generated = body_of(R"(<sheet cells="4 4" size="1 1"/>)" + place);
  expect_same_shape(*by_rules.body().map, *generated.body().map);
  EXPECT_NEAR(total_mass(*by_rules.body().map, *by_rules.body().mass), 1, 1e-14);
}

TEST(Construction, a_body_does_not_remember_how_it_was_made) {
  const auto once = body_of(R"(<sheet cells="2 2" size="1 1"/><subdivide times="2"/>)");
  const auto twice = body_of(R"(<sheet cells="2 2" size="1 1"/><subdivide/><subdivide/>)");
  EXPECT_EQ(once->hash(), twice->hash());
}

TEST(Construction, a_rule_applies_where_all_vertices_are_selected) {
  const auto slit =
      body_of(R"(<sheet cells="4 4" size="1 1"/><apply rule="unsew-edge" box="0.5 0.5 0 0.5 1 0"/>)");
  const CellCounts counts = count_cells(slit.body().map->map());
  EXPECT_EQ(counts.vertices, 25u + 2u); // the slit's two upper vertices are there twice, its end once
  EXPECT_EQ(counts.edges, 40u + 2u);
  EXPECT_EQ(counts.fragments, 1u);
}

TEST(Construction, rules_of_the_preset_and_their_arguments_move_vertices) {
  const std::string rule = R"(<rule name="lift" left="a*(1,2,3)" right="a(1,2,3)"><where name="by" value="1"/>
      <set node="a" position="a + point(0, 0, by*x(a))"/></rule>)";
  const auto lifted = body_of(R"(<sheet cells="2 2" size="1 1"/><apply rule="lift" by="3"/>)", rule);
  const EmbeddedMap& map = *lifted.body().map;
  map.map().for_each_dart([&](Dart d) {
    EXPECT_DOUBLE_EQ(map.position_of(d).z(), 3 * map.position_of(d).x());
    EXPECT_EQ(map.position_of(d), map.rest_of(d));
  });
}

TEST(Construction, refuses_what_is_no_body_in_a_sentence) {
  EXPECT_TRUE(says(refusal_of(R"(<create dimension="2"/>)"), "leave nothing of the body"));
  EXPECT_TRUE(says(refusal_of(R"(<create dimension="2"/><apply rule="create-vertex"/>)"), "a face is open"));
  EXPECT_TRUE(says(refusal_of(R"(<create dimension="3"/><apply rule="create-quad"/>)"), "a volume is open"));
  EXPECT_TRUE(
      says(refusal_of(R"(<sheet cells="2 2" size="1 1"/><apply rule="star-volume"/>)"), "applies nowhere"));
  EXPECT_TRUE(
      says(refusal_of(R"(<sheet cells="2 2" size="1 1"/><apply rule="star-fase"/>)"), "there is no rule"));
  EXPECT_TRUE(says(refusal_of(R"(<sheet cells="2 2" size="1 1"/><apply rule="star-face" v="1"/>)"),
                   "has no argument 'v'"));
  EXPECT_TRUE(says(refusal_of(R"(<sheet cells="2 2" size="1 1"/><apply rule="move" v="point(1/0, 0, 0)" /
                              >) "),
                                 "v of rule 'move'"));
  EXPECT_TRUE(says(refusal_of(R"(<sheet cells="2 2" size="1 1"/><apply rule="sew-edges"/>)"), "has 2 hooks"));
  const std::string flat = R"(<rule name="flatten" left="a*(1,2,3)" right="a(1,2,3)">
      <set node="a" position="point(x(a), 0, 0)"/></rule>)";
  EXPECT_TRUE(says(refusal_of(R"(<sheet cells="2 2" size="1 1"/><apply rule="flatten"/>)", flat), "no area"));
  const std::string collapsed = R"(<rule name="spike" left="a*(0,1) a|3" right="a(0,_) b(_,2) c(1,2) a-1-b b-0-c
      a|3 b|3 c|3"><set node="c" position="point(9, 9, 0)"/></rule>)";
  EXPECT_EQ(refusal_of(R"(<sheet cells="1 1" size="1 1"/><apply rule="star-face"/>)").first, 0);
  EXPECT_NE(refusal_of(R"(<sheet cells="1 1" size="1 1"/><apply rule="spike"/>)", collapsed).first, 70);
}

// The steps of a law that separates borders are those of the same law by the rule.
TEST(LawByRule, unsew_edge_is_separate) {
  const auto run = [](const std::string& change) {
    auto scene = presets::load(
        presets::cloth("quads", 12, R"(<tear criterion="atomic-border" threshold="0.9" )" + change + "/>"));
    for (int n = 0; n < 400; ++n) scene->step();
    return std::pair(scene->hash(), scene.body().events.size());
  };
  const auto by_change = run(R"(change="separate")"), by_rule = run(R"(rule="unsew-edge")");
  EXPECT_GT(by_change.second, 0u);
  EXPECT_EQ(by_change, by_rule);
}

// Stressed triangles are halved; mass and momentum stay, and what is bound to the map stays so.
TEST(LawByRule, what_divides_keeps_mass_and_momentum) {
  auto scene = presets::load(R"(<scene><body><sheet pattern="triangles" cells="8 4" size="0.8 0.4"/>
      <mass density="1000" thickness="1e-3"/>
      <elasticity model="corotational" young="2e5" poisson="0.3" thickness="1e-3" damping-mass="50"/>
      <drive side="-x" velocity="-0.3 0 0"/><drive side="+x" velocity="0.3 0 0"/>
      <tear criterion="atomic-element" threshold="1e4" rule="halve-triangles" until="0.12" max-per-step="3"/>
      </body><world gravity="0 0 0"/><time step="1e-4" duration="1"/></scene>)");
  Body& body = scene.body();
  const double mass = total_mass(*body.map, *body.mass);
  const std::size_t elements = count_cells(body.map->map()).faces;
  std::size_t tears = 0;
  for (int n = 0; n < 1200 && body.map->map().dart_count() < 3000; ++n) {
    scene->step();
    if (body.events.size() == tears) continue;
    tears = body.events.size();
    const auto fault = validate(*body.map);
    ASSERT_FALSE(fault) << *fault;
    ASSERT_NEAR(total_mass(*body.map, *body.mass), mass, 1e-13 * mass);
  }
  EXPECT_GT(tears, 3u);
  EXPECT_GT(count_cells(body.map->map()).faces, elements + 3);
  // rest area: the sum over all faces is what it was
  double area = 0;
  for_each_face(*body.map, [&](Dart d) { area += rest_area(*body.map, d); });
  EXPECT_NEAR(area, 0.32, 1e-12);
}

TEST(LawByRule, refuses_what_a_law_cannot_do) {
  const auto refused = [](const std::string& law) {
    try {
      presets::load(presets::cloth("quads", 4, law));
    } catch (const UserError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refused(R"(<tear criterion="atomic-border" threshold="1" rule="quarter-faces"/>)")
                .find("whole component"),
            std::string::npos);
  EXPECT_NE(refused(R"(<tear criterion="atomic-border" threshold="1" rule="sew-edges"/>)").find("2 hooks"),
            std::string::npos);
  EXPECT_NE(refused(R"(<tear criterion="atomic-border" threshold="1" rule="unsew-edge" change="separate"/>)")
                .find("both a change and a rule"),
            std::string::npos);
}

} // namespace
} // namespace rend
