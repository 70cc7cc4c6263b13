// The hinge law (mechanics/hinge_law.h), four hinges at a time.
//
// With h = AB, L = |h|, a_i the vector from A to the midpoint of side i's outer vertices, n1 = h × a1 and n2 =
// a2 × h, the angle is computed as in the law, operation by operation, so that a body at rest has zero force,
// to the bit. The gradient uses the same normals, without the unit vector and two more cross products:
//
//   ∂θ/∂P_i = −L n_i/|n_i|²,   t_i = a_i·h/L²
//
// A and B are the same vertices on both sides: they are read once, and with forces on vertices also written
// once. Without length or area the gradient is 0, as in the law; the values of padding are 0, and so is its
// moment.
#include "sim/base/arc_tangent.h"
#include "sim/mechanics/hinge_law.h"
#include "sim/rows/lanes.h"

namespace rend {
namespace {

using namespace lanes;

constexpr double nothing = 1e-290; // [m⁴]: its inverse is still finite

struct Side {
  Vector arm, normal;
  Vector turn; // ∂θ/∂P
  Double4 t;   // position of P's projection on AB, 0 at A
};

struct Hinge {
  Side side[2];
  Double4 angle;
  Double4 fade; // φ₁ φ₂
};

REND_INLINE bool any(const Long4& lanes) {
  return (lanes[0] | lanes[1] | lanes[2] | lanes[3]) != 0;
}

// From A to the midpoint of the outer vertices of side 0 or 1.
REND_INLINE Vector arm_of(const KernelArguments& a, const Record* records, const Vector& from, int side,
                          std::size_t at) {
  return splat(0.5) * ((gather(records, a.rows.index(4 * side + 2) + at) - from) +
                       (gather(records, a.rows.index(4 * side + 3) + at) - from));
}

REND_INLINE void measure(const KernelArguments& a, std::size_t at, const Double4& least, Hinge& hinge) {
  Side &one = hinge.side[0], &two = hinge.side[1];
  const Vector from = gather(a.position, a.rows.index(0) + at);
  const Vector h = gather(a.position, a.rows.index(1) + at) - from;
  const Double4 h2 = dot(h, h), length = square_root(h2), share = 1.0 / h2;
  one.arm = arm_of(a, a.position, from, 0, at);
  two.arm = arm_of(a, a.position, from, 1, at);
  one.normal = cross(h, one.arm);
  two.normal = cross(two.arm, h);
  const Double4 sine = dot(cross(one.normal, two.normal), h) / length;
  const Double4 square1 = dot(one.normal, one.normal), square2 = dot(two.normal, two.normal);
  const Long4 turns = (square1 > nothing) & (square2 > nothing),
              crushed = (square1 < least) | (square2 < least);
  hinge.fade = splat(1);
  if (any(crushed)) { // rarely
    hinge.fade *= square1 < least ? square1 / least : splat(1);
    hinge.fade *= square2 < least ? square2 / least : splat(1);
  }
  one.turn = (turns ? -length / square1 : Double4{}) * one.normal;
  two.turn = (turns ? -length / square2 : Double4{}) * two.normal;
  hinge.angle = turns ? arc_tangent_of(sine, dot(one.normal, two.normal)) : Double4{};
  for (Side& side : hinge.side) side.t = turns ? dot(side.arm, h) * share : Double4{};
}

// θ̇, from velocities relative to A's.
REND_INLINE Double4 rate_of(const KernelArguments& a, std::size_t at, const Hinge& hinge) {
  const Vector from = gather(a.velocity, a.rows.index(0) + at);
  const Vector h = gather(a.velocity, a.rows.index(1) + at) - from;
  Double4 rate{};
  for (int n = 0; n < 2; ++n) {
    const Side& side = hinge.side[n];
    rate += dot(side.turn, arm_of(a, a.velocity, from, n, at) - side.t * h);
  }
  return rate;
}

REND_INLINE Double4 wrapped(const Double4& angle) { // into (−π, π]
  const Double4 lowered = angle > pi ? angle - 2 * pi : angle;
  return angle <= -pi ? angle + 2 * pi : lowered;
}

// The negatives of the forces on P of both sides, and the positions of P's projections on AB.
struct Pulls {
  Vector pull[2];
  Double4 t[2];
};

template <bool damped> REND_INLINE void pull_at(const KernelArguments& a, std::size_t at, Pulls& pulls) {
  const double* values = a.rows.lanes_at(at); // k, damping if any, rest, least
  Hinge hinge;
  measure(a, at, load_four(values + (damped ? 12 : 8)), hinge);
  Double4 moment = load_four(values) * wrapped(hinge.angle - load_four(values + (damped ? 8 : 4)));
  if constexpr (damped) moment += load_four(values + 4) * (hinge.fade * rate_of(a, at, hinge));
  moment *= hinge.fade;
  for (int n = 0; n < 2; ++n) {
    pulls.pull[n] = moment * hinge.side[n].turn;
    pulls.t[n] = hinge.side[n].t;
  }
}

template <bool corners, bool whole>
REND_INLINE void add(const KernelArguments& a, std::size_t at, const Pulls& pulls) {
  constexpr int place = corners ? 8 : 0; // index column
  Vector end_a[2], end_b[2];
  for (int n = 0; n < 2; ++n) {
    end_b[n] = pulls.t[n] * pulls.pull[n];
    end_a[n] = pulls.pull[n] - end_b[n];
    const Vector outer = splat(-0.5) * pulls.pull[n];
    scatter<whole>(a, a.rows.index(place + 4 * n + 2) + at, outer);
    scatter<whole>(a, a.rows.index(place + 4 * n + 3) + at, outer);
  }
  if constexpr (corners) {
    for (int n = 0; n < 2; ++n) {
      scatter<whole>(a, a.rows.index(place + 4 * n) + at, end_a[n]);
      scatter<whole>(a, a.rows.index(place + 4 * n + 1) + at, end_b[n]);
    }
  } else {
    scatter<whole>(a, a.rows.index(0) + at, end_a[0] + end_a[1]);
    scatter<whole>(a, a.rows.index(1) + at, end_b[0] + end_b[1]);
  }
}

// All angles of a block first, then all forces: in short loops the divisions of several hinges overlap in the
// processor's pipeline.
template <bool damped, bool corners, bool whole>
REND_INLINE void run_rows(const KernelArguments& a, std::size_t block) {
  const std::size_t begin = a.rows.begin(block), count = a.rows.padded_in(block);
  Pulls pulls[PackedRows::block_size / PackedRows::lanes];
  for (std::size_t n = 0; n < count; n += PackedRows::lanes)
    pull_at<damped>(a, begin + n, pulls[n / PackedRows::lanes]);
  for (std::size_t n = 0; n < count; n += PackedRows::lanes)
    add<corners, whole>(a, begin + n, pulls[n / PackedRows::lanes]);
}

template <bool damped, bool corners> REND_INLINE void run(const KernelArguments& a) {
  for (std::size_t block = a.first; block < a.last; ++block) {
    const PackedRows::Range range = a.rows.range(block);
    if (corners || (range.low >= a.low && range.high < a.high))
      run_rows<damped, corners, true>(a, block);
    else if (range.low < a.high && range.high >= a.low)
      run_rows<damped, corners, false>(a, block);
  }
}

} // namespace

Kernel hinge_kernel() {
  return {[](const ForceLaw& law) { return &law == hinge_law().get(); },
          [](const KernelArguments& a) {
            a.damped ? at_width<run<true, false>>(a) : at_width<run<false, false>>(a);
          },
          [](const KernelArguments& a) {
            a.damped ? at_width<run<true, true>>(a) : at_width<run<false, true>>(a);
          }};
}

} // namespace rend
