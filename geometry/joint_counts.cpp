#include "geometry/joint_counts.h"

#include <fmt/format.h>

#include "solver/base/counted.h"

namespace voussoir {

JointCounts count_joints(const Assembly& assembly) {
  JointCounts counts;
  for (const Joint& joint : assembly.joints) {
    const JointLaw& law = assembly.laws[std::size_t(joint.law)];
    if (law.kind == JointLaw::Kind::tie)
      ++counts.ties;
    else if (law.kind == JointLaw::Kind::elastic || law.tension > 0.0 || law.cohesion > 0.0)
      ++counts.bonded;
    else
      ++counts.dry;
  }
  counts.fill = std::int64_t(assembly.fill_joints.size());
  return counts;
}

std::string joints_text(const Assembly& assembly) {
  const JointCounts n = count_joints(assembly);
  std::string text = fmt::format("{}: {} bonded, {} dry", counted(n.bonded + n.dry, "joint"), n.bonded, n.dry);
  if (n.ties > 0) text += fmt::format(", {}", counted(n.ties, "tie"));
  if (n.fill > 0) text += fmt::format(", {} with the fill", counted(n.fill, "patch", "patches"));
  return text;
}

}  // namespace voussoir
