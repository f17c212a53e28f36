// Cutting the content of a picture by a plane across an axis, so that what is inside is seen.
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

/// A plane in the assembly as built. What lies before it, as the reader sees it, is left out: the section moves with
/// the material, so that it shows how it deforms.
struct CutPlane {
  int axis = 1;        // 0 x, 1 y, 2 z
  double place = 0.0;  // m
  double side = 1.0;   // 1: what lies above `place` is kept, −1: what lies below

  /// m behind the plane; zero within a micrometre of it, so that no slivers are cut.
  double depth(const Vec3& x) const;
  std::string words() const;  // "cut at y = 0.5 m"
};

/// "y=0.5" or "y", the middle of `content`; empty: no cut. Throws InputError for other words, for a place outside of
/// `content`, and for a plane that the view sees from its edge.
std::optional<CutPlane> find_cut(const std::string& text, const View& view, const Box& content);

/// The points of a stored grid in the undeformed place, with their displacements relative to the base; new ones can be
/// put on edges.
class Places {
 public:
  /// Throws InputError when the grid has no displacements; `what` names it.
  Places(vtkPointSet* data, const char* what);
  const Vec3& reference(vtkIdType i) const { return reference_[std::size_t(i)]; }
  /// Where the edge from a to b meets the plane; the same point for the same edge.
  vtkIdType on_edge(vtkIdType a, vtkIdType b, const CutPlane& cut);
  /// Their number with those on edges.
  vtkIdType count() const { return vtkIdType(reference_.size()); }
  /// reference + amplification × displacement.
  vtkSmartPointer<vtkPoints> amplified(double amplification) const;
  /// Named "displacement_of_point", m.
  vtkSmartPointer<vtkDataArray> displacements() const;

 private:
  std::vector<Vec3> reference_, displacement_;
  std::map<std::pair<vtkIdType, vtkIdType>, vtkIdType> on_edges_;
};

using Loop = std::vector<vtkIdType>;

/// What the plane leaves of a plane polygon; fewer than three corners: nothing. The edges along the plane of the
/// section that closes the body behind it are added to `rim`, where one is given.
Loop cut_polygon(const Loop& polygon, Places& places, const CutPlane& cut, std::multimap<vtkIdType, vtkIdType>* rim);

bool in_plane(const Loop& polygon, const Places& places, const CutPlane& cut);

/// The faces that are left of a closed body with these faces, then its section; none when it lies before the plane. Of
/// the faces only those with `seen` are given back, and those in the plane: there the neighbour is left out.
std::vector<Loop> cut_body(const std::vector<Loop>& faces, const std::vector<bool>& seen, Places& places,
                           const CutPlane& cut);

}  // namespace voussoir
