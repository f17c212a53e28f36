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

/// The components that a picture leaves out, by name. Throws InputError that lists the names if one is unknown.
class Hidden {
 public:
  explicit Hidden(const std::vector<std::string>& names);
  bool operator()(int component) const { return component >= 0 && hidden_[std::size_t(component)]; }

 private:
  std::vector<bool> hidden_;
};

/// Faces of the visible stones, or of a fill those that no two tetrahedra share, at reference + amplification ×
/// displacement relative to the base. The faces of a stone, and of the fill, share points. The part in front of the
/// cut is left out, and the section through each stone and tetrahedron is a separate face. Cell data: those of the
/// grid, for each face. Point data: displacement_of_point. Throws InputError for a grid without these fields.
vtkSmartPointer<vtkPolyData> deformed_faces(vtkUnstructuredGrid* grid, const Hidden& hidden, double amplification,
                                            const std::optional<CutPlane>& cut = {});

/// Edges at an angle between faces of a stone, or at the end of a face.
vtkSmartPointer<vtkPolyData> outlines(vtkPolyData* faces);

/// The outline of the whole: the parts of undeformed edges at which neither adjacent face has a joint. Edges between
/// stones with flush faces are therefore left out. `faces` are those of the undeformed stones, `joints` all joints.
vtkSmartPointer<vtkPolyData> outer_outline(vtkPolyData* faces, vtkPolyData* joints);

/// The patches between visible stones that `shown` selects by number, deformed and cut like the stones. Patches
/// replaced by a contact are left out. Cell data: those of the joint.
vtkSmartPointer<vtkPolyData> joint_faces(vtkPolyData* joints, const Hidden& hidden, double amplification,
                                         const std::function<bool(vtkIdType)>& shown,
                                         const std::optional<CutPlane>& cut = {});

/// Limits from which a patch counts as cracked.
struct CrackRule {
  double opening = 1e-4, slip = 1e-4;  // m, largest since the start
  double bonded = 0.5;                 // a patch with an original bond that keeps a smaller share of its area
};

/// The cracked patches between visible stones, deformed and cut like the stones.
vtkSmartPointer<vtkPolyData> crack_patches(vtkPolyData* joints, const Hidden& hidden, double amplification,
                                           const CrackRule& rule, const std::optional<CutPlane>& cut = {});
/// The border lines of polygons.
vtkSmartPointer<vtkPolyData> borders(vtkPolyData* polygons);

}  // namespace voussoir
