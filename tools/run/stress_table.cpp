#include "tools/run/stress_table.h"

#include <fmt/format.h>

#include <cmath>

namespace voussoir {

namespace {

/// A number rounded to 1e-5 (m, or of a unit vector). Further digits are rounding errors.
double rounded(double value) {
  return std::round(1e5 * value) / 1e5 + 0.0;  // no "-0"
}

void add_cells(std::string& row, std::initializer_list<double> values) {
  for (const double value : values) row += std::isfinite(value) ? fmt::format(",{:.6g}", value) : ",";
}

void add_block(std::string& row, const Assembly& assembly, std::int64_t block) {
  const Block& b = assembly.blocks[std::size_t(block)];
  row += fmt::format(",{},{},{}", block, component_names()[std::size_t(b.component)], b.part);
}

}  // namespace

std::string joint_stress_table(const Assembly& assembly, const RestForces& rest) {
  std::string text =
      "patch,block_a,component_a,part_a,block_b,component_b,part_b,x_m,y_m,z_m,n_x,n_y,n_z,area_m2,normal_N,shear_N,"
      "mean_compression_Pa,mean_shear_Pa,largest_compression_Pa,eccentricity_x_m,eccentricity_y_m,eccentricity_z_m,"
      "eccentricity_over_depth,utilisation,opening_m,slip_m,condition\n";
  for (const JointStress& s : joint_stresses(rest, assembly.joints.size())) {
    const PatchSnapshot& p = rest.snapshot.patches[s.patch];
    text += fmt::format("{}", s.patch);
    add_block(text, assembly, p.a), add_block(text, assembly, p.b);
    for (const Vec3& v : {s.centre, p.normal}) add_cells(text, {rounded(v.x()), rounded(v.y()), rounded(v.z())});
    add_cells(text, {p.area});
    add_cells(text, {s.normal, s.shear, s.mean_compression, s.mean_shear, s.largest_compression});
    add_cells(text, {rounded(s.eccentricity.x()), rounded(s.eccentricity.y()), rounded(s.eccentricity.z())});
    add_cells(text, {rounded(s.eccentricity_over_depth), rounded(s.utilisation), p.opening, p.slip});
    text += fmt::format(",{}\n", condition_word(s.condition));
  }
  return text;
}

}  // namespace voussoir
