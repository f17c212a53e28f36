// Texts and scales around a picture: title, time, colour scale or legend, length scale, axes.
#pragma once
#include <string>

#include "viz/colouring.h"
#include "viz/overlay.h"
#include "viz/view.h"

namespace voussoir {

struct Sheet {
  int width = 0, height = 0;      // pixels
  double letter = 0.0;            // pixels, font height
  double metres_per_pixel = 0.0;  // 0 in perspective: no length scale
};

/// The font height for a picture of this width.
double letter_size(int width);
/// Heights in pixels of the strips above and below the content.
double top_strip(const Sheet& sheet);
double bottom_strip(const Sheet& sheet);

struct Words {
  std::string title;                                  // may be empty
  std::string time;                                   // "t = 12.50 s"
  std::string deform;                                 // "deformations × 2"
  std::string hidden;                                 // "hidden: backfill"; may be empty
  std::vector<std::pair<std::string, Colour>> lines;  // legend of the lines drawn over the picture
};

void draw_annotation(Overlay& overlay, const Sheet& sheet, const View& view, const Colouring& colouring,
                     const Words& words);

}  // namespace voussoir
