#include "sim/mechanics/element_law.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace rend {
namespace {

using Eigen::Matrix3d;

// An element's gradients at one integration point; for a sheet the third row is 0.
template <int N> struct PointOf {
  Eigen::Matrix<double, 3, N> gradient; // [1/m]
  double weight;                        // [m³]
};

template <int N, int Dim, int Points> struct Decoded {
  std::array<PointOf<N>, static_cast<std::size_t>(Points)> points;
  double volume = 0; // [m³]

  Decoded(const ElementShape& shape, const double* values) {
    for (std::size_t g = 0; g < points.size(); ++g, values += Dim * Dim + 1) {
      using Inverse = Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>;
      const Eigen::Map<const Inverse> inverse(values);
      points[g].gradient.setZero();
      for (int n = 0; n < N; ++n) {
        const double* reference = shape.points[g].gradient[static_cast<std::size_t>(n)].data();
        points[g].gradient.col(n).template head<Dim>() =
            inverse.transpose() * Eigen::Map<const Eigen::Matrix<double, Dim, 1>>(reference);
      }
      points[g].weight = values[Dim * Dim];
      volume += points[g].weight;
    }
  }
};

// The law with sizes known at compile time: N corners, Dim rest axes, Points integration points.
template <int N, int Dim, int Points> class ElementOf final : public ElementLaw {
public:
  ElementOf(ElementKind kind, ElasticModel model, Rotation rotation, const ElasticMaterial& material)
      : ElementLaw(shape_of(kind), model, rotation, material) {}

  void forces(const double* unit, const UnitState& s, Vec3* force) const override {
    const State at(*this, unit, s);
    for (int n = 0; n < N; ++n) force[n].setZero();
    for (std::size_t f = 0; f < frames; ++f) {
      Matrix3d moment = Matrix3d::Zero();
      if (moment_of_frame()) moment = Turning(*this, at, f).moment.Z;
      for (std::size_t g = f; g < end_of(f); ++g) {
        const auto& point = at.element.points[g];
        const Matrix3d& R = at.frame(g);
        const Matrix3d turned = stress_of(strain_of(R.transpose() * (at.moving * point.gradient.transpose())));
        const Matrix3d stress = point.weight * R * (turned - moment);
        for (int n = 0; n < N; ++n) force[n] -= stress * point.gradient.col(n);
      }
    }
  }

  double energy(const double* unit, const UnitState& s) const override {
    const State at(*this, unit, s);
    double sum = 0;
    for (std::size_t g = 0; g < at.element.points.size(); ++g) {
      const auto& point = at.element.points[g];
      const Matrix3d e = strain_of(at.frame(g).transpose() * (at.x * point.gradient.transpose()));
      sum += 0.5 * point.weight * stress_of(e).cwiseProduct(e).sum();
    }
    return sum;
  }

  void stiffness(const double* unit, const UnitState& s, Tangent tangent, UnitMatrix& by_position,
                 UnitMatrix& by_velocity) const override {
    const State at(*this, unit, s);
    by_position.resize(3 * N, 3 * N);
    by_velocity.resize(3 * N, 3 * N);
    Eigen::Map<Whole> K(by_position.data()), D(by_velocity.data());
    turned_stiffness(at, K);
    if (material().damping > 0)
      D = material().damping * K;
    else
      D.setZero();
    if (tangent == Tangent::Exact && model() == ElasticModel::Corotational)
      for (std::size_t f = 0; f < frames; ++f) K += rotation_stiffness(at, Turning(*this, at, f));
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
  using Corners = Eigen::Matrix<double, 3, N>;
  using Turns = Eigen::Matrix<double, 3 * N, 3>;

  static constexpr bool by_point = rotates_per_point(Dim, Points);

  // Frame f is that of the points f .. end_of(f) − 1: of one point, or of all.
  static constexpr std::size_t frames = by_point ? static_cast<std::size_t>(Points) : 1;
  static constexpr std::size_t end_of(std::size_t f) {
    return by_point ? f + 1 : static_cast<std::size_t>(Points);
  }

  // Whether the energy changes when R alone turns. It does not if R is the polar rotation of the only F that it
  // turns: RᵀF is then symmetric and σ commutes with it.
  bool moment_of_frame() const {
    return model() == ElasticModel::Corotational && (rotation() == Rotation::Qr || (Points > 1 && !by_point));
  }

  struct State {
    Decoded<N, Dim, Points> element;
    Corners x, moving; // [m], relative to the first corner: positions, and positions + β velocities
    Corners gradient;  // volume averages
    Matrix3d mean, R;  // F of the average gradients
    std::array<Matrix3d, by_point ? Points : 0> R_at;

    const Matrix3d& frame(std::size_t g) const {
      if constexpr (by_point) return R_at[g];
      return R;
    }

    State(const ElementOf& law, const double* unit, const UnitState& s)
        : element(law.shape(), unit + law.first_point()) {
      for (int n = 0; n < N; ++n) {
        x.col(n) = s.position[n] - s.position[0];
        moving.col(n) = x.col(n);
        if (law.material().damping > 0)
          moving.col(n) += law.material().damping * (s.velocity[n] - s.velocity[0]);
      }
      gradient.setZero();
      for (const auto& point : element.points) gradient += point.weight / element.volume * point.gradient;
      mean.noalias() = x * gradient.transpose();
      R = law.turn(unit, mean);
      if constexpr (by_point)
        for (std::size_t g = 0; g < R_at.size(); ++g)
          R_at[g] = law.turn(unit, x * element.points[g].gradient.transpose());
    }
  };

  // How a frame turns, and the moment on it: t·ω = Z : Rᵀ dF̄ is what the energy loses when R turns by ω.
  struct Turning {
    std::size_t frame;
    Corners gradient; // Ḡ
    Matrix3d R, U;    // U = Rᵀ F̄
    RotationDerivative derivative;
    RotationDerivative::Moment moment{Vec3::Zero(), Matrix3d::Zero()}; // per volume [Pa]

    Turning(const ElementOf& law, const State& at, std::size_t f)
        : frame(f), gradient(by_point ? at.element.points[f].gradient : at.gradient), R(at.frame(f)),
          U(R.transpose() * (at.x * gradient.transpose())), derivative(law.rotation(), R, R * U) {
      if (!law.moment_of_frame()) return;
      Vec3 t = Vec3::Zero();
      for (std::size_t g = f; g < end_of(f); ++g) {
        const auto& point = at.element.points[g];
        const Matrix3d at_point = R.transpose() * (at.x * point.gradient.transpose());
        t += point.weight * axial(law.stress_of(strain_of(at_point)) * at_point.transpose());
      }
      moment = derivative.moment(t / volume(at));
    }
    double volume(const State& at) const {
      return by_point ? at.element.points[frame].weight : at.element.volume;
    }
  };

  // a with [ω]× : M = a·ω.
  static Vec3 axial(const Matrix3d& M) { return {M(2, 1) - M(1, 2), M(0, 2) - M(2, 0), M(1, 0) - M(0, 1)}; }
  static Matrix3d crossing(const Vec3& v) {
    Matrix3d M;
    M << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return M;
  }

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

  // [e_axis]× M.
  static Matrix3d turned_about(int axis, const Matrix3d& M) {
    Matrix3d turned;
    turned.row(axis).setZero();
    turned.row((axis + 1) % 3) = -M.row((axis + 2) % 3);
    turned.row((axis + 2) % 3) = M.row((axis + 1) % 3);
    return turned;
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
      const Corners g = R * point.gradient;
      const double lambda = point.weight * material().lambda, mu = point.weight * material().mu;
      for (int j = 0; j < N; ++j) {
        const Vec3 lj = lambda * g.col(j), mj = mu * g.col(j);
        for (int i = 0; i <= j; ++i) {
          const double both = mj.dot(g.col(i));
          for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r)
              K(3 * i + r, 3 * j + c) += g(r, i) * lj(c) + mj(r) * g(c, i) + both * across(r, c);
        }
      }
    }
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < j; ++i)
        K.template block<3, 3>(3 * j, 3 * i) = K.template block<3, 3>(3 * i, 3 * j).transpose();
  }

  // −∂f/∂R : ∂R/∂x, and the change of the moment's forces. If R turns by ω, −f_n changes by Z_n ω; a
  // displacement of corner m turns R by L(Ḡ_m) Rᵀ.
  Whole rotation_stiffness(const State& at, const Turning& frame) const {
    Eigen::Matrix<double, 3, 3 * N> W;
    for (int m = 0; m < N; ++m)
      W.template block<3, 3>(0, 3 * m) = frame.derivative.of(frame.gradient.col(m)) * frame.R.transpose();
    const Turns turns = by_turning(at, at.moving, frame);
    Whole K = turns.lazyProduct(W); // a plain loop: Eigen's blocked product is for larger matrices
    if (!moment_of_frame()) return K;
    // The moment t changes by −Z_nᵀ (without damping) when corner n moves, and as R turns.
    const Turns elastic = material().damping > 0 ? by_turning(at, at.x, frame) : turns;
    const Eigen::Matrix<double, 3, 3 * N> change =
        moment_by_turning(at, frame).lazyProduct(W) - Eigen::Matrix<double, 3, 3 * N>(elastic.transpose());
    const double volume = frame.volume(at);
    for (int column = 0; column < 3 * N; ++column) {
      const Matrix3d spin = crossing(W.col(column));
      const Matrix3d dU =
          frame.R.row(column % 3).transpose() * frame.gradient.col(column / 3).transpose() - spin * frame.U;
      const Matrix3d dZ = spin * frame.moment.Z +
                          frame.derivative.moment_change(frame.moment.z, change.col(column) / volume, dU);
      const Matrix3d turned = volume * frame.R * dZ;
      for (int n = 0; n < N; ++n) K.template block<3, 1>(3 * n, column) -= turned * frame.gradient.col(n);
    }
    return K;
  }

  // Z_n: −f_n, without the moment's forces, by a turn of R.
  Turns by_turning(const State& at, const Corners& moving, const Turning& frame) const {
    Turns Z = Turns::Zero();
    const Matrix3d& R = frame.R;
    for (std::size_t g = frame.frame; g < end_of(frame.frame); ++g) {
      const auto& point = at.element.points[g];
      const Matrix3d U = R.transpose() * (moving * point.gradient.transpose());
      const Matrix3d sigma = stress_of(strain_of(U));
      for (int axis = 0; axis < 3; ++axis) {
        const Matrix3d change =
            point.weight * R * (turned_about(axis, sigma) - stress_of(symmetric(turned_about(axis, U))));
        for (int n = 0; n < N; ++n) Z.template block<3, 1>(3 * n, axis) += change * point.gradient.col(n);
      }
    }
    return Z;
  }

  // The change of the moment t by a turn of R.
  Matrix3d moment_by_turning(const State& at, const Turning& frame) const {
    Matrix3d change = Matrix3d::Zero();
    for (std::size_t g = frame.frame; g < end_of(frame.frame); ++g) {
      const auto& point = at.element.points[g];
      const Matrix3d U = frame.R.transpose() * (at.x * point.gradient.transpose());
      const Matrix3d sigma = stress_of(strain_of(U));
      for (int axis = 0; axis < 3; ++axis) {
        const Matrix3d dU = -turned_about(axis, U);
        change.col(axis) +=
            point.weight * axial(stress_of(symmetric(dU)) * U.transpose() + sigma * dU.transpose());
      }
    }
    return change;
  }
};

} // namespace

ElasticMaterial ElasticMaterial::of(double young, double poisson, int dimension) {
  ElasticMaterial m;
  m.mu = young / (2 * (1 + poisson));
  m.lambda = dimension == 2 ? young * poisson / (1 - poisson * poisson)
                            : young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  return m;
}

ElementLaw::ElementLaw(const ElementShape& shape, ElasticModel model, Rotation rotation,
                       const ElasticMaterial& material)
    : ForceLaw((model == ElasticModel::Linear ? "linear " : "co-rotational ") + shape.name, shape.corners,
               unit_values(shape.kind, model)),
      shape_(&shape), model_(model), rotation_(rotation), material_(material) {
  CHECK(first_point() == (model == ElasticModel::Linear && shape.dimension == 2 ? 6 : 0));
}

namespace {

// As write_element, with the axes at each point in the tangent plane of the rest element there: a quad that is
// warped at rest then has no strain at rest. False also if it is folded.
bool write_in_tangent_planes(const ElementShape& shape, const Vec3* rest, const Matrix3d& frame,
                             double thickness, double* values) {
  ElementShape one = shape;
  for (const ReferencePoint& point : shape.points) {
    Vec3 along = Vec3::Zero(), across = Vec3::Zero();
    for (int n = 1; n < shape.corners; ++n) {
      along += point.gradient[static_cast<std::size_t>(n)][0] * (rest[n] - rest[0]);
      across += point.gradient[static_cast<std::size_t>(n)][1] * (rest[n] - rest[0]);
    }
    Vec3 normal = along.cross(across).normalized();
    const double side = normal.dot(frame.col(2));
    if (side < 0) normal = -normal;
    Matrix3d own;
    own.col(2) = normal;
    own.col(0) = (frame.col(0) - frame.col(0).dot(normal) * normal).normalized();
    own.col(1) = normal.cross(own.col(0));
    one.points.assign(1, point);
    if (side == 0 || !own.allFinite() || !write_element(one, rest, own, thickness, values)) return false;
    values += one.values();
  }
  return true;
}

} // namespace

bool ElementLaw::write_unit(const Vec3* rest, double thickness, double* unit) const {
  const bool own_axes =
      shape_->dimension == 2 || (model_ == ElasticModel::Corotational && rotation_ == Rotation::Qr);
  const Eigen::Matrix3d frame = own_axes ? rest_frame(*shape_, rest) : Eigen::Matrix3d::Identity();
  for (int n = 0; n < first_point(); ++n) unit[n] = frame(n % 3, n / 3);
  const bool by_point = rotates_per_point(shape_->dimension, static_cast<int>(shape_->points.size()));
  if (model_ == ElasticModel::Corotational && by_point && write_element(*shape_, rest, frame, thickness, unit))
    return write_in_tangent_planes(*shape_, rest, frame, thickness, unit);
  return write_element(*shape_, rest, frame, thickness, unit + first_point());
}

std::shared_ptr<const ElementLaw> element_law(ElementKind kind, ElasticModel model, Rotation rotation,
                                              const ElasticMaterial& material) {
  const auto made = [&]<int N, int Dim, int Points>() -> std::shared_ptr<const ElementLaw> {
    return std::make_shared<ElementOf<N, Dim, Points>>(kind, model, rotation, material);
  };
  switch (kind) {
  case ElementKind::Triangle:
    return made.template operator()<3, 2, 1>();
  case ElementKind::Quad:
    return made.template operator()<4, 2, 4>();
  case ElementKind::Tetrahedron:
    return made.template operator()<4, 3, 1>();
  case ElementKind::Hexahedron:
    return made.template operator()<8, 3, 8>();
  case ElementKind::Prism:
    return made.template operator()<6, 3, 6>();
  case ElementKind::Pyramid:
    return made.template operator()<5, 3, 4>();
  }
  return nullptr;
}

} // namespace rend
