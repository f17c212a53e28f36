#include "viz/overlay.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkTriangleFilter.h>

#include <algorithm>
#include <cmath>

#include "solver/base/constants.h"
#include "viz/offscreen.h"

namespace voussoir {
namespace {

vtkSmartPointer<vtkActor2D> flat_actor(vtkPolyData* shape, const Colour& colour) {
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(shape);
  auto actor = vtkSmartPointer<vtkActor2D>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour.data());
  return actor;
}

using FlatPoints = std::vector<std::pair<double, double>>;

/// Gives the shape all these points and returns one cell through each list of them.
vtkSmartPointer<vtkCellArray> add_points(vtkPolyData* shape, const std::vector<FlatPoints>& lists) {
  vtkNew<vtkPoints> points;
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (const FlatPoints& corners : lists) {
    cells->InsertNextCell(int(corners.size()));
    for (const auto& [x, y] : corners)
      cells->InsertCellPoint(points->InsertNextPoint(x * kOversampling, y * kOversampling, 0.0));
  }
  shape->SetPoints(points);
  return cells;
}

void set_style(vtkTextProperty* style, double size, bool bold) {
  style->SetFontFamilyToArial();
  style->SetFontSize(int(std::lround(size * kOversampling)));
  style->SetBold(bold);
}

}  // namespace

double Overlay::text_width(const std::string& words, double size) {
  vtkNew<vtkTextProperty> style;
  set_style(style, size, false);
  int box[4] = {0, 0, 0, 0};
  if (vtkTextRenderer* measure = vtkTextRenderer::GetInstance()) measure->GetBoundingBox(style, words, box, 72);
  return double(box[1] - box[0]) / kOversampling;
}

void Overlay::text(double x, double y, const std::string& words, double size, Align align, const Colour& colour,
                   bool bold) {
  if (words.empty()) return;
  vtkNew<vtkTextActor> actor;
  actor->SetInput(words.c_str());
  actor->SetPosition(x * kOversampling, y * kOversampling);
  vtkTextProperty* style = actor->GetTextProperty();
  set_style(style, size, bold);
  style->SetColor(colour[0], colour[1], colour[2]);
  style->SetVerticalJustificationToBottom();
  if (align == Align::left)
    style->SetJustificationToLeft();
  else if (align == Align::centre)
    style->SetJustificationToCentered();
  else
    style->SetJustificationToRight();
  renderer_->AddActor2D(actor);
}

void Overlay::upright_text(double x, double y, const std::string& words, double size) {
  if (words.empty()) return;
  vtkNew<vtkTextActor> actor;
  actor->SetInput(words.c_str());
  actor->SetPosition(x * kOversampling, y * kOversampling);
  vtkTextProperty* style = actor->GetTextProperty();
  set_style(style, size, false);
  style->SetColor(kInk[0], kInk[1], kInk[2]);
  style->SetOrientation(90.0);
  style->SetVerticalJustificationToCentered();
  style->SetJustificationToCentered();
  renderer_->AddActor2D(actor);
}

void Overlay::line(double x0, double y0, double x1, double y1, double width, const Colour& colour) {
  // A thin rectangle: drivers differ in how they draw wide flat lines.
  const double length = std::hypot(x1 - x0, y1 - y0);
  if (length <= 0.0) return;
  const double nx = -(y1 - y0) / length * width / 2, ny = (x1 - x0) / length * width / 2;
  polygon({{x0 - nx, y0 - ny}, {x1 - nx, y1 - ny}, {x1 + nx, y1 + ny}, {x0 + nx, y0 + ny}}, colour);
}

void Overlay::rectangle(double x, double y, double width, double height, const Colour& colour) {
  polygon({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, colour);
}

void Overlay::polyline(const std::vector<std::pair<double, double>>& points, double width, const Colour& colour) {
  polylines({points}, width, colour);
}

void Overlay::polylines(const std::vector<std::vector<std::pair<double, double>>>& lines, double width,
                        const Colour& colour) {
  vtkNew<vtkPolyData> shape;
  const auto cells = add_points(shape, lines);
  shape->SetLines(cells);
  const auto actor = flat_actor(shape, colour);
  actor->GetProperty()->SetLineWidth(float(width * kOversampling));
  renderer_->AddActor2D(actor);
}

void Overlay::disc(double x, double y, double radius, const Colour& colour) {
  std::vector<std::pair<double, double>> corners;
  for (int k = 0; k < 24; ++k) {
    const double angle = 2.0 * pi * k / 24;
    corners.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle)});
  }
  polygon(corners, colour);
}

void Overlay::polygon(const std::vector<std::pair<double, double>>& corners, const Colour& colour) {
  polygons({corners}, colour);
}

void Overlay::polygons(const std::vector<std::vector<std::pair<double, double>>>& outlines, const Colour& colour) {
  vtkNew<vtkPolyData> shape;
  const auto cells = add_points(shape, outlines);
  shape->SetPolys(cells);
  if (std::ranges::all_of(outlines, [](const FlatPoints& corners) { return corners.size() <= 4; })) {
    renderer_->AddActor2D(flat_actor(shape, colour));
    return;
  }
  // Drivers fill a polygon as a fan, which is wrong for one that is not convex.
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(shape);
  triangles->Update();
  renderer_->AddActor2D(flat_actor(triangles->GetOutput(), colour));
}

double nice_below(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit) + 1e-9));
  for (const double step : {5.0, 2.0})
    if (step * power <= limit * (1 + 1e-9)) return step * power;
  return power;
}

double nice_above(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value) + 1e-9));
  for (const double step : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (step * power >= value * (1 - 1e-9)) return step * power;
  return 10.0 * power;
}

}  // namespace voussoir
