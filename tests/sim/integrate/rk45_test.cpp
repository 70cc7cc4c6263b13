// The Dormand-Prince pair: its order, its error estimate against theory, its substeps, and whole scenes.
#include "sim/integrate/oscillators.h"
#include "sim/presets.h"

#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend::rk45_test {
namespace {

using testing::HasSubstr;

const Scheme& rk45() {
  return *find_scheme("rk45");
}
constexpr SchemeSettings whole_steps{.tolerance = 0.1, .size = 1e30}; // any error is accepted

// One particle of 1 kg under a force that depends on its position.
class Particle final : public System {
public:
  explicit Particle(std::function<Vec3(const Vec3&)> pull) : pull_(std::move(pull)) {
    inverse_mass = &one_;
    now.resize(1);
    next.resize(1);
  }
  std::size_t vertices() const override { return 1; }
  void forces(double, const Record* x, const Record*, Record* force) override {
    ++evaluations;
    force[0] = Record(pull_(x[0].vec()));
  }
  void constrain(double, Record*, Record*) override {}

  // Integrates from the current state over `end` in steps of equal length.
  Vec3 go(const Scheme& scheme, const SchemeSettings& settings, double end, int steps) {
    const auto integrator = scheme.make(settings);
    for (int n = 0; n < steps; ++n) {
      std::vector<Record> force(1);
      forces(0, now.position.data(), now.velocity.data(), force.data());
      integrator->advance(*this, n * end / steps, end / steps, {now.position.data(), now.velocity.data()},
                          force.data(), next);
      std::swap(now, next);
    }
    figures = integrator->solver();
    return now.position[0];
  }

  State now, next;
  long evaluations = 0;
  SolverFigures figures;

private:
  std::function<Vec3(const Vec3&)> pull_;
  double one_ = 1;
};

// On a spring of 400 N/m and 1 m attached to the origin, thrown from the horizontal: it swings, rotates and
// stretches.
Particle pendulum() {
  Particle p([](const Vec3& x) { return Vec3(-400 * (x.norm() - 1) / x.norm() * x + Vec3(0, 0, -9.81)); });
  p.now.position[0] = Record(1.1, 0, 0);
  p.now.velocity[0] = Record(0, 0.7, 0.3);
  return p;
}

// An orbit around the sun, with an aphelion of 19 times the perihelion; the period is 2π s.
Particle comet() {
  Particle p([](const Vec3& x) { return Vec3(-x / (x.norm() * x.squaredNorm())); });
  p.now.position[0] = Record(1.9, 0, 0);
  p.now.velocity[0] = Record(0, std::sqrt(0.1 / 1.9), 0);
  return p;
}

TEST(RungeKutta45, is_of_order_five_in_whole_steps) {
  Particle fine = pendulum();
  fine.go(*find_scheme("rk4"), {}, 1, 40000);
  const auto error = [&](int steps) {
    Particle p = pendulum();
    p.go(rk45(), whole_steps, 1, steps);
    EXPECT_EQ(p.figures.substeps, steps);
    EXPECT_EQ(p.figures.rejected, 0);
    return std::hypot(20 * (p.now.position[0].vec() - fine.now.position[0].vec()).norm(),
                      (p.now.velocity[0].vec() - fine.now.velocity[0].vec()).norm());
  };
  EXPECT_NEAR(std::log2(error(160) / error(320)), 5, 0.1);
}

// For x'' = −ω²x, both solutions of a step are polynomials of z = iωh; of order 5: Σ z^n/n! + z⁶/600, of order
// 4: 1097/120000, 161/120000 and 1/24000 of z⁵, z⁶ and z⁷. A substep is rejected if their difference exceeds
// the tolerance.
TEST(RungeKutta45, measures_the_difference_of_its_two_solutions) {
  constexpr double omega = 17;
  for (const double h : {0.003, 0.03, 0.06}) {
    const std::complex<double> z(0, -omega * h), y(1, 0.7 / omega); // x + i v/ω
    const std::complex<double> e = (1.0 / 120 - 1097.0 / 120000) * std::pow(z, 5) +
                                   (1.0 / 600 - 161.0 / 120000) * std::pow(z, 6) - std::pow(z, 7) / 24000.0;
    const double theory = std::hypot((e * y).real(), h * omega * (e * y).imag());
    const auto rejected = [&](double tolerance) {
      Oscillators system({{omega, 0, 0}});
      system.now.position[0] = Record(1, 0, 0);
      system.now.velocity[0] = Record(0.7, 0, 0);
      const auto integrator = rk45().make({tolerance, 1});
      system.step(*integrator, 0, h);
      return integrator->solver().rejected;
    };
    EXPECT_GT(rejected(0.99999 * theory), 0) << h;
    EXPECT_EQ(rejected(1.00001 * theory), 0) << h;
  }
}

TEST(RungeKutta45, errs_in_proportion_to_the_tolerance) {
  const Vec3 exact = pendulum().go(*find_scheme("rk4"), {}, 2, 80000);
  std::vector<double> errors;
  for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
    Particle p = pendulum();
    errors.push_back((p.go(rk45(), {tolerance, 1}, 2, 10) - exact).norm());
    EXPECT_LT(errors.back(), 1e3 * tolerance);
    RecordProperty(fmt::format("{}", tolerance),
                   fmt::format("{}, {} parts", errors.back(), p.figures.substeps));
  }
  EXPECT_NEAR(std::log10(errors.front() / errors.back()) / 5, 1, 0.1);
}

// An orbit that is slow except near perihelion, over one period.
TEST(RungeKutta45, takes_fewer_evaluations_than_fixed_steps) {
  constexpr double turn = 2 * 3.14159265358979323846;
  const Vec3 start(1.9, 0, 0);
  Particle adaptive = comet();
  const double error = (adaptive.go(rk45(), {1e-7, 1}, turn, 20) - start).norm();
  int steps = 100;
  for (;; steps += steps / 10) {
    Particle fixed = comet();
    if ((fixed.go(*find_scheme("rk4"), {}, turn, steps) - start).norm() <= error) break;
  }
  EXPECT_LT(adaptive.evaluations * 3, 4 * steps);
  RecordProperty("evaluations", fmt::format("{} against {}", adaptive.evaluations, 4 * steps));
}

TEST(RungeKutta45, goes_on_from_what_it_carries) {
  Particle one = comet(), two = comet();
  const auto first = rk45().make({1e-8, 1});
  auto second = rk45().make({1e-8, 1});
  for (int n = 0; n < 10; ++n) {
    auto made = rk45().make({1e-8, 1});
    made->restore_state(second->saved_state());
    second = std::move(made);
    for (const auto& [p, integrator] : {std::pair(&one, first.get()), std::pair(&two, second.get())}) {
      std::vector<Record> force(1);
      p->forces(0, p->now.position.data(), p->now.velocity.data(), force.data());
      integrator->advance(*p, 0, 0.3, {p->now.position.data(), p->now.velocity.data()}, force.data(), p->next);
      std::swap(p->now, p->next);
    }
    EXPECT_EQ(one.now.position[0].vec(), two.now.position[0].vec());
    EXPECT_EQ(one.now.velocity[0].vec(), two.now.velocity[0].vec());
  }
  EXPECT_EQ(one.evaluations, two.evaluations);
}

TEST(RungeKutta45, gives_up_where_forces_are_no_numbers) {
  Particle p([](const Vec3& x) { return Vec3(std::nan(""), x.x(), 0); });
  EXPECT_THROW(p.go(rk45(), {}, 1, 1), NotConverged);
}

std::string time_of(const std::string& scheme, double step, const std::string& more = "") {
  return fmt::format(R"(<time step="{}" integrator="{}" duration="1" {}/>)", step, scheme, more);
}

double farthest(const Scene& a, const Scene& b) {
  double most = 0;
  const auto &x = a.bodies()[0]->map->position().values(), &y = b.bodies()[0]->map->position().values();
  for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, (x[i].vec() - y[i].vec()).norm());
  return most;
}

void run(Scene& scene, double end) {
  while (scene.time() < end * (1 - 1e-9)) scene.step();
}

// An edge that starts and stops moving within a step; another one is released.
TEST(RungeKutta45, follows_drives_within_a_step) {
  const auto cloth = [](const std::string& time) {
    return presets::load(presets::cloth("quads", 6, "", time, R"(<bend kind="angular" k="1e-3"/>)",
                                        R"(<drive side="-z" velocity="0 0.5 0" from="0.013" until="0.271"/>)"
                                        R"(<drive side="+z" rotate="0 0 1 40" until="0.153" then="free"/>)"));
  };
  const auto fine = cloth(time_of("rk4", 1e-4));
  run(*fine.scene, 0.3);
  for (const double tolerance : {1e-5, 1e-7}) {
    const auto s = cloth(time_of("rk45", 0.05, fmt::format(R"(tolerance="{}")", tolerance)));
    run(*s.scene, 0.3);
    EXPECT_LT(farthest(*s.scene, *fine.scene), 100 * tolerance) << tolerance;
    EXPECT_GT(s.body().integrator->solver().rejected, 0);
    std::vector<Record> x = s.body().map->position().values(), v = s.body().map->velocity().values();
    s.body().constrain(s->time(), x.data(), v.data());
    for (Slot i : s.body().constraints.vertices())
      EXPECT_EQ(x[i].vec(), s.body().map->position()[i].vec()); // to the bit
  }
}

// An overdamped sheet at rest, struck for 4 ms, that comes to rest again.
TEST(RungeKutta45, takes_fewer_evaluations_than_fixed_steps_where_something_sudden_happens) {
  const auto struck = [](const std::string& scheme, double step, const std::string& more = "") {
    auto s = presets::load(
        fmt::format(R"(<scene><body><sheet pattern="quads" cells="4 4" size="1 1"/><place rotate="90 0 0"/>)"
                    R"(<mass total="0.1"/><springs><stretch k="60"/><shear kind="isotropic" k="43"/></springs>)"
                    R"(<viscosity value="2" per="body"/><fix side="+z"/>)"
                    R"(<drive side="-z" velocity="0 0 -40" from="0.3" until="0.304"/></body>)"
                    R"(<world gravity="0 0 0"/><time step="{}" integrator="{}" duration="1" {}/></scene>)",
                    step, scheme, more));
    run(*s.scene, 1);
    return s;
  };
  const auto exact = struck("rk4", 2e-5);
  const auto adaptive = struck("rk45", 0.05, R"(tolerance="1e-7")");
  const double error = farthest(*adaptive.scene, *exact.scene);
  for (int steps = 300;; steps += steps / 10) {
    const auto fixed = struck("rk4", 1.0 / steps);
    if (farthest(*fixed.scene, *exact.scene) > error) continue;
    EXPECT_LT(adaptive->evaluations(), fixed->evaluations());
    RecordProperty("evaluations", fmt::format("{} against {}", adaptive->evaluations(), fixed->evaluations()));
    break;
  }
}

TEST(RungeKutta45, tears_as_small_steps_do) {
  const auto torn = [](const std::string& time) {
    auto s = presets::load(presets::cloth(
        "quads", 8, R"(<tear criterion="atomic-spring" kind="stretch" threshold="0.3" change="delete-edge"/>)",
        time, R"(<bend kind="provot" k="10"/>)", R"(<fix near="0 0 1"/><fix near="0.6 0 1"/>)"));
    run(*s.scene, 0.5);
    return s;
  };
  const auto fine = torn(time_of("rk4", 1e-3));
  const auto s = torn(time_of("rk45", 1e-3, R"(tolerance="1e-8")"));
  ASSERT_GT(s->tears(), 0u);
  EXPECT_EQ(s.body().events[0].time, fine.body().events[0].time);
  EXPECT_EQ(s.body().events[0].dart, fine.body().events[0].dart);
}

TEST(RungeKutta45, gives_the_same_bytes_on_any_number_of_threads) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 4}) {
    const auto s = presets::load(presets::cloth("quads", 64, "", time_of("rk45", 1e-3)),
                                 {.walk = false, .threads = threads});
    run(*s.scene, 0.01);
    EXPECT_EQ(s.body().program->parts(), threads);
    hashes.push_back(s->hash());
  }
  EXPECT_THAT(hashes, testing::Each(hashes.front()));
}

std::string stiff(double k, double step) {
  return fmt::format(
      R"(<scene><body><sheet pattern="quads" cells="4 4" size="1 1"/><mass total="0.1"/><springs>)"
      R"(<stretch k="{0}"/><shear kind="isotropic" k="{0}"/><bend kind="provot" k="{0}"/></springs>)"
      R"(<fix near="0 1 0"/><fix near="1 1 0"/></body>{1}</scene>)",
      k, time_of("rk45", step, R"(tolerance="1e-8")"));
}

// An explicit scheme with fixed steps is unstable here: 2/ω is about 1e-5 s.
TEST(RungeKutta45, holds_what_is_stiff_in_many_parts) {
  const auto s = presets::load(stiff(1e8, 1e-2));
  const double start = s->gravity_energy();
  run(*s.scene, 0.03);
  EXPECT_GT(s.body().integrator->solver().substeps, 1000);
  EXPECT_GT(s->kinetic_energy(), 1e-3);
  EXPECT_NEAR(s->kinetic_energy() + s->elastic_energy() + s->gravity_energy(), start,
              0.02 * s->kinetic_energy());
}

TEST(RungeKutta45, says_what_is_too_stiff) {
  const auto s = presets::load(stiff(1e300, 1e-2));
  try {
    for (int n = 0; n < 2; ++n) s->step();
    ADD_FAILURE();
  } catch (const Unstable& error) {
    EXPECT_EQ(error.code, Exit::Unstable);
    EXPECT_THAT(error.hint, HasSubstr("shorter step"));
  }
}

TEST(RungeKutta45, takes_the_step_of_symplectic_by_itself) {
  const auto step = [](const char* scheme) {
    return presets::load(
               presets::cloth("quads", 4, "", fmt::format(R"(<time integrator="{}" duration="1"/>)", scheme)))
        ->step_size();
  };
  EXPECT_EQ(step("rk45"), step("symplectic"));
}

TEST(Tolerance, belongs_to_adaptive_schemes) {
  for (const Scheme& scheme : all_schemes()) {
    if (scheme.adaptive) continue;
    try {
      presets::load(presets::cloth("quads", 4, "", time_of(scheme.name, 1e-3, R"(tolerance="1e-3")")));
      ADD_FAILURE() << scheme.name;
    } catch (const UserError& error) {
      EXPECT_EQ(error.code, Exit::BadInput);
      EXPECT_THAT(error.what(), HasSubstr("tolerance is used by rk45 alone"));
    }
  }
}

} // namespace
} // namespace rend::rk45_test
