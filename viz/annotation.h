// Texts and scales around a picture: title, time, colour scale or legend, length scale, axes.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "viz/colouring.h"
#include "viz/overlay.h"
#include "viz/view.h"

namespace voussoir {

struct Sheet {
  int width = 0, height = 0;      // pixels
  double letter = 0.0;            // pixels, font height
  double metres_per_pixel = 0.0;  // 0 in perspective: no length scale
  double raised = 0.0;            // pixels, height of the rows of a legend above the other words at the foot
};

/// The font height for a picture of this width, both in pixels.
double letter_size(int width);
/// Heights in pixels of the strips above and below the content.
double top_strip(const Sheet& sheet);
double bottom_strip(const Sheet& sheet);

struct Words {
  std::string title;                                  // may be empty
  std::string time;                                   // "t = 12.50 s"; empty if no time has passed
  std::string deform;                                 // "deformations × 2"
  std::string hidden;                                 // "hidden: backfill"; may be empty
  std::vector<std::pair<std::string, Colour>> lines;  // legend of the lines drawn over the picture
};

/// The height that the legend, or the title of the scale, needs above the other words at the foot (Sheet::raised): 0 if
/// it fits between the length scale and the words in the corner.
double raised_height(const Sheet& sheet, const Colouring& colouring, const Words& words);

void draw_annotation(Overlay& overlay, const Sheet& sheet, const View& view, const Colouring& colouring,
                     const Words& words);

}  // namespace voussoir
