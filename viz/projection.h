// Positions of points of the scene on the finished picture.
#pragma once
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>

#include "viz/annotation.h"

namespace voussoir {

using Spot = Eigen::Vector2d;  // pixels from the lower left

/// Projects points with a camera. Camera and sheet must outlive this object; the camera must not change.
class Projection {
 public:
  Projection(vtkCamera* camera, const Sheet& sheet)
      : sheet_(sheet),
        matrix_(camera->GetCompositeProjectionTransformMatrix(double(sheet.width) / sheet.height, -1.0, 1.0)) {}
  Spot operator()(const Vec3& x) const {
    const double in[4] = {x.x(), x.y(), x.z(), 1.0};
    double out[4];
    matrix_->MultiplyPoint(in, out);
    return {0.5 * (out[0] / out[3] + 1.0) * sheet_.width, 0.5 * (out[1] / out[3] + 1.0) * sheet_.height};
  }

 private:
  const Sheet& sheet_;
  vtkMatrix4x4* matrix_;
};

}  // namespace voussoir
