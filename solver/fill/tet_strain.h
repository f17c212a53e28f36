// Strain and stress of eight tetrahedra at a time from the displacements of their corners, for the time step and for
// output. L is Lanes or Floats. Differences between corners are computed in double precision. All further results are
// small against 1 or relative to it, so that single precision is sufficient for a time step.
#pragma once
#include "solver/fill/fill_pass.h"
#include "solver/fill/mohr_coulomb.h"

namespace voussoir::tet {

/// Three numbers of each of four corners, as differences from the first corner, and the mean of the fourth numbers.
template <class L>
struct Nodes {
  Triple<L> edge[3];
  L mean;
};
template <class L>
[[gnu::always_inline]] inline Nodes<L> gather_nodes(const double* pose, const TetBatch& batch) {
  Triple<Lanes> at[4];
  Lanes fourth[4];
  for (int k = 0; k < 4; k += 2) {
    Lanes rows[lane_count];
    for (int lane = 0; lane < lane_count; ++lane) {
      const Quad a = load_quad(pose + node_width * std::size_t(batch.node[k][lane]));
      const Quad b = load_quad(pose + node_width * std::size_t(batch.node[k + 1][lane]));
      rows[lane] = pair(a, b);
    }
    transpose(rows);
    at[k] = {rows[0], rows[1], rows[2]}, fourth[k] = rows[3];
    at[k + 1] = {rows[4], rows[5], rows[6]}, fourth[k + 1] = rows[7];
  }
  Nodes<L> n;
  for (int k = 0; k < 3; ++k) {
    const Triple<Lanes> d = at[k + 1] - at[0];
    n.edge[k] = {numbers_of<L>(d.x), numbers_of<L>(d.y), numbers_of<L>(d.z)};
  }
  n.mean = numbers_of<L>(0.25 * (fourth[0] + fourth[1] + fourth[2] + fourth[3]));
  return n;
}

/// In the reference placement: gradients of the shape functions of corners 1 to 3 (1/m), and the volume (m3).
template <class L>
struct Shape {
  Triple<L> gradient[3];
  L volume;
};
template <class L>
[[gnu::always_inline]] inline Shape<L> shape_of(const FillModel& fill, std::size_t index) {
  Shape<L> shape;
  if constexpr (std::is_same_v<L, Floats>) {
    const auto* rows = reinterpret_cast<const Singles*>(&fill.shapes[shape_rows * lane_count * index]);
    for (int k = 0; k < 3; ++k) shape.gradient[k] = {rows[3 * k], rows[3 * k + 1], rows[3 * k + 2]};
    shape.volume = rows[9];
  } else {
    const Nodes<L> at = gather_nodes<L>(fill.place.data(), fill.batches[index]);
    for (int k = 0; k < 3; ++k) shape.gradient[k] = cross(at.edge[(k + 1) % 3], at.edge[(k + 2) % 3]);
    const L volume6 = dot(at.edge[0], shape.gradient[0]), by = 1.0 / volume6;
    for (auto& g : shape.gradient) g = by * g;
    shape.volume = (1.0 / 6.0) * volume6;
  }
  return shape;
}

/// Displacement gradient H = F − 1.
template <class L>
[[gnu::always_inline]] inline Tensor<L> gradient(const Shape<L>& shape, const Nodes<L>& n) {
  Tensor<L> h;
  const auto& g = shape.gradient;
  const auto& d = n.edge;
  const auto row = [&](L(&to)[3], L first, L second, L third) {
    to[0] = first * g[0].x + second * g[1].x + third * g[2].x;
    to[1] = first * g[0].y + second * g[1].y + third * g[2].y;
    to[2] = first * g[0].z + second * g[1].z + third * g[2].z;
  };
  row(h.m[0], d[0].x, d[1].x, d[2].x);
  row(h.m[1], d[0].y, d[1].y, d[2].y);
  row(h.m[2], d[0].z, d[1].z, d[2].z);
  return h;
}

/// det(1 + H) − 1 without cancellation.
template <class L>
[[gnu::always_inline]] inline L volume_change(const Tensor<L>& h) {
  const auto& m = h.m;
  const L a = m[1][1] * m[2][2] - m[1][2] * m[2][1], b = m[1][0] * m[2][2] - m[1][2] * m[2][0],
          c = m[1][0] * m[2][1] - m[1][1] * m[2][0];
  const L second = m[0][0] * m[1][1] - m[0][1] * m[1][0] + m[0][0] * m[2][2] - m[0][2] * m[2][0] + a;
  return m[0][0] + m[1][1] + m[2][2] + second + m[0][0] * a - m[0][1] * b + m[0][2] * c;
}

/// Keeps results finite for a tetrahedron that has nearly lost its volume; the report gives its position.
constexpr double least_volume = 0.02;  // share of the reference volume
template <class L>
[[gnu::always_inline]] inline L clipped(L change) {
  return larger(change, all_lanes<L>(least_volume - 1.0));
}

/// The function ϑ(J), which replaces ln J, and its slope dϑ/d ln J. In compression ϑ = ½ (J − 1/J), which resists the
/// loss of all volume. In extension ϑ = y + ½ y² + ⅓ y³ with y = 1 − 1/J, the beginning of the series of ln J. Its
/// slope 1 − y³ decreases with J, so that a widely opened element does not become stiffer. Both agree with ln J to
/// second order.
template <class L>
struct Volumetric {
  L strain, slope, by;  // by: 1/J
};
template <class L>
[[gnu::always_inline]] inline Volumetric<L> volumetric(L change) {
  const L volume = 1.0 + change, by = 1.0 / volume, y = change * by;
  const LaneMask grown = less(all_lanes<L>(0.0), change);
  return {select(grown, y * (1.0 + y * (0.5 + (1.0 / 3.0) * y)), 0.5 * change * (1.0 + by)),
          select(grown, 1.0 - y * y * y, 0.5 * (volume + by)), by};
}

/// dev ½ ln b from b − 1, to fourth order in the elastic strain. b is first divided by its mean.
template <class L>
[[gnu::always_inline]] inline Symmetric<L> elastic_deviator(const Symmetric<L>& less_one) {
  const L sum = trace(less_one), scale = 3.0 / (3.0 + sum), mean = (1.0 / 3.0) * sum;
  const Symmetric<L> b = {scale * (less_one.xx - mean), scale * (less_one.yy - mean), scale * (less_one.zz - mean),
                          scale * less_one.xy,          scale * less_one.xz,          scale * less_one.yz};
  // ½ b − ¼ b² + ⅙ b³; without a trace, dev b³ = ½ tr b² b (Cayley–Hamilton).
  const Symmetric<L> b2 = coaxial_product(b, b);
  const L squares = trace(b2);
  return (0.5 + (1.0 / 12.0) * squares) * b - all_lanes<L>(0.25) * deviator(b2);
}

template <class L>
struct Strain {
  Tensor<L> h, f, cofactor;  // F − 1, F, its cofactor
  L change;                  // J − 1
  Symmetric<L> e;
};

template <class L>
[[gnu::always_inline]] inline Tensor<L> cofactor(const Tensor<L>& f) {
  const auto& m = f.m;
  const auto minor = [&](int r, int s, int c, int d) { return m[r][c] * m[s][d] - m[r][d] * m[s][c]; };
  return {{{minor(1, 2, 1, 2), minor(1, 2, 2, 0), minor(1, 2, 0, 1)},
           {minor(2, 0, 1, 2), minor(2, 0, 2, 0), minor(2, 0, 0, 1)},
           {minor(0, 1, 1, 2), minor(0, 1, 2, 0), minor(0, 1, 0, 1)}}};
}

/// Whether any of the eight has ever yielded or was built deformed. If not, their plastic memory is zero and need not
/// be read.
[[gnu::always_inline]] inline bool has_flowed(const std::uint8_t* yield) {
  std::uint64_t flags;
  std::memcpy(&flags, yield, sizeof(flags));
  return flags != 0;
}

/// A + Aᵀ + A Aᵀ = (1 + A)(1 + A)ᵀ − 1 without cancellation.
template <class L>
[[gnu::always_inline]] inline Symmetric<L> square_less_one(const Tensor<L>& a) {
  const auto& m = a.m;
  const auto rows = [&](int i, int j) { return m[i][0] * m[j][0] + m[i][1] * m[j][1] + m[i][2] * m[j][2]; };
  return {2.0 * m[0][0] + rows(0, 0),     2.0 * m[1][1] + rows(1, 1),     2.0 * m[2][2] + rows(2, 2),
          m[0][1] + m[1][0] + rows(0, 1), m[0][2] + m[2][0] + rows(0, 2), m[1][2] + m[2][1] + rows(1, 2)};
}

/// `plastic`: rows of plastic memory, or null without plastic flow.
template <class L>
[[gnu::always_inline]] inline Strain<L> strain_of(const Shape<L>& shape, const Nodes<L>& n, const Lanes* plastic) {
  Strain<L> s;
  s.h = gradient(shape, n);
  s.change = clipped(volume_change(s.h));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) s.f.m[i][j] = i == j ? 1.0 + s.h.m[i][j] : s.h.m[i][j];
  s.cofactor = cofactor(s.f);
  // b − 1 = H + Hᵀ + H Hᵀ + F (Cp⁻¹ − 1) Fᵀ
  Symmetric<L> total = square_less_one(s.h);
  if (plastic) {
    const Symmetric<L> memory = {numbers_of<L>(plastic[0]), numbers_of<L>(plastic[1]), numbers_of<L>(plastic[2]),
                                 numbers_of<L>(plastic[3]), numbers_of<L>(plastic[4]), numbers_of<L>(plastic[5])};
    total = total + push(s.f, memory);
  }
  s.e = elastic_deviator(total);
  return s;
}

/// Whether the lanes may yield, with the elastic deviator `e` and the mean stress `p` (Pa).
template <class L>
[[gnu::always_inline]] inline LaneMask may_flow(const FillLaw& law, const Symmetric<L>& e, L p) {
  const double shear2 = 4.0 * law.shear * law.shear;
  return ~surely_elastic(law, shear2 * inner(e, e), p);
}

/// Computes the plastic flow of yielding lanes and returns these lanes. It changes the plastic memory, the yield bits,
/// the elastic deviator and the mean stress. `dissipated`, the final stress times the plastic strain (J/m3), is set if
/// any lane yields.
template <class L>
LaneMask flow(const FillLaw& law, const Strain<L>& s, LaneMask lanes, Lanes* plastic, std::uint8_t* yield,
              Symmetric<L>& e, L& p, L& dissipated);

/// Kirchhoff stress τ = 2 μ e + p dϑ/d ln J, Pa.
template <class L>
[[gnu::always_inline]] inline Symmetric<L> kirchhoff(const FillLaw& law, const Strain<L>& s, L slope, L p) {
  const L round = p * slope;
  const Symmetric<L> dev = all_lanes<L>(2.0 * law.shear) * s.e;
  return {dev.xx + round, dev.yy + round, dev.zz + round, dev.xy, dev.xz, dev.yz};
}

}  // namespace voussoir::tet
