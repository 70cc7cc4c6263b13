// Bodies built from presets: elasticity, springs of solids, and invalid combinations.
#include "sim/build/build_matter.h"

#include "sim/body/measure.h"
#include "sim/build/body_types.h"
#include "sim/elements.h"
#include "sim/mechanics/mass_tensor.h"
#include "sim/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend::matter_test {
namespace {

using testing::HasSubstr;

std::string scene_of(const std::string& body, const std::string& time = R"(<time step="1e-4" duration="1"/>)") {
  return "<scene><body>" + body + "</body>" + time + "</scene>";
}

std::string refusal_of(const std::string& body) {
  try {
    presets::load(scene_of(body));
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::BadInput);
    return std::string(error.what()) + " | " + error.hint;
  }
  return "not refused";
}

const std::string bar = R"(<bar pattern="mixed" cells="6 2 2" size="3 1 1"/><mass density="1000"/>)";
const std::string sheet = R"(<sheet pattern="mixed" cells="4 4" size="1 1"/><mass total="1"/>)";

TEST(Elasticity, has_one_interaction_for_each_kind_of_element) {
  const auto scene = presets::load(scene_of(bar + R"(<elasticity young="1e5"/>)"));
  std::vector<std::string> names;
  for (const auto& each : scene.body().interactions) names.push_back(each->name);
  EXPECT_EQ(names, (std::vector<std::string>{"co-rotational tetrahedron", "co-rotational hexahedron",
                                             "co-rotational prism", "co-rotational pyramid"}));
}

TEST(Elasticity, stands_beside_springs_on_the_surface) {
  const auto scene = presets::load(
      scene_of(bar + R"(<springs on="surface"><stretch k="50"/></springs><elasticity young="1e5"/>)"));
  EXPECT_EQ(scene.body().interactions.size(), 5u);
  EXPECT_THAT(refusal_of(bar + R"(<springs on="surface"><shear where="volume" k="5"/></springs>)"),
              HasSubstr("no diagonals inside"));
}

TEST(Elasticity, damps_by_mass_as_a_uniform_drag) {
  const auto scene = presets::load(
      scene_of(bar + R"(<elasticity young="1e5" damping-mass="3"/><viscosity value="600" per="body"/>)"));
  EXPECT_NEAR(scene.body().uniform_drag, 3 + 600 / 3000.0, 1e-12);
}

TEST(Elasticity, refuses_what_it_cannot_hold) {
  EXPECT_THAT(refusal_of(sheet + R"(<elasticity young="1e5"/>)"), HasSubstr("needs its thickness"));
  EXPECT_THAT(refusal_of(bar + R"(<elasticity young="1e5" thickness="1"/>)"), HasSubstr("own thickness"));
  EXPECT_THAT(refusal_of(bar + R"(<springs young="1e5" thickness="1"><stretch/></springs>)"),
              HasSubstr("the springs of a solid cannot be computed from young"));
  EXPECT_THAT(refusal_of(bar + R"(<springs><bend k="1"/></springs>)"), HasSubstr("for sheets"));
}

TEST(Elasticity, of_small_strain_is_for_sheets_that_are_kept_in_their_plane) {
  for (const char* model : {"linear", "mass-tensor"}) {
    const std::string elastic =
        std::string(R"(<elasticity thickness="0.01" young="1e5" model=")") + model + "\"/>";
    EXPECT_THAT(refusal_of(sheet + elastic), HasSubstr(R"(<fix all="yes" axes="z"/>)"));
    EXPECT_EQ(refusal_of(sheet + elastic + R"(<fix all="yes" axes="z"/>)"), "not refused");
    EXPECT_THAT(refusal_of(R"(<sheet cells="4 4" size="1 1"/><place rotate="30 0 0"/><mass total="1"/>)" +
                           elastic + R"(<fix all="yes" axes="z"/>)"),
                HasSubstr("corotational"));
  }
}

TEST(Elasticity, names_an_element_without_area) {
  PolygonMesh mesh;
  mesh.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(2, 0, 0)};
  mesh.add({0, 1, 2});
  mesh.add({0, 1, 3}); // collinear
  for (const char* model : {"corotational", "mass-tensor"}) {
    try {
      elements::elastic_body(sheet_from(mesh), {model});
      ADD_FAILURE() << "not refused";
    } catch (const UserError& error) {
      EXPECT_EQ(error.code, Exit::BadInput);
      EXPECT_THAT(error.what(),
                  HasSubstr("triangle with the corners (0, 0, 0) (1, 0, 0) (2, 0, 0) has no area"));
    }
  }
}

// Every vertex under F = Q (I + E): every model gives the same stress and strain everywhere.
TEST(Measure, of_a_uniform_strain_is_the_same_everywhere_for_every_model) {
  for (const char* model : {"linear", "corotational", "mass-tensor"}) {
    for (auto& each : elements::irregular_maps()) {
      if (each.map->dimension() == 2) continue;
      SCOPED_TRACE(each.name + ", " + model);
      const auto body = elements::elastic_body(std::move(each.map), {model});
      const Vec3 stretch(0.004, -0.001, 0.002); // principal strains
      auto& x = body->map->position().values();
      for (Slot v = 0; v < x.size(); ++v) {
        const Vec3 X = body->map->rest()[v].vec();
        x[v] = Record(X + stretch.cwiseProduct(X));
      }
      const ElasticMaterial m = ElasticMaterial::of(1000, 0.3, 3);
      for (double strain : vertex_strain(*body)) EXPECT_NEAR(strain, 0.004, 1e-12);
      for (double stress : vertex_stress(*body))
        EXPECT_NEAR(stress, m.lambda * stretch.sum() + 2 * m.mu * 0.004, 1e-9);
    }
  }
}

// A cell at rest and a stretched one, which share a face: by thesis 7.2 the stress at the vertices between them
// is weighted by mass, however many corners each mass is spread over.
struct Pair {
  std::string name;
  std::unique_ptr<EmbeddedMap> map;
  Vec3 pulled;      // [m], positions of vertices of the stretched cell only
  double share = 0; // the stretched cell's share of mass
};

std::vector<Pair> pairs_of_cells() {
  PolygonMesh flat;
  flat.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(2, 0.5, 0)};
  flat.add({0, 1, 2, 3});
  flat.add({1, 4, 2});
  CellMesh solid;
  for (const Vec3& x : elements::regular(ElementKind::Hexahedron)) solid.points.push_back(x);
  solid.points.push_back(Vec3(2, 0.5, 0.5));
  solid.add(CellKind::Hexahedron, {0, 1, 2, 3, 4, 5, 6, 7});
  solid.add(CellKind::Pyramid, {1, 5, 6, 2, 8});
  std::vector<Pair> all;
  all.push_back({"quad and triangle", sheet_from(flat), flat.points.back(), 0.5 / 1.5});
  all.push_back({"hexahedron and pyramid", solid_from(solid), solid.points.back(), (1. / 3) / (4. / 3)});
  return all;
}

// [Pa], stress along x of a cell 1 m long that is stretched by 1 mm.
double pulled_by_a_millimetre(int dimension) {
  const ElasticMaterial m = ElasticMaterial::of(1000, 0.3, dimension);
  return (m.lambda + 2 * m.mu) * 1e-3;
}

std::unique_ptr<Body> pulled_pair(Pair& pair, const std::string& model) {
  auto body = elements::elastic_body(std::move(pair.map), {model});
  body->prepare(*find_scheme("symplectic"));
  for (Record& x : body->map->position().values())
    if (x.vec() == pair.pulled) x = Record(pair.pulled + Vec3(1e-3, 0, 0));
  return body;
}

TEST(Measure, of_stress_weighs_elements_by_their_mass_not_by_that_of_a_corner) {
  for (const char* model : {"linear", "corotational", "mass-tensor"}) {
    for (Pair& pair : pairs_of_cells()) {
      SCOPED_TRACE(pair.name + ", " + model);
      const auto body = pulled_pair(pair, model);
      const int dimension = body->map->dimension();
      const double pulled = pulled_by_a_millimetre(dimension);
      const std::vector<double> stress = vertex_stress(*body);
      std::size_t between = 0;
      for (Slot v = 0; v < stress.size(); ++v) {
        const double x = body->map->rest()[v].x;
        between += x == 1;
        EXPECT_NEAR(stress[v], x == 2 ? pulled : x == 1 ? pair.share * pulled : 0, 1e-11 * pulled) << v;
      }
      EXPECT_EQ(between, dimension == 2 ? 2u : 4u);
    }
  }
}

TEST(Measure, of_stress_is_that_of_each_cell_after_separation) {
  for (Pair& pair : pairs_of_cells()) {
    SCOPED_TRACE(pair.name);
    const auto body = pulled_pair(pair, "corotational");
    const int dimension = body->map->dimension();
    const std::size_t corners = dimension == 2 ? 3 : 5; // of the stretched cell
    const double pulled = pulled_by_a_millimetre(dimension);
    body->map->edit(
        [&](Edit& edit) { body->map->map().for_each_dart([&](Dart d) { unsew(edit, dimension, d); }); });
    body->rebind();
    std::size_t feel_it = 0;
    for (double stress : vertex_stress(*body)) {
      feel_it += stress > 0.5 * pulled;
      EXPECT_NEAR(stress, stress > 0.5 * pulled ? pulled : 0, 1e-11 * pulled);
    }
    EXPECT_EQ(feel_it, corners);
  }
}

TEST(Measure, of_force_is_the_largest_that_one_element_puts_on_the_vertex) {
  const auto body = elements::elastic_body(std::move(elements::irregular_maps()[0].map),
                                           {"corotational", "polar", 0, Cumulated::Auto, true});
  meshes::shake(*body, 0.1, 3);
  body->map->velocity().values().assign(body->map->velocity().values().size(), Record());
  std::vector<Record> corner(body->map->cells(VertexOfVolume).slots()), sum(body->program->vertices());
  body->program->corner_forces(meshes::positions(*body), meshes::velocities(*body), corner.data(), sum.data());
  std::vector<double> expected(sum.size(), 0);
  body->map->map().for_each_dart([&](Dart d) {
    double& most = expected[body->map->vertex(d)];
    most = std::max(most, corner[body->map->slot(VertexOfVolume, d)].vec().norm());
  });
  const std::vector<double> force = vertex_force(*body);
  for (std::size_t v = 0; v < expected.size(); ++v) EXPECT_NEAR(force[v], expected[v], 1e-11 * expected[v]);
}

// A scrambled solid returns to its rest shape (with viscous drag).
TEST(Elasticity, a_scrambled_solid_comes_back_to_rest) {
  const auto scene =
      presets::load(scene_of(R"(<bar pattern="tetrahedra" cells="2 2 2" size="1 1 1"/><mass density="1000"/>)"
                             R"(<elasticity young="1e4" damping-mass="4" damping-stiffness="0.01"/>)",
                             R"(<time step="auto" duration="9"/>)"));
  Body& body = scene.body();
  body.gravity = Record();
  meshes::shake(body, 0.6, 4);
  for (int n = 0; n < 20000; ++n) scene->step();
  const Vec3 rest0 = body.map->rest()[0], x0 = body.map->position()[0];
  for (Slot v = 1; v < body.program->vertices(); ++v)
    EXPECT_NEAR((body.map->position()[v].vec() - x0).norm(), (body.map->rest()[v].vec() - rest0).norm(), 1e-4);
}

// What help says of an attribute of an element in <springs>: its unit and its meaning.
std::pair<std::string, std::string> help_of(const std::string& element, const std::string& attribute) {
  for (const ChildType& matter : matter_types())
    for (const ChildType& spring : matter.type->children)
      if (spring.type->name == element)
        return {spring.type->find(attribute)->unit, spring.type->find(attribute)->what};
  return {};
}

TEST(Springs, say_of_their_attributes_what_holds_for_them) {
  using Help = std::pair<std::string, std::string>;
  EXPECT_EQ(help_of("stretch", "k"), Help("N/m", "stiffness of each spring; or computed from young"));
  EXPECT_EQ(help_of("shear", "k"),
            Help("N/m", "stiffness of each spring; or computed from young (isotropic in a "
                        "face, anisotropic in a face)"));
  EXPECT_EQ(help_of("bend", "k"), Help("N/m or N.m/rad", "stiffness of each spring"));
  EXPECT_EQ(help_of("stretch", "damping"), Help("N.s/m", "damping of each spring"));
  EXPECT_EQ(help_of("bend", "damping"), Help("N.s/m or N.m.s/rad", "damping of each spring"));
}

// Where help says that there is a formula, young is enough; elsewhere it is refused.
TEST(Springs, have_a_formula_where_help_says_so) {
  const std::string quads = R"(<sheet pattern="quads" cells="2 2" size="1 1"/><mass total="1"/>)";
  for (const InteractionType& type : all_interactions()) {
    if (type.where == "volume") continue; // no solid takes young
    const std::string kind = type.kind.empty() ? "" : " kind=\"" + type.kind + "\"";
    const std::string refusal = refusal_of(quads + R"(<springs young="1e5" poisson="0.33" thickness="1e-3"><)" +
                                           type.element + kind + "/></springs>");
    EXPECT_THAT(refusal, HasSubstr(type.by_formula ? "not refused" : "no formula gives this stiffness"))
        << type.element << kind;
  }
}

} // namespace
} // namespace rend::matter_test
