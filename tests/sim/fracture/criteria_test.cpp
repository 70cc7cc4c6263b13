// All criteria on every mesh and model against their definitions (plain_body.h, brute_force.h), and against
// known answers.
#include "sim/brute_force.h"
#include "sim/fracture/plain_body.h"
#include "sim/house_rules/house_rules.h"
#include "sim/rules/apply.h"

#include <gtest/gtest.h>

namespace rend::criteria_test {
namespace {

using elements::NamedMap;
using meshes::Noise;
using plain::PlainBody;
using plain::Values;

struct Asked {
  std::string criterion, kind;
  bool compression = false;
};

void add_law(Body& body, const Asked& asked, double threshold) {
  LawSettings settings = meshes::law(asked.criterion, threshold);
  settings.kind = asked.kind;
  settings.compression = asked.compression;
  body.tear_laws.emplace_back(body.request_for(settings), settings);
}

struct Matter {
  std::string name;
  std::string model, rotation; // of elasticity; empty: springs
};
const std::vector<Matter> continua{{"linear", "linear", "polar"},
                                   {"polar", "corotational", "polar"},
                                   {"qr", "corotational", "qr"},
                                   {"tensors", "mass-tensor", "polar"}};
const std::vector<meshes::Spring> solid_springs{{"stretch", "", 60, 0.5}, {"shear", "isotropic", 43, 0.3}};

std::unique_ptr<Body> made_of(std::unique_ptr<EmbeddedMap> map, const Matter& matter, double beta = 0.01) {
  auto made = std::make_unique<Body>();
  made->map = std::move(map);
  CornerMass mass;
  mass.density = 10;
  made->mass = &made->map->add(mass.on(*made->map));
  if (!matter.model.empty()) {
    elements::add_elasticity(*made, {matter.model, matter.rotation, beta});
  } else {
    for (const meshes::Spring& spring : solid_springs)
      if (auto added = meshes::interaction(*made->map, spring)) made->interactions.push_back(std::move(added));
  }
  made->border = &made->map->add(InitialBorder(made->map->dimension()));
  return made;
}

PlainBody plain_of(const Body& body, const Matter& matter, double beta = 0.01) {
  PlainBody all(body);
  if (matter.model.empty()) {
    for (const meshes::Spring& spring : solid_springs) all.add_springs(spring);
    return all;
  }
  ElasticMaterial material = ElasticMaterial::of(1000, 0.3, body.map->dimension());
  material.damping = beta;
  all.add_elements(matter.model == "corotational" ? ElasticModel::Corotational : ElasticModel::Linear,
                   matter.rotation == "qr" ? Rotation::Qr : Rotation::Polar, material,
                   body.map->dimension() == 2 ? 0.1 : 1);
  return all;
}

void prepare(Body& body, unsigned seed, double amount = 0.2) {
  body.prepare(*find_scheme("symplectic"));
  meshes::shake(body, amount, seed);
  body.evaluate();
}

// A law must find exactly the cells whose value exceeds its threshold, with value and plane.
void expect_found(Body& body, TearLaw& law, const Values& expected) {
  const double threshold = law.settings().threshold;
  double most = 0;
  for (const auto& [dart, m] : expected) most = std::max(most, m.value);
  std::size_t above = 0;
  for (const auto& [dart, m] : expected) above += m.value > threshold;
  const std::vector<Candidate> found = law.find(body.view());
  EXPECT_EQ(found.size(), above);
  for (const Candidate& c : found) {
    ASSERT_TRUE(expected.contains(c.dart));
    EXPECT_NEAR(c.value, expected.at(c.dart).value, 1e-11 * most);
    if (law.settings().cell != Cell::Vertices) continue;
    EXPECT_NEAR(c.normal.norm(), 1, 1e-12);
    if (law.settings().criterion->name == "vertex-stress") continue; // its eigenvalue is tested separately
    EXPECT_NEAR(std::abs(c.normal.dot(expected.at(c.dart).normal)), 1, 1e-6);
  }
}

// A threshold that about half of the values exceed, in the middle of the widest gap there, since both ends of a
// spring have the same value.
double middle(const Values& values) {
  std::vector<double> sorted;
  for (const auto& [dart, m] : values) sorted.push_back(m.value);
  std::sort(sorted.begin(), sorted.end());
  double best = 0.5 * sorted.back(), widest = 0;
  for (std::size_t n = sorted.size() / 4; n + 1 <= 3 * sorted.size() / 4 && n + 1 < sorted.size(); ++n) {
    if (sorted[n + 1] - sorted[n] <= widest) continue;
    widest = sorted[n + 1] - sorted[n];
    best = sorted[n] + 0.5 * widest;
  }
  return best;
}

// Tests thresholds from 0 to beyond the largest value.
void expect_measured(Body& body, const Asked& asked, const Values& expected) {
  SCOPED_TRACE(asked.criterion + " " + asked.kind + (asked.compression ? " compression" : ""));
  ASSERT_FALSE(expected.empty());
  double most = 0;
  for (const auto& [dart, m] : expected) most = std::max(most, m.value);
  for (double threshold : {1e-9 * most, middle(expected), 0.9 * most, 1.001 * most}) {
    if (threshold <= 0) continue;
    LawSettings settings = meshes::law(asked.criterion, threshold);
    settings.kind = asked.kind;
    settings.compression = asked.compression;
    const CriterionRequest request = body.request_for(settings);
    EXPECT_EQ(settings.criterion->lacking(request), "");
    settings.cell = settings.criterion->cell(settings.kind);
    settings.change = &default_change(settings.cell);
    TearLaw law(request, settings);
    expect_found(body, law, expected);
  }
}

const std::vector<Asked> of_elements{
    {"atomic-element", ""}, {"atomic-element", "", true}, {"vertex-stress", ""}, {"vertex-stress", "", true},
    {"strain", ""},         {"strain", "", true},         {"atomic-vertex", ""}, {"cumulative-vertex", ""}};

TEST(Criteria, measure_elements_and_vertices_of_every_continuum) {
  for (const Matter& matter : continua) {
    unsigned seed = 1;
    for (NamedMap& each : elements::irregular_maps()) {
      SCOPED_TRACE(matter.name + " " + each.name);
      const auto body = made_of(std::move(each.map), matter);
      prepare(*body, ++seed);
      const PlainBody all = plain_of(*body, matter);
      for (const Asked& asked : of_elements)
        expect_measured(*body, asked, all.values(asked.criterion, asked.kind, asked.compression));
    }
  }
}

TEST(Criteria, measure_borders_of_every_solid) {
  for (const Matter& matter : {continua[0], continua[1], continua[3], Matter{"springs", "", ""}}) {
    unsigned seed = 10;
    for (NamedMap& each : elements::irregular_maps()) {
      if (each.map->dimension() == 2) continue;
      SCOPED_TRACE(matter.name + " " + each.name);
      const auto body = made_of(std::move(each.map), matter);
      add_law(*body, {"atomic-border", ""}, 1e30); // so that corner forces are evaluated
      prepare(*body, ++seed);
      const PlainBody all = plain_of(*body, matter);
      for (const char* criterion : {"global-border", "atomic-border"})
        expect_measured(*body, {criterion, ""}, all.values(criterion, "", false));
    }
  }
}

TEST(Criteria, measure_single_springs_of_solids) {
  const Matter springs{"springs", "", ""};
  for (bool elementary : {false, true}) {
    unsigned seed = 20;
    for (NamedMap& each : elements::irregular_maps()) {
      if (each.map->dimension() == 2) continue;
      SCOPED_TRACE(each.name);
      const bool quads = each.name != "tetrahedra";
      const auto body = made_of(std::move(each.map), springs);
      if (elementary) add_law(*body, {"atomic-border", ""}, 1e30);
      prepare(*body, ++seed);
      const PlainBody all = plain_of(*body, springs);
      for (const char* criterion : {"atomic-spring", "strain"})
        for (const char* kind : {"stretch", "shear"})
          if (quads || kind == std::string("stretch"))
            for (bool compression : {false, true})
              expect_measured(*body, {criterion, kind, compression}, all.values(criterion, kind, compression));
      for (const char* criterion : {"atomic-vertex", "cumulative-vertex"})
        expect_measured(*body, {criterion, ""}, all.values(criterion, "", false));
    }
  }
}

// Reference values for a sheet, from its polygons.
Values of_sheet(const EmbeddedMap& map, const meshes::BruteForce& brute, const Asked& asked) {
  Values all;
  for (const auto& single : brute.singles()) {
    if (asked.criterion == "atomic-vertex") {
      for (const auto& [point, f] : single.pulls) {
        const Slot v = map.vertex(brute.darts()[brute.corner_at(point)]);
        plain::Measured& most = all[map.cells(Vertex).first_dart(v)];
        if (f.norm() > most.value) most = {f.norm(), f.normalized()};
      }
    } else if (single.element == asked.kind) {
      const Orbit orbit = asked.kind == "shear" ? FaceOfVolume : Edge;
      const double e = single.elongation;
      const double value = asked.criterion == "atomic-spring" ? single.force
                           : asked.compression                ? std::abs(e)
                                                              : e;
      double& most = all[smallest_dart(map.map(), orbit, single.on)].value;
      most = std::max(most, value);
    }
  }
  return all;
}

TEST(Criteria, measure_single_springs_of_every_sheet) {
  for (const char* bend : {"provot", "angular"}) {
    for (bool torn : {false, true}) {
      for (const meshes::Named& sheet : meshes::irregular()) {
        SCOPED_TRACE(sheet.name + " " + bend);
        meshes::Recipe recipe;
        recipe.springs = {{"stretch", "", 60, 0.5},
                          {"shear", "isotropic", 43, 0.3},
                          {"shear", "anisotropic", 17, 0.2},
                          {"bend", bend, 10, 0.1}};
        const auto body = meshes::body(sheet.mesh, recipe);
        Noise noise(3);
        for (int n = 0; torn && n < 15; ++n) {
          const Dart d{noise.below(body->map->map().capacity())};
          body->map->edit([&](Edit& edit) { unsew(edit, 2, d); });
          body->rebind();
        }
        meshes::shake(*body, 0.2, 4);
        body->evaluate();
        meshes::BruteForce brute(*body->map);
        brute.look_at(*body);
        for (const meshes::Spring& spring : recipe.springs) brute.add(spring);
        std::vector<Asked> asked{{"atomic-spring", "stretch"},
                                 {"atomic-spring", "bend"},
                                 {"atomic-vertex", ""},
                                 {"strain", "stretch"},
                                 {"strain", "stretch", true}};
        if (sheet.name.find("quads") != std::string::npos) asked.push_back({"atomic-spring", "shear"});
        if (bend == std::string("provot")) asked.push_back({"strain", "bend", true});
        for (const Asked& each : asked) expect_measured(*body, each, of_sheet(*body->map, brute, each));
      }
    }
  }
}

TEST(Criteria, of_a_bar_that_is_pulled_are_its_stress_and_the_normal_along_it) {
  const Vec3 axis = Vec3(1, 2, -2).normalized();
  const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), axis).toRotationMatrix();
  const double young = 1000, e = 1e-3;
  for (BarPattern pattern :
       {BarPattern::Hexahedra, BarPattern::Tetrahedra, BarPattern::Prisms, BarPattern::Mixed}) {
    for (const Matter& matter : {continua[1], continua[2]}) {
      const auto body = made_of(solid_from(elements::warped_bar(pattern, 5, 2, 2, 0, 1)), matter, 0);
      body->prepare(*find_scheme("symplectic"));
      for (Slot v = 0; v < body->vertices(); ++v) {
        const Vec3 x = body->map->rest()[v];
        body->map->position()[v] =
            Record(turn * Vec3((1 + e) * x.x(), (1 - 0.3 * e) * x.y(), (1 - 0.3 * e) * x.z()));
      }
      body->evaluate();
      LawSettings settings = meshes::law("vertex-stress", 0.5 * young * e);
      TearLaw law(body->request_for(settings), settings);
      const std::vector<Candidate> found = law.find(body->view());
      EXPECT_EQ(found.size(), body->vertices());
      for (const Candidate& c : found) {
        EXPECT_NEAR(c.value, young * e, e * young * e); // Gram-Schmidt is exact to first order
        EXPECT_NEAR(std::abs(c.normal.dot(axis)), 1, e * e);
      }
      settings = meshes::law("strain", 0.5 * e);
      TearLaw strained(body->request_for(settings), settings);
      for (const Candidate& c : strained.find(body->view())) EXPECT_NEAR(c.value, e, e * e);
    }
  }
}

TEST(Criteria, find_after_a_storm_what_they_would_if_made_anew) {
  for (const Matter& matter : {continua[1], continua[3], Matter{"springs", "", ""}}) {
    for (NamedMap& each : elements::irregular_maps()) {
      SCOPED_TRACE(matter.name + " " + each.name);
      const auto body = made_of(std::move(each.map), matter);
      std::vector<Asked> asked{
          {"atomic-vertex", ""}, {"cumulative-vertex", ""}, {"global-border", ""}, {"atomic-border", ""}};
      if (matter.model.empty())
        asked.insert(asked.end(), {{"atomic-spring", "stretch"}, {"strain", "stretch", true}});
      else
        asked.insert(asked.end(), {{"atomic-element", "", true}, {"vertex-stress", ""}, {"strain", ""}});
      for (const Asked& a : asked) add_law(*body, a, 1);
      body->prepare(*find_scheme("rk4"));
      Noise noise(11);
      const int dimension = body->map->dimension();
      for (int round = 0; round < 6; ++round) {
        for (int n = 0; n < 4; ++n) {
          const Dart d{noise.below(body->map->map().capacity())};
          body->map->edit([&](Edit& edit) { unsew(edit, dimension, d); });
        }
        body->rebind();
        meshes::shake(*body, 0.2, 30 + static_cast<unsigned>(round));
        body->evaluate();
        for (TearLaw& law : body->tear_laws) {
          LawSettings settings = law.settings();
          settings.threshold = 1e-3;
          TearLaw anew(body->request_for(settings), settings);
          const std::vector<Candidate> all = anew.find(body->view());
          settings.threshold = law.settings().threshold;
          TearLaw fresh(body->request_for(settings), settings);
          const std::vector<Candidate> one = fresh.find(body->view()), two = law.find(body->view());
          EXPECT_LE(one.size(), all.size());
          ASSERT_EQ(one.size(), two.size());
          for (std::size_t n = 0; n < one.size(); ++n) {
            EXPECT_EQ(one[n].dart, two[n].dart);
            EXPECT_EQ(one[n].value, two[n].value);
            EXPECT_EQ(one[n].normal, two[n].normal);
          }
        }
      }
    }
  }
}

TEST(Criteria, do_not_see_a_turn_of_the_body) {
  Noise noise(7);
  const Eigen::Matrix3d R = elements::random_rotation(noise);
  for (const Matter& matter : {continua[1], continua[2], Matter{"springs", "", ""}}) {
    for (NamedMap& each : elements::irregular_maps()) {
      SCOPED_TRACE(matter.name + " " + each.name);
      const auto body = made_of(std::move(each.map), matter, 0);
      if (body->interactions.empty()) continue;
      std::vector<Asked> asked{
          {"atomic-vertex", ""}, {"cumulative-vertex", ""}, {"global-border", ""}, {"atomic-border", ""}};
      if (matter.model.empty())
        asked.push_back({"atomic-spring", "stretch"});
      else
        asked.insert(asked.end(), {{"atomic-element", ""}, {"vertex-stress", ""}, {"strain", ""}});
      for (const Asked& a : asked) add_law(*body, a, 1e-6);
      prepare(*body, 5, 0.1);
      for (Record& v : body->map->velocity().values()) v = Record();
      body->evaluate();
      std::vector<std::vector<Candidate>> before;
      for (TearLaw& law : body->tear_laws) before.push_back(law.find(body->view()));
      for (Record& x : body->map->position().values()) x = Record(Vec3(R * x.vec() + Vec3(1, 2, 3)));
      body->evaluate();
      for (std::size_t n = 0; n < body->tear_laws.size(); ++n) {
        SCOPED_TRACE(asked[n].criterion);
        Values expected;
        for (const Candidate& c : before[n]) expected[c.dart] = {c.value, R * c.normal};
        const std::vector<Candidate> after = body->tear_laws[n].find(body->view());
        EXPECT_EQ(after.size(), before[n].size());
        for (const Candidate& c : after) {
          ASSERT_TRUE(expected.contains(c.dart));
          EXPECT_NEAR(c.value, expected.at(c.dart).value, 1e-9 * before[n][0].value);
        }
      }
    }
  }
}

} // namespace
} // namespace rend::criteria_test
