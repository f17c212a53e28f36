// Visible parts of a flat view: areas from back to front, and the lines that nothing hides.
#pragma once
#include <array>
#include <utility>
#include <vector>

#include "viz/arrangement/flat_view.h"

namespace voussoir {

/// Line widths of a drawing: joints between stones; edges and borders between components; the outline of the whole and
/// edges with a gap in depth behind them.
enum class LineKind { joint, edge, outline };
constexpr std::size_t kLineKinds = 3;
using FlatLine = std::pair<Vec3, Vec3>;  // (u, v, 0), m

/// Finds the nearest face at a point of a view. The view must outlive this object.
class InFront {
 public:
  explicit InFront(const FlatView& view);
  /// The nearest face at the point; −1 for none.
  std::ptrdiff_t at(const Vec3& place) const;
  /// Distance of the plane of the face along the view, m; larger values are farther from the reader.
  double depth(std::size_t face, const Vec3& place) const;
  /// Calls `pair(i, j)`, i < j, once for each two faces whose boxes overlap.
  template <class Pair>
  void near_pairs(Pair&& pair) const;
  double size() const { return size_; }  // m, of the whole view

 private:
  std::size_t column(double u) const;
  std::size_t row(double v) const;
  const FlatView& view_;
  std::vector<Box> boxes_;
  Box all_;
  std::size_t columns_ = 1, rows_ = 1;
  double size_ = 0.0;
  std::vector<std::vector<std::size_t>> cells_;
};

/// An order of the faces in which they can be painted over one another: of two that overlap on the sheet the farther
/// one is first (Newell, Newell & Sancha 1972, for convex faces that do not cross). Faces of one `colour` (a number
/// for each face) follow one another where possible.
std::vector<std::size_t> painting_order(const FlatView& view, const InFront& front, const std::vector<int>& colour);

/// The visible parts of the edges of all faces, by kind. Parts shorter than `resolution` (m) are not distinguished.
std::array<std::vector<FlatLine>, kLineKinds> visible_lines(const FlatView& view, const InFront& front,
                                                            double resolution);
/// The visible parts of a line on a face.
std::vector<FlatLine> visible_parts(const InFront& front, std::size_t face, const FlatLine& line, double resolution);

}  // namespace voussoir
