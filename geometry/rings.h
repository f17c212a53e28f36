// The rings of vaults with several rings, from the groups "arch 0 ring 1" of an assembly.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// The name in a case for the joints between the rings of a vault: [joints.ring-ring].
inline constexpr const char* ring_pair = "ring-ring";

/// The group of the stones of one ring (0: the lowest) of a vault: "arch 0 ring 1". Headers are in two groups.
std::string ring_group(std::size_t vault, std::size_t ring);

/// Joints between the rings of one vault. The assembly must outlive this object.
class RingJoints {
 public:
  explicit RingJoints(const Assembly& assembly);
  bool none() const { return vaults_.empty(); }
  /// Vaults with several rings, ascending.
  const std::vector<std::int32_t>& vaults() const { return vaults_; }
  /// Whether a joint is between stones of one vault that have no ring in common.
  bool operator()(const Joint& joint) const;
  /// Bit k: the block belongs to ring k of its vault; 0 for a vault with one ring and for other blocks.
  std::uint32_t rings_of(std::int64_t block) const { return rings_[std::size_t(block)]; }

 private:
  const Assembly* assembly_;
  std::vector<std::int32_t> vaults_;
  std::vector<std::uint32_t> rings_;  // bit k: the block belongs to ring k of its vault
};

}  // namespace voussoir
