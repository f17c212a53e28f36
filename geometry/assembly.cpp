#include "geometry/assembly.h"

#include <cmath>

#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {
namespace {

void check_cell(const Assembly& assembly, std::int64_t block, std::size_t cell) {
  const Polyhedron& shape = assembly.blocks[block].cells[cell];
  const auto at = [&] { return fmt::format("{}, cell {}", block_label(assembly, block), cell); };
  for (std::size_t v = 0; v < shape.vertices.size(); ++v) {
    const Vec3& p = shape.vertices[v];
    if (!p.allFinite())
      throw InputError(
          "{}: vertex {} is ({}, {}, {}). Coordinates must be finite numbers in metres. Correct this vertex.", at(), v,
          p.x(), p.y(), p.z());
  }
  const int count = static_cast<int>(shape.vertices.size());
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    const auto& face = shape.faces[f];
    if (face.size() < 3)
      throw InputError("{}: face {} has {}. It must have at least 3. Remove the face or complete it.", at(), f,
                       counted(face.size(), "corner"));
    for (int v : face)
      if (v < 0 || v >= count)
        throw InputError("{}: face {} uses vertex {}. It must be from 0 to {}. Correct the index.", at(), f, v,
                         count - 1);
  }
}

/// A volume this small against the box around the cell is rounding, not stone.
bool negligible(double volume, const Polyhedron& cell) {
  const Box box = bounding_box(cell);
  const double size = (box.high - box.low).norm();
  return std::abs(volume) <= 1e-12 * size * size * size;
}

void check_volume(const Assembly& assembly, std::int64_t block, std::size_t cell, double volume) {
  const auto at = [&] { return fmt::format("{}, cell {}", block_label(assembly, block), cell); };
  if (negligible(volume, assembly.blocks[block].cells[cell]))
    throw InputError("{}: the volume is {} m3. It must be above 0. Give the cell a thickness or remove it.", at(),
                     volume);
  if (volume < 0.0)
    throw InputError(
        "{}: the volume is {} m3. It must be above 0. The faces point inwards (inside-out): list the corners of every "
        "face "
        "counter-clockwise seen from outside.",
        at(), volume);
}

void check_density(const Assembly& assembly, std::int64_t block) {
  const Block& b = assembly.blocks[block];
  if (b.material < 0 || b.material >= static_cast<std::int32_t>(assembly.materials.size()))
    throw InputError("{}: the material index is {}. It must be from 0 to {}. Add the material or correct the index.",
                     block_label(assembly, block), b.material, static_cast<int>(assembly.materials.size()) - 1);
  const Material& material = assembly.materials[b.material];
  if (!std::isfinite(material.density) || material.density <= 0.0)
    throw InputError("{}: material \"{}\" has the density {} kg/m3. It must be above 0. Set the density.",
                     block_label(assembly, block), material.name, material.density);
}

void finish_block(Assembly& assembly, std::int64_t block) {
  Block& b = assembly.blocks[block];
  if (b.cells.empty())
    throw InputError("{}: the block has no cells. It must have at least one convex cell. Give it a shape or remove it.",
                     block_label(assembly, block));
  check_density(assembly, block);
  for (std::size_t c = 0; c < b.cells.size(); ++c) {
    check_cell(assembly, block, c);
    check_volume(assembly, block, c, mass_properties(b.cells[c]).volume);
  }
  const MassProperties properties = mass_properties(b.cells);
  const double density = block_density(assembly, b);
  b.mass = density * properties.volume;
  b.centroid = properties.centroid;
  b.inertia = density * properties.inertia;
}

}  // namespace

const std::vector<std::string>& component_names() {
  static const std::vector<std::string> names = {"arch",    "pier",     "abutment", "infill",    "backing", "spandrel",
                                                 "parapet", "backfill", "base",     "restraint", "wall",    "block"};
  return names;
}

const std::vector<std::string>& joint_law_kinds() {
  static const std::vector<std::string> names = {"brittle", "softening", "elastic", "tie", "composite"};
  return names;
}

std::string block_label(const Assembly& assembly, std::int64_t block) {
  const Block& b = assembly.blocks[block];
  const auto index = static_cast<std::size_t>(b.component);
  const auto& names = component_names();
  return fmt::format("block {} ({}, part {})", block, index < names.size() ? names[index] : "unknown component",
                     b.part);
}

void finish_blocks(Assembly& assembly) {
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) finish_block(assembly, static_cast<std::int64_t>(i));
}

double block_density(const Assembly& assembly, const Block& block) {
  return assembly.materials.at(block.material).density;
}

Box block_box(const Block& block) {
  Box box;
  for (const auto& cell : block.cells) {
    const Box one = bounding_box(cell);
    box.low = box.low.cwiseMin(one.low);
    box.high = box.high.cwiseMax(one.high);
  }
  return box;
}

std::array<Vec3, 2> tie_anchors(const Joint& tie) {
  if (tie.polygon.size() != 4)
    throw InputError("the tie between blocks {} and {} has a polygon of {} corners. It must have 4, two at each anchor",
                     tie.a, tie.b, tie.polygon.size());
  return {0.5 * (tie.polygon[0] + tie.polygon[1]), 0.5 * (tie.polygon[2] + tie.polygon[3])};
}

}  // namespace voussoir
