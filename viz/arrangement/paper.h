// Where the views of a drawing go: sizes of sheets, scales, and how views are placed beside one another.
#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "viz/arrangement/sheet.h"

namespace voussoir {

struct PaperSize {
  const char* name = "A3";
  double width = 420.0, height = 297.0;  // mm
  double pixels = 6.0;                   // a mm, of a picture
};

/// What a view takes up: its content in m, which the scale makes larger or smaller, and what is around it, mm.
struct ViewSize {
  double width = 0.0, height = 0.0;                          // m
  double left = 0.0, right = 0.0, above = 0.0, below = 0.0;  // mm
  double title = 0.0;                                        // mm, width of the words above the middle of the content
  double side(double own, double scale) const { return std::max(own, 0.5 * (title - 1000.0 * width / scale)); }
  double left_at(double scale) const { return side(left, scale); }
  double wide(double scale) const { return left_at(scale) + 1000.0 * width / scale + side(right, scale); }
  double high(double scale) const { return above + 1000.0 * height / scale + below; }
};

/// Views below one another with a common x (elevation … plan), others beside one another (cross sections), and blocks
/// of text of fixed size.
struct Content {
  std::vector<ViewSize> stack, across;
  std::vector<SheetBox> notes;  // sizes only
  bool one_scale = false;       // of the cross sections too
};

/// Upper left corners of all, mm from that of the sheet.
struct SheetPlan {
  PaperSize paper;
  double scale = 1.0, across_scale = 1.0;  // 1 : scale
  std::vector<SheetBox> stack, across, notes;
};

/// The largest scale in use on the smallest sheet on which it is not below 1 : 300; the largest sheet where there is
/// none. Cross sections are drawn up to twice as large unless all has
/// one scale.
SheetPlan place_on_paper(const Content& content);

}  // namespace voussoir
