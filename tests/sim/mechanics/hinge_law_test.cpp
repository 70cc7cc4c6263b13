#include "sim/mechanics/hinge_law.h"

#include "sim/base/math.h"
#include "sim/presets.h"
#include "sim/random_meshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rend::hinge_law_test {
namespace {

using meshes::Noise;

constexpr HingeParameters stiff{2.0, 0, 0};

// Two triangles at the hinge (0,0,0)-(1,0,0): M1 in the xy plane at y < 0, M2 rotated up by `angle` from flat.
HingePoints folded(double angle) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), m1(0.3, -0.8, 0), m2(0.6, 0.9 * std::cos(angle), 0.9 * std::sin(angle));
  return {a, b, m1, m1, a, b, m2, m2};
}

// Random hinges; the outer vertices of each side are one (triangles) or two (warped quads).
HingePoints random_hinge(Noise& noise, bool triangles) {
  const Vec3 a = noise.vector(), b = a + Vec3(1, 0, 0) + 0.3 * noise.vector();
  const auto outer = [&](double y) { return Vec3(a + Vec3(0.5, y, 0) + 0.4 * noise.vector()); };
  const Vec3 m1 = outer(-1), m2 = triangles ? m1 : outer(-1), m3 = outer(1), m4 = triangles ? m3 : outer(1);
  return {a, b, m1, m2, a, b, m3, m4};
}
HingePoints random_velocities(Noise& noise, bool triangles) {
  const Vec3 a = noise.vector(), b = noise.vector(), m1 = noise.vector(), m3 = noise.vector();
  const Vec3 m2 = triangles ? m1 : noise.vector(), m4 = triangles ? m3 : noise.vector();
  return {a, b, m1, m2, a, b, m3, m4};
}
const HingePoints still = [] {
  HingePoints v;
  v.fill(Vec3::Zero());
  return v;
}();

// Indices of the vertices among the eight points: four for a pair of triangles, six for a pair of quads.
using Places = std::vector<std::vector<std::size_t>>;
const Places of_triangles{{0, 4}, {1, 5}, {2, 3}, {6, 7}};
const Places of_quads{{0, 4}, {1, 5}, {2}, {3}, {6}, {7}};

HingePoints moved(HingePoints x, const std::vector<std::size_t>& vertex, const Vec3& by) {
  for (std::size_t place : vertex) x[place] += by;
  return x;
}
Vec3 at_vertex(const HingePoints& f, const std::vector<std::size_t>& vertex) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t place : vertex) sum += f[place];
  return sum;
}

TEST(Hinge, angle_is_that_between_the_faces_with_its_sign) {
  EXPECT_EQ(hinge_angle(folded(0)), 0);
  for (int n = -179; n <= 180; ++n) {
    const double angle = n * (pi / 180);
    EXPECT_NEAR(std::abs(hinge_angle(folded(angle))), std::abs(angle), 1e-14);
    if (n == 0 || n == 180) continue;
    EXPECT_GT(hinge_angle(folded(angle)) * hinge_angle(folded(0.1)) * angle, 0) << n;
  }
}

TEST(Hinge, angle_changes_sign_with_the_sides_and_with_the_direction) {
  Noise noise(1);
  for (int n = 0; n < 100; ++n) {
    const HingePoints x = random_hinge(noise, false);
    EXPECT_NEAR(hinge_angle({x[4], x[5], x[6], x[7], x[0], x[1], x[2], x[3]}), -hinge_angle(x), 1e-14);
    EXPECT_NEAR(hinge_angle({x[1], x[0], x[3], x[2], x[5], x[4], x[7], x[6]}), -hinge_angle(x), 1e-14);
  }
}

// At the given angle and rest angle: the force against finite differences of the energy.
void expect_gradient(const HingePoints& x, double rest, const Places& vertices) {
  HingeParameters p = stiff;
  p.rest = rest;
  const HingePoints f = hinge_forces(p, x, still);
  constexpr double h = 1e-5;
  double scale = 1e-3;
  for (const Vec3& force : f) scale = std::max(scale, force.norm());
  for (const auto& vertex : vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 by = h * Vec3::Unit(axis);
      const double slope =
          (hinge_energy(p, moved(x, vertex, by)) - hinge_energy(p, moved(x, vertex, -by))) / (2 * h);
      EXPECT_NEAR(at_vertex(f, vertex)[axis], -slope, 1e-7 * scale) << vertex[0] << " " << axis;
    }
  }
}

TEST(Hinge, force_is_minus_the_gradient_of_the_energy_on_triangles) {
  Noise noise(2);
  for (int n = 0; n < 100; ++n) expect_gradient(random_hinge(noise, true), 0.4 * noise(), of_triangles);
  for (double angle : {-3.1, -2.0, -1.0, -0.1, 0.0, 0.3, 1.5, 2.5, 3.1}) {
    for (double rest : {0.0, 0.7, -1.2}) expect_gradient(folded(angle), rest, of_triangles);
  }
}

TEST(Hinge, force_is_minus_the_gradient_of_the_energy_on_warped_quads) {
  Noise noise(6);
  for (int n = 0; n < 100; ++n) expect_gradient(random_hinge(noise, false), 0.4 * noise(), of_quads);
}

TEST(Hinge, force_is_minus_the_gradient_across_the_fold_back) {
  // With a rest angle of 2.9, angles beyond π are negative: the difference from the rest angle is still small.
  for (double angle : {3.0, pi + 0.2, pi + 0.5}) {
    const double sign = hinge_angle(folded(0.1)) > 0 ? 1 : -1;
    expect_gradient(folded(angle), sign * 2.9, of_triangles);
    HingeParameters p = stiff;
    p.rest = sign * 2.9;
    EXPECT_NEAR(hinge_energy(p, folded(angle)), 0.5 * p.k * (angle - 2.9) * (angle - 2.9), 1e-12);
  }
}

TEST(Hinge, turns_back_towards_rest) {
  const HingePoints f = hinge_forces(stiff, folded(0.3), still);
  EXPECT_LT(at_vertex(f, of_triangles[3]).z(), 0); // M2 was rotated up
  EXPECT_GT(hinge_forces(stiff, folded(-0.3), still)[6].z(), 0);
}

TEST(Hinge, conserves_linear_and_angular_momentum_on_warped_quads) {
  Noise noise(3);
  for (int n = 0; n < 400; ++n) {
    const bool triangles = n % 2 == 0;
    const HingePoints x = random_hinge(noise, triangles), v = random_velocities(noise, triangles);
    const HingePoints f = hinge_forces({2, 0.5, 0.3}, x, v);
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    double all = 0, all_moments = 0;
    for (std::size_t p = 0; p < 8; ++p) {
      force += f[p];
      moment += x[p].cross(f[p]);
      all += f[p].norm();
      all_moments += x[p].norm() * f[p].norm();
    }
    EXPECT_LT(force.norm(), 1e-14 * all);
    EXPECT_LT(moment.norm(), 1e-14 * all_moments);
  }
}

TEST(Hinge, conserves_momentum_with_an_outer_vertex_on_the_hinge_line) {
  HingePoints x = folded(0.5);
  x[2] = Vec3(-0.5, 0, 0); // one of the two outer vertices of side one
  const HingePoints f = hinge_forces(stiff, x, still);
  Vec3 moment = Vec3::Zero();
  for (std::size_t p = 0; p < 8; ++p) moment += x[p].cross(f[p]);
  EXPECT_GT(f[6].norm(), 0.1);
  EXPECT_LT(moment.norm(), 1e-14);
  x[3] = Vec3(1.5, 0, 0); // and the other: the side has no area
  for (const Vec3& force : hinge_forces(stiff, x, still)) EXPECT_EQ(force, Vec3(0, 0, 0));
}

TEST(Hinge, without_length_or_area_gives_no_force) {
  HingePoints x = folded(0.4);
  x[1] = x[5] = x[0];
  for (const Vec3& force : hinge_forces({2, 1, 0.1}, x, x)) EXPECT_EQ(force, Vec3(0, 0, 0));
  HingePoints point;
  point.fill(Vec3(1, 2, 3));
  for (const Vec3& force : hinge_forces({2, 1, 0.1}, point, point)) EXPECT_EQ(force, Vec3(0, 0, 0));
}

// A pair of triangles, side two of which has `height` times its height at rest.
HingePoints crushed_to(double height) {
  HingePoints x = folded(0.7);
  x[6] = x[7] = Vec3(0.6, 0, 0) + height * (x[6] - Vec3(0.6, 0, 0));
  return x;
}
HingePoints velocities_of(unsigned seed) {
  Noise noise(seed);
  return random_velocities(noise, true);
}
double largest_of(const HingePoints& f) {
  double most = 0;
  for (const Vec3& force : f) most = std::max(most, force.norm());
  return most;
}

TEST(Hinge, force_is_bounded_however_flat_a_side_is_crushed) {
  const HingePoints v = velocities_of(8);
  const HingeParameters p{2, 0.3, 0.1, hinge_fade_threshold(folded(0))}, damped{0, 0.3, 0.1, p.least};
  const double at_rest = largest_of(hinge_forces(p, crushed_to(1), still));
  const double rate_at_rest = largest_of(hinge_forces(damped, crushed_to(1), v));
  for (double height = 1; height > 1e-170; height *= 0.7) {
    EXPECT_LE(largest_of(hinge_forces(p, crushed_to(height), still)), 8 * at_rest) << height;
    EXPECT_LE(largest_of(hinge_forces(damped, crushed_to(height), v)), 8 * 8 * 2 * rate_at_rest) << height;
  }
  EXPECT_GT(largest_of(hinge_forces(p, crushed_to(0.13), still)), 5 * at_rest);
  EXPECT_LT(largest_of(hinge_forces(p, crushed_to(1e-6), still)), 1e-3 * at_rest); // side two passes through 0
}

TEST(Hinge, force_is_what_it_was_to_the_bit_where_nothing_is_crushed) {
  const double least = hinge_fade_threshold(folded(0));
  const HingePoints v = velocities_of(9);
  for (const double height : {10.0, 1.0, 0.2, 0.112}) {
    const HingePoints x = crushed_to(height), f = hinge_forces({2, 0.3, 0.1, least}, x, v),
                      plain = hinge_forces({2, 0.3, 0.1, 0}, x, v);
    for (std::size_t n = 0; n < 8; ++n) EXPECT_EQ(f[n], plain[n]) << height;
  }
  EXPECT_NE(hinge_forces({2, 0.3, 0.1, least}, crushed_to(0.11), v)[6],
            hinge_forces({2, 0.3, 0.1, 0}, crushed_to(0.11), v)[6]);
}

TEST(Hinge, conserves_momentum_and_dissipates_where_it_is_crushed) {
  Noise noise(10);
  for (int n = 0; n < 200; ++n) {
    const bool triangles = n % 2 == 0;
    const HingePoints x = random_hinge(noise, triangles), v = random_velocities(noise, triangles);
    const HingePoints f = hinge_forces({2, 0.5, 0.3, 4.0}, x, v), drag = hinge_forces({0, 0.5, 0.3, 4.0}, x, v);
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    double power = 0;
    for (std::size_t p = 0; p < 8; ++p) {
      sum += f[p];
      moment += x[p].cross(f[p]);
      power += drag[p].dot(v[p]);
    }
    EXPECT_LT(sum.norm(), 1e-14 * (1 + largest_of(f)));
    EXPECT_LT(moment.norm(), 1e-13 * (1 + largest_of(f)));
    EXPECT_LE(power, 0);
  }
}

TEST(Hinge, damping_dissipates) {
  Noise noise(4);
  for (int n = 0; n < 400; ++n) {
    const HingePoints x = random_hinge(noise, n % 2 == 0), v = random_velocities(noise, n % 2 == 0);
    const HingePoints f = hinge_forces({0, 0.7, 0}, x, v);
    double power = 0;
    for (std::size_t p = 0; p < 8; ++p) power += f[p].dot(v[p]);
    EXPECT_LE(power, 0);
  }
}

TEST(Hinge, damping_rate_is_that_of_the_angle) {
  Noise noise(5);
  for (int n = 0; n < 100; ++n) {
    const HingePoints x = random_hinge(noise, n % 2 == 0), v = random_velocities(noise, n % 2 == 0);
    HingePoints ahead = x, behind = x;
    constexpr double h = 1e-6;
    for (std::size_t p = 0; p < 8; ++p) {
      ahead[p] += h * v[p];
      behind[p] -= h * v[p];
    }
    const double rate = (hinge_angle(ahead) - hinge_angle(behind)) / (2 * h);
    const HingePoints g = hinge_gradient(x);
    double from_gradient = 0;
    for (std::size_t p = 0; p < 8; ++p) from_gradient += g[p].dot(v[p]);
    EXPECT_NEAR(from_gradient, rate, 1e-6 * std::max(1.0, std::abs(rate)));
  }
}

// A ball tears a cloth, whose pieces fall and are crushed: with unbounded forces it was torn to shreds and
// stopped as unstable at 0.95 s.
TEST(Hinge, lets_a_torn_cloth_fall_in_a_heap) {
  const auto s = presets::load(
      R"(<scene><body><sheet pattern="crossed" cells="10 10" size="1 1"/>)"
      R"(<place rotate="90 0 0" translate="-0.5 0 0.35"/><mass total="0.1"/>)"
      R"(<springs young="1e5" poisson="0.3333333333333333" thickness="1e-3"><stretch damping="0.01"/>)"
      R"(<bend kind="angular" k="5e-3" damping="1e-5"/></springs><viscosity value="0.05" per="body"/>)"
      R"(<fix box="-0.51 -1 1.24 -0.39 1 1.36"/><fix box="0.39 -1 1.24 0.51 1 1.36"/>)"
      R"(<tear criterion="global-border" threshold="1" until="0.29" change="separate"/>)"
      R"(<contact with="floor obstacles" thickness="0.004"/></body><world><floor z="0"/>)"
      R"(<sphere centre="0 -1.2 0.72" radius="0.14" velocity="0 5 1.2" mass="0.6"/></world>)"
      R"(<time step="auto" duration="1.2"/></scene>)");
  while (s->time() < 1.2 - 1e-9) s->step();
  EXPECT_GT(s->tears(), 0u);
}

} // namespace
} // namespace rend::hinge_law_test
