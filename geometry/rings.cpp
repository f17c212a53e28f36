#include "geometry/rings.h"

#include <fmt/format.h>

namespace voussoir {

std::string ring_group(std::size_t vault, std::size_t ring) {
  return fmt::format("arch {} ring {}", vault, ring);
}

RingJoints::RingJoints(const Assembly& assembly) : assembly_(&assembly), rings_(assembly.blocks.size(), 0) {
  std::int32_t last = -1;
  for (const Block& block : assembly.blocks)
    if (block.component == Component::arch) last = std::max(last, block.part);
  for (std::int32_t vault = 0; vault <= last; ++vault) {
    for (std::size_t ring = 0; ring < 32; ++ring) {
      const auto group = assembly.groups.find(ring_group(std::size_t(vault), ring));
      if (group == assembly.groups.end()) break;
      for (const std::int64_t block : group->second) rings_[std::size_t(block)] |= 1u << ring;
      if (ring == 1) vaults_.push_back(vault);
    }
  }
}

bool RingJoints::operator()(const Joint& joint) const {
  const auto a = std::size_t(joint.a), b = std::size_t(joint.b);
  if (a >= rings_.size() || b >= rings_.size() || rings_[a] == 0 || rings_[b] == 0) return false;
  return assembly_->blocks[a].part == assembly_->blocks[b].part && (rings_[a] & rings_[b]) == 0;
}

}  // namespace voussoir
