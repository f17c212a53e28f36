#include "solver/diagnosis/linear_model.h"

#include "solver/base/error.h"
#include "solver/linear/loose.h"

namespace voussoir {

namespace {

Unknowns number_sites(const Assembly& assembly) {
  Unknowns unknowns;
  unknowns.bodies = assembly.blocks.size();
  for (const Block& block : assembly.blocks) {
    auto& of = unknowns.of.emplace_back();
    for (int c = 0; c < 6; ++c) of[c] = block.fixed ? -1 : unknowns.count++;
  }
  for (std::size_t node = 0; node < assembly.fill.nodes.size(); ++node) {
    auto& of = unknowns.of.emplace_back();
    for (int c = 0; c < 6; ++c) of[c] = c > 2 ? -1 : unknowns.count++;
  }
  return unknowns;
}

Matrix6 block_of_nodes(const Mat3& block) {
  Matrix6 m = Matrix6::Zero();
  m.topLeftCorner<3, 3>() = block;
  return m;
}

class Assembler {
 public:
  explicit Assembler(const Assembly& assembly, const Contributions& parts)
      : blocks_(std::int32_t(assembly.blocks.size())), parts_(parts) {}

  BlockMatrix stiffness(std::size_t sites, std::size_t nodes) const {
    BlockMatrix k(sites, coupled(nodes));
    for (const auto& pair : parts_.pairs) {
      const auto a = std::int32_t(pair.a), b = std::int32_t(pair.b);
      k.add(a, a, pair.k.topLeftCorner<6, 6>());
      k.add(b, b, pair.k.bottomRightCorner<6, 6>());
      k.add(b, a, pair.k.bottomLeftCorner<6, 6>());
    }
    for (const auto& patch : parts_.patches) add(patch, k);
    for (const auto& e : parts_.elements)
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j <= i; ++j)
          k.add(site(e.nodes[i]), site(e.nodes[j]),
                block_of_nodes(e.scale * shear_block(e.gradient[i], e.gradient[j])));
    for (const auto& ring : parts_.rings)
      for (std::size_t i = 0; i < ring.nodes.size(); ++i)
        for (std::size_t j = 0; j <= i; ++j)
          k.add(site(ring.nodes[i]), site(ring.nodes[j]),
                block_of_nodes(ring.scale * ring.pull[i] * ring.pull[j].transpose()));
    return k;
  }

  BlockMatrix mass(const Unknowns& unknowns) const {
    BlockMatrix m(unknowns.of.size(), {});
    for (const auto& own : parts_.blocks)
      if (unknowns.any(std::size_t(own.block))) m.diagonal(std::int32_t(own.block)) = own.m;
    for (const auto& lump : parts_.lumps)
      for (const std::int32_t node : lump.nodes)
        m.diagonal(site(node)).topLeftCorner<3, 3>() += lump.mass * Mat3::Identity();
    return m;
  }

 private:
  std::int32_t site(std::int32_t node) const { return blocks_ + node; }

  SitePairs coupled(std::size_t nodes) const {
    SitePairs all;
    for (const auto& pair : parts_.pairs) all.emplace_back(std::int32_t(pair.a), std::int32_t(pair.b));
    std::vector<std::array<std::int32_t, 4>> elements;
    for (const auto& e : parts_.elements) elements.push_back(e.nodes);
    couple_nodes(elements, nodes, blocks_, all);
    for (const auto& patch : parts_.patches)
      for (const std::int32_t node : patch.nodes) all.emplace_back(std::int32_t(patch.block), site(node));
    return all;
  }

  void add(const Contributions::Patch& patch, BlockMatrix& k) const {
    const auto block = std::int32_t(patch.block);
    k.add(block, block, patch.k.topLeftCorner<6, 6>());
    for (std::size_t i = 0; i < 3; ++i) {
      const auto row = Eigen::Index(6 + 3 * i);
      Matrix6 across = Matrix6::Zero();
      across.topRows<3>() = patch.k.block<3, 6>(row, 0);
      k.add(site(patch.nodes[i]), block, across);
      for (std::size_t j = 0; j <= i; ++j)
        k.add(site(patch.nodes[i]), site(patch.nodes[j]),
              block_of_nodes(patch.k.block<3, 3>(row, Eigen::Index(6 + 3 * j))));
    }
  }

  std::int32_t blocks_;
  const Contributions& parts_;
};

}  // namespace

LinearModel linear_model(const Assembly& assembly, const Contributions& parts) {
  const Unknowns all = number_sites(assembly);
  const Assembler assembler(assembly, parts);
  BlockMatrix k = assembler.stiffness(all.of.size(), assembly.fill.nodes.size());
  const BlockMatrix m = assembler.mass(all);
  LinearModel model;
  const Loose loose = find_loose(k, m, all);
  model.unknowns = without(all, loose.adrift);
  if (model.unknowns.count == 0) throw InputError("no joint of this assembly holds anything, so it has no modes");
  hold_free_ways(k, m, model.unknowns, loose);
  model.k = k.over(model.unknowns);
  model.m = m.over(model.unknowns);
  return model;
}

LinearModel linear_model(const Assembly& assembly) {
  return linear_model(assembly, contributions(assembly));
}

}  // namespace voussoir
