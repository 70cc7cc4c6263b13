// Bodies that rules construct, against the generators of sim/mesh, which know no rules; and laws that act by
// rules.
#include "sim/build/construction.h"

#include "sim/topology/count.h"
#include "sim/topology/isomorphism.h"
#include "sim/topology/validate.h"
#include "sim/topology/walk.h"
#include "tests/sim/presets.h"

#include <gtest/gtest.h>

#include <map>

namespace rend::construction_test {
namespace {

// A scene of one body with that shape, rules of its own before it.
presets::Loaded body_of(const std::string& shape, const std::string& rules = "") {
  return presets::load("<scene>" + rules + "<body>" + shape +
                       R"xml(<mass total="1"/><springs><stretch k="60"/></springs></body>)xml" +
                       R"xml(<time step="1e-4" duration="0.01"/></scene>)xml");
}

void expect_same_shape(const EmbeddedMap& one, const EmbeddedMap& other) {
  EXPECT_TRUE(isomorphism(one.map(), other.map(), [&](Dart a, Dart b) {
    return (one.position_of(a) - other.position_of(b)).norm() < 1e-12;
  }));
}

// The message of the refusal; empty: it was not refused. Its code must be 65.
std::string refusal_of(const std::string& shape, const std::string& rules = "") {
  try {
    body_of(shape, rules);
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::BadInput);
    return error.what();
  }
  return {};
}

std::string hint_of(const std::string& shape) {
  try {
    body_of(shape);
  } catch (const UserError& error) {
    return error.hint;
  }
  return {};
}

bool says(const std::string& refusal, const std::string& words) {
  return refusal.find(words) != std::string::npos;
}

const std::string four_quads = R"xml(<sheet cells="2 2" size="1 1"/>)xml";

TEST(Construction, a_bar_from_one_vertex_is_the_generators_bar) {
  const auto by_rules = body_of(R"xml(<create dimension="3"/>
      <apply rule="create-vertex"/>
      <apply rule="extrude-vertex" v="point(0.15, 0, 0)"/>
      <apply rule="extrude-edge" v="point(0, 0.15, 0)"/>
      <apply rule="extrude-face" v="point(0, 0, 0.15)"/>
      <apply rule="extrude-side" side="+x" times="3" v="point(0.15, 0, 0)"/>
      <subdivide times="1"/>)xml");
  const auto generated = body_of(R"xml(<bar pattern="hexahedra" cells="8 2 2" size="0.6 0.15 0.15"/>)xml");
  const auto lowest = [](const EmbeddedMap& map) {
    Vec3 low = Vec3::Constant(1e9);
    map.map().for_each_dart([&](Dart d) { low = low.cwiseMin(map.position_of(d)); });
    return low;
  };
  const EmbeddedMap &one = *by_rules.body().map, &other = *generated.body().map;
  const Vec3 a = lowest(one), b = lowest(other);
  EXPECT_TRUE(isomorphism(one.map(), other.map(), [&](Dart d, Dart e) {
    return ((one.position_of(d) - a) - (other.position_of(e) - b)).norm() < 1e-12;
  }));
}

TEST(Construction, a_quad_divided_three_times_is_a_sheet_of_eight_by_eight) {
  const auto by_rules = body_of(R"xml(<sheet cells="1 1" size="1 1"/><subdivide times="3"/>)xml");
  const auto generated = body_of(R"xml(<sheet cells="8 8" size="1 1"/>)xml");
  expect_same_shape(*by_rules.body().map, *generated.body().map);
}

TEST(Construction, place_and_mass_come_after_the_rules) {
  const std::string place = R"xml(<place scale="2" rotate="0 0 90" translate="1 2 3"/>)xml";
  const auto by_rules = body_of(R"xml(<sheet cells="1 1" size="1 1"/><subdivide times="2"/>)xml" + place);
  const auto generated = body_of(R"xml(<sheet cells="4 4" size="1 1"/>)xml" + place);
  expect_same_shape(*by_rules.body().map, *generated.body().map);
  EXPECT_NEAR(total_mass(*by_rules.body().map, *by_rules.body().mass), 1, 1e-14);
}

TEST(Construction, all_faces_of_a_sheet_show_the_same_side) {
  const auto by_rules =
      body_of(R"xml(<create dimension="2"/><apply rule="create-quad"/><subdivide times="3"/>)xml");
  const EmbeddedMap& map = *by_rules.body().map;
  for_each_face(map, [&](Dart d) { // from the smallest dart: to the next corner, and back to the last
    const Vec3 x = map.position_of(d), next = map.position_of(map.map().alpha(0, d)),
               last = map.position_of(map.map().follow(d, std::string_view("10")));
    EXPECT_GT((next - x).cross(last - x).z(), 0);
  });
}

TEST(Construction, a_body_does_not_remember_how_often_rules_were_asked) {
  const auto once = body_of(four_quads + R"xml(<subdivide times="2"/>)xml");
  const auto twice = body_of(four_quads + "<subdivide/><subdivide/>");
  EXPECT_EQ(once->hash(), twice->hash());
}

TEST(Construction, a_rule_applies_where_all_vertices_are_selected) {
  const auto slit = body_of(R"xml(<sheet cells="4 4" size="1 1"/>
      <apply rule="unsew-edge" box="0.5 0.5 0 0.5 1 0"/>)xml");
  const CellCounts counts = count_cells(slit.body().map->map());
  EXPECT_EQ(counts.vertices, 25u + 2u); // the slit's two upper vertices are there twice, its end once
  EXPECT_EQ(counts.edges, 40u + 2u);
  EXPECT_EQ(counts.fragments, 1u);
}

TEST(Construction, what_touches_is_sewn) {
  const std::string slit =
      R"xml(<sheet cells="4 4" size="1 1"/><apply rule="unsew-edge" box="0.5 0 0 0.5 1 0"/>)xml";
  EXPECT_EQ(count_cells(body_of(slit).body().map->map()).fragments, 2u);
  const auto sewn = body_of(slit + R"xml(<apply rule="sew-edges" with="touching"/>)xml");
  const auto whole = body_of(R"xml(<sheet cells="4 4" size="1 1"/>)xml");
  expect_same_shape(*sewn.body().map, *whole.body().map);
  const std::string cut =
      R"xml(<bar cells="4 2 2" size="2 1 1"/><apply rule="unsew-face" box="1 -9 -9 1 9 9"/>)xml";
  EXPECT_EQ(count_cells(body_of(cut).body().map->map()).fragments, 2u);
  const auto bar = body_of(cut + R"xml(<apply rule="sew-faces" with="touching"/>)xml");
  const auto uncut = body_of(R"xml(<bar cells="4 2 2" size="2 1 1"/>)xml");
  expect_same_shape(*bar.body().map, *uncut.body().map);
}

TEST(Construction, rules_of_the_preset_and_their_arguments_move_vertices) {
  const std::string rule =
      R"xml(<rule name="lift" left="a*(1,2,3)" right="a(1,2,3)"><where name="by" value="1"/>
      <set node="a" position="a + point(0, 0, by*x(a))"/></rule>)xml";
  const auto lifted = body_of(four_quads + R"xml(<apply rule="lift" by="3"/>)xml", rule);
  const EmbeddedMap& map = *lifted.body().map;
  map.map().for_each_dart([&](Dart d) {
    EXPECT_DOUBLE_EQ(map.position_of(d).z(), 3 * map.position_of(d).x());
    EXPECT_EQ(map.position_of(d), map.rest_of(d));
  });
}

// Scripts stand where rules may, and what they make is what as many rules make, one after another.
TEST(Construction, scripts_construct) {
  const std::string cube = R"xml(<bar pattern="hexahedra" cells="2 1 1" size="2 1 1"/>)xml";
  const auto by_script = body_of(cube + R"xml(<apply rule="split-into-tetrahedra"/>)xml");
  const auto by_rules =
      body_of(cube + R"xml(<apply rule="star-face-both-sides"/><apply rule="star-volume"/>)xml");
  EXPECT_EQ(count_cells(by_script.body().map->map()).volumes, 2u * 24);
  expect_same_shape(*by_script.body().map, *by_rules.body().map);
  const std::string own = R"xml(<script name="twice" hook="a*(0,1,2,3)"><where name="t" value="0.1"/>
      <for each="e*(0,1,2,3)" apply="extrude-hull" t="t"/>
      <for each="e*(0,1,2,3)" apply="extrude-hull" t="2*t"/></script>)xml";
  const auto layers = body_of(cube + R"xml(<apply rule="twice" t="0.5"/>)xml", own);
  EXPECT_EQ(count_cells(layers.body().map->map()).volumes, 2u + 10 + 10);
  EXPECT_TRUE(says(refusal_of(cube + R"xml(<apply rule="divide-tetrahedra"/>)xml"),
                   "script 'divide-tetrahedra' applies nowhere: step 4"));
  EXPECT_TRUE(says(refusal_of(cube + R"xml(<apply rule="twice" s="1"/>)xml", own), "has no argument 's'"));
  EXPECT_TRUE(says(refusal_of(cube + R"xml(<apply rule="split-vertex-of-solid"/>)xml"), "asks for across"));
}

TEST(Construction, scripts_pass_on_mass_and_rest) {
  const auto divided = body_of(R"xml(<bar pattern="tetrahedra" cells="2 1 1" size="2 1 1"/>
      <apply rule="divide-tetrahedra" times="2"/>)xml");
  const EmbeddedMap& map = *divided.body().map;
  EXPECT_NEAR(total_mass(map, *divided.body().mass), 1, 1e-13);
  map.map().for_each_dart([&](Dart d) { EXPECT_EQ(map.position_of(d), map.rest_of(d)); });
}

TEST(Construction, refuses_what_is_no_body_in_a_sentence) {
  EXPECT_TRUE(says(refusal_of(R"xml(<create dimension="2"/>)xml"), "leave nothing of the body"));
  EXPECT_TRUE(says(refusal_of(R"xml(<create dimension="2"/><apply rule="create-vertex"/>)xml"),
                   "rule 'create-vertex' leaves a face open, near (0, 0, 0)"));
  // A rule that is well formed, and opens faces at the border: it is named, not one after it.
  const std::string opens = R"xml(<rule name="opens" left="a*(0,1,2) a|3" right="a(0,1,2) b(_,_,0) a|3 b|1,2,3">
      <set node="b" position="mean(a, component)"/></rule>)xml";
  EXPECT_TRUE(says(
      refusal_of(four_quads + R"xml(<apply rule="opens" to="all"/><apply rule="move" to="all"/>)xml", opens),
      "rule 'opens' leaves a face open, near"));
  // Not all vertices of a face are selected.
  EXPECT_TRUE(says(
      hint_of(four_quads + R"xml(<apply rule="star-face" near="0 0 0"/>)xml"),
      "its hook stands for all darts of an orbit <0,1> (face, one volume), and is tried where all vertices of "
      "that are selected"));
  EXPECT_TRUE(says(refusal_of(R"xml(<create dimension="3"/><apply rule="create-quad"/>)xml"),
                   "rule 'create-quad' leaves a volume open"));
  EXPECT_TRUE(says(refusal_of(four_quads + R"xml(<apply rule="star-volume"/>)xml"),
                   "changes what lies between volumes"));
  EXPECT_TRUE(says(refusal_of(four_quads + R"xml(<apply rule="star-fase"/>)xml"), "there is no rule"));
  EXPECT_TRUE(says(refusal_of(four_quads + R"xml(<apply rule="star-face" v="1"/>)xml"), "has no argument 'v'"));
  EXPECT_TRUE(
      says(refusal_of(four_quads + R"xml(<apply rule="move" v="point(1/0, 0, 0)"/>)xml"), "v of rule 'move'"));
  EXPECT_TRUE(says(refusal_of(four_quads + R"xml(<apply rule="sew-edges"/>)xml"), "has 2 hooks"));
  EXPECT_TRUE(
      says(refusal_of(four_quads + R"xml(<apply rule="move" with="touching"/>)xml"), "has no second hook"));
  const std::string flatten = R"xml(<rule name="flatten" left="a*(1,2,3)" right="a(1,2,3)">
      <set node="a" position="point(x(a), 0, 0)"/></rule>)xml";
  EXPECT_TRUE(says(refusal_of(four_quads + R"xml(<apply rule="flatten"/>)xml", flatten), "no area"));
}

// A sheet of quads is swept to the bar of the generator, and one of triangles to prisms; groups go along.
TEST(Construction, a_sheet_becomes_a_solid) {
  const auto swept = body_of(
      R"xml(<sheet cells="3 2" size="0.3 0.2"/>
            <apply rule="extrude-sheet" to="all" v="point(0, 0, 0.1)"/>)xml");
  const auto generated = body_of(R"xml(<bar pattern="hexahedra" cells="3 2 1" size="0.3 0.2 0.1"/>)xml");
  EXPECT_EQ(swept.body().map->dimension(), 3);
  EXPECT_NEAR(total_mass(*swept.body().map, *swept.body().mass), 1, 1e-12);
  const auto low = [](const EmbeddedMap& map) {
    Vec3 least = Vec3::Constant(1e9);
    map.map().for_each_dart([&](Dart d) { least = least.cwiseMin(map.position_of(d)); });
    return least;
  };
  const EmbeddedMap &one = *swept.body().map, &other = *generated.body().map;
  const Vec3 a = low(one), b = low(other);
  EXPECT_TRUE(isomorphism(one.map(), other.map(), [&](Dart d, Dart e) {
    return (one.position_of(d) - a - other.position_of(e) + b).norm() < 1e-12;
  }));
  const auto prisms = body_of(
      R"xml(<sheet pattern="triangles" cells="2 1" size="2 1"/><apply rule="extrude-sheet" to="all"/>
            <apply rule="extrude-side" box="-9 -9 0.05 9 9 9" v="point(0, 0, 0.1)"/>)xml");
  const CellCounts counts = count_cells(prisms.body().map->map());
  EXPECT_EQ(
      counts.volumes,
      2 * count_cells(body_of(R"xml(<sheet pattern="triangles" cells="2 1" size="2 1"/>)xml").body().map->map())
              .faces);
  EXPECT_TRUE(
      says(refusal_of(R"xml(<sheet cells="2 2" size="1 1"/><apply rule="extrude-sheet" side="+x"/>)xml"),
           "applies nowhere"));
}

// It has no step, so that nothing has to limit one.
TEST(Construction, a_scene_of_no_duration_is_only_built) {
  const auto built = presets::load(R"xml(<scene><body><create dimension="2"/><apply rule="create-quad"/>
      <subdivide times="2"/><mass total="1"/></body><time duration="0"/></scene>)xml");
  expect_same_shape(*built.body().map, *body_of(R"xml(<sheet cells="4 4" size="1 1"/>)xml").body().map);
  EXPECT_EQ(built->duration(), 0);
}

// All vertices of a round go to the mean of where their neighbours were before it, whatever the numbers of
// darts.
TEST(Construction, a_round_reads_the_points_from_before_it) {
  const auto smoothed = body_of(R"xml(<sheet cells="3 3" size="3 3"/><apply rule="bump" to="all"/>
      <apply rule="smooth" to="all"/>)xml",
                                R"xml(<rule name="bump" left="a*(1,2,3)" right="a(1,2,3)">
          <set node="a" position="a + point(0, 0, noise(3*a))"/></rule>
      <rule name="smooth" left="a*(1,2,3)" right="a(1,2,3)">
          <set node="a" position="mean(a, neighbours)"/></rule>)xml");
  const auto bumped = body_of(R"xml(<sheet cells="3 3" size="3 3"/><apply rule="bump" to="all"/>)xml",
                              R"xml(<rule name="bump" left="a*(1,2,3)" right="a(1,2,3)">
          <set node="a" position="a + point(0, 0, noise(3*a))"/></rule>)xml");
  const EmbeddedMap &after = *smoothed.body().map, &before = *bumped.body().map;
  before.map().for_each_dart([&](Dart d) { // the darts of both are numbered alike
    std::map<Slot, Vec3> neighbours;
    for (Dart e : darts_of(before.map(), Vertex, d)) {
      const Dart far = before.map().alpha(0, e);
      neighbours[before.vertex(far)] = before.position_of(far);
    }
    Vec3 mean = Vec3::Zero();
    for (const auto& [v, x] : neighbours) mean += x / static_cast<double>(neighbours.size());
    EXPECT_LT((after.position_of(d) - mean).norm(), 1e-14);
  });
}

TEST(Construction, refuses_in_a_sheet_what_is_of_solids) {
  for (const char* rule : {"unsew-face", "part-volumes"})
    EXPECT_TRUE(
        says(refusal_of(four_quads + "<apply rule=\"" + rule + "\" to=\"all\"/>"),
             std::string("rule '") + rule + "' changes what lies between volumes, and this body is a sheet"));
}

// Before the memory is taken: after the first round there would be 17 million darts, after all 10^18.
TEST(Construction, refuses_rounds_that_let_a_body_grow_too_large) {
  const std::string quads = R"xml(<sheet cells="730 730" size="1 1"/>)xml";
  const std::string subdivided = refusal_of(quads + R"xml(<subdivide times="20"/>)xml");
  EXPECT_TRUE(says(subdivided, "test.xml:1:")) << subdivided;
  EXPECT_TRUE(says(subdivided,
                   "round 1 of 20: with rule 'quarter-faces' the body would have 17052800 darts, and "
                   "rules may let it grow to 16777216"))
      << subdivided;
  const std::string starred =
      refusal_of(R"xml(<sheet cells="840 840" size="1 1"/><apply rule="star-face"/>)xml");
  EXPECT_TRUE(says(starred, "with rule 'star-face', at 705600 places, the body would have 16934400 darts"))
      << starred;
  const std::string scripted =
      refusal_of(quads + R"xml(<apply rule="divide"/>)xml", R"xml(<script name="divide" hook="a*(0,1,2,3)">
        <for each="e*(0,1,2,3)" apply="quarter-faces"/></script>)xml");
  EXPECT_TRUE(says(scripted, "with script 'divide' the body would have more darts, and rules may")) << scripted;
}

// The steps of a law that separates borders are those of the same law by the rule.
TEST(LawByRule, unsew_edge_is_separate) {
  const auto run = [](const std::string& change) {
    auto scene = presets::load(presets::cloth(
        "quads", 12, R"xml(<tear criterion="atomic-border" threshold="0.9" )xml" + change + "/>"));
    for (int n = 0; n < 400; ++n) scene->step();
    return std::pair(scene->hash(), scene.body().events.size());
  };
  const auto by_change = run(R"xml(change="separate")xml"), by_rule = run(R"xml(rule="unsew-edge")xml");
  EXPECT_GT(by_change.second, 0u);
  EXPECT_EQ(by_change, by_rule);
}

// Stressed triangles are halved: mass and rest area stay.
TEST(LawByRule, what_divides_keeps_mass_and_area) {
  auto scene = presets::load(R"xml(<scene><body><sheet pattern="triangles" cells="8 4" size="0.8 0.4"/>
      <mass density="1000" thickness="1e-3"/>
      <elasticity model="corotational" young="2e5" poisson="0.3" thickness="1e-3" damping-mass="50"/>
      <drive side="-x" velocity="-0.3 0 0"/><drive side="+x" velocity="0.3 0 0"/>
      <tear criterion="atomic-element" threshold="1e4" rule="halve-triangles" max-per-step="3"/>
      </body><world gravity="0 0 0"/><time step="1e-4" duration="1"/></scene>)xml");
  Body& body = scene.body();
  const double mass = total_mass(*body.map, *body.mass);
  const std::size_t elements = count_cells(body.map->map()).faces;
  std::size_t tears = 0;
  for (int n = 0; n < 3000 && tears < 40; ++n) {
    scene->step();
    if (body.events.size() == tears) continue;
    tears = body.events.size();
    const auto fault = validate(*body.map);
    ASSERT_FALSE(fault) << *fault;
    ASSERT_NEAR(total_mass(*body.map, *body.mass), mass, 1e-13 * mass);
  }
  EXPECT_GT(tears, 3u);
  EXPECT_GT(count_cells(body.map->map()).faces, elements + 3);
  double area = 0;
  for_each_face(*body.map, [&](Dart d) { area += rest_area(*body.map, d); });
  EXPECT_NEAR(area, 0.32, 1e-12);
}

// A rule of a whole component is applied to each component that tears, once a step.
TEST(LawByRule, changes_a_whole_component_once_a_step) {
  for (const char* rule : {"quarter-faces", "split-into-triangles"}) {
    auto scene = presets::load(std::string(R"xml(<scene><body><sheet cells="4 2" size="0.8 0.4"/>
      <mass density="1000" thickness="1e-3"/>
      <elasticity model="corotational" young="2e5" poisson="0.3" thickness="1e-3" damping-mass="50"/>
      <drive side="-x" velocity="-0.3 0 0"/><drive side="+x" velocity="0.3 0 0"/>
      <tear criterion="atomic-element" threshold="1e3" rule=")xml") +
                               rule + R"xml("/>
      </body><world gravity="0 0 0"/><time step="1e-4" duration="1"/></scene>)xml");
    Body& body = scene.body();
    const double mass = total_mass(*body.map, *body.mass);
    for (int n = 0; n < 3000 && body.events.empty(); ++n) scene->step();
    ASSERT_EQ(body.events.size(), 1u) << rule;
    EXPECT_EQ(count_cells(body.map->map()).faces, 4u * 8);
    EXPECT_NEAR(total_mass(*body.map, *body.mass), mass, 1e-13 * mass);
    const auto fault = validate(*body.map);
    EXPECT_FALSE(fault) << *fault;
  }
}

// Rules of the hull, where the border that is opened most lies inside: each border of the element is tried.
TEST(LawByRule, is_tried_at_every_border_of_an_element) {
  auto scene = presets::load(R"xml(<scene><rule name="dent" left="a*(0,1) a|3" right="a(0,1) a|3">
        <set node="a" position="a + point(0, 0.001, 0)"/></rule>
      <body><bar pattern="hexahedra" cells="3 1 1" size="0.3 0.1 0.1"/>
      <mass density="1000"/><elasticity model="corotational" young="2e5" poisson="0.3" damping-mass="50"/>
      <drive side="-x" velocity="-0.3 0 0"/><drive side="+x" velocity="0.3 0 0"/>
      <tear criterion="atomic-element" threshold="1e3" rule="dent" max-per-step="1"/>
      </body><world gravity="0 0 0"/><time step="1e-4" duration="1"/></scene>)xml");
  Body& body = scene.body();
  for (int n = 0; n < 3000 && body.events.empty() && body.tear_laws[0].refusals().empty(); ++n) scene->step();
  EXPECT_TRUE(body.tear_laws[0].refusals().empty()) << body.tear_laws[0].refusals().begin()->first;
  EXPECT_EQ(body.events.size(), 1u);
}

TEST(LawByRule, refuses_what_a_law_cannot_do) {
  const auto refused = [](const std::string& law) -> std::string {
    try {
      presets::load(
          presets::cloth("quads", 4, R"xml(<tear criterion="atomic-border" threshold="1" )xml" + law + "/>"));
    } catch (const UserError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_TRUE(says(refused(R"xml(rule="sew-edges")xml"), "2 hooks"));
  EXPECT_TRUE(says(refused(R"xml(rule="unsew-edge" change="separate")xml"), "both a change and a rule"));
  // Between volumes, of which a sheet has none: it could never apply.
  for (const char* rule : {"unsew-face", "part-volumes", "split-vertex-of-solid", "delete-volume"})
    EXPECT_TRUE(says(refused("rule=\"" + std::string(rule) + "\""),
                     "changes what lies between volumes, but this body is a sheet"))
        << rule << ": " << refused("rule=\"" + std::string(rule) + "\"");
}

} // namespace
} // namespace rend::construction_test
