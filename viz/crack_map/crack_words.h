// Position, direction and length of a crack.
#pragma once
#include "geometry/rings.h"
#include "viz/crack_map/cracks.h"

namespace voussoir {

/// Frame and texts of cracks between two parts.
class CrackWords {
 public:
  CrackWords(const Assembly& assembly, const std::vector<Intrados>& vaults)
      : assembly_(assembly), vaults_(vaults), between_rings_(assembly) {}
  /// Sets where, direction and length of a crack from its parts, joints and box.
  void describe(Crack& crack) const;

 private:
  enum class Frame { vault, wall, space };
  const Intrados* vault_of(const Crack& crack) const;
  Frame frame_of(const Crack& crack) const;
  std::string where(const Crack& crack, Frame frame) const;
  std::string direction(const Crack& crack, Frame frame, const Vec3& way) const;
  double trace(const Crack& crack, Frame frame) const;
  double steepness(const Crack& crack, const Vec3& way) const;
  double share_of_area(const Crack& crack, bool (*counts)(const Joint&)) const;

  const Assembly& assembly_;
  const std::vector<Intrados>& vaults_;
  RingJoints between_rings_;
};

}  // namespace voussoir
