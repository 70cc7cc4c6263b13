// Every built-in rule as the change of a law, on every mesh and material: what a body is made of acts in all
// cells that it comes to have, and mass goes with deleted elements alone.
//
// A torn body is compared with one that is built anew from its darts and points, and with values without rows.
#include "sim/build/build_body.h"
#include "sim/fracture/rule_change.h"
#include "sim/house_rules/house_rules.h"
#include "sim/house_rules/house_scripts.h"
#include "sim/outside/world.h"
#include "sim/rows/continuum.h"
#include "sim/rows/frequency.h"
#include "sim/rows/walk_forces.h"
#include "tests/sim/fracture/plain_body.h"
#include "tests/sim/fracture/torn_bodies.h"
#include "tests/sim/fracture/torn_checks.h"

#include <gtest/gtest.h>

namespace rend::rules_as_laws_test {
namespace {

struct Material {
  std::string name;
  std::optional<ContinuumModel> model;
  Formulation formulation = Formulation::Plain;
};
void PrintTo(const Material& material, std::ostream* out) {
  *out << material.name;
}
const std::vector<Material>& materials() {
  static const std::vector<Material> all{{"springs", {}},
                                         {"linear", ContinuumModel::Linear},
                                         {"corotational", ContinuumModel::Corotational},
                                         {"mass_tensor", ContinuumModel::MassTensor},
                                         {"enhanced", ContinuumModel::Corotational, Formulation::Enhanced}};
  return all;
}

struct Mesh {
  std::string name;
  int dimension;
  ShapeSettings shape;
};
std::vector<Mesh> all_meshes() {
  const auto sheet = [](SheetPattern pattern) {
    return SheetShape{.pattern = pattern, .nx = 4, .ny = 3, .size = {{4, 3}}};
  };
  const auto bar = [](BarPattern pattern) {
    return BarShape{.pattern = pattern, .nx = 2, .ny = 1, .nz = 1, .size = {2, 1, 1}};
  };
  return {{"quads", 2, sheet(SheetPattern::Quads)},       {"triangles", 2, sheet(SheetPattern::Triangles)},
          {"mixed sheet", 2, sheet(SheetPattern::Mixed)}, {"hexahedra", 3, bar(BarPattern::Hexahedra)},
          {"tetrahedra", 3, bar(BarPattern::Tetrahedra)}, {"prisms", 3, bar(BarPattern::Prisms)},
          {"mixed solid", 3, bar(BarPattern::Mixed)}};
}

constexpr double young = 1000, poisson = 0.3, thickness = 0.1, density = 10;

BodySettings settings_of(const Mesh& mesh, const Material& material, const std::string& rule) {
  BodySettings body;
  body.shape = mesh.shape;
  body.mass = {.density = density};
  if (mesh.dimension == 2) body.mass.thickness = 1;
  LawSettings law{.criterion = find_criterion("strain"), .threshold = 1e-6, .rule = rule};
  if (material.model) {
    body.elasticity = ElasticitySettings{
        .model = *material.model, .formulation = material.formulation, .young = young, .poisson = poisson};
    if (mesh.dimension == 2) body.elasticity->thickness = thickness;
    if (mesh.dimension == 2) body.motions = {FixSettings{.where = {.all = true}, .axes = Axes::Z}};
  } else {
    body.springs =
        SpringsSettings{.springs = {{.type = find_interaction("stretch"), .k = 60},
                                    {.type = find_interaction("shear", "isotropic", "face"), .k = 43}}};
    if (mesh.dimension == 2)
      body.springs->springs.push_back({.type = find_interaction("bend", "angular"), .k = 2});
    else
      body.springs->springs.push_back({.type = find_interaction("shear", "isotropic", "volume"), .k = 20});
    law.kind = "stretch";
  }
  body.tears = {law};
  return body;
}

std::unique_ptr<Body> body_of(const BodySettings& settings) {
  auto body = build_body(settings, World{});
  torn::watch(*body); // all criteria, which must know new kinds of cells
  body->prepare(*find_scheme("symplectic"));
  meshes::shake(*body, 0.08, 7);
  for (Record& x : body->map->position().values())
    if (body->map->dimension() == 2) x.z = 0;
  body->evaluate();
  return body;
}

// The same darts, points and material, built as from a file.
std::unique_ptr<Body> built_anew(const Body& torn, const BodySettings& settings) {
  auto anew = std::make_unique<Body>();
  anew->map = std::make_unique<EmbeddedMap>(GMap(torn.map->map()), [&](Dart d) {
    return Point{torn.map->position_of(d), torn.map->rest_of(d),
                 torn.map->velocity()[torn.map->vertex(d)].vec()};
  });
  CornerMass mass;
  mass.density = density;
  anew->mass = &anew->map->add(mass.on(*anew->map));
  anew->map->map().for_each_dart(
      [&](Dart d) { // what is made inherits masses; a new body has them from its shape
        (*anew->mass)[anew->map->slot(anew->mass->orbit(), d)] =
            (*torn.mass)[torn.map->slot(torn.mass->orbit(), d)];
      });
  if (settings.elasticity)
    for (auto& made : make_elasticity(*anew->map, *settings.elasticity, anew->notes))
      anew->interactions.push_back(std::move(made));
  if (settings.springs)
    for (const SpringSettings& spring : settings.springs->springs)
      if (auto made = spring.type->make(*anew->map, {spring, spring.type->element, {}, anew->notes}))
        anew->interactions.push_back(std::move(made));
  anew->program =
      std::make_unique<Program>(*anew->map, anew->interactions, *anew->mass, nullptr, ProgramOptions{});
  return anew;
}

// Of each interaction that has units: their number and their energy [J].
std::map<std::string, std::pair<std::size_t, double>> energies(const Body& body) {
  std::map<std::string, std::pair<std::size_t, double>> all;
  for_each_unit(*body.map, body.interactions, [&](const Interaction& interaction, Dart d, std::size_t unit) {
    const CurrentUnit now(*body.map, interaction, d, unit, meshes::positions(body), nullptr);
    if (!now.acts()) return;
    auto& [count, energy] = all[interaction.name];
    ++count;
    energy += interaction.law->energy(now.values, now.state());
  });
  return all;
}

// σ of each element, by its smallest dart.
std::map<Dart, Eigen::Matrix3d> stresses(const Body& body) {
  std::map<Dart, Eigen::Matrix3d> all;
  Continuum(*body.map, body.interactions)
      .each(meshes::positions(body), nullptr, [&](const Continuum::Part& part, const CurrentUnit& now) {
        EXPECT_TRUE(all.emplace(smallest_dart(body.map->map(), element_orbit(body.map->dimension()), now.owner),
                                stress_of(part, now))
                        .second);
      });
  return all;
}

// Springs along sides that were divided are in series: their stiffness is not that of a new spring.
bool divides_sides(const std::string& rule) {
  static const std::set<std::string> dividing{"catmull-clark",
                                              "divide-edge-of-tetrahedra",
                                              "divide-edge-of-triangles",
                                              "divide-tetrahedra",
                                              "divide-volumes",
                                              "halve-tetrahedra",
                                              "halve-triangles",
                                              "insert-vertex",
                                              "insert-vertex-border",
                                              "quarter-faces",
                                              "sponge"};
  return dividing.contains(rule);
}

// Others keep the mass, even if no dart of an element is left.
bool deletes(const std::string& rule) {
  return rule.starts_with("delete-") || rule.starts_with("remove-") || rule == "collapse-edge" ||
         rule == "sponge";
}

// Elements that share two corners come to lie in the same place, and others between them become flat: then R is
// not determined by F (sim/mechanics/rotation.h), and two ways of computing it may differ.
bool lays_elements_flat(const std::string& rule) {
  return rule == "shape-quad";
}

void expect_same_forces(const Body& torn, const Body& anew) {
  std::vector<Record> now(torn.vertices()), expected(anew.program->vertices()), walked(torn.vertices());
  torn.program->forces(meshes::positions(torn), meshes::velocities(torn), now.data());
  anew.program->forces(meshes::positions(anew), meshes::velocities(anew), expected.data());
  const double scale = std::max(1.0, meshes::largest(expected));
  torn.map->map().for_each_dart([&](Dart d) {
    EXPECT_LT((now[torn.map->vertex(d)].vec() - expected[anew.map->vertex(d)].vec()).norm(), 1e-10 * scale);
  });
}

void expect_walk_gives_the_same(const Body& torn) {
  std::vector<Record> now(torn.vertices()), walked(torn.vertices());
  torn.program->forces(meshes::positions(torn), meshes::velocities(torn), now.data());
  walk_forces(*torn.map, torn.interactions, torn.mass->orbit(), meshes::positions(torn),
              meshes::velocities(torn), nullptr, walked.data());
  EXPECT_LT(meshes::difference(now, walked), 1e-12);
}

void expect_matter_as_built_anew(const Body& torn, const BodySettings& settings, const std::string& rule) {
  const auto anew = built_anew(torn, settings);
  const auto now = energies(torn), expected = energies(*anew);
  EXPECT_EQ(now.size(), expected.size());
  for (const auto& [name, unit] : expected) {
    ASSERT_TRUE(now.contains(name)) << name;
    EXPECT_EQ(now.at(name).first, unit.first) << name;
    if (name == "stretch" && divides_sides(rule)) continue;
    EXPECT_NEAR(now.at(name).second, unit.second, 1e-10 * std::abs(unit.second)) << name;
  }
  if (!divides_sides(rule) || settings.elasticity) expect_same_forces(torn, *anew);
  if (!lays_elements_flat(rule)) expect_walk_gives_the_same(torn);
  const auto stress = stresses(torn), stress_anew = stresses(*anew);
  if (settings.elasticity) { // every element has one
    EXPECT_EQ(stress.size(), plain::polyhedra(*torn.map).size());
  }
  ASSERT_EQ(stress.size(), stress_anew.size());
  for (const auto& [d, sigma] : stress)
    EXPECT_LT((sigma - stress_anew.at(d)).norm(), 1e-10 * std::max(1.0, sigma.norm()));
  if (divides_sides(rule)) return;
  const FrequencyBounds bounds = frequency_bounds(*torn.map, torn.interactions, *torn.mass, nullptr),
                        bounds_anew = frequency_bounds(*anew->map, anew->interactions, *anew->mass, nullptr);
  EXPECT_NEAR(bounds.omega_squared, bounds_anew.omega_squared, 1e-9 * bounds_anew.omega_squared);
}

// Against values from lists of polygons and polyhedra.
void expect_plain_values(Body& torn, const BodySettings& settings, const std::string& rule) {
  const bool solid = torn.map->dimension() == 3;
  if (!settings.elasticity || settings.elasticity->formulation == Formulation::Enhanced) return;
  if (lays_elements_flat(rule)) return;
  plain::PlainBody body(torn);
  body.add_elements(settings.elasticity->model == ContinuumModel::Corotational ? ElasticModel::Corotational
                                                                               : ElasticModel::Linear,
                    Rotation::Polar, ElasticMaterial::of(young, poisson, torn.map->dimension()), thickness,
                    torn.mass);
  const ForceView view = torn.view();
  for (std::size_t n = 1; n < torn.tear_laws.size(); ++n) {
    TearLaw& law = torn.tear_laws[n];
    const std::string& name = law.settings().criterion->name;
    const bool mass_tensor = settings.elasticity->model == ContinuumModel::MassTensor;
    if ((name.ends_with("border") && !solid) || (name == "atomic-vertex" && mass_tensor)) continue;
    const plain::Values values = body.values(name, "", false);
    std::size_t above = 0;
    double most = 0;
    for (const auto& [d, measured] : values) {
      above += measured.value > law.settings().threshold;
      most = std::max(most, measured.value);
    }
    const std::vector<Candidate>& found = law.find(view);
    EXPECT_EQ(found.size(), above) << name;
    for (const Candidate& one : found) {
      ASSERT_TRUE(values.contains(one.dart)) << name;
      EXPECT_NEAR(one.value, values.at(one.dart).value, 1e-9 * most) << name;
    }
  }
}

// The elements of a body before a change: their darts and masses.
class Weighed {
public:
  explicit Weighed(const Body& body) : whole_(total_mass(*body.map, *body.mass)) {
    for (const plain::Polyhedron& each : plain::polyhedra(*body.map)) {
      auto darts = darts_of(body.map->map(), element_orbit(body.map->dimension()), each.first);
      std::set<Slot> corners;
      double mass = 0;
      for (Dart d : darts)
        if (corners.insert(body.map->slot(body.mass->orbit(), d)).second)
          mass += (*body.mass)[*corners.find(body.map->slot(body.mass->orbit(), d))];
      elements_.push_back({std::move(darts), mass});
    }
  }
  // The mass without that of elements of which no dart is left.
  double without_deleted(const Body& body) const {
    double mass = whole_;
    for (const auto& [darts, own] : elements_)
      if (std::none_of(darts.begin(), darts.end(), [&](Dart d) { return body.map->map().alive(d); }))
        mass -= own;
    return mass;
  }
  double whole() const { return whole_; }

private:
  std::vector<std::pair<std::vector<Dart>, double>> elements_;
  double whole_;
};

// Calls f(name, rule or script) for all that may be the change of a law of such a body.
template <class F> void for_each_law(int dimension, F&& f) {
  std::vector<std::string> names;
  for (const Rule& rule : house_rules()) names.push_back(rule.name());
  for (const Script& script : house_scripts()) names.push_back(script.name());
  for (const std::string& name : names)
    if (misfit_of(*find_house_rule_or_script(name), dimension).empty()) f(name);
}

class RulesAsLaws : public testing::TestWithParam<Material> {};

TEST_P(RulesAsLaws, make_cells_that_are_as_built_anew_and_no_mass) {
  int changed = 0, refused = 0;
  for (const Mesh& mesh : all_meshes())
    for_each_law(mesh.dimension, [&](const std::string& rule) {
      SCOPED_TRACE(rule + " on " + mesh.name);
      BodySettings settings = settings_of(mesh, GetParam(), rule);
      for (int most : {2, 0}) { // few places in each of two steps, and all at once
        settings.tears[0].max_per_step = most;
        const auto body = body_of(settings);
        for (int step = 0; step < (most > 0 ? 2 : 1); ++step) {
          const Weighed before(*body);
          ASSERT_NO_THROW(changed += body->tear(0.1 * step, step, [] {}));
          EXPECT_NEAR(total_mass(*body->map, *body->mass),
                      deletes(rule) ? before.without_deleted(*body) : before.whole(), 1e-12 * before.whole());
          ASSERT_EQ(validate(*body->map), std::nullopt);
          if (body->map->map().dart_count() == 0) break;
          expect_matter_as_built_anew(*body, settings, rule);
          torn::expect_as_built_anew(*body, torn::Seen(*body));
          expect_plain_values(*body, settings, rule);
          if (HasFailure()) return;
        }
        refused += !body->tear_laws[0].refusals().empty();
      }
    });
  EXPECT_GT(changed, 1000);
  EXPECT_GT(refused, 100);
}

INSTANTIATE_TEST_SUITE_P(Of, RulesAsLaws, testing::ValuesIn(materials()),
                         [](const auto& of) { return of.param.name; });

} // namespace
} // namespace rend::rules_as_laws_test
