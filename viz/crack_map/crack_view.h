// One view of a crack map: the stones' pattern and the edges of cracked joints that are seen in it.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "viz/arrangement/hidden_lines.h"
#include "viz/crack_map/cracks.h"

namespace voussoir {

/// Widths of cracks that are drawn alike.
struct WidthClass {
  double from = 0.0;        // m
  const char* colour = "";  // of the line: ever darker
  double line = 0.0;        // mm, ever thicker
};
/// From 0.3, 1, 3, 10 and 30 mm on.
const std::vector<WidthClass>& width_classes();
/// The class of a width (m); the lowest below all.
std::size_t width_class(double width);

/// An edge of a cracked joint where a surface shows it.
struct CrackTrace {
  std::size_t joint = 0;  // of Assembly::joints
  std::size_t crack = 0;  // of the cracks
  FlatLine line;          // (u, v), m
};

struct CrackView {
  std::string title, u_name;        // "x", "s": what the scale below counts
  bool mirrored = false;            // u runs against it
  double u_from = 0.0, u_to = 0.0;  // m, of the scale
  std::array<std::vector<FlatLine>, kLineKinds> pattern;
  std::vector<CrackTrace> traces;
  std::vector<Polygon> fallen;  // faces of stones that fell
  Box extent() const;           // of the pattern
};

/// What both need to know.
struct CrackedAssembly {
  const Assembly& assembly;
  const std::vector<Crack>& cracks;
  std::vector<bool> fell;  // of each block
};
/// Blocks that have gone farther than kStoneFell relative to the base.
std::vector<bool> fallen_blocks(const Assembly& assembly, const Snapshot& snapshot);

/// An assembly seen along an axis, without some blocks.
CrackView seen_view(const CrackedAssembly& cracked, const SheetAxes& axes, const std::vector<std::int64_t>& without,
                    const std::string& title);
/// The intrados of a vault unrolled: s along it from the left springing to the right, w along the barrel upwards, as
/// seen from above.
CrackView unrolled_view(const CrackedAssembly& cracked, const Intrados& vault);

}  // namespace voussoir
