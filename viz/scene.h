// The shapes of a picture, made from the stored grids: deformed faces and outlines of the visible stones and of the
// fill, and the cracks.
#pragma once
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "viz/cut.h"

namespace voussoir {

/// Which components a picture leaves out, by name. Throws InputError listing the names when one is unknown.
class Hidden {
 public:
  explicit Hidden(const std::vector<std::string>& names);
  bool operator()(int component) const { return component >= 0 && hidden_[std::size_t(component)]; }

 private:
  std::vector<bool> hidden_;
};

/// Faces of the visible stones, or of a fill those that no two tetrahedra share, moved to reference + amplification ×
/// displacement relative to the base. Points of one stone, and of the fill, are shared by its faces. What lies before
/// the cut is left out and the section through each stone and tetrahedron is a face of its own. Cell data: the grid's,
/// taken over face by face; point data: displacement_of_point. Throws InputError for a grid without these fields.
vtkSmartPointer<vtkPolyData> deformed_faces(vtkUnstructuredGrid* grid, const Hidden& hidden, double amplification,
                                            const std::optional<CutPlane>& cut = {});

/// Edges where faces of a stone meet at an angle, or where a face ends.
vtkSmartPointer<vtkPolyData> outlines(vtkPolyData* faces);

/// The outline of the whole: of the edges of undeformed stones what has nothing but air on both its faces, so none of
/// the edges between stones that join in one face. `faces` are those of the undeformed stones, `joints` all patches.
vtkSmartPointer<vtkPolyData> outer_outline(vtkPolyData* faces, vtkPolyData* joints);

/// The patches between visible stones that `shown` picks by their numbers, deformed and cut like the stones. Those that
/// a contact has taken the place of are left out. Cell data: that of the joints.
vtkSmartPointer<vtkPolyData> joint_faces(vtkPolyData* joints, const Hidden& hidden, double amplification,
                                         const std::function<bool(vtkIdType)>& shown,
                                         const std::optional<CutPlane>& cut = {});

/// When a patch counts as cracked.
struct CrackRule {
  double opening = 1e-4, slip = 1e-4;  // m, largest since the start
  double bonded = 0.5;                 // a patch that had a bond and keeps less of its area
};

/// The cracked patches between visible stones, deformed and cut like the stones.
vtkSmartPointer<vtkPolyData> crack_patches(vtkPolyData* joints, const Hidden& hidden, double amplification,
                                           const CrackRule& rule, const std::optional<CutPlane>& cut = {});
/// The border lines of polygons.
vtkSmartPointer<vtkPolyData> borders(vtkPolyData* polygons);

}  // namespace voussoir
