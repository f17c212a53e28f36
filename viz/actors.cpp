#include "viz/actors.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <cmath>

#include "viz/offscreen.h"

namespace voussoir {

namespace {

/// The same shape moved towards the reader by `lift` (m), so that lines are in front of the faces they border. Each
/// point moves along its own line of sight, so its position in the picture does not change.
vtkSmartPointer<vtkPolyData> lifted(vtkPolyData* shape, vtkCamera* camera, double lift) {
  Vec3 eye, focus;
  camera->GetPosition(eye.data());
  camera->GetFocalPoint(focus.data());
  const Vec3 along = (eye - focus).normalized();
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < shape->GetNumberOfPoints(); ++i) {
    Vec3 x;
    shape->GetPoint(i, x.data());
    points->InsertNextPoint(Vec3(x + lift * (camera->GetParallelProjection() ? along : (eye - x).normalized())).data());
  }
  auto moved = vtkSmartPointer<vtkPolyData>::New();
  moved->ShallowCopy(shape);
  moved->SetPoints(points);
  return moved;
}

}  // namespace

void add_faces(vtkRenderer* renderer, vtkPolyData* faces, double ambient) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(faces);
  mapper->SetColorModeToDirectScalars();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->SetAmbient(ambient);
  actor->GetProperty()->SetDiffuse(1.0 - ambient);
  renderer->AddActor(actor);
}

void add_lines(vtkRenderer* renderer, vtkPolyData* lines, double width, const Colour& colour, double lift) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(lifted(lines, renderer->GetActiveCamera(), lift));
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
  actor->GetProperty()->SetLineWidth(float(width * kOversampling));
  actor->GetProperty()->LightingOff();
  renderer->AddActor(actor);
}

void add_edge_on(vtkRenderer* renderer, vtkPolyData* faces, const View& view, double lift) {
  constexpr double edge_on = 0.02;  // cosine between the normal and the line of sight
  vtkDataArray* colours = faces->GetCellData()->GetScalars();
  vtkNew<vtkPolyData> lines;
  vtkNew<vtkCellArray> cells;
  auto painted = vtkSmartPointer<vtkDataArray>::Take(colours->NewInstance());
  painted->SetNumberOfComponents(3);
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < faces->GetNumberOfPolys(); ++c) {
    faces->GetPolys()->GetCellAtId(c, corners);
    Polygon polygon;
    for (const vtkIdType i : *corners.GetPointer()) polygon.push_back(Vec3::Map(faces->GetPoint(i)));
    if (std::abs(polygon_normal(polygon).dot(view.forward)) > edge_on) continue;
    corners->InsertNextId(corners->GetId(0));
    cells->InsertNextCell(corners);
    painted->InsertNextTuple(colours->GetTuple(c));
  }
  lines->SetPoints(faces->GetPoints());
  lines->SetLines(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  const auto moved = lifted(lines, renderer->GetActiveCamera(), lift);
  moved->GetCellData()->SetScalars(painted);
  mapper->SetInputData(moved);
  mapper->SetColorModeToDirectScalars();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetLineWidth(float(4.0 * kOversampling));
  actor->GetProperty()->LightingOff();
  renderer->AddActor(actor);
}

void add_crack_faces(vtkRenderer* renderer, vtkPolyData* cracks) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(cracks);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(kCrack[0], kCrack[1], kCrack[2]);
  actor->GetProperty()->LightingOff();
  renderer->AddActor(actor);
}

void add_lights(vtkRenderer* renderer, const View& view) {
  const auto add = [&](double x, double y, double z, double intensity) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(x, y, z);
    light->SetFocalPoint(0, 0, 0);
    light->SetIntensity(intensity);
    renderer->AddLight(light);
  };
  renderer->RemoveAllLights();
  renderer->SetAutomaticLightCreation(0);
  const double strength = view.perspective ? 1.3 : 1.0;  // in an oblique view no face is square to the lamps
  add(-0.5, 0.8, 1.2, 0.75 * strength);
  add(0.8, -0.1, 1.2, 0.50 * strength);
}

}  // namespace voussoir
