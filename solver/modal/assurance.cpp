#include "solver/modal/modes.h"

namespace voussoir {

BlockPlaces block_places(const Assembly& assembly, const Model& model) {
  BlockPlaces places;
  for (const Block& block : assembly.blocks) {
    places.centroid.push_back(block.centroid);
    places.mass.push_back(block.fixed ? 0.0 : block.mass);
  }
  places.size = model.typical_size;
  return places;
}

BlockPairs pair_blocks(const BlockPlaces& a, const BlockPlaces& b) {
  std::vector<std::size_t> order;  // of b's moving blocks, by x
  for (std::size_t j = 0; j < b.centroid.size(); ++j)
    if (b.mass[j] > 0.0) order.push_back(j);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return b.centroid[i].x() < b.centroid[j].x(); });
  const double reach = std::max(a.size, b.size);
  BlockPairs pairs;
  double all = 0.0, paired = 0.0;
  for (std::size_t i = 0; i < a.centroid.size(); ++i) {
    if (a.mass[i] <= 0.0) continue;
    all += a.mass[i];
    double nearest = reach;
    std::int64_t partner = -1;
    const double x = a.centroid[i].x();
    auto at = std::lower_bound(order.begin(), order.end(), x - reach,
                               [&](std::size_t j, double value) { return b.centroid[j].x() < value; });
    for (; at != order.end() && b.centroid[*at].x() <= x + reach; ++at)
      if (const double distance = (b.centroid[*at] - a.centroid[i]).norm(); distance < nearest)
        nearest = distance, partner = std::int64_t(*at);
    if (partner < 0) continue;
    pairs.blocks.emplace_back(std::int64_t(i), partner);
    pairs.mass.push_back(a.mass[i]);
    paired += a.mass[i];
  }
  pairs.share = all > 0.0 ? paired / all : 0.0;
  return pairs;
}

Eigen::MatrixXd assurance(const std::vector<Mode>& a, const std::vector<Mode>& b, const BlockPairs& pairs) {
  const Eigen::Index rows = 3 * Eigen::Index(pairs.blocks.size());
  const auto weighted = [&](const std::vector<Mode>& modes, bool of_a) {  // columns √W φ, of unit length
    Eigen::MatrixXd columns(rows, Eigen::Index(modes.size()));
    for (std::size_t k = 0; k < modes.size(); ++k) {
      for (std::size_t i = 0; i < pairs.blocks.size(); ++i) {
        const std::int64_t block = of_a ? pairs.blocks[i].first : pairs.blocks[i].second;
        columns.block<3, 1>(3 * Eigen::Index(i), Eigen::Index(k)) =
            std::sqrt(pairs.mass[i]) * modes[k].shape.row(block).head<3>().transpose();
      }
      columns.col(Eigen::Index(k)).normalize();
    }
    return columns;
  };
  return (weighted(a, true).transpose() * weighted(b, false)).cwiseAbs2();
}

}  // namespace voussoir
