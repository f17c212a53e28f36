// A view of an assembly on a sheet: areas in the colours of the components, hatches, lines of three widths.
#pragma once
#include "viz/arrangement/flat_view.h"
#include "viz/arrangement/paper.h"
#include "viz/arrangement/sheet.h"

namespace voussoir {

/// From (u, v) in m to mm on the sheet.
struct SheetPlace {
  double x0 = 0.0, y0 = 0.0;  // mm, of u = v = 0
  double mm = 1.0;            // mm a metre: 1000 / scale
  double x(double u) const { return x0 + mm * u; }
  double y(double v) const { return y0 - mm * v; }
  Vec3 at(const Vec3& p) const { return {x(p.x()), y(p.y()), 0.0}; }
};

/// Position of the content (u, v) of a view, from the upper left of its box.
SheetPlace place_in(const SheetBox& box, const ViewSize& size, const Box& content, double scale);

/// Draws a view. In a section, parts that are not cut have paler colours.
void paint_view(DrawingSheet& sheet, const FlatView& view, const SheetPlace& place);

/// A patch in the colour and hatch of a component, for the legend.
void paint_patch(DrawingSheet& sheet, const SheetBox& box, Component component, bool fixed);

}  // namespace voussoir
