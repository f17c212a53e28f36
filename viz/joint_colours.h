// Joint stresses as colours of the faces of joints.
#pragma once
#include <vtkSmartPointer.h>

#include "viz/colouring.h"

namespace voussoir {

/// Whether this word colours the joints: normal (compression, MPa; also tension if there is any), shear (MPa),
/// utilisation (shear force / shear resistance) or eccentricity (relative to the depth, in classes).
bool colours_joints(const std::string& by);

/// The joints in such a picture: all except ties. `joints` are all of them.
bool is_shown_as_joint(vtkPolyData* joints, vtkIdType number);

/// Faces of joints in two groups.
struct ColouredJoints {
  Colouring colouring;
  vtkSmartPointer<vtkPolyData> faces;  // with the colours as active scalars
  vtkSmartPointer<vtkPolyData> bare;   // almost unstressed faces: they are outlines only, to not hide the others
};

/// Colours the joints. `range` is the upper end of the scale, MPa or –; 0 for one from the data, and 1 for the
/// utilisation. Bare joints have less than 5 % of the upper end or, for the eccentricity, less than 5 % of the usual
/// largest mean compression. Throws InputError if the faces do not have the fields.
ColouredJoints colour_joints(vtkPolyData* faces, const std::string& by, double range);

}  // namespace voussoir
