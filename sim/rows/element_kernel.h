// The kernel of mechanics/element_law.h: four elements at a time, in one pass over their data.
//
// For each kind of element, with or without rotation and damping: positions are gathered and transposed into
// lanes, F is computed at each integration point, R from the average F (for a quad of a sheet, at each point),
// and P = w R (σ − Z) is mapped by J⁻ᵀ to forces on the corners; where there is a Z, P stays in the frame and
// the forces are turned by R at last. Only J⁻¹ and w are read: 80 bytes for a tetrahedron, 640 for a
// hexahedron (its 24 × 24 stiffness matrix would be 4608). The points of a hexahedron are read twice, the
// second time from the L1 cache.
#pragma once

#include "sim/mechanics/element_law.h"
#include "sim/rows/element_stress.h"

namespace rend::lanes {

enum class FrameRotation { None, Qr, Polar };

// J⁻¹ of a point: F's column c is Σ_r D_r A[r][c].
template <int Dim> struct Inverse {
  Double4 A[Dim][Dim];
  Double4 weight;
  static constexpr std::size_t stride = (Dim * Dim + 1) * PackedRows::lanes;
  explicit REND_INLINE Inverse(const double* values) {
    for (int r = 0; r < Dim; ++r)
      for (int c = 0; c < Dim; ++c) A[r][c] = load_four(values + 4 * (Dim * r + c));
    weight = load_four(values + 4 * Dim * Dim);
  }
};

template <class Shape, int Dim>
REND_INLINE Matrix<Dim> gradient_at(int g, const Vector* D, const Inverse<Dim>& inverse) {
  Matrix<Dim> F;
  for (int c = 0; c < Dim; ++c) {
    F.column[c] = inverse.A[0][c] * D[Shape::column(g, 0)];
    for (int r = 1; r < Dim; ++r) F.column[c] = F.column[c] + inverse.A[r][c] * D[Shape::column(g, r)];
  }
  return F;
}

// Three properties are tested at run time: whether forces go to vertices or corners, whether a block writes
// outside its part's vertices, and, for elements with several points, whether the material is damped. The cost
// is not measurable, and the compiler would otherwise generate a kernel for each case.
enum class Damping { No, Yes, Asked };

template <class Shape, FrameRotation turning, Damping damping, bool enhanced = false> struct ElementLanes {
  static constexpr int N = Shape::N, Dim = Shape::dim;
  static constexpr bool flat =
      turning == FrameRotation::None && Dim == 2; // a linear sheet stores its rest axes
  static constexpr bool turned = turning != FrameRotation::None;
  static constexpr Rotation rotation = turning == FrameRotation::Qr ? Rotation::Qr : Rotation::Polar;
  // whether the energy changes when a frame alone turns (mechanics/element_of.h)
  static constexpr bool moments =
      turned && (rotation == Rotation::Qr || (Dim == 3 && Shape::points > 1) || enhanced);
  static constexpr bool framed = Dim == 3 && (moments || enhanced); // P is computed in the rotated frame
  static constexpr int frames = turned && rotates_per_point(Dim, Shape::points) ? Shape::points : 1;

  // Forces on the corners of the rows at .. at + 3.
  static REND_INLINE void forces(const KernelArguments& a, const ElasticMaterial& m, std::size_t at,
                                 Vector* f) {
    const double* values = a.rows.lanes_at(at);
    if constexpr (Shape::points == 1) // longer data are prefetched well by the processor
      for (std::size_t n = 0; n < Inverse<Dim>::stride; n += 8) prefetch<3072>(values + n);
    Matrix<Dim> R[frames];
    if constexpr (flat) {
      for (int c = 0; c < 2; ++c, values += 12)
        R[0].column[c] = {load_four(values), load_four(values + 4), load_four(values + 8)};
    }
    Vector x[N], D[Shape::columns_count], H[Shape::columns_count] = {};
    from_first_corner(a.position, a, at, x);
    Matrix<Dim> F[Shape::points], mean;
    Double4 volume{};
    const bool damped = damping == Damping::Asked ? a.damped : damping == Damping::Yes;
    if (turned || !damped) {
      Shape::columns(x, D);
      mean_gradient(values, D, F, mean, volume);
    }
    if constexpr (turned)
      for (int g = 0; g < frames; ++g) rotations_of<rotation, Dim>(frames == 1 ? mean : F[g], volume, R[g]);
    TurnedStress elastic[framed ? Shape::points : 1];
    Vector z{};
    if constexpr (framed && !turned) {
      const Double4 one = splat(1), zero{};
      R[0].column[0] = {one, zero, zero}, R[0].column[1] = {zero, one, zero},
      R[0].column[2] = {zero, zero, one};
    }
    if constexpr (framed)
      if (turned || !damped) z = stresses(m, values, R[0], F, mean, volume, elastic);
    if (damped) {
      Vector v[N];
      from_first_corner(a.velocity, a, at, v);
      for (int n = 1; n < N; ++n) x[n] = x[n] + splat(m.damping) * v[n];
      Shape::columns(x, D);
      if constexpr (framed && enhanced) {
        for (int g = 0; g < Shape::points; ++g)
          F[g] = gradient_at<Shape, Dim>(
              g, D, Inverse<Dim>(values + static_cast<std::size_t>(g) * Inverse<Dim>::stride));
        enhanced_stresses(m, values, R[0], F, elastic);
      }
    }
    for (int g = 0; g < Shape::points; ++g) {
      const Inverse<Dim> inverse(values + static_cast<std::size_t>(g) * Inverse<Dim>::stride);
      Double4 sheet_z;
      if constexpr (moments && Dim == 2) sheet_z = sheet_moment(R[g], F[g], inverse.weight, m.lambda, m.mu);
      if (damped && !enhanced) F[g] = gradient_at<Shape, Dim>(g, D, inverse);
      Matrix<Dim> P;
      if constexpr (framed) {
        if (damped && !enhanced) elastic[g] = turned_stress<false>(R[0], F[g], inverse.weight, m.lambda, m.mu);
        P = with_moment(elastic[g], inverse.weight, z);
      } else if constexpr (Dim == 3 && !turned)
        P = stress(F[g], inverse.weight, m.lambda, m.mu);
      else if constexpr (Shape::points == 1 && turning == FrameRotation::Polar && damping == Damping::No)
        P = stretched_stress<Dim>(R[0], F[0], inverse.weight, m.lambda, m.mu);
      else
        P = rotated_stress<Dim>(R[frames == 1 ? 0 : g], F[g], inverse.weight, m.lambda, m.mu);
      if constexpr (moments && Dim == 2) P.column[0] = P.column[0] - sheet_z * R[g].column[1];
      for (int r = 0; r < Dim; ++r) {
        Vector& sum = H[Shape::column(g, r)];
        for (int c = 0; c < Dim; ++c) sum = sum + inverse.A[r][c] * P.column[c];
      }
    }
    // What was computed in the rotated frame is turned: the columns or the corners, what is less.
    constexpr bool columns = Shape::columns_count < N;
    if constexpr (framed && turned && columns) turn_all(R[0], H, Shape::columns_count);
    Shape::corners(H, f);
    if constexpr (framed && turned && !columns) turn_all(R[0], f, N);
  }

private:
  // w σ at each point, in the rotated frame, and z of the moment on the frame, per volume.
  static REND_INLINE Vector stresses(const ElasticMaterial& m, const double* values, const Matrix<3>& R,
                                     const Matrix<3>* F, const Matrix<3>& mean, const Double4& volume,
                                     TurnedStress* stress) {
    Vector against{};
    if constexpr (enhanced) {
      against = enhanced_stresses(m, values, R, F, stress);
      if constexpr (!turned) return Vector{};
    }
    for (int g = 0; !enhanced && g < Shape::points; ++g) {
      const Double4 weight = load_four(values + (static_cast<std::size_t>(g) + 1) * Inverse<3>::stride - 4);
      stress[g] =
          turned_stress < rotation == Rotation::Qr && Shape::points == 1 > (R, F[g], weight, m.lambda, m.mu);
      against = against + moment_against(stress[g]);
    }
    const Double4 share = volume > 0.0 ? -1.0 / volume : Double4{};
    return moment_of<rotation>(R, mean, share * against);
  }

  // w σ at each point with the share of enhanced modes (mechanics/enhanced_modes.h). Returns −t: to that of σ
  // without them, axial(E σ) of their strain E is added.
  static REND_INLINE Vector enhanced_stresses(const ElasticMaterial& m, const double* values,
                                              const Matrix<3>& R, const Matrix<3>* F, TurnedStress* stress) {
    const Double4 one = splat(1), half = splat(0.5);
    for (int g = 0; g < Shape::points; ++g) stress[g] = turned_stress<false>(R, F[g], one, m.lambda, m.mu);
    const double* modes = values + Shape::points * Inverse<3>::stride;
    Vector H[3], r[3];
    for (int a = 0; a < 3; ++a, modes += 12)
      H[a] = {load_four(modes), load_four(modes + 4), load_four(modes + 8)};
    for (int a = 0; a < 3; ++a) {
      TurnedStress sum{};
      for (int g = 0; g < Shape::points; ++g) add_signed(sum, stress[g], g >> a & 1);
      r[a] = {sum.on[0] * H[a].x + sum.off[2] * H[a].y + sum.off[1] * H[a].z,
              sum.off[2] * H[a].x + sum.on[1] * H[a].y + sum.off[0] * H[a].z,
              sum.off[1] * H[a].x + sum.off[0] * H[a].y + sum.on[2] * H[a].z};
    }
    amplify(modes, r);
    TurnedStress share[3]; // strain of each mode
    for (int a = 0; a < 3; ++a) {
      const Vector &h = H[a], &alpha = r[a];
      share[a] = {{alpha.x * h.x, alpha.y * h.y, alpha.z * h.z},
                  {half * (alpha.y * h.z + alpha.z * h.y), half * (alpha.x * h.z + alpha.z * h.x),
                   half * (alpha.x * h.y + alpha.y * h.x)},
                  {}};
    }
    Vector against{};
    for (int g = 0; g < Shape::points; ++g) {
      TurnedStress E{};
      for (int a = 0; a < 3; ++a) add_signed(E, share[a], g >> a & 1);
      against = against - axial_product(E, stress[g]);
      const Double4 weight = load_four(values + (static_cast<std::size_t>(g) + 1) * Inverse<3>::stride - 4);
      const Double4 trace = m.lambda * (E.on[0] + E.on[1] + E.on[2]);
      for (int n = 0; n < 3; ++n) {
        stress[g].on[n] = weight * stress[g].on[n] + (2 * m.mu) * E.on[n] + trace;
        stress[g].off[n] = weight * stress[g].off[n] + (2 * m.mu) * E.off[n];
      }
      against = against + moment_against(stress[g]);
    }
    return against;
  }

  // σ − Z.
  static REND_INLINE Matrix<3> with_moment(const TurnedStress& s, const Double4& weight, const Vector& moment) {
    const Vector z = weight * moment;
    const Double4 &yz = s.off[0], &xz = s.off[1], &xy = s.off[2];
    if constexpr (rotation == Rotation::Qr)
      return {{{s.on[0], xy - z.z, xz - z.y}, {xy, s.on[1], yz - z.x}, {xz, yz, s.on[2]}}};
    return {{{s.on[0], xy - z.z, xz + z.y}, {xy + z.z, s.on[1], yz - z.x}, {xz - z.y, yz + z.x, s.on[2]}}};
  }

  static REND_INLINE void from_first_corner(const Record* records, const KernelArguments& a, std::size_t at,
                                            Vector* x) {
    const Vector first = gather(records, a.rows.index(0) + at);
    x[0] = Vector{};
    for (int n = 1; n < N; ++n) x[n] = gather(records, a.rows.index(n) + at) - first;
  }

  // F at each point, and Σ w F / Σ w. For padding, 0/0 becomes 0.
  static REND_INLINE void mean_gradient(const double* values, const Vector* D, Matrix<Dim>* F,
                                        Matrix<Dim>& mean, Double4& volume) {
    for (int g = 0; g < Shape::points; ++g) {
      const Inverse<Dim> inverse(values + static_cast<std::size_t>(g) * Inverse<Dim>::stride);
      F[g] = gradient_at<Shape, Dim>(g, D, inverse);
      if constexpr (!turned) continue;
      volume += inverse.weight;
      for (int c = 0; c < Dim; ++c)
        mean.column[c] =
            g == 0 ? inverse.weight * F[g].column[c] : mean.column[c] + inverse.weight * F[g].column[c];
    }
    if constexpr (Shape::points == 1) {
      mean = F[0];
    } else if constexpr (turned) {
      const Double4 share = volume > 0.0 ? 1.0 / volume : Double4{};
      for (int c = 0; c < Dim; ++c) mean.column[c] = share * mean.column[c];
    }
  }
};

// The rows of a block; `first`: index column of the first record that is written to; `whole`: all of them
// belong to this part.
template <class Lanes>
REND_INLINE void run_rows(const KernelArguments& a, const ElasticMaterial& m, int first, std::size_t block,
                          bool whole) {
  const std::size_t begin = a.rows.begin(block), end = begin + a.rows.padded_in(block);
  for (std::size_t at = begin; at < end; at += PackedRows::lanes) {
    Vector f[Lanes::N];
    Lanes::forces(a, m, at, f);
    if (whole)
      for (int n = 0; n < Lanes::N; ++n) scatter<true>(a, a.rows.index(first + n) + at, f[n]);
    else
      for (int n = 0; n < Lanes::N; ++n) scatter<false>(a, a.rows.index(first + n) + at, f[n]);
  }
}

template <class Lanes>
REND_INLINE void run_blocks(const KernelArguments& a, const ElasticMaterial& m, bool corners) {
  const int first = corners ? Lanes::N : 0;
  for (std::size_t block = a.first; block < a.last; ++block) {
    const PackedRows::Range range = a.rows.range(block);
    const bool whole = corners || (range.low >= a.low && range.high < a.high);
    if (whole || (range.low < a.high && range.high >= a.low)) run_rows<Lanes>(a, m, first, block, whole);
  }
}

template <class Shape, FrameRotation turning>
REND_INLINE void run_damped_or_not(const KernelArguments& a, const ElasticMaterial& m, bool corners) {
  if constexpr (Shape::points > 1)
    run_blocks<ElementLanes<Shape, turning, Damping::Asked>>(a, m, corners);
  else if (a.damped)
    run_blocks<ElementLanes<Shape, turning, Damping::Yes>>(a, m, corners);
  else
    run_blocks<ElementLanes<Shape, turning, Damping::No>>(a, m, corners);
}

template <class Shape> REND_INLINE void run_enhanced_elements(const KernelArguments& a, bool corners) {
  const auto& law = static_cast<const ElementLaw&>(a.law);
  const ElasticMaterial& m = law.material();
  if (law.model() == ElasticModel::Linear)
    run_blocks<ElementLanes<Shape, FrameRotation::None, Damping::Asked, true>>(a, m, corners);
  else if (law.rotation() == Rotation::Qr)
    run_blocks<ElementLanes<Shape, FrameRotation::Qr, Damping::Asked, true>>(a, m, corners);
  else
    run_blocks<ElementLanes<Shape, FrameRotation::Polar, Damping::Asked, true>>(a, m, corners);
}

// Chooses the loop for a law; run by at_width.
template <class Shape> REND_INLINE void run_elements(const KernelArguments& a, bool corners) {
  const auto& law = static_cast<const ElementLaw&>(a.law);
  if (law.model() == ElasticModel::Linear)
    run_damped_or_not<Shape, FrameRotation::None>(a, law.material(), corners);
  else if (law.rotation() == Rotation::Qr)
    run_damped_or_not<Shape, FrameRotation::Qr>(a, law.material(), corners);
  else
    run_damped_or_not<Shape, FrameRotation::Polar>(a, law.material(), corners);
}

// In one file each, element_kernel_<kind>.cpp, since they take long to compile. `corners`: as
// Kernel::corner_forces.
void triangles(const KernelArguments& a, bool corners);
void quads(const KernelArguments& a, bool corners);
void tetrahedra(const KernelArguments& a, bool corners);
void hexahedra(const KernelArguments& a, bool corners);
void prisms(const KernelArguments& a, bool corners);
void pyramids(const KernelArguments& a, bool corners);
void enhanced_hexahedra(const KernelArguments& a, bool corners);

} // namespace rend::lanes
