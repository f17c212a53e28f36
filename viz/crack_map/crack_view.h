// One view of a crack map: the pattern of the stones and the visible edges of cracked joints.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "viz/arrangement/hidden_lines.h"
#include "viz/crack_map/cracks.h"

namespace voussoir {

/// A class of crack widths with the same line.
struct WidthClass {
  double from = 0.0;        // m
  const char* colour = "";  // colour of the line, darker with each class
  double line = 0.0;        // mm, width of the line, thicker with each class
};
/// The classes, from 0.3, 1, 3, 10 and 30 mm.
const std::vector<WidthClass>& width_classes();
/// The class of a width (m); the lowest class for smaller widths.
std::size_t width_class(double width);

/// A visible edge of a cracked joint on a surface.
struct CrackTrace {
  std::size_t joint = 0;  // of Assembly::joints
  std::size_t crack = 0;  // of the cracks
  FlatLine line;          // (u, v), m
};

struct CrackView {
  std::string title, u_name;        // "x", "s": quantity of the scale below
  bool mirrored = false;            // u is opposite to this quantity
  double u_from = 0.0, u_to = 0.0;  // m, of the scale
  std::array<std::vector<FlatLine>, kLineKinds> pattern;
  std::vector<CrackTrace> traces;
  std::vector<Polygon> fallen;  // faces of stones that fell
  Box extent() const;           // of the pattern
};

/// Input of both kinds of view.
struct CrackedAssembly {
  const Assembly& assembly;
  const std::vector<Crack>& cracks;
  std::vector<bool> fell;  // of each block
};
/// Blocks that have moved farther than kStoneFell relative to the base.
std::vector<bool> fallen_blocks(const Assembly& assembly, const Snapshot& snapshot);

/// An assembly seen along an axis, without some blocks.
CrackView seen_view(const CrackedAssembly& cracked, const SheetAxes& axes, const std::vector<std::int64_t>& without,
                    const std::string& title);
/// The unrolled intrados of a vault, seen from above: s along it from the left springing to the right, w along the
/// barrel upwards.
CrackView unrolled_view(const CrackedAssembly& cracked, const Intrados& vault);

}  // namespace voussoir
