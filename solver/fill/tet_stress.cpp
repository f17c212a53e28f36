#include "solver/fill/tet_stress.h"

#include "solver/fill/tet_strain.h"

namespace voussoir {

namespace {

/// Of the eight tetrahedra of a batch. `memory` is a copy, in which they flow.
Symmetric<Lanes> batch_cauchy(const FillModel& fill, FillMemory& memory, std::size_t index) {
  const FillLaw& law = fill.law_of(index);
  const TetBatch& batch = fill.batches[index];
  auto* plastic = reinterpret_cast<Lanes*>(&memory.plastic[plastic_index(index, 0)]);
  const auto n = tet::gather_nodes<Lanes>(memory.pose.data(), batch);
  tet::Strain<Lanes> s = tet::strain_of(tet::shape_of<Lanes>(fill, index), n, plastic);
  Lanes p = law.bulk * n.mean;
  const LaneMask yields = tet::may_flow(law, s.e, p);
  Lanes dissipated;
  if (any(yields)) tet::flow(law, s, yields, plastic, &memory.yield[lane_count * index], s.e, p, dissipated);
  const tet::Volumetric<Lanes> grown = tet::volumetric(s.change);
  return grown.by * tet::kirchhoff(law, s, grown.slope, p);
}

}  // namespace

std::vector<std::array<double, 6>> cauchy_stress(const FillModel& fill, const FillMemory& memory) {
  FillMemory copy;
  copy.pose = memory.pose, copy.plastic = memory.plastic, copy.yield = memory.yield;
  Array<double> volume_sums(fill.sum_count());
  FillPass pass;
  pass.fill = &fill, pass.memory = &copy, pass.volume_sums = volume_sums.data();
  for (std::size_t tile = 0; tile < fill.tiles.size(); ++tile) pass.volumes(tile);
  for (std::size_t tile = 0; tile < fill.tiles.size(); ++tile) pass.means(tile);

  std::vector<std::array<double, 6>> stress(fill.lane_of_tet.size());
  for (std::size_t b = 0; b < fill.batches.size(); ++b) {
    const Symmetric<Lanes> s = batch_cauchy(fill, copy, b);
    for (std::size_t lane = 0; lane < std::size_t(fill.batches[b].count); ++lane)
      stress[std::size_t(fill.tet_of_lane[lane_count * b + lane])] = {s.xx[lane], s.yy[lane], s.zz[lane],
                                                                      s.xy[lane], s.yz[lane], s.xz[lane]};
  }
  return stress;
}

}  // namespace voussoir
