#include "sim/mechanics/mass_tensor.h"

namespace rend {
namespace {

using Eigen::Matrix3d;
using Tensor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Eigen::Map<const Tensor> tensor(const double* unit) {
  return Eigen::Map<const Tensor>(unit);
}

Vec3 moved(const UnitState& s, int n, double damping) {
  return s.position[n] - s.rest[n] + damping * s.velocity[n];
}

bool any(const double* unit, int count) {
  for (int n = 0; n < count; ++n)
    if (unit[n] != 0) return true;
  return false;
}

class VertexTensor final : public MassTensorLaw {
public:
  explicit VertexTensor(const MassTensorRequest& request)
      : MassTensorLaw("mass-tensor of a vertex", 1, 10, request) {}

  void forces(const double* unit, const UnitState& s, Vec3* force) const override {
    force[0] = -tensor(unit) * moved(s, 0, damping());
  }
  double energy(const double* unit, const UnitState& s) const override {
    const Vec3 u = moved(s, 0, 0);
    return 0.5 * u.dot(tensor(unit) * u);
  }
  void stiffness(const double* unit, const UnitState&, Tangent, UnitMatrix& by_position,
                 UnitMatrix& by_velocity) const override {
    by_position = tensor(unit);
    by_velocity = damping() * tensor(unit);
  }
  // The largest eigenvalue of the whole element: its pairs then add nothing, and with equal masses at its
  // corners this is the element's highest frequency, where bounds of single tensors would give up to twice
  // that.
  void bound(const double* unit, const Vec3*, const double*, double* stiffness,
             double* damping_bound) const override {
    stiffness[0] = unit[9];
    damping_bound[0] = damping() * unit[9];
  }
  bool acts(const double* unit, const std::uint32_t*) const override { return any(unit, 9); }
  void fold(double* sum, const double* other, bool) const override {
    for (int n = 0; n < values(); ++n) sum[n] += other[n];
  }
};

class PairTensor final : public MassTensorLaw {
public:
  explicit PairTensor(const MassTensorRequest& request)
      : MassTensorLaw("mass-tensor of a pair", 2, 9, request) {}

  void forces(const double* unit, const UnitState& s, Vec3* force) const override {
    force[0] = -tensor(unit) * moved(s, 1, damping());
    force[1] = -tensor(unit).transpose() * moved(s, 0, damping());
  }
  double energy(const double* unit, const UnitState& s) const override {
    return moved(s, 0, 0).dot(tensor(unit) * moved(s, 1, 0));
  }
  // Semi-definite only together with the tensors of the vertices, which are always present too.
  void stiffness(const double* unit, const UnitState&, Tangent, UnitMatrix& by_position,
                 UnitMatrix& by_velocity) const override {
    by_position = UnitMatrix::Zero(6, 6);
    by_position.topRightCorner<3, 3>() = tensor(unit);
    by_position.bottomLeftCorner<3, 3>() = tensor(unit).transpose();
    by_velocity = damping() * by_position;
  }
  void bound(const double*, const Vec3*, const double*, double* stiffness,
             double* damping_bound) const override { // contained in the bound of the vertices
    stiffness[0] = stiffness[1] = damping_bound[0] = damping_bound[1] = 0;
  }
  bool acts(const double* unit, const std::uint32_t*) const override { return any(unit, 9); }
  void fold(double* sum, const double* other, bool swapped) const override {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) sum[3 * r + c] += swapped ? other[3 * c + r] : other[3 * r + c];
  }
};

} // namespace

std::shared_ptr<const MassTensorLaw> vertex_tensor_law(const MassTensorRequest& request) {
  return std::make_shared<VertexTensor>(request);
}
std::shared_ptr<const MassTensorLaw> pair_tensor_law(const MassTensorRequest& request) {
  return std::make_shared<PairTensor>(request);
}

} // namespace rend
