#include "viz/colouring.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "solver/base/error.h"
#include "solver/step/principal_stress.h"
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

std::vector<double> cell_values(vtkPolyData* faces, const char* field, double factor, const char* what) {
  vtkDataArray* values = faces->GetCellData()->GetArray(field);
  if (!values) throw InputError("pictures: the {} no field '{}'. Give a file written by voussoir", what, field);
  std::vector<double> scaled;
  for (vtkIdType i = 0; i < faces->GetNumberOfPolys(); ++i) scaled.push_back(factor * values->GetComponent(i, 0));
  return scaled;
}

bool is_fixed(vtkPolyData* faces, vtkIdType i) {
  vtkDataArray* fixed = faces->GetCellData()->GetArray("fixed");
  return fixed && fixed->GetComponent(i, 0) != 0.0;
}

Colouring colour_by_cell(vtkPolyData* faces, const char* field, const char* title, double range) {
  std::vector<double> mm = cell_values(faces, field, 1e3, "blocks have");
  for (std::size_t i = 0; i < mm.size(); ++i)
    if (is_fixed(faces, vtkIdType(i))) mm[i] = 0.0;
  Colouring colouring{.title = title};
  set_top(colouring, mm, range);
  paint_faces(faces, [&](vtkIdType i) {
    return is_fixed(faces, i) ? kFixed : scale_colour(mm[std::size_t(i)] / colouring.top);
  });
  return colouring;
}

/// mm, of the points of faces; a cut leaves other points behind.
std::vector<double> point_displacements(vtkPolyData* faces) {
  std::vector<double> mm;
  if (!faces) return mm;
  vtkDataArray* displacement = faces->GetPointData()->GetArray("displacement_of_point");
  mm.assign(std::size_t(faces->GetNumberOfPoints()), 0.0);
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < faces->GetNumberOfPolys(); ++c) {
    faces->GetPolys()->GetCellAtId(c, corners);
    for (const vtkIdType i : *corners.GetPointer()) {
      double d[3];
      displacement->GetTuple(i, d);
      mm[std::size_t(i)] = 1e3 * std::hypot(d[0], d[1], d[2]);
    }
  }
  return mm;
}

Colouring colour_by_displacement(vtkPolyData* stones, vtkPolyData* fill, double range) {
  std::vector<double> all;
  for (vtkPolyData* faces : {stones, fill}) {
    const std::vector<double> mm = point_displacements(faces);
    all.insert(all.end(), mm.begin(), mm.end());
  }
  Colouring colouring{.title = "displacement relative to the base, mm"};
  set_top(colouring, all, range);
  for (vtkPolyData* faces : {stones, fill}) {
    if (!faces) continue;
    const std::vector<double> mm = point_displacements(faces);
    auto colours = make_colours(vtkIdType(mm.size()));
    for (std::size_t i = 0; i < mm.size(); ++i) set_colour(colours, vtkIdType(i), scale_colour(mm[i] / colouring.top));
    faces->GetPointData()->SetScalars(colours);
  }
  return colouring;
}

/// Shares of the largest displacement.
Colouring colour_by_mode(vtkPolyData* stones, vtkPolyData* fill) {
  double largest = 0.0;
  for (vtkPolyData* faces : {stones, fill})
    for (const double mm : point_displacements(faces)) largest = std::max(largest, mm);
  // A scale of "mm" whose top is 1: the numbers at its ticks are shares.
  Colouring colouring = colour_by_displacement(stones, fill, largest > 0.0 ? largest : 1.0);
  colouring.title = "displacement / largest displacement";
  colouring.top = 1.0;
  return colouring;
}

/// By component, or all in the colour of stone.
Colouring colour_plainly(vtkPolyData* stones, vtkPolyData* fill, bool by_component) {
  vtkDataArray* component = stones->GetCellData()->GetArray("component");
  vtkDataArray* block = stones->GetCellData()->GetArray("block");
  std::set<Component> seen;
  paint_faces(stones, [&](vtkIdType i) {
    const auto which = Component(int(component->GetComponent(i, 0)));
    seen.insert(which);
    const Colour tone = by_component ? component_colour(which) : is_fixed(stones, i) ? kFixed : kStone;
    return varied(tone, block ? vtkIdType(block->GetComponent(i, 0)) : i);
  });
  paint_faces(fill, [](vtkIdType) { return component_colour(Component::backfill); });
  if (fill) seen.insert(Component::backfill);
  Colouring colouring;
  if (by_component)
    for (const Component c : seen)
      colouring.legend.emplace_back(component_names()[std::size_t(c)], component_colour(c));
  return colouring;
}

/// Stones next to a coloured fill: the colours do not apply to them.
void colour_aside(vtkPolyData* stones) {
  paint_faces(stones, [&](vtkIdType i) { return is_fixed(stones, i) ? kFixed : kAside; });
}

Colouring colour_by_plastic_strain(vtkPolyData* stones, vtkPolyData* fill, double range) {
  colour_aside(stones);
  const std::vector<double> percent = cell_values(fill, "plastic_shear_strain", 100.0, "fill has");
  Colouring colouring{.title = "plastic shear strain of the fill, %"};
  set_top(colouring, percent, range);
  paint_faces(fill, [&](vtkIdType i) { return scale_colour(percent[std::size_t(i)] / colouring.top); });
  return colouring;
}

/// Fill that yields both in shear and in tension counts as yielding in tension, which opens the fill.
Colouring colour_by_yield(vtkPolyData* stones, vtkPolyData* fill) {
  constexpr int tension = 2;
  colour_aside(stones);
  const std::vector<double> now = cell_values(fill, "yields_now", 1.0, "fill has"),
                            ever = cell_values(fill, "has_yielded", 1.0, "fill has");
  Colouring colouring;
  colouring.legend = {{"fill: elastic", kElastic},
                      {"has yielded", kYielded},
                      {"yields in shear", kYieldsInShear},
                      {"yields in tension", kYieldsInTension}};
  paint_faces(fill, [&](vtkIdType i) {
    const int bits = int(now[std::size_t(i)]);
    if (bits & tension) return kYieldsInTension;
    return bits ? kYieldsInShear : ever[std::size_t(i)] > 0.0 ? kYielded : kElastic;
  });
  return colouring;
}

/// The largest compression: minus the least eigenvalue of the stress. kPa.
Colouring colour_by_stress(vtkPolyData* stones, vtkPolyData* fill, double range) {
  colour_aside(stones);
  vtkDataArray* stress = fill->GetCellData()->GetArray("stress");
  if (!stress) throw InputError("pictures: the fill has no field 'stress'. Give a file written by voussoir");
  std::vector<double> kpa;
  for (vtkIdType i = 0; i < fill->GetNumberOfPolys(); ++i) {
    std::array<double, 6> s;
    stress->GetTuple(i, s.data());
    kpa.push_back(1e-3 * largest_compression(s));
  }
  Colouring colouring{.title = "largest compression in the fill, kPa"};
  set_top(colouring, kpa, range);
  paint_faces(fill, [&](vtkIdType i) { return scale_colour(kpa[std::size_t(i)] / colouring.top); });
  return colouring;
}

}  // namespace

Colour colour_on_scale(const Colouring& colouring, double value) {
  return value < 0.0 && colouring.bottom < 0.0 ? other_side_colour(value / colouring.bottom)
                                               : scale_colour(value / colouring.top);
}

int scale_steps(double top) {
  const double leading = top / std::pow(10.0, std::floor(std::log10(top) + 1e-9));
  const auto is = [&](double value) { return std::abs(leading - value) < 1e-6; };
  if (is(1.5) || is(3) || is(6)) return 3;
  return is(1.2) || is(2) || is(4) || is(8) ? 4 : 5;
}

void set_top(Colouring& colouring, std::vector<double> values, double range) {
  std::erase_if(values, [](double v) { return !(v > 0.0); });
  std::sort(values.begin(), values.end());
  const double largest = values.empty() ? 0.0 : values.back();
  double top = range;
  if (top <= 0.0 && largest < 1e-6)
    top = 1.0;
  else if (top <= 0.0) {
    const double usual = values[std::size_t(0.98 * double(values.size() - 1))];
    top = nice_above(largest > 3.0 * usual ? usual : largest);
  }
  colouring.top = top;
  colouring.exceeded = largest > top * (1 + 1e-9);
}

void paint_faces(vtkPolyData* faces, const std::function<Colour(vtkIdType)>& colour) {
  if (!faces) return;
  const vtkIdType n = faces->GetNumberOfPolys();
  auto colours = make_colours(n);
  for (vtkIdType i = 0; i < n; ++i) set_colour(colours, i, colour(i));
  faces->GetCellData()->SetScalars(colours);
}

bool colours_fill(const std::string& by) {
  return by == "plastic" || by == "yield" || by == "stress";
}

Colouring colour_faces(vtkPolyData* stones, vtkPolyData* fill, const std::string& by, double range) {
  if (colours_fill(by) && !fill)
    throw InputError(
        "pictures: the colouring by {} needs a deformable fill, and none is visible. If the model has one, it is "
        "hidden (give --hide none) or cut away. Otherwise colour by opening, slip or displacement",
        by);
  if (by == "plastic") return colour_by_plastic_strain(stones, fill, range);
  if (by == "yield") return colour_by_yield(stones, fill);
  if (by == "stress") return colour_by_stress(stones, fill, range);
  if (by == "displacement") return colour_by_displacement(stones, fill, range);
  if (by == "mode") return colour_by_mode(stones, fill);
  if (by == "component" || by == "stone") return colour_plainly(stones, fill, by == "component");
  if (by == "opening" || by == "slip") {
    paint_faces(fill, [](vtkIdType) { return component_colour(Component::backfill); });
    return by == "opening" ? colour_by_cell(stones, "max_joint_opening", "largest joint opening, mm", range)
                           : colour_by_cell(stones, "max_joint_slip", "largest joint slip, mm", range);
  }
  throw InputError(
      "pictures: the colouring '{}' does not exist. Give opening, slip, displacement, mode, component or stone; for "
      "joints normal, shear, utilisation or eccentricity; for a deformable fill plastic, yield or stress",
      by);
}

}  // namespace voussoir
