// Modes in words: where most of the kinetic energy goes, and how often the motion changes sign along the structure.
#include <fmt/format.h>

#include "solver/modal/modes.h"

namespace voussoir {

namespace {

constexpr int slice_count = 24;

/// One slice across the longest axis.
struct Slice {
  double mass = 0.0, polar = 0.0;  // kg; kg m2 about the axis through the slice's own centre
  Vec3 centre = Vec3::Zero(), move = Vec3::Zero();
  double turn = 0.0;  // rad, about the longest axis
};

/// A block, or a node of the fill, with its share of the mode.
struct Part {
  double mass = 0.0;            // kg
  Vec3 place = Vec3::Zero();    // m
  Mat3 inertia = Mat3::Zero();  // kg m2
  Vec3 move = Vec3::Zero(), turn = Vec3::Zero();
  Component component = Component::block;
};

/// Those that can move.
std::vector<Part> parts_of(const Assembly& assembly, const Mode& mode) {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Block& block = assembly.blocks[i];
    if (block.fixed) continue;
    const auto row = mode.shape.row(Eigen::Index(i));
    parts.push_back({block.mass, block.centroid, block.inertia, row.head<3>(), row.tail<3>(), block.component});
  }
  const FillMesh& fill = assembly.fill;
  if (mode.nodes.rows() != Eigen::Index(fill.nodes.size())) return parts;
  const std::size_t first = parts.size();
  for (std::size_t i = 0; i < fill.nodes.size(); ++i)
    parts.push_back(
        {0.0, fill.nodes[i], Mat3::Zero(), mode.nodes.row(Eigen::Index(i)), Vec3::Zero(), Component::backfill});
  for (std::size_t t = 0; t < fill.tets.size(); ++t) {
    const auto at = [&](std::size_t k) { return fill.nodes[std::size_t(fill.tets[t][k])]; };
    const double volume = (at(1) - at(0)).dot((at(2) - at(0)).cross(at(3) - at(0))) / 6.0;
    for (const std::int32_t node : fill.tets[t])
      parts[first + std::size_t(node)].mass +=
          0.25 * volume * assembly.materials[std::size_t(fill.material[t])].density;
  }
  return parts;
}

struct Extent {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  explicit Extent(const std::vector<Part>& parts) {
    for (const Part& p : parts) low = low.cwiseMin(p.place), high = high.cwiseMax(p.place);
  }
};

std::vector<Slice> cut(const std::vector<Part>& parts, const Extent& extent, int axis) {
  const double low = extent.low[axis], width = std::max((extent.high[axis] - low) / slice_count, 1e-9);
  std::vector<Slice> slices(slice_count);
  const auto of = [&](const Part& part) -> Slice& {
    return slices[std::size_t(std::clamp(int((part.place[axis] - low) / width), 0, slice_count - 1))];
  };
  for (const Part& part : parts) {
    Slice& s = of(part);
    s.mass += part.mass;
    s.centre += part.mass * part.place;
    s.move += part.mass * part.move;
  }
  for (Slice& s : slices)
    if (s.mass > 0.0) s.centre /= s.mass, s.move /= s.mass;
  for (const Part& part : parts) {
    Slice& s = of(part);
    Vec3 arm = part.place - s.centre;
    arm[axis] = 0.0;
    s.polar += part.mass * arm.squaredNorm() + part.inertia(axis, axis);
    s.turn += part.mass * arm.cross(part.move)[axis] + (part.inertia * part.turn)[axis];
  }
  for (Slice& s : slices)
    if (s.polar > 0.0) s.turn /= s.polar;
  return slices;
}

/// 1 + changes of sign; a slice that moves less than 15 % of the largest is on neither side.
template <class F>
int order_of(const std::vector<Slice>& slices, F motion) {
  double largest = 0.0;
  for (const Slice& s : slices) largest = std::max(largest, std::abs(motion(s)));
  int order = 1;
  double last = 0.0;
  for (const Slice& s : slices) {
    const double x = motion(s);
    if (std::abs(x) < 0.15 * largest || s.mass == 0.0) continue;
    if (x * last < 0.0) ++order;
    last = x;
  }
  return order;
}

/// The component that most of the moving mass belongs to.
std::string where(const std::vector<Part>& parts) {
  std::vector<double> share(component_names().size(), 0.0);
  for (const Part& part : parts) share[std::size_t(part.component)] += part.mass * part.move.squaredNorm();
  return component_names()[std::size_t(std::max_element(share.begin(), share.end()) - share.begin())];
}

}  // namespace

std::string ModeWords::text() const {
  std::string words = direction;
  if (order > 0) {
    const char* ending = order == 1 ? "st" : order == 2 ? "nd" : order == 3 ? "rd" : "th";
    words += fmt::format(", {}{} order", order, ending);
  }
  return detail.empty() ? words : words + ", " + detail;
}

ModeWords mode_words(const Assembly& assembly, const Mode& mode) {
  const std::vector<Part> parts = parts_of(assembly, mode);
  Vec3 along = Vec3::Zero();  // twice the kinetic energy at ω = 1, less that of turning blocks
  double mass = 0.0, fourth = 0.0;
  for (const Part& part : parts) {
    along += part.mass * part.move.cwiseAbs2();
    mass += part.mass;
    fourth += part.mass * part.move.squaredNorm() * part.move.squaredNorm();
  }
  if (mode.frequency == 0.0) {
    if (mode.residual > 0.0) return {"unstable", 0, where(parts)};
    const bool supported = std::any_of(assembly.blocks.begin(), assembly.blocks.end(), [](auto& b) { return b.fixed; });
    if (supported) return {"mechanism", 0, where(parts)};
    return {"rigid motion", 0, ""};
  }
  // The mass that takes part, as if all of it moved alike (inverse participation ratio).
  if (along.sum() * along.sum() < 0.02 * mass * fourth) return {"local", 0, where(parts)};
  const Extent extent(parts);
  int axis = 0;
  (extent.high - extent.low).maxCoeff(&axis);
  const std::vector<Slice> slices = cut(parts, extent, axis);
  double turning = 0.0;
  for (const Slice& s : slices) turning += s.polar * s.turn * s.turn;
  if (turning > 0.5 * mode.modal_mass)
    return {"torsional", order_of(slices, [](const Slice& s) { return s.turn; }), ""};
  static const char* const names[] = {"longitudinal", "transverse", "vertical"};
  int main = 0, second = 0;
  along.maxCoeff(&main);
  const int order = order_of(slices, [&](const Slice& s) { return s.move[main]; });
  along[main] = 0.0;
  along.maxCoeff(&second);
  const bool mixed = along[second] > 0.3 * mode.modal_mass;
  return {names[main], order, mixed ? fmt::format("with {}", names[second]) : ""};
}

}  // namespace voussoir
