// Texts and dimension lines of a drawing on paper, in mm from the upper left; no text lies on another.
#pragma once
#include <string>
#include <vector>

#include "viz/page/drawing.h"

namespace voussoir {

constexpr double kPixelsPerMm = 96.0 / 25.4;  // CSS: prints true to scale
// mm: height of letters with what is above and below them, and lengths of marks
constexpr double kSmallText = 2.6, kPlainText = 3.0, kHeadText = 4.0, kTickLength = 2.0, kDimensionRow = 6.5;

struct SheetBox {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;  // mm
  bool meets(const SheetBox& other) const {
    return x < other.x + other.width && other.x < x + width && y < other.y + other.height && other.y < y + height;
  }
};

/// A stop of a chain of dimensions: its place along the chain and where the line that leads to it begins, mm.
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

  /// Text whose baseline begins, has its middle or ends at (x, y); upright reads upwards, its middle at (x, y).
  /// Whatever lies below.
  void text(double x, double y, const std::string& words, double size = kSmallText, Align align = Align::start,
            bool bold = false, bool upright = false);
  /// The same where no other text is; on white. False where there is one. Fonts differ; it surely takes less than
  /// width_of().
  bool try_text(double x, double y, const std::string& words, Align align = Align::middle, bool upright = false);
  static double width_of(const std::string& words, double size = kSmallText);
  /// The words, their end left out where they would take more room, mm.
  static std::string fitting(std::string words, double room, double size = kSmallText);

  /// Title of the view in a box, underlined, its middle at x.
  void title(const SheetBox& box, double middle, const std::string& words);
  /// A chain of dimensions along x at height y, one text between each two stops (none where it is empty), and likewise
  /// along y. Texts that do not fit between their stops are put beside the line.
  void chain_along_x(double y, const std::vector<ChainStop>& stops, const std::vector<std::string>& texts);
  void chain_along_y(double x, const std::vector<ChainStop>& stops, const std::vector<std::string>& texts,
                     bool outside_left);
  /// An arrow from (x1, y1) with its head at (x2, y2).
  void arrow(double x1, double y1, double x2, double y2, double width = 0.18);

  const std::vector<SheetBox>& texts() const { return texts_; }
  int left_out() const { return left_out_; }  // texts of chains for which there was no place

 private:
  bool free(const SheetBox& box) const;
  static SheetBox box_of(double x, double y, const std::string& words, double size, Align align, bool upright);
  void tick(double x, double y);
  void put(double x, double y, const std::string& words, double size, Align align, bool bold, bool upright);

  Drawing& drawing_;
  std::vector<SheetBox> texts_;
  int left_out_ = 0;
};

/// A length in m as it stands at a dimension line: to the centimetre, below a metre to the millimetre where that says
/// more.
std::string length_text(double metres);

}  // namespace voussoir
