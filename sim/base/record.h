// A point or vector stored as four doubles, the fourth 0: one aligned load for AVX, two for SSE, the same
// layout for both. Against separate arrays of x, y, z it halves the time per spring (sim/README.md, "Kernels").
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace rend {

using Vec3 = Eigen::Vector3d;

struct alignas(32) Record {
  double x = 0, y = 0, z = 0, w = 0; // w stays 0

  Record() = default;
  Record(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
  Record(const Vec3& v) : x(v.x()), y(v.y()), z(v.z()) {}
  Vec3 vec() const { return {x, y, z}; }
  operator Vec3() const { return vec(); }
};
static_assert(sizeof(Record) == 32);

} // namespace rend
