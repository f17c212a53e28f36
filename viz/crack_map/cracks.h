// Cracks: connected joints that have opened or slid (docs/theory/crack-map.md).
#pragma once
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "solver/step/snapshot.h"
#include "viz/crack_map/intrados.h"

namespace voussoir {

constexpr double kCrackThreshold = 3e-4;  // m, width that the eye sees from nearby
constexpr double kStoneFell = 1.0;        // m, displacement of a fallen stone; larger values have no meaning

enum class CrackState { ever, now };  // ever: largest value since the start; now: at present

/// Opening and slip of a joint, m.
struct JointGap {
  double opening = 0.0, slip = 0.0;
  double width() const { return std::max(opening, slip); }
  bool slides() const { return slip > opening; }
  bool fallen() const { return width() >= kStoneFell; }
};
struct JointGaps {
  JointGap ever, now;
  const JointGap& in(CrackState state) const { return state == CrackState::ever ? ever : now; }
};
/// Opening and slip of each joint of the assembly in a snapshot. If a contact has replaced a joint, its opening is the
/// separation of the two stones since they were built.
std::vector<JointGaps> joint_gaps(const Assembly& assembly, const Snapshot& snapshot);
/// Displacement of block b relative to block a at the point `at` (as built), m.
Vec3 moved_apart(const Assembly& assembly, const Snapshot& snapshot, const Joint& joint, const Vec3& at);

/// The part of a stone: "arch 0", "spandrel y-".
struct CrackedPart {
  Component component = Component::block;
  std::int32_t part = 0;
  auto operator<=>(const CrackedPart&) const = default;
};
std::string part_words(const CrackedPart& part);
/// Spandrels, parapets and walls are separate parts.
bool is_wall(Component component);

/// Joints above the threshold between the same two parts, each touching another.
struct Crack {
  int number = 0;                                // from 1, the widest first in the state of find_cracks()
  std::vector<std::size_t> joints;               // of Assembly::joints, ascending
  std::array<CrackedPart, 2> parts;              // ascending
  std::string where, direction;                  // words
  Box box;                                       // m
  double length = 0.0;                           // m, from end to end along the surface
  double area = 0.0;                             // m2, of its joints
  JointGap ever, now;                            // largest values of its joints
  double width() const { return ever.width(); }  // m, largest since the start
};

/// The cracks whose joints have opened or slid by at least `threshold` (m) in this state. The crack that is widest in
/// this state is the first. Ties and joints with blocks of backfill (soil) are not cracks. Positions are as built.
std::vector<Crack> find_cracks(const Assembly& assembly, const std::vector<JointGaps>& gaps,
                               const std::vector<Intrados>& vaults, double threshold, CrackState state);

/// The same with the vaults measured. `snapshot` must be of this assembly.
std::vector<Crack> find_cracks(const Assembly& assembly, const Snapshot& snapshot, double threshold = kCrackThreshold,
                               CrackState state = CrackState::ever);

/// cracks.csv (docs/formats.md).
std::string crack_table(const std::vector<Crack>& cracks);

/// A length in mm, "0.42", "18", with as many digits as an inspector reads.
std::string width_text(double metres);

}  // namespace voussoir
