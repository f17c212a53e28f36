// Layout of a drawing: sheet sizes, scales, and positions of the views.
#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "viz/arrangement/sheet.h"

namespace voussoir {

struct PaperSize {
  const char* name = "A3";
  double width = 420.0, height = 297.0;  // mm
  double pixels = 6.0;                   // pixels per mm of a picture
};

/// The size of a view: its content in m, which is drawn to scale, and its surroundings in mm.
struct ViewSize {
  double width = 0.0, height = 0.0;                          // m
  double left = 0.0, right = 0.0, above = 0.0, below = 0.0;  // mm
  double title = 0.0;                                        // mm, width of the title above the middle of the content
  double side(double own, double scale) const { return std::max(own, 0.5 * (title - 1000.0 * width / scale)); }
  double left_at(double scale) const { return side(left, scale); }
  double wide(double scale) const { return left_at(scale) + 1000.0 * width / scale + side(right, scale); }
  double high(double scale) const { return above + 1000.0 * height / scale + below; }
};

/// Views below one another with a common x (elevation … plan), other views next to one another (cross sections), and
/// blocks of text of fixed size.
struct Content {
  std::vector<ViewSize> stack, across;
  std::vector<SheetBox> notes;  // sizes only
  bool one_scale = false;       // the cross sections have the same scale
};

/// Upper left corners of all parts, mm from that of the sheet.
struct SheetPlan {
  PaperSize paper;
  double scale = 1.0, across_scale = 1.0;  // 1 : scale
  std::vector<SheetBox> stack, across, notes;
};

/// Chooses the smallest sheet on which a usual scale of at least 1 : 300 fits, and the largest such scale on it; if
/// there is none, the largest sheet. Cross sections are up to twice as large unless all views have one scale.
SheetPlan place_on_paper(const Content& content);

}  // namespace voussoir
