// Mass scaling and the element that limits the step, on a bar of tetrahedra with slivers.
#include "sim/scene/mass_scaling.h"

#include "sim/check/linearised.h"
#include "sim/mesh/mesh_files.h"
#include "sim/presets.h"
#include "sim/scene/element_steps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace rend::mass_scaling_test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

// 2 n × n × n cells of 0.1 m; an inner vertex is moved to a hundredth of a cell below the plane of its
// neighbours.
std::string bar_with_slivers(int n) {
  CellMesh mesh = bar_cells({BarPattern::Tetrahedra, 2 * n, n, n, 0.1 * Vec3(2 * n, n, n)});
  for (Vec3& x : mesh.points)
    if ((x - Vec3(0.3, 0.1, 0.1)).norm() < 1e-9) x.z() = 0.199;
  return files::text_of(solid_from(mesh));
}

struct Bar {
  files::Folder folder;
  std::unique_ptr<Scene> scene;
  Body& body() const { return *scene->bodies().front(); }
};

std::unique_ptr<Bar> bar(std::optional<double> scaling, const std::string& scheme = "symplectic",
                         std::optional<double> step = {}, int cells = 3) {
  auto made = std::make_unique<Bar>();
  BodySettings body;
  body.name = "bar";
  body.shape = MeshSettings{.file = made->folder.write("bar.msh", bar_with_slivers(cells)).string()};
  body.mass.density = 1000;
  body.elasticity = ElasticitySettings{};
  body.elasticity->young = 1e5;
  body.elasticity->poisson = 0.3;
  body.place.spin = Vec3(0, 0, 90);
  SceneDefinition scene;
  scene.world.gravity = Vec3::Zero();
  add_body(scene, body);
  scene.time.scheme = find_scheme(scheme);
  scene.time.duration = 1;
  scene.time.step = step;
  scene.time.mass_scaling = scaling;
  made->scene = std::make_unique<Scene>(std::move(scene), SceneOptions{});
  return made;
}

// The largest eigenvalue of M⁻¹ K by power iteration [1/s²]: below the true one, and close after so many.
double highest(const Body& body) {
  Linearised linear(body, 0);
  const double* inverse = body.program->inverse_mass();
  std::vector<Record> x(linear.vertices()), still(x.size()), f(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = Record(std::sin(1.0 + double(i)), std::cos(3.0 * double(i)), std::sin(0.3 + 2.0 * double(i)));
  double value = 0;
  for (int n = 0; n < 4000; ++n) {
    linear.forces(0, x.data(), still.data(), f.data());
    double above = 0, below = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      above -= x[i].vec().dot(f[i].vec());
      below += x[i].vec().squaredNorm() / inverse[i];
    }
    value = above / below;
    double largest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] = Record(-inverse[i] * f[i].vec());
      largest = std::max(largest, x[i].vec().norm());
    }
    for (Record& one : x) one = Record(one.vec() / largest);
  }
  return value;
}

TEST(MassScaling, makes_the_step_larger_and_stable_within_its_share) {
  const auto plain = bar({}), scaled = bar(0.05);
  const double mass = total_mass(*plain->body().map, *plain->body().mass);
  EXPECT_EQ(plain->body().added_mass, 0);
  EXPECT_NEAR(mass, 1000 * 0.6 * 0.3 * 0.3, 1e-9);
  EXPECT_GT(scaled->scene->step_size(), 3 * plain->scene->step_size());
  EXPECT_NEAR(total_mass(*scaled->body().map, *scaled->body().mass), mass + scaled->body().added_mass, 1e-9);
  EXPECT_LE(scaled->body().added_mass, 0.05 * mass * (1 + 1e-12));
  EXPECT_GT(scaled->body().added_mass, 0.045 * mass) << "the whole share is used";
  EXPECT_THAT(scaled->body().notes, Contains(HasSubstr("mass scaling: ")));
  for (const auto* each : {&plain, &scaled})
    EXPECT_LE((*each)->scene->step_size(), 2 / std::sqrt(highest((*each)->body())));
}

TEST(MassScaling, leaves_elements_alone_that_do_not_limit_the_step) {
  const auto plain = bar({}), scaled = bar(0.05);
  const MassColumn &before = *plain->body().mass, &after = *scaled->body().mass;
  std::size_t same = 0, heavier = 0;
  for (Slot c = 0; c < before.values().size(); ++c) {
    EXPECT_GE(after[c], before[c]);
    ++(after[c] == before[c] ? same : heavier);
  }
  EXPECT_GT(heavier, 0u);
  EXPECT_GT(same, 5 * heavier);
}

TEST(MassScaling, keeps_energy_and_momentum_of_the_heavier_body) {
  const auto scaled = bar(0.05);
  Scene& s = *scaled->scene;
  const double energy = s.kinetic_energy() + s.elastic_energy();
  const Vec3 turning = s.angular_momentum();
  EXPECT_GT(energy, 0.1);
  while (s.time() < 0.99) {
    s.step();
    ASSERT_NEAR(s.kinetic_energy() + s.elastic_energy(), energy, 0.02 * energy) << s.time();
  }
  EXPECT_LT((s.angular_momentum() - turning).norm(), 0.02 * turning.norm());
  EXPECT_EQ(s.guard().rejected, 0);
}

TEST(MassScaling, of_a_given_step_adds_no_more_than_it_takes) {
  const double step = bar({})->scene->step_size();
  const auto scaled = bar(0.5, "symplectic", 2 * step);
  EXPECT_EQ(scaled->scene->step_size(), 2 * step);
  EXPECT_LE(2 * step, scaled->scene->stability_limit(*find_scheme("symplectic")) * (1 + 1e-9));
  EXPECT_LT(scaled->body().added_mass, bar(0.5)->body().added_mass);
  EXPECT_EQ(bar(0.5, "symplectic", 0.5 * step)->body().added_mass, 0);
}

TEST(MassScaling, is_refused_where_nothing_limits_the_step) {
  EXPECT_THROW(bar(0.01, "implicit", 0.01), UserError);
}

TEST(StepLimitNote, names_the_element_where_a_few_limit_the_step) {
  const auto notes = bar({}, "symplectic", {}, 6)->scene->notes();
  EXPECT_THAT(notes, Contains(AllOf(HasSubstr("body 'bar': the tetrahedron"), HasSubstr("(a sliver: dihedral"),
                                    HasSubstr("without the worst 3 of 2592 elements"))));
  const auto even = presets::load(R"(<scene><body><bar pattern="tetrahedra" cells="6 3 3" size="0.6 0.3 0.3"/>
      <mass density="1000"/><elasticity model="corotational" young="1e5" poisson="0.3"/></body>
      <time step="auto" duration="1"/></scene>)");
  EXPECT_TRUE(even->notes().empty());
}

// Elements by themselves and the body: the least step is the same.
TEST(ElementSteps, have_the_limit_of_the_body_as_their_least) {
  const auto plain = bar({});
  const ElementSteps steps(plain->body());
  const Scheme& scheme = *find_scheme("symplectic");
  double least = 1e300;
  for (Slot e = 0; e < steps.count(); ++e) least = std::min(least, steps.step(scheme, e));
  EXPECT_NEAR(least, plain->scene->stability_limit(scheme), 1e-12 * least);
}

} // namespace
} // namespace rend::mass_scaling_test
