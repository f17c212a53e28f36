#include "viz/colouring.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "solver/base/error.h"
#include "viz/overlay.h"

namespace voussoir {
namespace {

void set_colour(vtkUnsignedCharArray* colours, vtkIdType i, const Colour& colour) {
  for (int c = 0; c < 3; ++c) colours->SetComponent(i, c, std::lround(255.0 * std::clamp(colour[c], 0.0, 1.0)));
}

vtkSmartPointer<vtkUnsignedCharArray> make_colours(vtkIdType n) {
  auto colours = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colours->SetName("colour");
  colours->SetNumberOfComponents(3);
  colours->SetNumberOfTuples(n);
  return colours;
}

/// A slight variation from stone to stone, always the same for the same stone.
Colour varied(const Colour& colour, vtkIdType stone) {
  const auto bits = (std::uint64_t(stone) + 1) * 0x9e3779b97f4a7c15ULL;
  const double factor = 1.0 + 0.05 * (double(bits >> 40) / double(1 << 24) - 0.5);
  return {colour[0] * factor, colour[1] * factor, colour[2] * factor};
}

/// A round top of the scale. A few stones far beyond all others (fallen ones) do not set it: then it is cut at the 98th
/// percentile of the values that are not zero.
void set_top(Colouring& colouring, std::vector<double> values, double range_mm) {
  std::erase_if(values, [](double v) { return !(v > 0.0); });
  std::sort(values.begin(), values.end());
  const double largest = values.empty() ? 0.0 : values.back();
  double top = range_mm;
  if (top <= 0.0 && largest < 1e-6)
    top = 1.0;
  else if (top <= 0.0) {
    const double usual = values[std::size_t(0.98 * double(values.size() - 1))];
    top = nice_above(largest > 3.0 * usual ? usual : largest);
  }
  colouring.top_mm = top;
  colouring.exceeded = largest > top * (1 + 1e-9);
}

Colouring colour_by_cell(vtkPolyData* faces, const char* field, const char* title, double range_mm) {
  vtkDataArray* values = faces->GetCellData()->GetArray(field);
  vtkDataArray* fixed = faces->GetCellData()->GetArray("fixed");
  if (!values || !fixed)
    throw InputError("pictures: the blocks have no field '{}'; give a file written by voussoir", field);
  const vtkIdType n = faces->GetNumberOfPolys();
  std::vector<double> mm;
  for (vtkIdType i = 0; i < n; ++i) mm.push_back(fixed->GetComponent(i, 0) ? 0.0 : 1e3 * values->GetComponent(i, 0));
  Colouring colouring{title, 0.0, false, {}};
  set_top(colouring, mm, range_mm);
  auto colours = make_colours(n);
  for (vtkIdType i = 0; i < n; ++i)
    set_colour(colours, i, fixed->GetComponent(i, 0) ? kFixed : scale_colour(mm[i] / colouring.top_mm));
  faces->GetCellData()->SetScalars(colours);
  return colouring;
}

Colouring colour_by_displacement(vtkPolyData* faces, double range_mm) {
  vtkDataArray* displacement = faces->GetPointData()->GetArray("displacement_of_point");
  const vtkIdType n = faces->GetNumberOfPoints();
  std::vector<double> mm;
  for (vtkIdType i = 0; i < n; ++i) {
    double d[3];
    displacement->GetTuple(i, d);
    mm.push_back(1e3 * std::hypot(d[0], d[1], d[2]));
  }
  Colouring colouring{"displacement relative to the base (mm)", 0.0, false, {}};
  set_top(colouring, mm, range_mm);
  auto colours = make_colours(n);
  for (vtkIdType i = 0; i < n; ++i) set_colour(colours, i, scale_colour(mm[i] / colouring.top_mm));
  faces->GetPointData()->SetScalars(colours);
  return colouring;
}

/// Shares of the largest displacement.
Colouring colour_by_mode(vtkPolyData* faces) {
  vtkDataArray* displacement = faces->GetPointData()->GetArray("displacement_of_point");
  double range[2];
  displacement->GetRange(range, -1);
  // A scale of "mm" whose top is 1: the numbers at its ticks are shares.
  Colouring colouring = colour_by_displacement(faces, range[1] > 0.0 ? 1e3 * range[1] : 1.0);
  colouring.title = "displacement, share of the largest";
  colouring.top_mm = 1.0;
  return colouring;
}

/// By component, or all in the tone of stone.
Colouring colour_plainly(vtkPolyData* faces, bool by_component) {
  vtkDataArray* component = faces->GetCellData()->GetArray("component");
  vtkDataArray* fixed = faces->GetCellData()->GetArray("fixed");
  vtkDataArray* block = faces->GetCellData()->GetArray("block");
  const vtkIdType n = faces->GetNumberOfPolys();
  auto colours = make_colours(n);
  std::set<Component> seen;
  for (vtkIdType i = 0; i < n; ++i) {
    const auto which = Component(int(component->GetComponent(i, 0)));
    seen.insert(which);
    const bool grey = fixed && fixed->GetComponent(i, 0) != 0.0;
    const Colour tone = by_component ? component_colour(which) : grey ? kFixed : kStone;
    set_colour(colours, i, varied(tone, block ? vtkIdType(block->GetComponent(i, 0)) : i));
  }
  faces->GetCellData()->SetScalars(colours);
  if (!by_component) seen.clear();
  return {"", 0.0, false, {seen.begin(), seen.end()}};
}

}  // namespace

Colouring colour_faces(vtkPolyData* faces, const std::string& by, double range_mm) {
  if (by == "opening") return colour_by_cell(faces, "max_joint_opening", "largest joint opening (mm)", range_mm);
  if (by == "slip") return colour_by_cell(faces, "max_joint_slip", "largest joint slip (mm)", range_mm);
  if (by == "displacement") return colour_by_displacement(faces, range_mm);
  if (by == "mode") return colour_by_mode(faces);
  if (by == "component" || by == "stone") return colour_plainly(faces, by == "component");
  throw InputError("pictures: cannot colour by '{}'; give opening, slip, displacement, mode, component or stone", by);
}

}  // namespace voussoir
