// Cuts the content of a picture by a plane across an axis, to show the inside.
#pragma once
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "viz/view.h"

namespace voussoir {

/// A plane in the assembly as built. The part in front of it, as the reader sees it, is left out. The section moves
/// with the material and therefore shows how it deforms.
struct CutPlane {
  int axis = 1;        // 0 x, 1 y, 2 z
  double place = 0.0;  // m
  double side = 1.0;   // 1: the part above `place` is kept, −1: the part below

  /// Distance behind the plane, m; zero within a micrometre of it, so that no slivers are cut.
  double depth(const Vec3& x) const;
  std::string words() const;  // "cut at y = 0.5 m"
};

/// Reads "y=0.5", or "y" for the middle of `content`; empty: no cut. Throws InputError for other words, for a place
/// outside of `content`, and for a plane that the view sees edge-on.
std::optional<CutPlane> find_cut(const std::string& text, const View& view, const Box& content);

/// The points of a stored grid in the undeformed position, with their displacements relative to the base. New points
/// can be put on edges.
class Places {
 public:
  /// Throws InputError when the grid has no displacements; `what` names it.
  Places(vtkPointSet* data, const char* what);
  const Vec3& reference(vtkIdType i) const { return reference_[std::size_t(i)]; }
  /// Intersection of the edge from a to b with the plane; the same point for the same edge.
  vtkIdType on_edge(vtkIdType a, vtkIdType b, const CutPlane& cut);
  /// Number of points including those on edges.
  vtkIdType count() const { return vtkIdType(reference_.size()); }
  /// Points at reference + amplification × displacement relative to the base, m.
  vtkSmartPointer<vtkPoints> amplified(double amplification) const;
  /// Named "displacement_of_point", m.
  vtkSmartPointer<vtkDataArray> displacements() const;

 private:
  std::vector<Vec3> reference_, displacement_;
  std::map<std::pair<vtkIdType, vtkIdType>, vtkIdType> on_edges_;
};

using Loop = std::vector<vtkIdType>;

/// The part of a plane polygon behind the plane; fewer than three corners: nothing. The edges of the section that
/// closes the body are added to `rim`, if given.
Loop cut_polygon(const Loop& polygon, Places& places, const CutPlane& cut, std::multimap<vtkIdType, vtkIdType>* rim);

bool in_plane(const Loop& polygon, const Places& places, const CutPlane& cut);

/// The faces that remain of a closed body after the cut, then its section; none if the body is in front of the plane. A
/// face is returned only if it is marked in `seen`, or if it lies in the plane, because the neighbour there is left
/// out.
std::vector<Loop> cut_body(const std::vector<Loop>& faces, const std::vector<bool>& seen, Places& places,
                           const CutPlane& cut);

}  // namespace voussoir
