#include "sim/fracture/element_scan.h"

#include "sim/rows/element_lanes.h"

#include <limits>

namespace rend {
namespace {

using namespace lanes;

// The bound first · tr + second · λmax, compared with the limit.
struct Bound {
  double first, second; // λ and 2μ [Pa]; for strain 0 and 1
  double limit;
  bool compression;
};

REND_INLINE Double4 larger(Double4 a, Double4 b) {
  return a > b ? a : b;
}

// Σ w F / Σ w.
template <class Shape> REND_INLINE Matrix<Shape::dim> mean_gradient(const double* values, const Vector* x) {
  constexpr int Dim = Shape::dim, stride = 4 * (Dim * Dim + 1);
  Vector D[Shape::columns_count];
  Shape::columns(x, D);
  Matrix<Dim> F{};
  Double4 volume{};
  for (int g = 0; g < Shape::points; ++g, values += stride) {
    const Double4 weight = Shape::points == 1 ? splat(1) : load_four(values + 4 * Dim * Dim);
    volume += weight;
    for (int c = 0; c < Dim; ++c)
      for (int r = 0; r < Dim; ++r)
        F.column[c] = F.column[c] + (weight * load_four(values + 4 * (Dim * r + c))) * D[Shape::column(g, r)];
  }
  if constexpr (Shape::points > 1) {
    const Double4 share = volume > 0.0 ? 1.0 / volume : Double4{};
    for (int c = 0; c < Dim; ++c) F.column[c] = share * F.column[c];
  }
  return F;
}

// Invariants of a symmetric tensor that bound all its principal values.
struct Invariants {
  Double4 trace, spread; // spread: √(1 − 1/d) |dev|
  Double4 square;        // |E|²
};
template <int Dim> REND_INLINE Invariants invariants(const Double4 (&E)[Dim][Dim]) {
  Double4 trace = E[0][0], dev{}, off{};
  for (int r = 1; r < Dim; ++r) trace += E[r][r];
  for (int r = 0; r < Dim; ++r) {
    for (int c = r + 1; c < Dim; ++c) {
      const Double4 d = E[r][r] - E[c][c];
      dev += d * d;
      off += E[r][c] * E[r][c];
    }
  }
  const Double4 square = dev * (1.0 / Dim) + 2.0 * off; // |dev E|²
  return {trace, square_root((1.0 - 1.0 / Dim) * square), square + trace * trace * (1.0 / Dim)};
}

// Which of four elements may exceed the limit, as a mask of −1.
template <int Dim> REND_INLINE Long4 exceed(const Matrix<Dim>& F, const Bound& bound) {
  Double4 E[Dim][Dim];
  for (int r = 0; r < Dim; ++r)
    for (int c = r; c < Dim; ++c) E[r][c] = 0.5 * (dot(F.column[r], F.column[c]) - (r == c ? 1.0 : 0.0));
  const Invariants e = invariants<Dim>(E);
  const Double4 mean = e.trace * (1.0 / Dim);
  const Double4 most = bound.first * e.trace + bound.second * (mean + e.spread);
  Long4 is = ~(most <= bound.limit); // true for NaN too
  if (!bound.compression) return is;
  const Double4 zero{}, least = mean - e.spread;
  const Double4 c = 2.0 / (1.0 + square_root(larger(1.0 + 2.0 * least, zero)));
  const Double4 pressed =
      bound.first * (0.5 * c * c * e.square - e.trace) + bound.second * c * larger(-least, zero);
  is |= ~(pressed <= bound.limit);
  if constexpr (Dim == 3) is |= ~(dot(F.column[0], cross(F.column[1], F.column[2])) > 0.0);
  return is;
}

// Bit n: the n-th row of the block may exceed the limit.
template <class Shape>
REND_INLINE std::uint64_t look_at(const PackedRows& rows, std::size_t block, int first_value,
                                  const Record* position, const Bound& bound) {
  const std::size_t begin = rows.begin(block), count = rows.rows_in(block);
  std::uint64_t found = 0;
  for (std::size_t n = 0; n < count; n += PackedRows::lanes) {
    Vector x[Shape::N];
    const Vector origin = gather(position, rows.index(0) + begin + n);
    x[0] = Vector{};
    for (int k = 1; k < Shape::N; ++k) x[k] = gather(position, rows.index(k) + begin + n) - origin;
    const Long4 is = exceed(mean_gradient<Shape>(rows.lanes_at(begin + n) + 4 * first_value, x), bound);
    for (std::size_t r = 0; r < PackedRows::lanes; ++r)
      found |= static_cast<std::uint64_t>(is[static_cast<int>(r)] & 1) << (n + r);
  }
  return count < 64 ? found & ((std::uint64_t{1} << count) - 1) : found;
}

struct Scan {
  const PackedRows& rows;
  int first_value;
  const Record* position;
  Bound bound;
  std::vector<std::size_t>& keys;
};

template <class Shape> REND_INLINE void run(const Scan& scan) {
  for (std::size_t block = 0; block < scan.rows.blocks(); ++block) {
    const std::uint64_t found = look_at<Shape>(scan.rows, block, scan.first_value, scan.position, scan.bound);
    if (found == 0) continue;
    const std::size_t begin = block * PackedRows::block_size;
    for (std::size_t key = begin; key < begin + PackedRows::block_size && key < scan.rows.keys(); ++key)
      if (scan.rows.live(key) && (found >> (scan.rows.row(key) - scan.rows.begin(block)) & 1))
        scan.keys.push_back(key);
  }
}

void run_kind(ElementKind kind, const Scan& scan) {
  switch (kind) {
  case ElementKind::Triangle:
    return at_width<run<SimplexLanes<2>>>(scan);
  case ElementKind::Quad:
    return at_width<run<QuadLanes>>(scan);
  case ElementKind::Tetrahedron:
    return at_width<run<SimplexLanes<3>>>(scan);
  case ElementKind::Hexahedron:
    return at_width<run<HexahedronLanes>>(scan);
  case ElementKind::Prism:
    return at_width<run<PrismLanes>>(scan);
  case ElementKind::Pyramid:
    return at_width<run<PyramidLanes>>(scan);
  }
}

} // namespace

ElementScan::ElementScan(const CriterionRequest& request, Quantity quantity)
    : rows_(request), quantity_(quantity), compression_(request.compression) {}

void ElementScan::scan(const Continuum::Part& part, const PackedRows& rows, const Record* position,
                       double threshold) {
  const ElasticMaterial& m = part.law->material();
  Bound bound{0, 1, threshold, compression_};
  if (quantity_ == Quantity::Stress) bound = {m.lambda, 2 * m.mu, threshold, compression_};
  // Margins for rounding: relative, and absolute of E.
  bound.limit -= 1e-9 * threshold + 1e-12 * (3 * bound.first + bound.second);
  const bool closest =
      part.law->model() == ElasticModel::Corotational && part.law->rotation() == Rotation::Polar;
  if (compression_ && !closest) bound.limit = -std::numeric_limits<double>::infinity(); // no bound is known
  run_kind(part.law->shape().kind, {rows, part.law->first_point(), position, bound, keys_});
}

namespace {

class LargestOfElements final : public Criterion {
public:
  LargestOfElements(const CriterionRequest& request, ElementScan::Quantity quantity)
      : scan_(request, quantity),
        tensor_of_(quantity == ElementScan::Quantity::Stress ? &stress_of : &strain_of),
        compression_{request.compression} {}

  void find(const ForceView& view, double threshold, std::vector<Candidate>& candidates) override {
    scan_.each_above(view, threshold, [&](Dart d) {
      scan_.continuum().each_of(
          d, view.position, nullptr, [&](const Continuum::Part& part, const CurrentUnit& now) {
            const double value = largest_principal(tensor_of_(part, now), compression_).value;
            if (value > threshold) candidates.push_back({value, d});
          });
    });
  }

  void rebind(const Changes& changes) override { scan_.rebind(changes); }
  void reserve_for_separations() override { scan_.reserve_for_separations(); }
  std::size_t bytes() const override { return scan_.bytes(); }

private:
  ElementScan scan_;
  Eigen::Matrix3d (*tensor_of_)(const Continuum::Part&, const CurrentUnit&); // σ [Pa] or ε, in world space
  Compression compression_;
};

} // namespace

std::unique_ptr<Criterion> largest_of_elements(const CriterionRequest& request,
                                               ElementScan::Quantity quantity) {
  return std::make_unique<LargestOfElements>(request, quantity);
}

std::string lacking_for_stress(const CriterionRequest& request) {
  if (!Continuum(request.map, request.interactions).empty()) return {};
  return "measures finite elements, but this body has no <elasticity>; with <springs> take atomic-spring, "
         "atomic-vertex or atomic-border";
}

} // namespace rend
