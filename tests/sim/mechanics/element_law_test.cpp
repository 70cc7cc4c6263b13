// The laws of single elements against finite differences, closed forms and brute force.
#include "sim/mechanics/element_law.h"

#include "sim/elements.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <gtest/gtest.h>

namespace rend::element_law_test {
namespace {

using namespace elements;
using Eigen::Matrix3d;

// −∂f/∂x or −∂f/∂v by central differences.
Eigen::MatrixXd differences(Element& e, std::vector<Vec3>& of) {
  const auto size = static_cast<Eigen::Index>(3 * e.corners());
  Eigen::MatrixXd K(size, size);
  const double h = 1e-6;
  for (Eigen::Index column = 0; column < size; ++column) {
    double& x = of[static_cast<std::size_t>(column / 3)][column % 3];
    const double at = x;
    x = at + h;
    const std::vector<Vec3> ahead = e.forces();
    x = at - h;
    const std::vector<Vec3> behind = e.forces();
    x = at;
    for (Eigen::Index n = 0; n < size / 3; ++n) {
      const auto m = static_cast<std::size_t>(n);
      K.block<3, 1>(3 * n, column) = (behind[m] - ahead[m]) / (2 * h);
    }
  }
  return K;
}

TEST(ElementLaw, exact_stiffness_is_that_of_differences) {
  for_each_element(0.15, 0.02, [](Element e, const std::string& name) {
    SCOPED_TRACE(name);
    Noise noise(4);
    e.turn(random_rotation(noise));
    e.shake(0.2, 6);
    UnitMatrix by_position, by_velocity;
    e.law->stiffness(e.unit.data(), e.state(), Tangent::Exact, by_position, by_velocity);
    const double scale = by_position.norm();
    EXPECT_LT((differences(e, e.x) - by_position).norm(), 1e-7 * scale);
    EXPECT_LT((differences(e, e.v) - by_velocity).norm(), 1e-7 * scale);
  });
}

TEST(ElementLaw, definite_stiffness_is_symmetric_without_negative_eigenvalue) {
  for_each_element(0.15, 0.02, [](Element e, const std::string& name) {
    SCOPED_TRACE(name);
    e.shake(0.9, 6);
    UnitMatrix K, by_velocity;
    e.law->stiffness(e.unit.data(), e.state(), Tangent::SemiDefinite, K, by_velocity);
    EXPECT_LT((K - K.transpose()).norm(), 1e-13 * K.norm());
    const Eigen::MatrixXd dense = K;
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues();
    EXPECT_GT(values[0], -1e-12 * values[values.size() - 1]);
    EXPECT_LT((by_velocity - 0.02 * K).norm(), 1e-14 * K.norm());
  });
}

TEST(ElementLaw, forces_sum_to_zero_and_so_do_moments_where_they_must) {
  for_each_element(0.15, 0, [](Element e, const std::string& name) {
    SCOPED_TRACE(name);
    e.shake(0.4, 7);
    const std::vector<Vec3> f = e.forces();
    Vec3 sum = Vec3::Zero(), moment = sum, rest_moment = sum;
    for (std::size_t n = 0; n < f.size(); ++n) {
      sum += f[n];
      moment += e.x[n].cross(f[n]);
      rest_moment += e.rest[n].cross(f[n]);
    }
    EXPECT_GT(largest(f), 0.01);
    EXPECT_LT(sum.norm(), 1e-12 * largest(f));
    if (e.law->model() == ElasticModel::Linear) {
      EXPECT_LT(rest_moment.norm(), 1e-12 * largest(f));
    } else {
      EXPECT_LT(moment.norm(), 1e-12 * largest(f));
    }
  });
}

TEST(ElementLaw, a_rigid_motion_gives_no_corotational_force) {
  for_each_element(0.15, 0, [](Element e, const std::string& name) {
    if (e.law->model() == ElasticModel::Linear) return;
    SCOPED_TRACE(name);
    Noise noise(3);
    std::vector<Matrix3d> turns;
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 2, 3).normalized()})
      turns.push_back(2 * axis * axis.transpose() - Matrix3d::Identity()); // by 180°
    for (int n = 0; n < 10; ++n) turns.push_back(random_rotation(noise));
    for (const Matrix3d& R : turns) {
      e.x = e.rest;
      e.turn(R);
      for (Vec3& x : e.x) x += Vec3(3, -2, 1);
      EXPECT_LT(largest(e.forces()), 1e-12 * 100);
    }
  });
}

TEST(ElementLaw, a_warped_quad_is_at_rest_where_it_rests) {
  for (const Model& model : every_model()) {
    std::vector<Vec3> corners = distorted(ElementKind::Quad, 0.15, 3);
    corners[1] += Vec3(0.1, 0.2, 0.3);
    Element e(ElementKind::Quad, model, corners);
    EXPECT_LT(largest(e.forces()), 1e-13 * 100) << model.name;
    if (model.model == ElasticModel::Linear) continue;
    Noise noise(3);
    e.turn(random_rotation(noise));
    EXPECT_LT(largest(e.forces()), 1e-12 * 100) << model.name;
  }
}

// F = Q (I + E) everywhere: σ = Q (λ tr E + 2μ E) Qᵀ, and the energy is that of a constant strain.
TEST(ElementLaw, a_uniform_strain_gives_the_stress_of_the_closed_form_in_every_distorted_element) {
  for (ElementKind kind : every_kind) {
    for (const Model& model : every_model()) {
      for (unsigned seed = 1; seed < 5; ++seed) {
        SCOPED_TRACE(shape_of(kind).name + ", " + model.name);
        Element e(kind, model, distorted(kind, 0.15, seed), 0, 0.25);
        Noise noise(seed);
        const bool sheet = shape_of(kind).dimension == 2;
        Matrix3d E;
        E << 2, 1, 1, 1, 2, 1, 1, 1, 2;
        E *= 0.5e-3;
        Matrix3d plane = Matrix3d::Identity(); // projection onto that of a sheet
        if (sheet) {
          const Vec3 n = (e.rest[1] - e.rest[0]).cross(e.rest[2] - e.rest[0]).normalized();
          plane -= n * n.transpose();
          E = plane * E * plane;
        }
        Matrix3d Q = random_rotation(noise);
        if (model.model == ElasticModel::Linear) Q.setIdentity();
        if (model.rotation == Rotation::Qr) Q.setIdentity(), E.setZero(); // its frame is not the rotation of F
        for (std::size_t n = 0; n < e.corners(); ++n) e.x[n] = Q * (e.rest[n] + E * e.rest[n]);
        const ElasticMaterial& m = e.law->material();
        const Matrix3d sigma = m.lambda * E.trace() * plane + 2 * m.mu * E;
        EXPECT_LT((e.law->stress(e.unit.data(), e.state()) - Q * sigma * Q.transpose()).norm(), 1e-10 * 100);
        EXPECT_LT((e.law->strain(e.unit.data(), e.state()) - Q * E * Q.transpose()).norm(), 1e-12);
        double volume = 0;
        const int stride = shape_of(kind).dimension * shape_of(kind).dimension + 1;
        for (std::size_t g = 1; g <= shape_of(kind).points.size(); ++g)
          volume +=
              e.unit[static_cast<std::size_t>(e.law->first_point() - 1) + g * static_cast<std::size_t>(stride)];
        EXPECT_NEAR(e.energy(), 0.5 * volume * sigma.cwiseProduct(E).sum(), 1e-10 * (1e-12 + e.energy()));
      }
    }
  }
}

TEST(ElementLaw,
     plane_stress_is_the_one_of_the_patch_test) { // E = 1e6, ν = 0.25, u = 1e-3 (x + y/2), v = 1e-3 (y + x/2)
  const ElasticMaterial m = ElasticMaterial::of(1e6, 0.25, 2);
  EXPECT_NEAR(m.lambda * 2e-3 + 2 * m.mu * 1e-3, 1333.3333333333333, 1e-9);
  EXPECT_NEAR(2 * m.mu * 0.5e-3, 400, 1e-9);
  const ElasticMaterial solid = ElasticMaterial::of(1e6, 0.25, 3);
  EXPECT_NEAR(solid.lambda * 3e-3 + 2 * solid.mu * 1e-3, 2000, 1e-9);
}

// The same element with its corners permuted by a symmetry of its shape.
std::vector<std::size_t> renamed(ElementKind kind) {
  switch (kind) {
  case ElementKind::Triangle:
    return {1, 2, 0};
  case ElementKind::Quad:
    return {2, 1, 0, 3};
  case ElementKind::Tetrahedron:
    return {2, 0, 1, 3};
  case ElementKind::Hexahedron:
    return {5, 1, 2, 6, 4, 0, 3, 7};
  case ElementKind::Prism:
    return {4, 3, 5, 1, 0, 2};
  case ElementKind::Pyramid:
    return {1, 2, 3, 0, 4};
  }
  return {};
}

TEST(ElementLaw, polar_does_not_depend_on_the_order_of_corners) {
  for (ElementKind kind : every_kind) {
    SCOPED_TRACE(shape_of(kind).name);
    const std::vector<Vec3> rest = distorted(kind, 0.15, 5);
    const std::vector<std::size_t> order = renamed(kind);
    std::vector<Vec3> other_rest;
    for (std::size_t n : order) other_rest.push_back(rest[n]);
    Element one(kind, every_model()[2], rest), two(kind, every_model()[2], other_rest);
    one.shake(0.4, 3);
    for (std::size_t n = 0; n < order.size(); ++n) two.x[n] = one.x[order[n]];
    const std::vector<Vec3> f = one.forces(), g = two.forces();
    for (std::size_t n = 0; n < order.size(); ++n) EXPECT_LT((g[n] - f[order[n]]).norm(), 1e-11 * largest(f));
  }
}

// Highest eigenvalue of M^(−1/2) K M^(−1/2) at rest.
double brute_frequency(const Element& e, const std::vector<double>& mass) {
  UnitMatrix K, by_velocity;
  e.law->stiffness(e.unit.data(), e.state(), Tangent::SemiDefinite, K, by_velocity);
  Eigen::MatrixXd scaled = K;
  for (Eigen::Index r = 0; r < K.rows(); ++r)
    for (Eigen::Index c = 0; c < K.cols(); ++c)
      scaled(r, c) /= std::sqrt(mass[static_cast<std::size_t>(r / 3)] * mass[static_cast<std::size_t>(c / 3)]);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled).eigenvalues().maxCoeff();
}

TEST(ElementLaw, the_bound_is_the_frequency_of_the_element_itself) {
  for_each_element(0.15, 0.03, [](const Element& e, const std::string& name) {
    SCOPED_TRACE(name);
    Noise noise(2);
    std::vector<double> mass, s(e.corners()), d(e.corners());
    for (std::size_t n = 0; n < e.corners(); ++n) mass.push_back(1.5 + noise());
    e.law->bound(e.unit.data(), e.rest.data(), mass.data(), s.data(), d.data());
    const double square = brute_frequency(e, mass);
    for (std::size_t n = 0; n < e.corners(); ++n) {
      EXPECT_LT(square, (1 + 1e-10) * s[n] / mass[n]);
      if (e.law->formulation() == Formulation::Plain) {
        EXPECT_NEAR(s[n] / mass[n], square, 1e-10 * square);
      }
      EXPECT_NEAR(d[n], 0.03 * s[n], 1e-12 * s[n]);
    }
  });
}

// All distances between corners, relative to those at rest.
double strain_of_distances(const Element& e) {
  double most = 0;
  for (std::size_t n = 0; n < e.corners(); ++n)
    for (std::size_t m = 0; m < n; ++m)
      most = std::max(most, std::abs((e.x[n] - e.x[m]).norm() / (e.rest[n] - e.rest[m]).norm() - 1));
  return most;
}

void relax(Element& e) {
  std::vector<double> mass(e.corners(), 1), s(e.corners()), d(e.corners());
  e.law->bound(e.unit.data(), e.rest.data(), mass.data(), s.data(), d.data());
  for (int step = 0; step < 4000; ++step) {
    const std::vector<Vec3> f = e.forces();
    for (std::size_t n = 0; n < e.corners(); ++n) {
      ASSERT_TRUE(f[n].allFinite());
      e.x[n] += f[n] / s[0];
    }
  }
}

TEST(ElementLaw, flat_collapsed_and_inverted_elements_come_back_to_rest) {
  for_each_element(0.1, 0, [](const Element& start, const std::string& name) {
    if (start.law->model() == ElasticModel::Linear) return;
    for (const Vec3& scale : {Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 0), Vec3(1, 1, -1), Vec3(-1, -1, -1),
                              Vec3(1e-9, 1, 1), Vec3(-2, 0.7, 1)}) {
      SCOPED_TRACE(name);
      SCOPED_TRACE(scale.transpose());
      Element e = start;
      for (std::size_t n = 0; n < e.corners(); ++n) e.x[n] = scale.cwiseProduct(e.rest[n]);
      relax(e);
      EXPECT_LT(strain_of_distances(e), 1e-6);
    }
    Element pushed = start; // moves the last corner through the others
    pushed.x.back() += 4 * (pushed.x.front() - pushed.x.back());
    relax(pushed);
    if (start.law->shape().kind == ElementKind::Quad) { // it bends freely: its diagonals may become shorter
      EXPECT_LT(strain_of_distances(pushed), 1e-2) << name;
      EXPECT_LT(largest(pushed.forces()), 1e-4) << name;
      return;
    }
    EXPECT_LT(strain_of_distances(pushed), 1e-6) << name;
  });
}

TEST(ElementLaw, an_element_without_volume_is_refused) {
  for (ElementKind kind : every_kind) {
    std::vector<Vec3> flat = regular(kind);
    for (Vec3& x : flat) (shape_of(kind).dimension == 2 ? x.y() : x.z()) = 0;
    EXPECT_TRUE(Element(kind, every_model()[2], flat).unit.empty()) << shape_of(kind).name;
  }
  std::vector<Vec3> folded = regular(ElementKind::Hexahedron);
  folded[6] = Vec3(-1, -1, -1);
  EXPECT_TRUE(Element(ElementKind::Hexahedron, every_model()[2], folded).unit.empty());
}

} // namespace
} // namespace rend::element_law_test
