// A force law: the forces between the particles of one unit of an interaction.
//
// A unit is a spring, a hinge, an element: some particles, and some values of its own (stiffness, rest length,
// gradients of shape functions ...), which are embedded on the orbit that carries it and copied into its row.
// This is the reference implementation, one unit at a time; a kernel (rows/kernels.h) may process many at once
// and must agree with it.
//
// To add one: a class like these, and interactions that use it. It runs without a kernel.
#pragma once

#include "sim/base/record.h"

#include <cstdint>
#include <string>

namespace rend {

// The state of one unit's particles, in the order of its words.
struct UnitState {
  const Vec3* position; // [m]
  const Vec3* velocity; // [m/s]
  const Vec3* rest;     // [m]
};

constexpr int most_particles = 8;
// 3n × 3n for a unit of n particles: rows and columns 3i..3i+2 belong to particle i. Never allocates.
using UnitMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3 * most_particles, 3 * most_particles>;

// Which tangent of the force is wanted: the exact one, or a positive semi-definite approximation, for solvers
// that need it: without the negative part of the geometric stiffness under compression, and without the
// derivative of a co-rotational frame. Projected keeps of that derivative what tension adds (element_law.h); it
// is as SemiDefinite for other laws.
enum class Tangent { Exact, SemiDefinite, Projected };

class ForceLaw {
public:
  virtual ~ForceLaw() = default;

  const std::string& name() const { return name_; }
  int particles() const { return particles_; } // per unit, at most 8
  int values() const { return values_; }       // number of values per unit
  // index of the value that is 0 for units without damping; -1: none
  int damping_value() const { return damping_; }

  // The force [N] on each particle. Finite for every finite state.
  virtual void forces(const double* unit, const UnitState& s, Vec3* force) const = 0;

  virtual double energy(const double* unit, const UnitState& s) const = 0; // [J], without damping

  // −∂f/∂x [N/m] and −∂f/∂v [N·s/m]; both resized.
  virtual void stiffness(const double* unit, const UnitState& s, Tangent tangent, UnitMatrix& by_position,
                         UnitMatrix& by_velocity) const = 0;

  // Diagonal bounds s_n [N/m] and d_n [N·s/m] for each particle such that at rest −∂f/∂x ≼ diag(s_n) and −∂f/∂v
  // ≼ diag(d_n). `mass` [kg]: of the element corners at which the forces act, for choosing the tightest
  // diagonal.
  virtual void bound(const double* unit, const Vec3* rest, const double* mass, double* stiffness,
                     double* damping) const = 0;

  // Whether the unit can ever exert a force between these vertices; if not, it gets no row.
  virtual bool acts(const double* unit, const std::uint32_t* vertex) const = 0;

  // Adds the values of a unit to those of another between the same particles (cumulated rows); `swapped`: with
  // the particles in the opposite order.
  virtual void fold(double* sum, const double* other, bool swapped) const;

protected:
  ForceLaw(std::string name, int particles, int values, int damping_value = -1)
      : name_(std::move(name)), particles_(particles), values_(values), damping_(damping_value) {}

private:
  std::string name_;
  int particles_, values_, damping_;
};

// The values of springs and hinges.
struct UnitParameters {
  double k = 0;       // [N/m] (spring), [N·m/rad] (hinge)
  double damping = 0; // [N·s/m], [N·m·s/rad]
  double rest = 0;    // length [m], angle [rad]

  static UnitParameters of(const double* unit) { return {unit[0], unit[1], unit[2]}; }
};
static_assert(sizeof(UnitParameters) == 3 * sizeof(double));

} // namespace rend
