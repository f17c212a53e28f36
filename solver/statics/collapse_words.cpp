// What a collapse stage found, in words for the log, the summary and the page.
#include <fmt/format.h>

#include <map>

#include "solver/base/counted.h"
#include "solver/statics/collapse.h"

namespace voussoir {

std::string edge_name(const Assembly& assembly, const MechanismJoint& joint) {
  const Block &a = assembly.blocks[std::size_t(joint.a)], &b = assembly.blocks[std::size_t(joint.b)];
  if (joint.slides || (a.component != Component::arch && b.component != Component::arch)) return {};
  const std::int32_t part = a.component == Component::arch ? a.part : b.part;
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  for (const Block& block : assembly.blocks)
    if (block.component == Component::arch && block.part == part)
      low = low.cwiseMin(block.centroid), high = high.cwiseMax(block.centroid);
  const Vec3 feet(0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()), low.z());
  const Vec3 out = Vec3(1, 0, 1).cwiseProduct(joint.centre - feet);
  return (joint.place - joint.centre).dot(out) > 0.0 ? "extrados" : "intrados";
}

namespace {

/// To the millimetre, and never −0.
double rounded(double x) {
  return std::round(1e3 * x) / 1e3 + 0.0;
}

}  // namespace

std::string mechanism_text(const Assembly& assembly, const std::vector<MechanismJoint>& mechanism) {
  if (mechanism.empty()) return "no mechanism: no joint moves";
  std::size_t slides = 0;
  for (const MechanismJoint& joint : mechanism) slides += joint.slides;
  std::string text =
      fmt::format("mechanism: {}, {}", counted(mechanism.size() - slides, "joint hinges", "joints hinge"),
                  counted(slides, "slides", "slide"));
  if (mechanism.size() > 12) return text;
  for (const MechanismJoint& joint : mechanism) {
    const std::string edge = edge_name(assembly, joint);
    text += fmt::format("\n  blocks {} and {} {} at ({:.3f}, {:.3f}, {:.3f}) m{}", joint.a, joint.b,
                        joint.slides ? "slide" : "hinge", rounded(joint.place.x()), rounded(joint.place.y()),
                        rounded(joint.place.z()), edge.empty() ? "" : ", " + edge);
  }
  return text;
}

namespace {

/// The pronoun for so many things.
const char* them(std::size_t things) {
  return things == 1 ? "it" : "them";
}

}  // namespace

std::string moving_part(const Assembly& assembly, const CollapseLoss& loss) {
  const std::string fill = loss.fill ? fmt::format(" and the fill around {}", them(loss.blocks.size())) : "";
  if (loss.blocks.empty()) return loss.fill ? "the fill" : "nothing";
  if (loss.loaded_only) return counted(loss.blocks.size(), "loaded block") + fill;
  std::map<std::string, std::size_t> counts;
  for (std::int64_t block : loss.blocks)
    ++counts[component_names()[std::size_t(assembly.blocks[std::size_t(block)].component)]];
  std::string text;
  for (const auto& [name, count] : counts)
    text += fmt::format("{}{} of component {}", text.empty() ? "" : ", ", counted(count, "block"), name);
  return text + fill;
}

std::string collapse_headline(const Assembly& assembly, const Collapse& c) {
  if (!c.found) return fmt::format("The assembly still stands at a multiplier of {:.4g}.", c.multiplier);
  if (c.falls_above == false)
    return fmt::format(
        "The static and the dynamic solver disagree: the static solver loses equilibrium at a multiplier of {:.4g}, "
        "but the dynamic run stands above it. {:.4g} is not a collapse load.",
        c.multiplier, c.multiplier);
  std::string text = fmt::format(
      "{} loss of equilibrium at a multiplier of {:.4g}: {} ({:.0f} % of the mass that can "
      "move).",
      c.loss.local ? "Local" : "Global", c.multiplier, moving_part(assembly, c.loss), 100.0 * c.loss.share);
  if (c.loss.rest_stands)
    text += *c.loss.rest_stands ? " The rest stands if this part is held and its loads are removed."
                                : " The rest falls even if this part is held and its loads are removed.";
  if (c.stands_below == false) text += " The dynamic run does not stand below it, which contradicts the static solver.";
  return text;
}

}  // namespace voussoir
