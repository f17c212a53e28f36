// New ties across the bridge, from one spandrel wall to the other: bars between anchor plates that act only in tension
// and yield.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/stiffness.h"
#include "solver/base/error.h"
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

/// The parameters, in their order.
struct Tie {
  double axial_stiffness, yield_force, pretension;  // N
  double spacing, depth;                            // m
};

bool is_wall(const Block& block, int side) {
  return block.component == Component::spandrel && block.part == side && !block.fixed;
}

/// Of both spandrel walls together; nothing (low above high) unless there are two.
Box box_of_walls(const Assembly& assembly) {
  Box box;
  bool sides[2] = {};
  for (const Block& block : assembly.blocks)
    for (const int side : {0, 1})
      if (is_wall(block, side)) {
        const Box own = block_box(block);
        box.low = box.low.cwiseMin(own.low), box.high = box.high.cwiseMax(own.high);
        sides[side] = true;
      }
  return sides[0] && sides[1] ? box : Box{};
}

/// Supports that lie under the walls, then the whole length.
std::vector<std::string> places_of_retrofit_ties(const Assembly& assembly) {
  if (box_of_walls(assembly).low.x() > box_of_walls(assembly).high.x()) return {};
  std::vector<std::string> names = supports(assembly);
  names.push_back("all");
  return names;
}

/// The outermost stone of a wall at this x and z; −1: none.
std::int64_t wall_stone(const Assembly& assembly, int side, double x, double z) {
  std::int64_t found = -1;
  double outermost = -1e300;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    if (!is_wall(assembly.blocks[i], side)) continue;
    const Box box = block_box(assembly.blocks[i]);
    const double out = side == 0 ? -box.low.y() : box.high.y();
    const bool there = box.low.x() <= x && x <= box.high.x() && box.low.z() <= z && z <= box.high.z();
    if (there && out > outermost) outermost = out, found = std::int64_t(i);
  }
  return found;
}

Vec3 anchor(const Assembly& assembly, std::int64_t stone, int side, double x, double z) {
  const Box box = block_box(assembly.blocks[std::size_t(stone)]);
  return {x, side == 0 ? box.low.y() : box.high.y(), z};
}

void add_tie(Assembly& assembly, double x, double z, const Tie& tie) {
  const std::int64_t stones[2] = {wall_stone(assembly, 0, x, z), wall_stone(assembly, 1, x, z)};
  if (stones[0] < 0 || stones[1] < 0)
    throw InputError(
        "effect retrofit_ties: at x = {:.2f} m the spandrel walls have no stone at {:g} m below their top. Choose "
        "another depth.",
        x, tie.depth);
  const Vec3 from = anchor(assembly, stones[0], 0, x, z), to = anchor(assembly, stones[1], 1, x, z);
  const Vec3 side(0.05, 0.0, 0.0);  // m, half the width of the strip that stands for the bar
  const Polygon strip = {from + side, from - side, to - side, to + side};
  const double length = (to - from).norm(), area = polygon_area(strip);
  JointLaw law;
  law.kind = JointLaw::Kind::tie;
  law.tension = tie.yield_force / area;
  law.prestress = tie.pretension / area;
  const double kn = tie.axial_stiffness / length / area;
  const auto number = std::count_if(assembly.joints.begin(), assembly.joints.end(), [&](const Joint& joint) {
    return std::min(joint.a, joint.b) == std::min(stones[0], stones[1]) &&
           std::max(joint.a, joint.b) == std::max(stones[0], stones[1]);
  });
  Joint& joint =
      add_joint(assembly, stones[0], stones[1], strip, polygon_normal(strip), kn, kn, law_index(assembly.laws, law));
  // A bar meets no faces; their numbers tell the ties of two stones apart.
  const auto faces = std::int64_t(assembly.blocks[std::size_t(joint.b)].cells[0].faces.size());
  joint.face_a = std::int32_t(number / faces), joint.face_b = std::int32_t(number % faces);
}

void apply_retrofit_ties(Assembly& assembly, const std::string& where, const std::vector<double>& values) {
  const Tie tie = {values[0], values[1], values[2], values[3], values[4]};
  if (tie.pretension > tie.yield_force)
    throw InputError(
        "effect retrofit_ties: pretension is {:g} N. It must not exceed yield_force, {:g} N. Lower pretension or raise "
        "yield_force.",
        tie.pretension, tie.yield_force);
  if (tie.axial_stiffness == 0.0) return;
  const Box walls = box_of_walls(assembly);
  Box range = walls;
  if (where != "all") range = block_box(assembly.blocks[std::size_t(base_of(assembly, where))]);
  const double length = range.high.x() - range.low.x();
  const int count = std::max(1, int(std::lround(length / tie.spacing)));
  for (int i = 0; i < count; ++i)
    add_tie(assembly, range.low.x() + (i + 0.5) / count * length, walls.high.z() - tie.depth, tie);
}

}  // namespace

Effect retrofit_ties() {
  return {"retrofit_ties",
          "new ties between the spandrel walls, which act only in tension and yield",
          "",
          {{"axial_stiffness", "N", "axial stiffness E A of a tie", 0.0, 1e10, 0.0, 2e8, 2e8},
           {"yield_force", "N", "yield force of a tie", 1e3, 1e9, 2e5, 2e5, 2e5},
           {"pretension", "N", "tensile force of a tie in the bridge as built", 0.0, 1e9, 0.0, 0.0, 1e4},
           {"spacing", "m", "spacing of the ties along the bridge", 0.2, 100.0, 1.5, 1.5, 1.0},
           {"depth", "m", "depth of the ties below the top of the walls", 0.05, 50.0, 1.0, 1.0, 1.0}},
          places_of_retrofit_ties,
          apply_retrofit_ties,
          nullptr,
          nullptr,
          0.0};
}

}  // namespace voussoir
