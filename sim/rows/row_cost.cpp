#include "sim/rows/row_cost.h"

#include "sim/mechanics/element_law.h"
#include "sim/mechanics/hinge_law.h"
#include "sim/mechanics/mass_tensor.h"
#include "sim/mechanics/spring_law.h"

#include <algorithm>

namespace rend {
namespace {

constexpr double add = 3, scale = 3, dot = 5, cross = 9; // operations on vectors

double spring_operations(bool damped) {
  const double factor = add + dot + 6; // l, 1/l², times l, l − rest, times k, times 1/l
  const double velocities = add + dot + 3;
  return factor + (damped ? velocities : 0) + scale + 2 * add;
}

// As in hinge_kernel.cpp: the angle, its moment, and the forces on the eight particles.
double hinge_operations(bool damped) {
  constexpr double arm = 3 * add + scale, arc_tangent = 30;
  const double measure = add + dot + 2 + 2 * arm + 2 * cross + (cross + dot + 1) + 2 * dot + 2 * (1 + scale) +
                         dot + arc_tangent + 2 * (dot + 1);
  const double rate = add + 2 * (arm + scale + add + dot + 1) + 3;
  const double moment = 4 + 2 * scale, shares = 2 * (scale + add + scale) + 2 * add, sums = 6 * add;
  return measure + (damped ? rate : 0) + moment + shares + sums;
}

double tensor_operations(int particles, bool damped) {
  const double moved = add + (damped ? scale + add : 0), product = 15 + add;
  return particles * (moved + product);
}

// From corners to the derivatives along reference axes (element_lanes.h), and the transpose.
struct Derivatives {
  double there, back;
};

Derivatives derivatives_of(const ElementShape& shape) {
  constexpr double mean = 2 * scale + add, means = 8 * mean;     // averages of two, of four
  constexpr double shares = 2 * add + scale + 3 * (scale + add); // at the points of a triangle
  switch (shape.kind) {
  case ElementKind::Triangle:
    return {0, add};
  case ElementKind::Tetrahedron:
    return {0, 2 * add};
  case ElementKind::Quad:
    return {2 * (2 * add + 2 * mean), 2 * (2 * mean + 4 * add)};
  case ElementKind::Hexahedron:
    return {3 * (4 * add + means), 3 * (means + 8 * add)};
  case ElementKind::Prism:
    return {2 * (2 * add + 2 * mean) + 3 * add + shares, shares + 3 * add + 2 * (2 * mean + 4 * add)};
  case ElementKind::Pyramid:
    return {2 * (2 * add + 2 * mean) + means + 4 * add, 2 * (2 * mean + 4 * add) + means + 8 * add};
  }
  return {};
}

double rotation_operations(Rotation rotation, int dimension) { // rotation_lanes.h
  constexpr int iterations = 3;
  const double columns = dimension; // each is also squared, for the threshold
  const double gram_schmidt = columns * dot + (2 + scale) + (dot + scale + add) + dot + (2 + scale) + columns +
                              (dimension == 3 ? cross : 0);
  if (rotation == Rotation::Qr) return gram_schmidt;
  if (dimension == 2) return gram_schmidt + 3 * dot + 1 + 3 + 2 + 2 + 2 * (2 * scale + add);
  constexpr double invariants = 3 * cross + 7 * dot + 4, halley = 23; // of F; per iteration for s
  constexpr double weights = 12 + 3 * (dot + 1), column = 2 + 4 * scale + 3 * add;
  return invariants + iterations * halley + weights + 3 * column;
}

// The moment on a frame (rotation_lanes.h), at each point, and once for each frame. A solid's forces are
// turned at its corners.
struct MomentOperations {
  double points, once;
};
MomentOperations moment_operations(const ElementShape& shape, Rotation rotation) {
  const double points = static_cast<double>(shape.points.size());
  if (shape.dimension == 2) return {points * (4 * dot + 8 + scale + add), 0};
  const bool triangular = rotation == Rotation::Qr && points == 1; // U has nothing below its diagonal
  const double stress = (triangular ? 6 * dot + 3 : 9 * dot + 2 * 3) + 2 + 5 + 3 * 3;
  const double moment = (triangular ? 2 : 3) + 24, turned = points == 1 ? 3 : shape.corners;
  const double z = rotation == Rotation::Qr ? 3 * dot + 8 : 9 * dot + 6 + 3 + 18 + 7 + 3 * dot + scale;
  const double sum = 3 + (rotation == Rotation::Qr ? 3 : 6);
  return {points * (stress + moment + sum), 1 + scale + z + turned * (3 * scale + 2 * add)};
}

// As in element_kernel.h.
double element_operations(const ElementLaw& law, bool damped) {
  const ElementShape& shape = law.shape();
  const double d = shape.dimension, points = static_cast<double>(shape.points.size()), n = shape.corners;
  const bool turned = law.model() == ElasticModel::Corotational;
  const double frames = !turned ? 0 : rotates_per_point(shape.dimension, static_cast<int>(points)) ? points : 1;
  const Derivatives derivatives = derivatives_of(shape);
  const double gradient = points * d * (d * scale + (d - 1) * add);
  const double mean = turned && points > 1 ? points * (1 + d * (scale + add)) + 1 + d * scale : 0;
  const bool plain = !turned && shape.dimension == 3;
  const bool stretched = turned && law.rotation() == Rotation::Polar && points == 1 && !damped;
  const double stress = plain       ? 22
                        : stretched ? d * dot + (d - 1) + 5 + d * (2 * scale + add)
                                    : d * d * dot + (d - 1) + 5 + d * (3 + scale + (d - 1) * (2 + scale + add));
  const bool moments = turned && (law.rotation() == Rotation::Qr || (shape.dimension == 3 && points > 1));
  const MomentOperations moment = moments ? moment_operations(shape, law.rotation()) : MomentOperations{0, 0};
  const double stresses = moments && shape.dimension == 3 ? moment.points : points * stress + moment.points;
  const double back = points * d * d * (scale + add);
  double sum = (n - 1) * add + derivatives.there + gradient + mean;
  if (turned) sum += frames * rotation_operations(law.rotation(), shape.dimension);
  if (damped) sum += (n - 1) * (2 * add + scale) + (turned ? derivatives.there + gradient : 0);
  if (damped && moments && shape.dimension == 3) sum += points * (9 * dot + 2 + 5 + 3 * 3 + 3 * 2 + 3);
  return sum + stresses + moment.once + back + derivatives.back + n * add;
}

// The number of distinct records in these index columns.
std::size_t records(const PackedRows& rows, int first, int last) {
  std::vector<std::uint32_t> all;
  rows.for_each([&](std::size_t, std::size_t row) {
    for (int column = first; column < last; ++column) all.push_back(rows.index(column)[row]);
  });
  std::sort(all.begin(), all.end());
  return static_cast<std::size_t>(std::unique(all.begin(), all.end()) - all.begin());
}

} // namespace

std::optional<double> operations_of(const ForceLaw& law, bool damped) {
  if (&law == spring_law().get()) return spring_operations(damped);
  if (&law == hinge_law().get()) return hinge_operations(damped);
  if (const auto* tensor = dynamic_cast<const MassTensorLaw*>(&law))
    return tensor_operations(tensor->particles(), damped);
  if (const auto* element = dynamic_cast<const ElementLaw*>(&law))
    if (element->formulation() == Formulation::Plain) return element_operations(*element, damped);
  return {};
}

RowCost cost_of(const Binder& binder, bool corners) {
  const Interaction& interaction = *binder.interaction();
  const ForceLaw& law = *interaction.law;
  const auto live = static_cast<double>(binder.rows().live_count());
  RowCost cost;
  cost.operations = operations_of(law, interaction.damped);
  if (live == 0) return cost;
  const int particles = law.particles();
  const auto vertices = static_cast<double>(records(binder.rows(), 0, particles));
  const double forces =
      corners ? static_cast<double>(records(binder.rows(), particles, 2 * particles)) : vertices;
  const double carried =
      8.0 * static_cast<double>(binder.rows().columns()) + 4.0 * particles * (corners ? 2 : 1);
  cost.written = sizeof(Record) * forces / live;
  cost.read = carried + sizeof(Record) * vertices * (interaction.damped ? 2 : 1) / live + cost.written;
  return cost;
}

} // namespace rend
