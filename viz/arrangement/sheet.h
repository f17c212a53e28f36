// Texts and dimension lines of a drawing on paper, in mm from the upper left. Texts do not overlap.
#pragma once
#include <string>
#include <vector>

#include "viz/page/drawing.h"

namespace voussoir {

constexpr double kPixelsPerMm = 96.0 / 25.4;  // CSS: prints true to scale
// mm: height of letters with the space above and below them, and lengths of marks.
constexpr double kSmallText = 2.6, kPlainText = 3.0, kHeadText = 4.0, kTickLength = 2.0, kDimensionRow = 6.5;

struct SheetBox {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;  // mm
  bool meets(const SheetBox& other) const {
    return x < other.x + other.width && other.x < x + width && y < other.y + other.height && other.y < y + height;
  }
};

/// A point of a chain of dimensions: its position along the chain, and the start of its extension line, mm.
struct ChainStop {
  double at = 0.0, from = 0.0;
};

class DrawingSheet {
 public:
  enum class Align { start, middle, end };
  explicit DrawingSheet(Drawing& drawing) : drawing_(drawing) {}

  void line(double x1, double y1, double x2, double y2, double width = 0.13, const char* dashes = "");
  void lines(const std::vector<std::pair<Vec3, Vec3>>& lines, double width, const std::string& colour,
             const char* dashes = "");
  void areas(const std::vector<Drawing::Path>& outlines, const std::string& colour);
  void rectangle(const SheetBox& box, const std::string& fill, const std::string& stroke, double width = 0.13);

  /// Text whose baseline begins, is centred or ends at (x, y). Upright text reads upwards and is centred at (x, y). It
  /// is drawn over anything below.
  void text(double x, double y, const std::string& words, double size = kSmallText, Align align = Align::start,
            bool bold = false, bool upright = false);
  /// The same on a white background, but only if no other text is there; otherwise returns false. Fonts differ: the
  /// text takes at most width_of().
  bool try_text(double x, double y, const std::string& words, Align align = Align::middle, bool upright = false);
  static double width_of(const std::string& words, double size = kSmallText);
  /// The text, shortened at its end to fit the given width, mm.
  static std::string fitting(const std::string& words, double room, double size = kSmallText);
  /// The text in lines that are not wider than `room` (mm). Only a line of a single word may be wider.
  static std::vector<std::string> wrapped(const std::string& words, double room, double size = kSmallText);

  /// Title of the view in a box, underlined and centred at x.
  void title(const SheetBox& box, double middle, const std::string& words);
  /// A chain of dimensions along x at height y, with one text between neighbouring points (none if it is empty), and
  /// likewise along y. Texts that do not fit between their points are put next to the line.
  void chain_along_x(double y, const std::vector<ChainStop>& stops, const std::vector<std::string>& texts);
  void chain_along_y(double x, const std::vector<ChainStop>& stops, const std::vector<std::string>& texts,
                     bool outside_left);
  /// An arrow from (x1, y1) with its head at (x2, y2).
  void arrow(double x1, double y1, double x2, double y2, double width = 0.18);

  const std::vector<SheetBox>& texts() const { return texts_; }
  int left_out() const { return left_out_; }  // number of texts of chains that did not fit

 private:
  bool free(const SheetBox& box) const;
  static SheetBox box_of(double x, double y, const std::string& words, double size, Align align, bool upright);
  void tick(double x, double y);
  void put(double x, double y, const std::string& words, double size, Align align, bool bold, bool upright);

  Drawing& drawing_;
  std::vector<SheetBox> texts_;
  int left_out_ = 0;
};

/// A length in m as text on a dimension line: to the centimetre; below a metre to the millimetre if needed.
std::string length_text(double metres);

}  // namespace voussoir
