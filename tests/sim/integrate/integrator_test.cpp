// Every scheme on systems with known answers: free fall, damped oscillators (tests/README.md, "Closed forms").
#include "sim/integrate/oscillators.h"

#include "sim/base/math.h"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <vector>

namespace rend::integrator_test {
namespace {

struct Phase {
  double x = 0, v = 0; // [m], [m/s]
};

// The state at `end`, from x = 1, v = 0.7.
Phase reached(const Scheme& scheme, const Oscillators::Mode& mode, double end, int steps) {
  Oscillators system({mode});
  system.now.position[0] = Record(1, 0, 0);
  system.now.velocity[0] = Record(0.7, 0, 0);
  const auto integrator = scheme.make({});
  for (int n = 0; n < steps; ++n) system.step(*integrator, n * end / steps, end / steps);
  return {system.now.position[0].x, system.now.velocity[0].x};
}

Phase exact(const Oscillators::Mode& mode, double t) {
  const double d = mode.d + mode.drag, w2 = mode.omega * mode.omega, w = std::sqrt(w2 - d * d);
  const double c = std::cos(w * t), s = std::sin(w * t) / w;
  return {std::exp(-d * t) * (c + (0.7 + d) * s), std::exp(-d * t) * (0.7 * c - (w2 + 0.7 * d) * s)};
}

double observed_order(const Scheme& scheme, const Oscillators::Mode& mode) {
  const double end = 0.3; // five radians
  const int steps = scheme.order == 4 ? 128 : 4096;
  const auto error = [&](int n) {
    const Phase is = reached(scheme, mode, end, n), should = exact(mode, end);
    return std::hypot(mode.omega * (is.x - should.x), is.v - should.v);
  };
  return std::log2(error(steps) / error(2 * steps));
}

// The largest growth of (x, v) over one step: the spectral radius of the scheme's amplification matrix.
double growth(const Scheme& scheme, const Oscillators::Mode& mode, double step) {
  std::array<double, 4> m{}; // columns: images of (1, 0) and (0, 1)
  for (std::size_t column = 0; column < 2; ++column) {
    Oscillators system({mode});
    system.now.position[0] = Record(column == 0 ? 1 : 0, 0, 0);
    system.now.velocity[0] = Record(column == 1 ? 1 : 0, 0, 0);
    system.step(*scheme.make({}), 0, step);
    m[2 * column] = system.now.position[0].x;
    m[2 * column + 1] = system.now.velocity[0].x;
  }
  const std::complex<double> half = 0.5 * (m[0] + m[3]);
  const std::complex<double> root = std::sqrt(half * half - (m[0] * m[3] - m[1] * m[2]));
  return std::max(std::abs(half + root), std::abs(half - root));
}

// The smallest step at which the oscillator grows, by bisection.
double bisected_limit(const Scheme& scheme, const Oscillators::Mode& mode) {
  double low = 0, high = 0.01 / (mode.omega + mode.d + mode.drag);
  while (growth(scheme, mode, high) <= 1 + 1e-9) high *= 1.05;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (growth(scheme, mode, middle) <= 1 + 1e-9 ? low : high) = middle;
  }
  return low;
}

StabilityBounds bounds_of(const Oscillators::Mode& mode) {
  return {mode.omega * mode.omega, 2 * (mode.d + mode.drag), 2 * mode.drag};
}

const Scheme& scheme(const std::string& name) {
  return *find_scheme(name);
}

constexpr double omega = 17;

std::vector<Scheme> schemes_that(bool (*ask)(const Scheme&)) {
  std::vector<Scheme> chosen;
  std::copy_if(all_schemes().begin(), all_schemes().end(), std::back_inserter(chosen), ask);
  return chosen;
}
std::vector<Scheme> marching_schemes() { // time-stepping schemes, without static
  return schemes_that([](const Scheme& s) { return s.name != "static"; });
}
std::vector<Scheme> explicit_schemes() {
  return schemes_that([](const Scheme& s) { return !s.solves; });
}
std::vector<Scheme> steady_schemes() { // schemes with a fixed step
  return schemes_that([](const Scheme& s) { return s.name != "static" && !s.adaptive; });
}
std::vector<Scheme> limited_schemes() {
  return schemes_that([](const Scheme& s) { return !s.solves && !s.adaptive; });
}

TEST(SymplecticEuler, falls_as_the_formula_says) {
  Oscillators system({Oscillators::Mode{}});
  system.gravity = Record(0, 0, -9.81);
  system.now.position[0] = Record(0, 0, 3);
  system.now.velocity[0] = Record(0, 0, 2);
  const auto integrator = scheme("symplectic").make({});
  const double dt = 1e-3;
  for (int n = 1; n <= 2000; ++n) {
    system.step(*integrator, (n - 1) * dt, dt);
    EXPECT_NEAR(system.now.position[0].z, 3 + n * dt * 2 - 9.81 * dt * dt * (n * (n + 1.0) / 2), 1e-12);
    EXPECT_NEAR(system.now.velocity[0].z, 2 - 9.81 * n * dt, 1e-12);
  }
}

TEST(Schemes, of_order_two_and_more_fall_exactly) {
  for (const Scheme& each : all_schemes()) {
    if (each.order < 2) continue;
    Oscillators system({Oscillators::Mode{}});
    system.gravity = Record(0, 0, -9.81);
    system.now.velocity[0] = Record(1, 0, 2);
    const auto integrator = each.make({});
    for (int n = 0; n < 1000; ++n) system.step(*integrator, n * 1e-3, 1e-3);
    EXPECT_NEAR((system.now.position[0].vec() - Vec3(1, 0, 2 - 9.81 / 2)).norm(), 0, 1e-12) << each.name;
  }
}

TEST(Schemes, reach_their_order) {
  for (const Scheme& each : steady_schemes())
    EXPECT_NEAR(observed_order(each, {omega, 0, 0}), each.order, 0.1) << each.name;
}

TEST(Schemes, keep_their_order_with_damping) {
  for (const Scheme& each : steady_schemes()) {
    EXPECT_NEAR(observed_order(each, {omega, 0.2 * omega, 0}), each.order, 0.1)
        << each.name << ", damped springs";
    EXPECT_NEAR(observed_order(each, {omega, 0, 0.2 * omega}), each.order, 0.1) << each.name << ", viscosity";
  }
}

TEST(Schemes, take_damping_of_springs_and_viscosity_for_the_same) {
  for (const Scheme& each : marching_schemes())
    EXPECT_NEAR(reached(each, {omega, 3, 0}, 1, 400).x, reached(each, {omega, 1, 2}, 1, 400).x, 1e-12)
        << each.name;
}

TEST(Schemes, evaluate_forces_as_often_as_they_say) {
  for (const Scheme& each : explicit_schemes()) {
    Oscillators system({{omega, 0, 0}});
    system.step(*each.make({}), 0, 1e-3);
    EXPECT_EQ(system.evaluations, each.evaluations) << each.name;
  }
}

TEST(Schemes, find_their_names) {
  for (const Scheme& each : all_schemes()) EXPECT_EQ(find_scheme(each.name)->what, each.what);
  EXPECT_EQ(find_scheme("Verlet"), nullptr);
  EXPECT_EQ(find_scheme(""), nullptr);
}

// With many vertices, states are written by non-temporal stores: the values must be the same.
TEST(Schemes, step_many_vertices_as_they_step_one) {
  constexpr std::size_t many = 200001;
  for (const Scheme& each : marching_schemes()) {
    Oscillators one({{omega, 1, 2}}), all(std::vector<Oscillators::Mode>(many, {omega, 1, 2}));
    one.now.position[0] = Record(1, 2, 3);
    one.now.velocity[0] = Record(-1, 0, 4);
    std::fill(all.now.position.begin(), all.now.position.end(), one.now.position[0]);
    std::fill(all.now.velocity.begin(), all.now.velocity.end(), one.now.velocity[0]);
    const auto a = each.make({}), b = each.make({});
    for (int n = 0; n < 2; ++n) {
      one.step(*a, n * 1e-3, 1e-3);
      all.step(*b, n * 1e-3, 1e-3);
    }
    EXPECT_TRUE(all.now.finite());
    for (std::size_t n : {std::size_t{0}, many / 2, many - 1}) {
      EXPECT_EQ(all.now.position[n].vec(), one.now.position[0].vec()) << each.name;
      EXPECT_EQ(all.now.velocity[n].vec(), one.now.velocity[0].vec()) << each.name;
    }
  }
}

// The modified energy ½(v² + ω²x²) − ½ω² dt x v, with the velocity updated first (tests/README.md, "Closed
// forms").
TEST(SymplecticEuler, keeps_its_invariant) {
  const double dt = 1.9 / omega; // just below the limit of stability
  Oscillators system({{omega, 0, 0}});
  system.now.position[0] = Record(1, 0, 0);
  system.now.velocity[0] = Record(0.7, 0, 0);
  const auto integrator = scheme("symplectic").make({});
  const auto invariant = [&] {
    const double x = system.now.position[0].x, v = system.now.velocity[0].x;
    return 0.5 * (v * v + omega * omega * x * x) - 0.5 * omega * omega * dt * x * v;
  };
  const double start = invariant();
  for (int n = 0; n < 100000; ++n) system.step(*integrator, n * dt, dt);
  EXPECT_NEAR(invariant(), start, 1e-9 * start);
}

// The numerical frequency is (2/dt) asin(ω dt/2): after the corresponding number of steps the oscillator is
// back at its start.
TEST(SymplecticEuler, oscillates_a_little_faster) {
  const int steps = 12;
  const double dt = 2 / omega * std::sin(pi / steps);
  Oscillators system({{omega, 0, 0}});
  system.now.position[0] = Record(1, 0, 0);
  system.now.velocity[0] = Record(0.7, 0, 0);
  const auto integrator = scheme("symplectic").make({});
  for (int n = 0; n < 10 * steps; ++n) system.step(*integrator, n * dt, dt);
  EXPECT_NEAR(system.now.position[0].x, 1, 1e-12);
  EXPECT_NEAR(system.now.velocity[0].x, 0.7, 1e-11);
}

TEST(Stability, ends_where_theory_has_it_without_damping) {
  const Oscillators::Mode mode{omega, 0, 0};
  EXPECT_NEAR(bisected_limit(scheme("symplectic"), mode), 2 / omega, 0.01 * 2 / omega);
  EXPECT_NEAR(bisected_limit(scheme("verlet"), mode), 2 / omega, 0.01 * 2 / omega);
  EXPECT_NEAR(bisected_limit(scheme("rk4"), mode), 2 * std::sqrt(2.0) / omega, 0.01 * 2 / omega);
  for (const char* name : {"explicit", "midpoint"}) {
    EXPECT_GT(growth(scheme(name), mode, 0.05 / omega), 1 + 1e-7) << name;
    EXPECT_EQ(scheme(name).limit(bounds_of(mode)), 0) << name;
  }
}

TEST(Stability, ends_where_theory_has_it_with_damping) {
  for (const double xi : {0.05, 0.3, 0.9}) {
    const Oscillators::Mode mode{omega, xi * omega, 0};
    const double symplectic = 2 / omega * (std::sqrt(1 + xi * xi) - xi);
    EXPECT_NEAR(bisected_limit(scheme("symplectic"), mode), symplectic, 0.01 * symplectic) << xi;
    EXPECT_NEAR(limit_symplectic(bounds_of(mode)), symplectic, 1e-12 * symplectic) << xi;
    EXPECT_NEAR(bisected_limit(scheme("explicit"), mode), 2 * xi / omega, 0.01 * 2 * xi / omega) << xi;
  }
  EXPECT_NEAR(bisected_limit(scheme("rk4"), {omega, 0.5 * omega, 0}), 2.62 / omega, 0.01 * 2.62 / omega);
}

// step="auto" relies on this: the limit never exceeds the true one, and is not far below it. The largest
// distance is that of RK4: its limit has the form of the symplectic one, and is 0.39 of the true one at ξ = 1
// (0.92 at ξ = 0, 0.93 at large ξ).
TEST(Stability, limits_are_safe_and_not_far_below_the_true_ones) {
  for (const Scheme& each : limited_schemes()) {
    double worst = 1;
    for (const double xi : {0.0, 0.001, 0.01, 0.1, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 5.0, 50.0}) {
      const Oscillators::Mode mode{omega, 0, xi * omega};
      const double limit = each.limit(bounds_of(mode)), bisected = bisected_limit(each, mode);
      EXPECT_LE(limit, bisected * (1 + 1e-6)) << each.name << ", xi " << xi;
      if (limit > 0) worst = std::min(worst, limit / bisected);
    }
    EXPECT_GE(worst, each.name == "rk4" ? 0.385 : 0.4999) << each.name;
    RecordProperty(each.name, std::to_string(worst));
  }
}

// The bounds on ω and on damping may come from different modes: every mode within them must be stable at the
// limit.
TEST(Stability, holds_for_all_modes_within_the_bounds) {
  for (const Scheme& each : limited_schemes()) {
    for (const double least : {0.0, 0.2, 3.0, 40.0}) {
      for (const double most : {least, least + 1, least + 10, least + 200}) {
        const double limit = each.limit({omega * omega, 2 * most, 2 * least});
        if (limit == 0) continue;
        for (int i = 0; i <= 20; ++i)
          for (int j = 0; j <= 20; ++j) {
            const Oscillators::Mode mode{omega * i / 20, (most - least) * j / 20, least};
            EXPECT_LE(growth(each, mode, limit * (1 - 1e-9)), 1 + 1e-9)
                << each.name << ", omega " << mode.omega << ", d " << mode.d + mode.drag << " of " << least
                << " to " << most;
          }
      }
    }
  }
}

TEST(Stability, has_no_limit_where_nothing_acts) {
  for (const Scheme& each : all_schemes()) EXPECT_TRUE(std::isinf(each.limit({}))) << each.name;
}

// (x', v') from (x, v) by v' = (v − h ω² x)/(1 + h² ω²): the amplitude, √(ω²x² + v²), shrinks by 1/√(1 + ω²h²).
TEST(ImplicitEuler, damps_an_oscillator_as_the_formula_says) {
  for (const double h : {1e-4, 1e-2, 1.0, 1e3}) {
    Oscillators system({{omega, 0, 0}});
    system.now.position[0] = Record(1, 0, 0);
    system.now.velocity[0] = Record(0.7, 0, 0);
    const auto integrator = scheme("implicit").make({});
    const auto amplitude = [&] {
      return std::hypot(omega * system.now.position[0].x, system.now.velocity[0].x);
    };
    for (int n = 0; n < 20; ++n) {
      const double before = amplitude();
      system.step(*integrator, n * h, h);
      EXPECT_NEAR(amplitude(), before / std::sqrt(1 + omega * omega * h * h), 1e-11 * before) << h;
    }
    EXPECT_EQ(integrator->solver().newton, 20);
  }
}

// Prescribed vertices: a scheme must set them wherever it evaluates forces, and at the end.
TEST(Schemes, evaluate_forces_on_prescribed_vertices_where_they_then_are) {
  struct Driven final : System {
    std::vector<double> inverse{1.0};
    double worst = 0;
    Driven() { inverse_mass = inverse.data(); }
    std::size_t vertices() const override { return 1; }
    void forces(double time, const Record* x, const Record* v, Record* f) override {
      worst = std::max({worst, std::abs(x[0].x - std::sin(time)), std::abs(v[0].x - std::cos(time))});
      f[0] = Record(1e6, 0, 0);
    }
    void constrain(double time, Record* x, Record* v) override {
      x[0] = Record(std::sin(time), 0, 0);
      v[0] = Record(std::cos(time), 0, 0);
    }
  };
  for (const Scheme& each : explicit_schemes()) {
    Driven system;
    State now, next;
    now.resize(1);
    next.resize(1);
    system.constrain(0, now.position.data(), now.velocity.data());
    const auto integrator = each.make({});
    std::vector<Record> force(1);
    for (int n = 0; n < 10; ++n) {
      system.forces(n * 0.1, now.position.data(), now.velocity.data(), force.data());
      integrator->advance(system, n * 0.1, 0.1, {now.position.data(), now.velocity.data()}, force.data(), next);
      std::swap(now, next);
      EXPECT_NEAR(now.position[0].x, std::sin((n + 1) * 0.1), 1e-15) << each.name;
      EXPECT_NEAR(now.velocity[0].x, std::cos((n + 1) * 0.1), 1e-15) << each.name;
    }
    EXPECT_LT(system.worst, 1e-15) << each.name;
  }
}

TEST(State, knows_whether_it_is_finite) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf})
    for (int place = 0; place < 6; ++place) {
      State state;
      state.resize(3);
      std::array<double, 6> value{1, 2, 3, 4, 5, 6};
      const auto put = [&](std::size_t i) {
        state.put(i, load(Record(value[0], value[1], value[2])), load(Record(value[3], value[4], value[5])));
      };
      put(0);
      EXPECT_TRUE(state.finite());
      value[static_cast<std::size_t>(place)] = bad;
      put(1);
      value.fill(1);
      put(2);
      EXPECT_FALSE(state.finite()) << bad << " at " << place;
    }
}

} // namespace
} // namespace rend::integrator_test
