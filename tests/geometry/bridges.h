// Bridges of the generator "bridge" as its tests build and measure them.
#pragma once
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/fill_mesh.h"
#include "geometry/generator.h"
#include "geometry/joints.h"
#include "geometry/rings.h"

namespace voussoir::test {

/// Defaults for so many spans and entries of piers.
inline GeneratorInput with_entries(std::size_t spans, std::size_t piers) {
  const Generator& generator = find_generator("bridge");
  GeneratorInput in = default_input(generator);
  in.entries["span"] = spans, in.entries["pier"] = piers;
  const Keys keys = keys_of(generator, in);
  for (const Parameter& p : keys.parameters) in.values.try_emplace(p.name, p.value);
  for (const Choice& c : keys.choices) in.choices.try_emplace(c.name, c.words.front());
  return in;
}

/// m3, of all stones that can move.
inline double moving_volume(const Assembly& assembly) {
  double sum = 0.0;
  for (const Block& block : assembly.blocks)
    if (!block.fixed) sum += mass_properties(block.cells).volume;
  return sum;
}

/// m2, of stones and fill, that no joint covers.
inline double free_surface(const Assembly& assembly) {
  double free = uncovered_surface(assembly);
  for (std::size_t t = 0; t < assembly.fill.triangles.size(); ++t)
    free += polygon_area(triangle_polygon(assembly.fill, std::int32_t(t)));
  for (const FillJoint& joint : assembly.fill_joints) free -= joint.area;
  return free;
}

/// m2, between a line of the plane x-z and a level z.
inline double area_under(const Polygon& line, double level) {
  double area = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    area += (line[i + 1].x() - line[i].x()) * (0.5 * (line[i].z() + line[i + 1].z()) - level);
  return area;
}

}  // namespace voussoir::test
