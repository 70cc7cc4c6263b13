// What rules ask of a law, against the definitions (plain_body.h): of the map as it is, and of what it was
// before changes of the same edit. And rules that ask.
#include "sim/fracture/law_quantities.h"

#include "sim/fracture/plain_body.h"
#include "sim/fracture/torn_bodies.h"
#include "sim/house_rules/house_rules.h"
#include "sim/presets.h"
#include "sim/rules/apply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend::law_quantities_test {
namespace {

using plain::PlainBody;
using plain::Values;
using testing::HasSubstr;
using Of = RuleQuantities::Of;

std::unique_ptr<Body> made_of(std::unique_ptr<EmbeddedMap> map, const std::string& model) {
  auto body = std::make_unique<Body>();
  body->map = std::move(map);
  CornerMass mass;
  mass.density = 10;
  body->mass = &body->map->add(mass.on(*body->map));
  elements::add_elasticity(*body, {model, "polar", 0});
  body->border = &body->map->add(InitialBorder(body->map->dimension()));
  body->map->let_grow();
  body->prepare(*find_scheme("symplectic"));
  meshes::shake(*body, 0.1, 5);
  body->evaluate();
  return body;
}

// The largest principal values of all elements and vertices, by the definitions.
struct Expected {
  Values stress, strain, vertex_stress, vertex_strain;
  double most = 0; // stress

  Expected(const Body& body, const std::string& model, bool compression) {
    PlainBody plain(body);
    plain.add_elements(model == "corotational" ? ElasticModel::Corotational : ElasticModel::Linear,
                       Rotation::Polar, ElasticMaterial::of(1000, 0.3, body.map->dimension()),
                       body.map->dimension() == 2 ? 0.1 : 1);
    stress = plain.values("atomic-element", "", compression);
    strain = plain.values("strain", "", compression);
    vertex_stress = plain.values("vertex-stress", "", compression);
    vertex_strain = plain.values("vertex-strain", "", compression);
    for (const auto& [d, measured] : stress) most = std::max(most, std::abs(measured.value));
  }
};

// Of each dart before the edit, the smallest of its element and of its vertex.
struct Cells {
  std::map<Dart, Dart> element, vertex;
  explicit Cells(const GMap& map) {
    map.for_each_dart([&](Dart d) {
      element[d] = smallest_dart(map, element_orbit(map.dimension()), d);
      vertex[d] = smallest_dart(map, Vertex, d);
    });
  }
};

// At every dart with a dart from before the edit in its element, and in its vertex; returns how many.
std::size_t expect_same(LawQuantities& quantities, const Edit& edit, const Expected& expected,
                        const Cells& was) {
  const GMap& map = edit.map();
  std::size_t checked = 0;
  const auto first_old = [&](Orbit orbit, Dart d) -> std::optional<Dart> {
    std::vector<Dart> darts = darts_of(map, orbit, d);
    std::sort(darts.begin(), darts.end());
    const auto found =
        std::find_if(darts.begin(), darts.end(), [&](Dart e) { return was.element.contains(e); });
    return found == darts.end() ? std::nullopt : std::optional(*found);
  };
  map.for_each_dart([&](Dart d) {
    const double near = 1e-11 * expected.most;
    if (const auto e = first_old(element_orbit(map.dimension()), d)) {
      const Dart cell = was.element.at(*e);
      EXPECT_NEAR(quantities.stress(edit, d, Of::InElement), expected.stress.at(cell).value, near);
      EXPECT_NEAR(quantities.strain(edit, d, Of::InElement), expected.strain.at(cell).value, 1e-12);
      ++checked;
    }
    if (const auto e = first_old(Vertex, d)) {
      const Dart cell = was.vertex.at(*e);
      EXPECT_NEAR(quantities.stress(edit, d, Of::AtVertex), expected.vertex_stress.at(cell).value, near);
      EXPECT_NEAR(quantities.strain(edit, d, Of::AtVertex), expected.vertex_strain.at(cell).value, 1e-12);
      ++checked;
    }
  });
  return checked;
}

struct Case {
  const char* model;
  bool compression;
};
constexpr Case cases[] = {
    {"corotational", false}, {"corotational", true}, {"linear", false}, {"mass-tensor", true}};

TEST(LawQuantities, are_the_largest_principal_values_of_every_element_and_vertex) {
  for (const auto& [model, compression] : cases)
    for (elements::NamedMap& named : elements::irregular_maps()) {
      SCOPED_TRACE(named.name + " " + model);
      const auto body = made_of(std::move(named.map), model);
      LawSettings law;
      law.compression = compression;
      LawQuantities quantities(body->request_for(law));
      const Expected expected(*body, model, compression);
      quantities.begin(body->view());
      body->map->edit([&](Edit& edit) {
        EXPECT_GT(expect_same(quantities, edit, expected, Cells(edit.map())), edit.map().dart_count());
      });
    }
}

struct Born {
  Dart dart;   // of a new vertex
  double mean; // of the stress at the vertices around it
};

// A new vertex in the element of d. Returns how many darts it has; 0: it was refused.
std::size_t divide(LawQuantities& quantities, Edit& edit, RuleRunner& star, Dart d, std::vector<Born>& born) {
  const GMap& map = edit.map();
  double sum = 0, count = 0;
  std::set<Dart> met;
  for (Dart e : darts_of(map, element_orbit(map.dimension()), d))
    if (met.insert(smallest_dart(map, Vertex, e)).second) {
      sum += quantities.stress(edit, e, Of::AtVertex);
      ++count;
    }
  const std::size_t before = edit.journal()->created.size();
  if (!star.apply(edit, d)) return 0;
  const Vec3 middle = edit.point(edit.journal()->created.back()).rest;
  std::size_t darts = 0;
  for (std::size_t n = before; n < edit.journal()->created.size(); ++n)
    if (const Dart e = edit.journal()->created[n]; edit.point(e).rest == middle) {
      born.push_back({e, sum / count});
      ++darts;
    }
  return darts;
}

// Elements are divided, cut off and, if asked for, removed, in one edit: whatever was there before it keeps its
// value until it is closed, and a new vertex has the mean of those around.
void change_and_check(Body& body, LawQuantities& quantities, const Expected& expected, bool remove) {
  const GMap& map = body.map->map();
  const int dimension = map.dimension();
  const Cells was(map);
  RuleRunner star(*find_house_rule(dimension == 2 ? "star-face" : "star-volume"));
  meshes::Noise noise(3);
  std::vector<Born> born;
  quantities.begin(body.view());
  body.map->edit([&](Edit& edit) {
    for (int n = 0; n < 8; ++n) {
      Dart d{noise.below(map.capacity())};
      while (!map.alive(d)) d = Dart{noise.below(map.capacity())};
      quantities.before_change(edit);
      if (n % 2 == 0) {
        divide(quantities, edit, star, d, born);
      } else if (n % 4 == 1) {
        unsew(edit, dimension, d);
      } else if (remove) {
        remove_element_of(edit, d);
      }
    }
    EXPECT_GT(expect_same(quantities, edit, expected, was), 0u);
    EXPECT_GT(born.size(), 3u);
    for (const auto& [d, mean] : born) {
      if (!map.alive(d) || was.element.contains(smallest_dart(map, Vertex, d))) continue;
      EXPECT_NEAR(quantities.stress(edit, d, Of::AtVertex), mean, 1e-11 * expected.most);
    }
  });
  ASSERT_FALSE(validate(*body.map));
}

TEST(LawQuantities, are_those_from_before_the_edit_and_are_inherited) {
  for (const auto& [model, compression] : cases)
    for (bool remove : {false, true})
      for (elements::NamedMap& named : elements::irregular_maps()) {
        SCOPED_TRACE(named.name + " " + model);
        const bool simplices = named.name == "triangles" || named.name == "tetrahedra";
        const auto body = made_of(std::move(named.map), model);
        LawSettings law;
        law.compression = compression;
        LawQuantities quantities(body->request_for(law));
        change_and_check(*body, quantities, Expected(*body, model, compression), remove);
        // Stars have simplices around; and what is left of an element takes the mass of what was removed of it.
        if (!simplices || remove) continue;
        quantities.rebind(body->changes);
        body->rebind();
        body->evaluate();
        const Expected afterwards(*body, model, compression);
        quantities.begin(body->view());
        body->map->edit([&](Edit& edit) { expect_same(quantities, edit, afterwards, Cells(edit.map())); });
      }
}

TEST(LawQuantities, of_what_is_made_out_of_nothing_are_not_known) {
  const auto body = made_of(sheet_from(meshes::sheet(SheetPattern::Triangles, 2, 2)), "corotational");
  LawQuantities quantities(body->request_for({}));
  quantities.begin(body->view());
  body->map->edit([&](Edit& edit) {
    quantities.before_change(edit);
    RuleRunner create(*find_house_rule("create-triangle"));
    ASSERT_TRUE(create.apply(edit, {}));
    EXPECT_THROW(quantities.stress(edit, create.darts()[0], Of::InElement), ExpressionError);
    EXPECT_THROW(quantities.strain(edit, create.darts()[0], Of::AtVertex), ExpressionError);
  });
}

// A sheet of triangles that is pulled apart.
std::string pulled(const std::string& rules, const std::string& law, const std::string& more = "") {
  return "<scene>" + rules + R"xml(<body><sheet pattern="triangles" cells="8 4" size="0.8 0.4"/>)xml" + more +
         R"xml(<mass density="1000" thickness="1e-3"/>
      <elasticity model="corotational" young="2e5" poisson="0.3" thickness="1e-3" damping-mass="50"/>
      <drive side="-x" velocity="-0.3 0 0"/><drive side="+x" velocity="0.3 0 0"/>)xml" +
         law + R"xml(</body><world gravity="0 0 0"/><time step="1e-4" duration="1"/></scene>)xml";
}

const std::string halve_where = R"xml(<rule name="halve"
    left="a*(0,2) b(_,_) c(1,_) a-1-b b-0-c a|3 b|3 c|3"
    right="a(_,2) b(_,_) c(_,_) g(_,2) h(2,_) i(2,_) a-1-b b-0-c a-0-g g-1-h h-0-i i-1-c
            a|3 b|3 c|3 g|3 h|3 i|3">
    <set node="g" position="mean(a, edge)"/>
    <when test="TEST" at="any" otherwise="it is not pulled enough"/></rule>)xml";

std::string halve_if(const std::string& test) {
  std::string rule = halve_where;
  return rule.replace(rule.find("TEST"), 4, test);
}

// The law finds elements above 1e4 Pa; the rule asks for 1.2e4 of one of the two at the edge. An event's
// value is that of the element found. Where the rule refuses, the law counts it.
TEST(LawByRule, halves_where_the_stress_is_above_a_bound) {
  constexpr double bound = 1.2e4;
  const auto run = [&](const std::string& test) {
    auto scene = presets::load(
        pulled(halve_if(test), R"xml(<tear criterion="atomic-element" threshold="1e4" rule="halve"/>)xml"));
    for (int n = 0; n < 3000 && scene.body().events.size() < 30; ++n) scene->step();
    return scene;
  };
  const auto always = run("length(a) > 0"), by_stress = run("stress(a, element) > 1.2e4");
  const std::vector<TearEvent>&one = always.body().events, &two = by_stress.body().events;
  ASSERT_GE(two.size(), 30u);
  EXPECT_LT(one.front().value, bound);
  EXPECT_GT(two.front().step, one.front().step);
  // Until its first change, the largest value was between the threshold and the bound, and it is above it then.
  EXPECT_GT(two.front().value, bound);
  const Refusals& refused = by_stress.body().tear_laws[0].refusals();
  ASSERT_TRUE(refused.contains("it is not pulled enough"));
  EXPECT_GT(refused.at("it is not pulled enough"), 100u);
  EXPECT_FALSE(always.body().tear_laws[0].refusals().contains("it is not pulled enough"));
}

// All that the rule is asked for is refused and counted, once a candidate and step, and nothing changes.
TEST(LawByRule, counts_what_it_refuses_and_changes_nothing) {
  const auto run = [](const std::string& law) {
    auto scene = presets::load(pulled(halve_if("length(a) > 100"), law));
    for (int n = 0; n < 900; ++n) scene->step();
    return scene;
  };
  const auto none = run(""),
             all = run(R"xml(<tear criterion="atomic-element" threshold="1e4" rule="halve"/>)xml");
  EXPECT_EQ(all.body().events.size(), 0u);
  std::size_t differing = 0;
  for (Slot v = 0; v < none.body().map->cells(Vertex).slots(); ++v)
    differing += none.body().map->position()[v].vec() != all.body().map->position()[v].vec();
  EXPECT_EQ(differing, 0u);
  std::uint64_t counted = 0; // by a law that finds the same, and does nothing
  auto scene = presets::load(pulled("", R"xml(<tear criterion="atomic-element" threshold="1e30"/>)xml"));
  LawSettings settings = scene.body().tear_laws[0].settings();
  settings.threshold = 1e4;
  TearLaw law(scene.body().request_for(settings), settings);
  for (int n = 0; n < 900; ++n) {
    scene.body().evaluate();
    counted += law.find(scene.body().view()).size();
    scene->step();
  }
  EXPECT_GT(counted, 100u);
  EXPECT_EQ(all.body().tear_laws[0].refusals(), (Refusals{{"it is not pulled enough", counted}}));
}

// Each vertex on which the forces exceed the threshold goes up by what was found there.
TEST(LawByRule, moves_by_what_the_criterion_found) {
  const auto scene = presets::load(pulled(
      R"xml(<rule name="lift" left="a*(1,2,3)" right="a(1,2,3)">
        <set node="a" position="a + point(0, 0, 1e-3 * value)"
              velocity="point(time, stress(a, vertex), 0)"/></rule>)xml",
      R"xml(<tear criterion="cumulative-vertex" threshold="0.05" rule="lift"/>)xml"));
  Body& body = scene.body();
  while (body.events.empty() && scene->steps_done() < 3000) {
    body.evaluate();
    PlainBody plain(body);
    plain.add_elements(ElasticModel::Corotational, Rotation::Polar, ElasticMaterial::of(2e5, 0.3, 2), 1e-3);
    const Values stress = plain.values("vertex-stress", "", false);
    std::vector<double> force(body.map->cells(Vertex).slots());
    for (Slot v = 0; v < force.size(); ++v) force[v] = body.force[v].vec().norm();
    const double time = body.time();
    if (body.tear(time, scene->steps_done(), [] {}) == 0) {
      scene->step();
      continue;
    }
    ASSERT_FALSE(body.events.empty());
    for (const TearEvent& event : body.events) {
      const Slot v = body.map->vertex(event.dart);
      EXPECT_NEAR(body.map->position()[v].z, 1e-3 * event.value, 1e-15);
      EXPECT_NEAR(event.value, force[v], 1e-12 * force[v]);
      EXPECT_EQ(body.map->velocity()[v].x, time);
      EXPECT_NEAR(body.map->velocity()[v].y, stress.at(event.dart).value, 1e-3);
    }
  }
  EXPECT_FALSE(body.events.empty());
}

// A vertex that a law moves is displaced: the matter around it is strained, and stays the same matter. Where
// the rule says so, it has another shape at rest, too.
TEST(LawByRule, moves_vertices_and_keeps_their_mass) {
  const auto areas = [](const EmbeddedMap& map) {
    double sum = 0;
    for_each_face(map, [&](Dart d) { sum += rest_area(map, d); });
    return sum;
  };
  for (const bool rest : {false, true}) {
    const auto scene = presets::load(
        pulled(std::string(R"xml(<rule name="lift" left="a*(1,2,3)" right="a(1,2,3)">
        <set node="a" position="a + point(0, 0, 0.3)" velocity="point(0, 0, 0)")xml") +
                   (rest ? R"xml( rest="a + point(0, 0, 0.3)")xml" : "") + "/></rule>",
               R"xml(<tear criterion="cumulative-vertex" threshold="0.05" rule="lift" max-per-step="1"/>)xml"));
    Body& body = scene.body();
    const double mass = total_mass(*body.map, *body.mass), area = areas(*body.map);
    const auto shape = body.map->rest().values();
    for (body.evaluate(); body.tear(body.time(), scene->steps_done(), [] {}) == 0; body.evaluate()) {
      ASSERT_LT(scene->steps_done(), 3000);
      scene->step();
    }
    const Slot v = body.map->vertex(body.events[0].dart);
    EXPECT_EQ(body.map->position()[v].z, 0.3);
    EXPECT_EQ(total_mass(*body.map, *body.mass), mass);
    EXPECT_EQ(body.map->rest()[v].vec() - shape[v].vec(), Vec3(0, 0, rest ? 0.3 : 0));
    if (rest)
      EXPECT_GT(areas(*body.map), area + 0.01);
    else
      EXPECT_EQ(areas(*body.map), area);
  }
}

TEST(LawByRule, tells_stress_and_time_to_laws_alone) {
  const auto refused = [](const std::string& preset) -> std::string {
    try {
      presets::load(preset);
    } catch (const UserError& error) {
      EXPECT_EQ(static_cast<int>(error.code), 65);
      return error.what();
    }
    return {};
  };
  for (const char* what : {"stress(a, element)", "strain(a, vertex)", "value", "time"}) {
    const std::string rule = R"xml(<rule name="up" left="a*(1,2,3)" right="a(1,2,3)">
        <when test=")xml" + std::string(what) +
                             R"xml( > 0"/><set node="a" position="a + point(0, 0, 1)"/></rule>)xml";
    EXPECT_THAT(refused(pulled(rule, "", R"xml(<apply rule="up" to="all"/>)xml")),
                HasSubstr("rule 'up' asks for "));
    EXPECT_EQ(refused(pulled(rule, R"xml(<tear criterion="vertex-stress" threshold="1" rule="up"/>)xml")), "");
  }
  const std::string script = R"xml(<script name="s" hook="a*(1,2,3)"><for each="e*(1,2,3)"
      where="stress(e, element) > stress(a, vertex)" apply="move"/></script>)xml";
  EXPECT_THAT(refused(pulled(script, "", R"xml(<apply rule="s" to="all"/>)xml")),
              HasSubstr("script 's' asks for stress"));
}

TEST(LawByRule, has_no_stress_where_the_body_has_springs_alone) {
  const std::string cloth =
      presets::cloth("quads", 3, R"xml(<tear criterion="cumulative-vertex" threshold="1" rule="up"/>)xml");
  const auto with = [&](const std::string& test) {
    std::string preset = cloth;
    return preset.insert(preset.find("<body"),
                         R"xml(<rule name="up" left="a*(1,2,3)" right="a(1,2,3)"><when test=")xml" + test +
                             R"xml("/></rule>)xml");
  };
  EXPECT_NO_THROW(presets::load(with("value > 2 and time > 0.1")));
  try {
    presets::load(with("stress(a, vertex) > 1"));
    FAIL();
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("asks for stress or strain, but this body has no <elasticity>"));
  }
}

} // namespace
} // namespace rend::law_quantities_test
