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

int longest_axis(const Assembly& assembly) {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const Block& block : assembly.blocks)
    if (!block.fixed) low = low.cwiseMin(block.centroid), high = high.cwiseMax(block.centroid);
  int axis = 0;
  (high - low).maxCoeff(&axis);
  return axis;
}

std::vector<Slice> cut(const Assembly& assembly, const Mode& mode, int axis) {
  double low = 1e300, high = -1e300;
  for (const Block& block : assembly.blocks)
    if (!block.fixed) low = std::min(low, block.centroid[axis]), high = std::max(high, block.centroid[axis]);
  const double width = std::max((high - low) / slice_count, 1e-9);
  std::vector<Slice> slices(slice_count);
  const auto of = [&](const Block& block) -> Slice& {
    return slices[std::size_t(std::clamp(int((block.centroid[axis] - low) / width), 0, slice_count - 1))];
  };
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Block& block = assembly.blocks[i];
    if (block.fixed) continue;
    Slice& s = of(block);
    s.mass += block.mass;
    s.centre += block.mass * block.centroid;
    s.move += block.mass * mode.shape.row(Eigen::Index(i)).head<3>().transpose();
  }
  for (Slice& s : slices)
    if (s.mass > 0.0) s.centre /= s.mass, s.move /= s.mass;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Block& block = assembly.blocks[i];
    if (block.fixed) continue;
    Slice& s = of(block);
    Vec3 arm = block.centroid - s.centre;
    arm[axis] = 0.0;
    const Vec3 u = mode.shape.row(Eigen::Index(i)).head<3>();
    const Vec3 turn = mode.shape.row(Eigen::Index(i)).tail<3>();
    s.polar += block.mass * arm.squaredNorm() + block.inertia(axis, axis);
    s.turn += block.mass * arm.cross(u)[axis] + (block.inertia * turn)[axis];
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
std::string where(const Assembly& assembly, const Mode& mode) {
  std::vector<double> share(component_names().size(), 0.0);
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    share[std::size_t(assembly.blocks[i].component)] +=
        assembly.blocks[i].mass * mode.shape.row(Eigen::Index(i)).head<3>().squaredNorm();
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
  Vec3 along = Vec3::Zero();  // twice the kinetic energy at ω = 1, less that of turning blocks
  double mass = 0.0, fourth = 0.0;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Block& block = assembly.blocks[i];
    if (block.fixed) continue;
    const Vec3 u = mode.shape.row(Eigen::Index(i)).head<3>();
    along += block.mass * u.cwiseAbs2();
    mass += block.mass;
    fourth += block.mass * u.squaredNorm() * u.squaredNorm();
  }
  if (mode.frequency == 0.0) {
    if (mode.residual > 0.0) return {"unstable", 0, where(assembly, mode)};
    const bool supported = std::any_of(assembly.blocks.begin(), assembly.blocks.end(), [](auto& b) { return b.fixed; });
    if (supported) return {"mechanism", 0, where(assembly, mode)};
    return {"rigid motion", 0, ""};
  }
  // The mass that takes part, as if all of it moved alike (inverse participation ratio).
  if (along.sum() * along.sum() < 0.02 * mass * fourth) return {"local", 0, where(assembly, mode)};
  const std::vector<Slice> slices = cut(assembly, mode, longest_axis(assembly));
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
