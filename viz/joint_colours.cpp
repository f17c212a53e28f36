#include "viz/joint_colours.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "solver/base/error.h"

namespace voussoir {

namespace {

std::vector<double> joint_values(vtkPolyData* faces, const char* field, double factor) {
  vtkDataArray* values = faces->GetCellData()->GetArray(field);
  if (!values)
    throw InputError(
        "pictures: the joints have no field '{}', because an earlier version wrote this frame. Give a checkpoint of "
        "the run, or run it again",
        field);
  std::vector<double> scaled;
  for (vtkIdType i = 0; i < faces->GetNumberOfPolys(); ++i) scaled.push_back(factor * values->GetComponent(i, 0));
  return scaled;
}

constexpr double hardly = 0.05;  // of the top of a scale

/// Colours by the numbers `of`; joints without a number are bare.
ColouredJoints painted(vtkPolyData* faces, Colouring colouring,
                       const std::function<std::optional<Colour>(std::size_t)>& of) {
  ColouredJoints joints{std::move(colouring), vtkSmartPointer<vtkPolyData>::New(), vtkSmartPointer<vtkPolyData>::New()};
  std::vector<Colour> colours;
  vtkNew<vtkCellArray> seen, bare;
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < faces->GetNumberOfPolys(); ++i) {
    faces->GetCellPoints(i, corners);
    const std::optional<Colour> colour = of(std::size_t(i));
    (colour ? seen : bare)->InsertNextCell(corners);
    if (colour) colours.push_back(*colour);
  }
  joints.faces->SetPoints(faces->GetPoints()), joints.faces->SetPolys(seen);
  joints.bare->SetPoints(faces->GetPoints()), joints.bare->SetPolys(bare);
  paint_faces(joints.faces, [&](vtkIdType i) { return colours[std::size_t(i)]; });
  return joints;
}

ColouredJoints painted_by(vtkPolyData* faces, const Colouring& colouring, const std::vector<double>& values) {
  return painted(faces, colouring, [&](std::size_t i) -> std::optional<Colour> {
    if (std::abs(values[i]) < hardly * colouring.top) return {};
    return colour_on_scale(colouring, values[i]);
  });
}

/// Compression upwards and tension downwards, in whole parts of the same scale.
ColouredJoints joints_by_normal(vtkPolyData* faces, double range) {
  const std::vector<double> compression = joint_values(faces, "normal_traction", -1e-6);
  Colouring colouring{.title = "mean compression of the joints, MPa; outlines: below 5 % of the scale"};
  set_top(colouring, compression, range);
  const double part = colouring.top / scale_steps(colouring.top);
  const double least = compression.empty() ? 0.0 : *std::ranges::min_element(compression);
  if (-least > hardly * colouring.top) {
    const double parts = std::min(std::ceil(-least / part), double(scale_steps(colouring.top)));
    colouring.bottom = -parts * part;
    colouring.title = "mean compression of the joints, MPa (negative: tension); outlines: below 5 % of the scale";
  }
  return painted_by(faces, colouring, compression);
}

ColouredJoints joints_on_one_side(vtkPolyData* faces, const char* field, double factor, const char* title,
                                  double range) {
  const std::vector<double> values = joint_values(faces, field, factor);
  Colouring colouring{.title = title};
  set_top(colouring, values, range);
  return painted_by(faces, colouring, values);
}

/// The kern ends at a sixth of the depth. At a third, a joint without tension has opened to half its depth.
ColouredJoints joints_by_eccentricity(vtkPolyData* faces) {
  constexpr std::array<double, 3> ends = {1.0 / 6.0, 1.0 / 3.0, 0.45};
  const std::array<Colour, 4> colours = {scale_colour(0.1), scale_colour(0.35), scale_colour(0.65), scale_colour(1.0)};
  const std::vector<double> values = joint_values(faces, "eccentricity", 1.0),
                            compression = joint_values(faces, "normal_traction", -1e-6);
  Colouring usual;
  set_top(usual, compression, 0.0);
  const Colouring colouring{.legend = {{"within the kern (e/d ≤ 1/6)", colours[0]},
                                       {"≤ 1/3", colours[1]},
                                       {"≤ 0.45", colours[2]},
                                       {"at the edge or outside", colours[3]},
                                       {"outlines only: almost no compression", {1, 1, 1}}}};
  return painted(faces, colouring, [&](std::size_t i) -> std::optional<Colour> {
    if (compression[i] <= hardly * usual.top) return {};
    const double value = values[i] * (1.0 - 1e-9);  // a value on a limit counts as inside
    return colours[std::size_t(std::ranges::lower_bound(ends, value) - ends.begin())];
  });
}

}  // namespace

bool colours_joints(const std::string& by) {
  return by == "normal" || by == "shear" || by == "utilisation" || by == "eccentricity";
}

bool is_shown_as_joint(vtkPolyData* joints, vtkIdType number) {
  vtkDataArray* tie = joints->GetCellData()->GetArray("tie");
  return !tie || tie->GetComponent(number, 0) == 0.0;
}

ColouredJoints colour_joints(vtkPolyData* faces, const std::string& by, double range) {
  if (by == "normal") return joints_by_normal(faces, range);
  if (by == "shear")
    return joints_on_one_side(faces, "shear_traction", 1e-6,
                              "mean shear stress of the joints, MPa; outlines: below 5 % of the scale", range);
  if (by == "utilisation")
    return joints_on_one_side(
        faces, "utilisation", 1.0,
        "utilisation: shear force / shear resistance (friction and cohesion); outlines: below 5 % of the scale",
        range > 0.0 ? range : 1.0);
  return joints_by_eccentricity(faces);
}

}  // namespace voussoir
