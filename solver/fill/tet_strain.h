// Eight tetrahedra at a time: from the displacements of their corners to strain and stress, for the step and for what
// is read off a state.
#pragma once
#include "solver/fill/fill_pass.h"
#include "solver/fill/mohr_coulomb.h"

namespace voussoir::tet {

using Vector = Triple<Lanes>;

/// Displacements of the four corners, and the fourth number of each.
struct Nodes {
  Vector u[4];
  Lanes mean[4];
};
[[gnu::always_inline]] inline Nodes gather_nodes(const double* pose, const TetBatch& batch) {
  Nodes n;
  for (int k = 0; k < 4; k += 2) {
    Lanes rows[lane_count];
    for (int lane = 0; lane < lane_count; ++lane) {
      const Quad a = load_quad(pose + node_width * std::size_t(batch.node[k][lane]));
      const Quad b = load_quad(pose + node_width * std::size_t(batch.node[k + 1][lane]));
      rows[lane] = pair(a, b);
    }
    transpose(rows);
    n.u[k] = {rows[0], rows[1], rows[2]}, n.mean[k] = rows[3];
    n.u[k + 1] = {rows[4], rows[5], rows[6]}, n.mean[k + 1] = rows[7];
  }
  return n;
}

/// In the reference placement: six times the volume (m3), and its products with the gradients of the shape functions
/// of corners 1 to 3 (m2), which are those of the edges from corner 0.
struct Shape {
  Vector area[3];
  Lanes volume6;
};
[[gnu::always_inline]] inline Shape shape_of(const double* place, const TetBatch& batch) {
  const Nodes at = gather_nodes(place, batch);
  const Vector e[3] = {at.u[1] - at.u[0], at.u[2] - at.u[0], at.u[3] - at.u[0]};
  Shape shape;
  for (int k = 0; k < 3; ++k) shape.area[k] = cross(e[(k + 1) % 3], e[(k + 2) % 3]);
  shape.volume6 = dot(e[0], shape.area[0]);
  return shape;
}

/// Displacement gradient H = F − 1.
[[gnu::always_inline]] inline Tensor<Lanes> gradient(const Shape& shape, const Nodes& n) {
  Tensor<Lanes> h;
  const Lanes by = 1.0 / shape.volume6;
  const Vector d[3] = {by * (n.u[1] - n.u[0]), by * (n.u[2] - n.u[0]), by * (n.u[3] - n.u[0])};
  const auto row = [&](Lanes(&to)[3], Lanes first, Lanes second, Lanes third) {
    to[0] = first * shape.area[0].x + second * shape.area[1].x + third * shape.area[2].x;
    to[1] = first * shape.area[0].y + second * shape.area[1].y + third * shape.area[2].y;
    to[2] = first * shape.area[0].z + second * shape.area[1].z + third * shape.area[2].z;
  };
  row(h.m[0], d[0].x, d[1].x, d[2].x);
  row(h.m[1], d[0].y, d[1].y, d[2].y);
  row(h.m[2], d[0].z, d[1].z, d[2].z);
  return h;
}

/// det(1 + H) − 1 without cancellation.
[[gnu::always_inline]] inline Lanes volume_change(const Tensor<Lanes>& h) {
  const auto& m = h.m;
  const Lanes a = m[1][1] * m[2][2] - m[1][2] * m[2][1], b = m[1][0] * m[2][2] - m[1][2] * m[2][0],
              c = m[1][0] * m[2][1] - m[1][1] * m[2][0];
  const Lanes second = m[0][0] * m[1][1] - m[0][1] * m[1][0] + m[0][0] * m[2][2] - m[0][2] * m[2][0] + a;
  return m[0][0] + m[1][1] + m[2][2] + second + m[0][0] * a - m[0][1] * b + m[0][2] * c;
}

/// A tetrahedron that has all but lost its volume is kept from infinity; the report says where.
constexpr double least_volume = 0.02;  // of the reference
[[gnu::always_inline]] inline Lanes clipped(Lanes change) {
  return larger(change, splat(least_volume - 1.0));
}

/// θ for ln J, and dθ/d ln J: ½ (J − 1/J) in compression, which resists the loss of all volume; y + ½ y² + ⅓ y³ with
/// y = 1 − 1/J in extension, the series of ln J, whose slope 1 − y³ falls with J, so that what has been torn wide open
/// is not stiffer than it was. Both agree with ln J to second order.
struct Volumetric {
  Lanes strain, slope, by;  // by: 1/J
};
[[gnu::always_inline]] inline Volumetric volumetric(Lanes change) {
  const Lanes volume = 1.0 + change, by = 1.0 / volume, y = change * by;
  const LaneMask grown = less(splat(0.0), change);
  return {select(grown, y * (1.0 + y * (0.5 + (1.0 / 3.0) * y)), 0.5 * change * (1.0 + by)),
          select(grown, 1.0 - y * y * y, 0.5 * (volume + by)), by};
}

/// dev ½ ln b from b − 1, to fourth order in the elastic strain. The mean of b is divided out first.
[[gnu::always_inline]] inline Symmetric<Lanes> elastic_deviator(const Symmetric<Lanes>& less_one) {
  const Lanes sum = trace(less_one), scale = 3.0 / (3.0 + sum), mean = (1.0 / 3.0) * sum;
  const Symmetric<Lanes> b = {scale * (less_one.xx - mean), scale * (less_one.yy - mean), scale * (less_one.zz - mean),
                              scale * less_one.xy,          scale * less_one.xz,          scale * less_one.yz};
  // ½ b − ¼ b² + ⅙ b³; without a trace, dev b³ = ½ tr b² b (Cayley–Hamilton).
  const Symmetric<Lanes> b2 = coaxial_product(b, b);
  const Lanes squares = trace(b2);
  return (0.5 + (1.0 / 12.0) * squares) * b - splat(0.25) * deviator(b2);
}

struct Strain {
  Tensor<Lanes> f, cofactor;
  Lanes change;  // J − 1
  Symmetric<Lanes> e;
};

[[gnu::always_inline]] inline Tensor<Lanes> cofactor(const Tensor<Lanes>& f) {
  const auto& m = f.m;
  const auto minor = [&](int r, int s, int c, int d) { return m[r][c] * m[s][d] - m[r][d] * m[s][c]; };
  return {{{minor(1, 2, 1, 2), minor(1, 2, 2, 0), minor(1, 2, 0, 1)},
           {minor(2, 0, 1, 2), minor(2, 0, 2, 0), minor(2, 0, 0, 1)},
           {minor(0, 1, 1, 2), minor(0, 1, 2, 0), minor(0, 1, 0, 1)}}};
}

/// Whether any of the eight has ever flowed: if not, their plastic memory is zero and need not be read.
[[gnu::always_inline]] inline bool has_flowed(const std::uint8_t* yield) {
  std::uint64_t flags;
  std::memcpy(&flags, yield, sizeof(flags));
  return flags != 0;
}

/// `plastic`: rows of plastic memory, or null where nothing has flowed.
[[gnu::always_inline]] inline Strain strain_of(const Shape& shape, const Nodes& n, const Lanes* plastic) {
  const Tensor<Lanes> h = gradient(shape, n);
  Strain s;
  s.change = clipped(volume_change(h));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) s.f.m[i][j] = i == j ? 1.0 + h.m[i][j] : h.m[i][j];
  s.cofactor = cofactor(s.f);
  // b − 1 = H + Hᵀ + H Hᵀ + F (Cp⁻¹ − 1) Fᵀ
  const auto& m = h.m;
  const auto rows = [&](int i, int j) { return m[i][0] * m[j][0] + m[i][1] * m[j][1] + m[i][2] * m[j][2]; };
  Symmetric<Lanes> total = {2.0 * m[0][0] + rows(0, 0),     2.0 * m[1][1] + rows(1, 1),
                            2.0 * m[2][2] + rows(2, 2),     m[0][1] + m[1][0] + rows(0, 1),
                            m[0][2] + m[2][0] + rows(0, 2), m[1][2] + m[2][1] + rows(1, 2)};
  if (plastic) {
    const Symmetric<Lanes> memory = {plastic[0], plastic[1], plastic[2], plastic[3], plastic[4], plastic[5]};
    total = total + push(s.f, memory);
  }
  s.e = elastic_deviator(total);
  return s;
}

/// Whether the lanes may have to flow, with the elastic deviator `e` and the mean stress `p` (Pa).
[[gnu::always_inline]] inline LaneMask may_flow(const FillLaw& law, const Symmetric<Lanes>& e, Lanes p) {
  const double shear2 = 4.0 * law.shear * law.shear;
  return ~surely_elastic(law, shear2 * inner(e, e), p);
}

/// Plastic flow of the lanes that need it, which it returns: changes the plastic memory, the yield bits, the elastic
/// deviator and the mean stress. `dissipated`, the stress after it on what flowed (J/m3), is set if any flows.
LaneMask flow(const FillLaw& law, const Strain& s, LaneMask lanes, Lanes* plastic, std::uint8_t* yield,
              Symmetric<Lanes>& e, Lanes& p, Lanes& dissipated);

/// Kirchhoff stress τ = 2 μ e + p dθ/d ln J, Pa.
[[gnu::always_inline]] inline Symmetric<Lanes> kirchhoff(const FillLaw& law, const Strain& s, Lanes slope, Lanes p) {
  const Lanes round = p * slope;
  const Symmetric<Lanes> dev = splat(2.0 * law.shear) * s.e;
  return {dev.xx + round, dev.yy + round, dev.zz + round, dev.xy, dev.xz, dev.yz};
}

}  // namespace voussoir::tet
