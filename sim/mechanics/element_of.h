// The law of element_law.h, with the numbers of corners, rest axes and integration points known at compile
// time: its force, its energy and its two tangents. Only element_law.cpp includes it.
//
// What belongs to corners is an array of vectors, not a matrix of 3 x N: expressions of 3 x 3 and 3 x 1 are
// compiled once, those of 3 x N for each of six kinds, which took a minute.
#pragma once

#include "sim/mechanics/element_law.h"
#include "sim/mechanics/enhanced_modes.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace rend {

// A vector for each corner.
template <int N> using CornerVectors = std::array<Vec3, static_cast<std::size_t>(N)>;

// The sum of term(begin) .. term(end − 1), by halves.
template <int begin, int end> double sum_by_halves(const auto& term) {
  constexpr int middle = begin + (end - begin) / 2;
  if constexpr (end - begin == 1)
    return term(static_cast<std::size_t>(begin));
  else
    return sum_by_halves<begin, middle>(term) + sum_by_halves<middle, end>(term);
}

// Σ a_n b_nᵀ. In the order in which Eigen adds up the product of 3 x N and N x 3: states depend on it.
template <std::size_t N>
Eigen::Matrix3d sum_of_products(const std::array<Vec3, N>& a, const std::array<Vec3, N>& b) {
  Eigen::Matrix3d sum;
  for (int c = 0; c < 3; ++c) {
    Eigen::Vector2d two = a[0].template head<2>() * b[0][c];
    for (std::size_t n = 1; n < N; ++n) two += a[n].template head<2>() * b[n][c];
    sum.col(c).head<2>() = two;
    sum(2, c) = sum_by_halves<0, static_cast<int>(N)>([&](std::size_t n) { return a[n][2] * b[n][c]; });
  }
  return sum;
}

template <std::size_t N>
std::array<Vec3, N> each_times(const Eigen::Matrix3d& matrix, const std::array<Vec3, N>& vectors) {
  std::array<Vec3, N> out;
  for (std::size_t n = 0; n < N; ++n) out[n] = matrix * vectors[n];
  return out;
}

// An element's gradients at one integration point; for a sheet the third coordinate is 0.
template <int N> struct PointOf {
  CornerVectors<N> gradient; // [1/m]
  double weight;             // [m³]
};

template <int N, int Dim, int Points> struct Decoded {
  std::array<PointOf<N>, static_cast<std::size_t>(Points)> points;
  double volume = 0; // [m³]

  Decoded(const ElementShape& shape, const double* values) {
    for (std::size_t g = 0; g < points.size(); ++g, values += Dim * Dim + 1) {
      using Inverse = Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>;
      const Eigen::Map<const Inverse> inverse(values);
      for (std::size_t n = 0; n < N; ++n) {
        points[g].gradient[n].setZero();
        points[g].gradient[n].template head<Dim>() =
            inverse.transpose() *
            Eigen::Map<const Eigen::Matrix<double, Dim, 1>>(shape.points[g].gradient[n].data());
      }
      points[g].weight = values[Dim * Dim];
      volume += points[g].weight;
    }
  }
};

// The law with sizes known at compile time: N corners, Dim rest axes, Points integration points.
template <int N, int Dim, int Points> class ElementOf final : public ElementLaw {
  using Matrix3d = Eigen::Matrix3d;

public:
  ElementOf(ElementKind kind, const ElementSettings& settings, const ElasticMaterial& material)
      : ElementLaw(shape_of(kind), settings, material) {}

  void forces(const double* unit, const UnitState& s, Vec3* force) const override {
    const State at(*this, unit, s);
    const Tensors strain = strains(at, at.moving);
    for (int n = 0; n < N; ++n) force[n].setZero();
    for (std::size_t f = 0; f < frames; ++f) {
      Matrix3d moment = Matrix3d::Zero();
      if (moment_of_frame())
        moment = Turning(*this, at, f, material().damping > 0 ? strains(at, at.x) : strain).moment.Z;
      for (std::size_t g = f; g < end_of(f); ++g) {
        const auto& point = at.element.points[g];
        const Matrix3d stress = point.weight * at.frame(g) * (stress_of(strain[g]) - moment);
        for (std::size_t n = 0; n < N; ++n) force[n] -= stress * point.gradient[n];
      }
    }
  }

  double energy(const double* unit, const UnitState& s) const override {
    const State at(*this, unit, s);
    const Tensors strain = strains(at, at.x);
    double sum = 0;
    for (std::size_t g = 0; g < at.element.points.size(); ++g)
      sum += 0.5 * at.element.points[g].weight * stress_of(strain[g]).cwiseProduct(strain[g]).sum();
    return sum;
  }

  void stiffness(const double* unit, const UnitState& s, Tangent tangent, UnitMatrix& by_position,
                 UnitMatrix& by_velocity) const override {
    const State at(*this, unit, s);
    by_position.resize(3 * N, 3 * N);
    by_velocity.resize(3 * N, 3 * N);
    Eigen::Map<Whole> K(by_position.data());
    turned_stiffness(at, K);
    if constexpr (enhanceable)
      if (at.modes) {
        const Coupling L = coupling(at);
        K -= L.transpose().lazyProduct(Coupling(at.modes->inverse.lazyProduct(L)));
      }
    const double damping = material().damping;
    double* const D = by_velocity.data();
    if (damping > 0)
      for (int n = 0; n < 9 * N * N; ++n) D[n] = damping * K.data()[n];
    else
      std::fill_n(D, 9 * N * N, 0.0);
    if (model() != ElasticModel::Corotational) return;
    if (tangent == Tangent::Exact) add_rotation_stiffness(at, by_position.data());
    if (tangent == Tangent::Projected && !moment_of_frame()) add_tension(at, K);
  }

  void bound(const double* unit, const Vec3*, const double* mass, double* stiffness,
             double* damping) const override {
    const double square = largest_stiffness(shape(), unit + first_point(), material(), mass);
    for (int n = 0; n < N; ++n) {
      stiffness[n] = square * mass[n];
      damping[n] = material().damping * square * mass[n];
    }
  }

  Matrix3d stress(const double* unit, const UnitState& s) const override {
    const State at(*this, unit, s);
    return at.R * stress_of(strain_of(at.R.transpose() * at.mean)) * at.R.transpose();
  }
  Matrix3d strain(const double* unit, const UnitState& s) const override {
    const State at(*this, unit, s);
    return at.R * strain_of(at.R.transpose() * at.mean) * at.R.transpose();
  }

private:
  using Whole = Eigen::Matrix<double, 3 * N, 3 * N>;
  using Corners = CornerVectors<N>;
  using Turns = Eigen::Matrix<double, 3 * N, 3>;

  using Tensors = std::array<Matrix3d, static_cast<std::size_t>(Points)>; // at each point, in the rotated frame

  static constexpr bool by_point = rotates_per_point(Dim, Points);
  static constexpr bool enhanceable = N == 4 * (Dim - 1) && Points == N;
  using Modes = EnhancedModes<Dim, Points>;
  using Coupling = Eigen::Matrix<double, Modes::modes, 3 * N>;
  using TurnCoupling = Eigen::Matrix<double, Modes::modes, 3>;

  // Frame f is that of the points f .. end_of(f) − 1: of one point, or of all.
  static constexpr std::size_t frames = by_point ? static_cast<std::size_t>(Points) : 1;
  static constexpr std::size_t end_of(std::size_t f) {
    return by_point ? f + 1 : static_cast<std::size_t>(Points);
  }

  // Whether the energy changes when R alone turns. It does not if R is the polar rotation of the only F that it
  // turns: RᵀF is then symmetric and σ commutes with it, unless enhanced modes have a share in σ.
  bool moment_of_frame() const {
    return model() == ElasticModel::Corotational &&
           (rotation() == Rotation::Qr || (Points > 1 && !by_point) || formulation() == Formulation::Enhanced);
  }

  struct State {
    Decoded<N, Dim, Points> element;
    Corners x, moving; // [m], relative to the first corner: positions, and positions + β velocities
    Corners gradient;  // [1/m], volume averages
    Matrix3d mean, R;  // F of the average gradients
    std::array<Matrix3d, by_point ? Points : 0> R_at;
    std::optional<Modes> modes; // of an enhanced element

    const Matrix3d& frame(std::size_t g) const {
      if constexpr (by_point) return R_at[g];
      return R;
    }

    State(const ElementOf& law, const double* unit, const UnitState& s)
        : element(law.shape(), unit + law.first_point()) {
      for (std::size_t n = 0; n < N; ++n) {
        x[n] = s.position[n] - s.position[0];
        moving[n] = x[n];
        if (law.material().damping > 0) moving[n] += law.material().damping * (s.velocity[n] - s.velocity[0]);
        gradient[n].setZero();
        for (const auto& point : element.points)
          gradient[n] += point.weight / element.volume * point.gradient[n];
      }
      mean = sum_of_products(x, gradient);
      R = law.turn(unit, mean);
      if constexpr (by_point)
        for (std::size_t g = 0; g < R_at.size(); ++g)
          R_at[g] = law.turn(unit, sum_of_products(x, element.points[g].gradient));
      if (enhanceable && law.formulation() == Formulation::Enhanced) modes.emplace(unit + law.first_mode());
    }
  };

  // How a frame turns, and the moment on it: t·ω = Z : Rᵀ dF̄ is what the energy loses when R turns by ω.
  struct Turning {
    std::size_t frame;
    Corners gradient; // Ḡ
    Matrix3d R, U;    // U = Rᵀ F̄
    RotationDerivative derivative;
    RotationDerivative::Moment moment{Vec3::Zero(), Matrix3d::Zero()}; // per volume [Pa]

    Turning(const ElementOf& law, const State& at, std::size_t f, const Tensors& strain)
        : frame(f), gradient(by_point ? at.element.points[f].gradient : at.gradient), R(at.frame(f)),
          U(R.transpose() * sum_of_products(at.x, gradient)), derivative(law.rotation(), R, R * U) {
      if (!law.moment_of_frame()) return;
      Vec3 t = Vec3::Zero();
      for (std::size_t g = f; g < end_of(f); ++g) {
        const auto& point = at.element.points[g];
        const Matrix3d at_point = R.transpose() * sum_of_products(at.x, point.gradient);
        t += point.weight * axial(law.stress_of(strain[g]) * at_point.transpose());
      }
      moment = derivative.moment(t / volume(at));
    }
    double volume(const State& at) const {
      return by_point ? at.element.points[frame].weight : at.element.volume;
    }
  };

  Matrix3d turn(const double* unit, const Matrix3d& mean) const {
    if (model() == ElasticModel::Linear) {
      if (Dim == 3) return Matrix3d::Identity();
      const Vec3 a(unit[0], unit[1], unit[2]), b(unit[3], unit[4], unit[5]);
      Matrix3d R;
      R << a, b, a.cross(b);
      return R;
    }
    if (rotation() == Rotation::Qr) return gram_schmidt(mean, Dim);
    return Dim == 3 ? closest_rotation(mean) : closest_sheet_rotation(mean);
  }

  // ε at each point, of enhanced modes too.
  Tensors strains(const State& at, const Corners& x) const {
    Tensors e;
    for (std::size_t g = 0; g < e.size(); ++g)
      e[g] = strain_of(at.frame(g).transpose() * sum_of_products(x, at.element.points[g].gradient));
    if constexpr (enhanceable)
      if (at.modes) {
        Tensors sigma;
        for (std::size_t g = 0; g < e.size(); ++g) sigma[g] = stress_of(e[g]);
        const auto alpha = at.modes->of(sigma);
        for (std::size_t g = 0; g < e.size(); ++g)
          e[g] += at.modes->strain(g, at.element.points[g].weight, alpha);
      }
    return e;
  }

  // ε from RᵀF, or the change of ε from a change of RᵀF.
  static Matrix3d symmetric(const Matrix3d& turned) {
    Matrix3d e = Matrix3d::Zero();
    e.topLeftCorner<Dim, Dim>() =
        0.5 * (turned.topLeftCorner<Dim, Dim>() + turned.topLeftCorner<Dim, Dim>().transpose());
    return e;
  }
  static Matrix3d strain_of(const Matrix3d& turned) {
    Matrix3d e = symmetric(turned);
    e.diagonal().template head<Dim>().array() -= 1;
    return e;
  }
  Matrix3d stress_of(const Matrix3d& e) const {
    Matrix3d sigma = 2 * material().mu * e;
    sigma.diagonal().template head<Dim>().array() += material().lambda * e.trace();
    return sigma;
  }

  void turned_stiffness(const State& at, Eigen::Map<Whole>& K) const {
    K.setZero();
    for (std::size_t p = 0; p < at.element.points.size(); ++p) {
      const auto& point = at.element.points[p];
      const Matrix3d& R = at.frame(p);
      const Matrix3d across = R.template leftCols<Dim>() * R.template leftCols<Dim>().transpose();
      const Corners g = each_times(R, point.gradient);
      const double lambda = point.weight * material().lambda, mu = point.weight * material().mu;
      for (int j = 0; j < N; ++j) {
        const Vec3 &gj = g[static_cast<std::size_t>(j)], lj = lambda * gj, mj = mu * gj;
        for (int i = 0; i <= j; ++i) {
          const Vec3& gi = g[static_cast<std::size_t>(i)];
          const double both = mj.dot(gi);
          for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r)
              K(3 * i + r, 3 * j + c) += gi(r) * lj(c) + mj(r) * gi(c) + both * across(r, c);
        }
      }
    }
    for (int j = 1; j < N; ++j)
      for (int i = 0; i < j; ++i)
        for (int c = 0; c < 3; ++c)
          for (int r = 0; r < 3; ++r) K(3 * j + c, 3 * i + r) = K(3 * i + r, 3 * j + c);
  }

  using Spins = Eigen::Matrix<double, 3, 3 * N>; // ω, or a moment, by positions

  // −∂f/∂R : ∂R/∂x, and the change of the moments' forces. If R turns by ω, −f_n changes by Z_n ω; a
  // displacement of corner m turns R by L(Ḡ_m) Rᵀ. Amplitudes of modes follow both.
  void add_rotation_stiffness(const State& at, double* to) const {
    const Tensors strain = strains(at, at.x), moving = strains(at, at.moving);
    std::array<Spins, frames> spins;
    Coupling modes = Coupling::Zero(), moving_modes = Coupling::Zero(); // D⁻¹ ∂r/∂x
    for (std::size_t f = 0; f < frames; ++f) spins[f] = turning_of(Turning(*this, at, f, strain));
    if constexpr (enhanceable)
      if (at.modes) {
        for (std::size_t f = 0; f < frames; ++f) {
          modes += coupling_by_turning(at, at.x, f).lazyProduct(spins[f]);
          moving_modes += coupling_by_turning(at, at.moving, f).lazyProduct(spins[f]);
        }
        modes = at.modes->inverse.lazyProduct(Coupling(modes + coupling(at))).eval();
        moving_modes = at.modes->inverse.lazyProduct(moving_modes).eval();
      }
    Whole K = Whole::Zero();
    for (std::size_t f = 0; f < frames; ++f) {
      const Turning frame(*this, at, f, strain);
      const Turns turns = by_turning(at, at.moving, moving, frame);
      // a plain loop: Eigen's blocked product is for larger matrices
      K += turns.lazyProduct(spins[f]);
      if (!moment_of_frame()) continue;
      // The moment t changes by −Z_nᵀ (without damping) when corner n moves, and as R turns.
      const Turns elastic = material().damping > 0 ? by_turning(at, at.x, strain, frame) : turns;
      Spins change = moment_by_turning(at, strain, frame).lazyProduct(spins[f]) - Spins(elastic.transpose());
      if constexpr (enhanceable)
        if (at.modes) change += coupling_by_turning(at, at.x, f).transpose().lazyProduct(modes);
      subtract_moment_forces(at, frame, spins[f], change, K);
    }
    if constexpr (enhanceable)
      if (at.modes) K -= coupling(at).transpose().lazyProduct(moving_modes);
    for (std::size_t n = 0; n < 9 * N * N; ++n) to[n] += K.data()[n];
  }

  Spins turning_of(const Turning& frame) const {
    Spins W;
    for (std::size_t m = 0; m < N; ++m)
      Eigen::Map<Matrix3d>(W.data() + 9 * m) = frame.derivative.of(frame.gradient[m]) * frame.R.transpose();
    return W;
  }

  // Subtracts the change of the forces R Z Ḡ_n, where a displacement turns R by `spins` and changes t by
  // `change`.
  void subtract_moment_forces(const State& at, const Turning& frame, const Spins& spins, const Spins& change,
                              Whole& K) const {
    const double volume = frame.volume(at);
    for (int column = 0; column < 3 * N; ++column) {
      const Matrix3d spin = cross_matrix(Eigen::Map<const Vec3>(spins.data() + 3 * column));
      const Vec3& gradient = frame.gradient[static_cast<std::size_t>(column / 3)];
      const Matrix3d dU = frame.R.row(column % 3).transpose() * gradient.transpose() - spin * frame.U;
      const Vec3 dt = Eigen::Map<const Vec3>(change.data() + 3 * column) / volume;
      const Matrix3d dZ = spin * frame.moment.Z + frame.derivative.moment_change(frame.moment.z, dt, dU);
      const Matrix3d turned = volume * frame.R * dZ;
      for (std::size_t n = 0; n < N; ++n) Eigen::Map<Vec3>(&K(0, column) + 3 * n) -= turned * frame.gradient[n];
    }
  }

  // The positive ones of the modes of twist, of frames that are the polar rotation of a single F.
  void add_tension(const State& at, Eigen::Map<Whole>& K) const {
    const Tensors strain = strains(at, at.x);
    for (std::size_t g = 0; g < at.element.points.size(); ++g) {
      const auto& point = at.element.points[g];
      const Matrix3d& R = at.frame(g);
      const Matrix3d sigma = stress_of(strain[g]);
      Matrix3d stretch = strain[g];
      stretch.diagonal().template head<Dim>().array() += 1;
      const auto [axes, along] = principal(sigma);
      const auto add = [&](double factor, const Corners& w) {
        if (!(factor > 0)) return;
        double scaled[3 * N], *to = K.data();
        for (int i = 0; i < 3 * N; ++i) scaled[i] = point.weight * factor * w[0].data()[i];
        for (int j = 0; j < 3 * N; ++j, to += 3 * N)
          for (int i = 0; i < 3 * N; ++i) to[i] += scaled[i] * w[0].data()[j];
      };
      const auto stretch_along = [&](int a) { return axes.col(a).dot(stretch * axes.col(a)); };
      for (int c = Dim == 2 ? 2 : 0; c < 3; ++c) { // twist about axis c
        const int a = (c + 1) % 3, b = (c + 2) % 3;
        const double both = stretch_along(a) + stretch_along(b);
        const Matrix3d turn = R * cross_matrix(axes.col(c));
        if (both > 0) add(0.5 * (along[a] + along[b]) / both, each_times(turn, point.gradient));
      }
      for (int a = 0; Dim == 2 && a < 2; ++a)
        if (const double s = stretch_along(a); s > 0) {
          Corners along_normal;
          for (std::size_t n = 0; n < N; ++n) along_normal[n] = R.col(2) * axes.col(a).dot(point.gradient[n]);
          add(along[a] / s, along_normal);
        }
    }
  }

  // The principal axes of σ and the stresses along them; of a sheet, the third axis is the normal.
  static std::pair<Matrix3d, Vec3> principal(const Matrix3d& sigma) {
    if constexpr (Dim == 3) {
      Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
      solver.computeDirect(sigma);
      return {solver.eigenvectors(), solver.eigenvalues()};
    } else {
      return principal_in_plane(sigma);
    }
  }
  static std::pair<Matrix3d, Vec3> principal_in_plane(const Matrix3d& sigma) {
    const double mean = 0.5 * (sigma(0, 0) + sigma(1, 1)), half = 0.5 * (sigma(0, 0) - sigma(1, 1));
    const double both = sigma(0, 1), radius = std::sqrt(half * half + both * both);
    // of the two forms of the axis, the one that does not cancel
    Vec3 axis(half + radius, both, 0);
    if (half < 0) axis = Vec3(both, radius - half, 0);
    if (radius == 0) axis = Vec3::UnitX();
    axis.normalize();
    Matrix3d axes;
    axes << axis, Vec3::UnitZ().cross(axis), Vec3::UnitZ();
    return {axes, Vec3(mean + radius, mean - radius, 0)};
  }

  // ∂r/∂x of the modes (enhanced_modes.h), R held.
  Coupling coupling(const State& at) const {
    Coupling L = Coupling::Zero();
    const double lambda = material().lambda, mu = material().mu;
    for (std::size_t g = 0; g < at.element.points.size(); ++g) {
      const Matrix3d turned = at.frame(g).transpose();
      for (int a = 0; a < Dim; ++a) {
        const Vec3 W = at.modes->at(g, a);
        for (int n = 0; n < N; ++n) {
          const Vec3& G = at.element.points[g].gradient[static_cast<std::size_t>(n)];
          const Matrix3d block =
              mu * (G.dot(W) * Matrix3d::Identity() + G * W.transpose()) + lambda * W * G.transpose();
          L.template block<Dim, 3>(Dim * a, 3 * n) += (block * turned).template topRows<Dim>();
        }
      }
    }
    return L;
  }

  // ∂r by a turn of frame f.
  TurnCoupling coupling_by_turning(const State& at, const Corners& x, std::size_t f) const {
    TurnCoupling L = TurnCoupling::Zero();
    for (std::size_t g = f; g < end_of(f); ++g) {
      const Matrix3d U = at.frame(g).transpose() * sum_of_products(x, at.element.points[g].gradient);
      for (int axis = 0; axis < 3; ++axis) {
        const Matrix3d sigma = stress_of(symmetric(turned_about(axis, U)));
        for (int a = 0; a < Dim; ++a)
          L.template block<Dim, 1>(Dim * a, axis) -= (sigma * at.modes->at(g, a)).template head<Dim>();
      }
    }
    return L;
  }

  // Z_n: −f_n, without the moment's forces, by a turn of R, with the amplitudes of modes held.
  Turns by_turning(const State& at, const Corners& x, const Tensors& strain, const Turning& frame) const {
    Turns Z = Turns::Zero();
    const Matrix3d& R = frame.R;
    for (std::size_t g = frame.frame; g < end_of(frame.frame); ++g) {
      const auto& point = at.element.points[g];
      const Matrix3d U = R.transpose() * sum_of_products(x, point.gradient);
      const Matrix3d sigma = stress_of(strain[g]);
      for (int axis = 0; axis < 3; ++axis) {
        const Matrix3d change =
            point.weight * R * (turned_about(axis, sigma) - stress_of(symmetric(turned_about(axis, U))));
        for (std::size_t n = 0; n < N; ++n) Eigen::Map<Vec3>(&Z(0, axis) + 3 * n) += change * point.gradient[n];
      }
    }
    return Z;
  }

  // The change of the moment t by a turn of R, with the amplitudes of modes held.
  Matrix3d moment_by_turning(const State& at, const Tensors& strain, const Turning& frame) const {
    Matrix3d change = Matrix3d::Zero();
    for (std::size_t g = frame.frame; g < end_of(frame.frame); ++g) {
      const auto& point = at.element.points[g];
      const Matrix3d U = frame.R.transpose() * sum_of_products(at.x, point.gradient);
      const Matrix3d sigma = stress_of(strain[g]);
      for (int axis = 0; axis < 3; ++axis) {
        const Matrix3d dU = -turned_about(axis, U);
        change.col(axis) +=
            point.weight * axial(stress_of(symmetric(dU)) * U.transpose() + sigma * dU.transpose());
      }
    }
    return change;
  }
};

} // namespace rend
