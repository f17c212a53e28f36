// What the joints carry, as colours of their own faces.
#pragma once
#include <vtkSmartPointer.h>

#include "viz/colouring.h"

namespace voussoir {

/// Whether it is the joints that are coloured by this word: normal (compression, MPa; tension where there is any),
/// shear (MPa), utilisation (shear over what friction and cohesion allow) or eccentricity (over the depth, in classes).
bool colours_joints(const std::string& by);

/// Which joints such a picture shows: ties are none. `joints` are all of them.
bool is_shown_as_joint(vtkPolyData* joints, vtkIdType number);

/// Faces of joints by what there is to see of them.
struct ColouredJoints {
  Colouring colouring;
  vtkSmartPointer<vtkPolyData> faces;  // with the colours as active scalars
  vtkSmartPointer<vtkPolyData> bare;   // hardly stressed: they would hide the others
};

/// `range` is the top of the scale, MPa or –; 0 for one from the data, of the utilisation 1. Bare are joints with less
/// than 5 % of the top, and of the eccentricity those with less than 5 % of the usual largest mean compression. Throws
/// InputError where the faces do not have what it takes.
ColouredJoints colour_joints(vtkPolyData* faces, const std::string& by, double range);

}  // namespace voussoir
