// TR-BDF2 and generalised-α against their own equations, solved here by other means, and on stiff systems.
#include "sim/integrate/oscillators.h"

#include "sim/base/math.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>

namespace rend::second_order_test {
namespace {

constexpr double omega = 17; // [rad/s]

const Scheme& scheme(const std::string& name) {
  return *find_scheme(name);
}

// One free coordinate x, its velocity and its acceleration.
using Motion = Eigen::Vector3d;

Motion stepped(Integrator& integrator, const Oscillators::Mode& mode, const Motion& from, double h) {
  Oscillators system({mode});
  system.now.accelerates = true;
  system.now.resize(1);
  system.now.position[0] = Record(from[0], 1, 0); // y: so that the state has a size, wherever x is
  system.now.velocity[0] = Record(from[1], 0, 0);
  system.now.acceleration[0] = Record(from[2], 0, 0);
  system.step(integrator, 0, h);
  return {system.now.position[0].x, system.now.velocity[0].x,
          system.now.accelerates ? system.now.acceleration[0].x : 0};
}

// ωx + iv of an undamped oscillator is multiplied by R(−iωh) in each step.
std::complex<double> factor_of_tr_bdf2(double angle) {
  const double gamma = 2 - std::sqrt(2.0);
  const std::complex<double> z(0, -angle), whole = 1.0 - 0.5 * gamma * z;
  return (1.0 + (1 - gamma) * z) / (whole * whole);
}

TEST(TrBdf2, multiplies_an_oscillation_by_the_factor_of_the_formula) {
  for (const double h : {1e-4, 1e-2, 0.1, 1.0, 1e3}) {
    const auto integrator = scheme("tr-bdf2").make({});
    Motion now(1, 0.7, 0);
    for (int n = 0; n < 5; ++n) {
      const std::complex<double> expected =
          factor_of_tr_bdf2(omega * h) * std::complex<double>(omega * now[0], now[1]);
      const double size = std::hypot(omega * now[0], now[1]);
      now = stepped(*integrator, {omega, 0, 0}, now, h);
      EXPECT_NEAR(omega * now[0], expected.real(), 1e-11 * size) << h;
      EXPECT_NEAR(now[1], expected.imag(), 1e-11 * size) << h;
    }
  }
}

// A step turns by 0.0404 (ωh)³ too little: the error constant of TR-BDF2 is (3γ² − 4γ + 2)/(12 (2 − γ)).
// Of the amplitude it loses (γ/2)⁴/2 (ωh)⁴.
TEST(TrBdf2, has_its_error_constant) {
  const double gamma = 2 - std::sqrt(2.0);
  const double constant = (3 * gamma * gamma - 4 * gamma + 2) / (12 * (2 - gamma));
  const auto after = [](double angle) {
    return stepped(*scheme("tr-bdf2").make({}), {omega, 0, 0}, {1, 0, 0}, angle / omega);
  };
  const Motion fine = after(0.02), rough = after(0.2);
  EXPECT_NEAR((0.02 - std::atan2(-fine[1], omega * fine[0])) / std::pow(0.02, 3), constant, 0.01 * constant);
  const double lost = 0.5 * std::pow(gamma / 2, 4) * std::pow(0.2, 4);
  EXPECT_NEAR(1 - std::hypot(omega * rough[0], rough[1]) / omega, lost, 0.02 * lost);
}

TEST(TrBdf2, leaves_nothing_in_one_step_of_what_is_too_fast_for_it) {
  for (const double angle : {1e4, 1e6, 1e8}) {
    const Motion now = stepped(*scheme("tr-bdf2").make({}), {omega, 0, 0}, {1, 0.7, 0}, angle / omega);
    EXPECT_LT(std::hypot(omega * now[0], now[1]), 10 * omega / angle);
  }
}

// Chung and Hulbert's equations as they stand, for x', v', a' of a damped oscillator.
Motion by_their_equations(const Motion& now, double rho, double d, double h) {
  const double m = (2 * rho - 1) / (rho + 1), f = rho / (rho + 1), gamma = 0.5 - m + f,
               beta = 0.25 * (1 - m + f) * (1 - m + f), w2 = omega * omega;
  Eigen::Matrix3d A;
  A << 1, 0, -h * h * beta, 0, 1, -h * gamma, (1 - f) * w2, (1 - f) * 2 * d, 1 - m;
  const Eigen::Vector3d b(now[0] + h * now[1] + h * h * (0.5 - beta) * now[2],
                          now[1] + h * (1 - gamma) * now[2], -m * now[2] - f * (w2 * now[0] + 2 * d * now[1]));
  return A.colPivHouseholderQr().solve(b);
}

TEST(GeneralisedAlpha, solves_the_equations_that_define_it) {
  for (const double rho : {0.0, 0.5, 0.8, 1.0})
    for (const double d : {0.0, 2.0})
      for (const double h : {1e-3, 1e-2, 0.3}) {
        const auto integrator = scheme("alpha").make({.rho_infinity = rho});
        Motion now(1, 0.7, -omega * omega - 2 * d * 0.7), expected = now;
        for (int n = 0; n < 5; ++n) {
          expected = by_their_equations(expected, rho, d, h);
          now = stepped(*integrator, {omega, d, 0}, now, h);
          EXPECT_NEAR(now[0], expected[0], 1e-10) << rho << ' ' << d << ' ' << h;
          EXPECT_NEAR(now[1], expected[1], 1e-10 * omega);
          EXPECT_NEAR(now[2], expected[2], 1e-10 * omega * omega);
        }
      }
}

// The spectral radius of the scheme's own steps; states without an acceleration would begin with one.
double radius_of_alpha(double rho, double angle) {
  const auto integrator = scheme("alpha").make({.rho_infinity = rho});
  const double h = angle / omega;
  const auto image = [&](const Motion& from) { return stepped(*integrator, {omega, 0, 0}, from, h); };
  const double a = 1 / (h * h), v = 1 / h; // so that all have the size of a length
  const Motion third = image({0, 0, a});
  Eigen::Matrix3d step;
  step << image({1, 0, a}) - third, image({0, v, a}) - third, third;
  const Eigen::Vector3d scale(1, h, h * h);
  const Eigen::Matrix3d scaled = scale.asDiagonal() * step;
  return scaled.eigenvalues().cwiseAbs().maxCoeff();
}

TEST(GeneralisedAlpha, leaves_rho_infinity_of_what_is_too_fast_and_all_of_what_is_slow) {
  for (const double rho : {0.0, 0.3, 0.8, 1.0}) {
    EXPECT_NEAR(radius_of_alpha(rho, 1e5), rho, 2e-3);
    EXPECT_NEAR(radius_of_alpha(rho, 1e-2), 1, 1e-6);
    for (const double angle : {0.1, 1.0, 10.0, 100.0}) EXPECT_LT(radius_of_alpha(rho, angle), 1 + 1e-7);
  }
}

// What it began with is forgotten: a state without an acceleration takes that of the forces.
TEST(GeneralisedAlpha, begins_with_the_acceleration_of_the_forces) {
  const Motion with(1, 0.7, -omega * omega), without(1, 0.7, 0);
  const auto one = scheme("alpha").make({}), other = scheme("alpha").make({});
  EXPECT_EQ(stepped(*one, {omega, 0, 0}, with, 0.01), stepped(*other, {omega, 0, 0}, without, 0.01));
}

// A mass of 1 kg on a spring of length 1 m, about the origin.
class Pendulum final : public System {
public:
  explicit Pendulum(double k) : k_(k) {
    inverse_mass = &one_;
    gravity = Record(0, 0, -9.81);
    pattern_ = std::make_shared<const BlockPattern>(BlockPattern::of({0, 0}, {}));
  }
  std::size_t vertices() const override { return 1; }
  void forces(double, const Record* x, const Record*, Record* f) override {
    const double length = x[0].vec().norm();
    f[0] = Record(Vec3(-k_ * (length - 1) / length * x[0].vec()));
  }
  void constrain(double, Record*, Record*) override {}
  std::shared_ptr<const BlockPattern> pattern() override { return pattern_; }
  void add_stiffness(const Record* x, const Record*, Tangent, double by_position, double,
                     BlockMatrix& out) override {
    const double length = x[0].vec().norm();
    const Eigen::Matrix3d along = x[0].vec() * x[0].vec().transpose() / (length * length);
    const double sideways = std::max(0.0, k_ * (length - 1) / length);
    const Eigen::Matrix3d K = k_ * along + sideways * (Eigen::Matrix3d::Identity() - along);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) out.at(0)(r, c) += by_position * K(r, c);
  }

private:
  double k_, one_ = 1;
  std::shared_ptr<const BlockPattern> pattern_;
};

// Time [s] at which x passes 0 for the last time of `passes`; the length stays within 1e-3 of that at rest.
double time_of_passes(const Scheme& each, double k, double h, int passes) {
  Pendulum system(k);
  State now, next;
  now.resize(1);
  next.resize(1);
  const double angle = 0.1;
  now.position[0] = Record(std::sin(angle), 0, -std::cos(angle));
  const auto integrator = each.make({});
  Record force;
  for (int n = 0; n < 100000; ++n) {
    system.forces(n * h, now.position.data(), now.velocity.data(), &force);
    next.probe = Double4{};
    integrator->advance(system, n * h, h, now.view(), &force, next);
    EXPECT_NEAR(next.position[0].vec().norm(), 1, 1e-3);
    const double a = now.position[0].x, b = next.position[0].x;
    std::swap(now, next);
    next.resize(1);
    if ((a > 0) != (b > 0) && --passes == 0) return (n + a / (a - b)) * h;
  }
  return -1;
}

// The spring turns by 1000 radians and more in a step; the period is that of the rigid one,
// 2π √(L/g) (1 + θ²/16).
TEST(SecondOrder, swings_a_stiff_pendulum_with_its_period) {
  const double period = 2 * pi / std::sqrt(9.81) * (1 + 0.01 / 16);
  for (const char* name : {"tr-bdf2", "alpha"}) {
    const double rough = time_of_passes(scheme(name), 1e10, 0.02, 9) - 4.25 * period;
    const double fine = time_of_passes(scheme(name), 1e10, 0.01, 9) - 4.25 * period;
    EXPECT_LT(std::abs(rough), 1e-3 * 4.25 * period) << name;
    EXPECT_NEAR(rough / fine, 4, 0.6) << name; // of order 2, stiff as it is
  }
}

} // namespace
} // namespace rend::second_order_test
