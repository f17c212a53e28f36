#include "viz/cut.h"

#include <fmt/format.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>

#include "solver/base/error.h"

namespace voussoir {
namespace {

constexpr const char* axis_names = "xyz";

Vec3 base_displacement(vtkDataObject* data) {
  Vec3 base = Vec3::Zero();
  if (vtkDataArray* array = data->GetFieldData()->GetArray("base_displacement")) array->GetTuple(0, base.data());
  return base;
}

/// Twice the area, along the normal.
Vec3 area_vector(const Loop& polygon, const Places& places) {
  Vec3 sum = Vec3::Zero();
  const Vec3& from = places.reference(polygon[0]);
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += (places.reference(polygon[i]) - from).cross(places.reference(polygon[i + 1]) - from);
  return sum;
}

/// Adds the edges of the section that close the remaining part of a polygon, with reversed direction. They run along
/// keep × normal. If a non-convex polygon crosses the plane more than twice, they are every second edge between the
/// crossings.
void add_rim(const Loop& polygon, std::vector<vtkIdType> crossings, const Places& places, const CutPlane& cut,
             std::multimap<vtkIdType, vtkIdType>& rim) {
  const Vec3 along = (cut.side * Vec3::Unit(cut.axis)).cross(area_vector(polygon, places));
  std::sort(crossings.begin(), crossings.end(),
            [&](vtkIdType a, vtkIdType b) { return places.reference(a).dot(along) < places.reference(b).dot(along); });
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
    if (crossings[i] != crossings[i + 1]) rim.emplace(crossings[i + 1], crossings[i]);
}

/// The loops formed by directed edges.
std::vector<Loop> loops_of(std::multimap<vtkIdType, vtkIdType> edges) {
  std::vector<Loop> loops;
  while (!edges.empty()) {
    Loop loop;
    for (auto edge = edges.begin(); edge != edges.end(); edge = edges.find(loop.back())) {
      if (loop.empty()) loop.push_back(edge->first);
      const vtkIdType next = edge->second;
      edges.erase(edge);
      if (next == loop.front()) break;
      loop.push_back(next);
    }
    if (loop.size() >= 3) loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

double CutPlane::depth(const Vec3& x) const {
  const double d = side * (x[axis] - place);
  return std::abs(d) < 1e-6 ? 0.0 : d;
}

std::string CutPlane::words() const {
  return fmt::format("cut at {} = {:.4g} m", axis_names[axis], std::abs(place) < 1e-6 ? 0.0 : place);
}

std::optional<CutPlane> find_cut(const std::string& text, const View& view, const Box& content) {
  if (text.empty()) return std::nullopt;
  const auto fail = [&] {
    throw InputError(
        "pictures: the cut is '{}'. Give an axis (x, y or z) and a position in m, such as y=0.5, or only the axis for "
        "the middle",
        text);
  };
  CutPlane cut;
  const std::string names(axis_names);
  const auto at = names.find(text[0]);
  if (at == std::string::npos) fail();
  cut.axis = int(at);
  const double low = content.low[cut.axis], high = content.high[cut.axis];
  cut.place = 0.5 * (low + high);
  if (text.size() > 1) {
    std::size_t read = 0;
    try {
      if (text[1] == '=') cut.place = std::stod(text.substr(2), &read);
    } catch (const std::logic_error&) {
      fail();
    }
    if (text[1] != '=' || read + 2 != text.size() || !std::isfinite(cut.place)) fail();
  }
  if (!(cut.place > low && cut.place < high))
    throw InputError(
        "pictures: the cut {} = {:g} m does not intersect the model, which extends from {:.3f} to {:.3f} m on this "
        "axis",
        axis_names[cut.axis], cut.place, low, high);
  if (std::abs(view.forward[cut.axis]) < 1e-9)
    throw InputError("pictures: the view {} shows a cut across {} edge-on. Give the view {} or oblique", view.name,
                     axis_names[cut.axis],
                     cut.axis == 0   ? "side"
                     : cut.axis == 1 ? "front"
                                     : "plan");
  cut.side = view.forward[cut.axis] > 0.0 ? 1.0 : -1.0;
  return cut;
}

Places::Places(vtkPointSet* data, const char* what) {
  vtkDataArray* displacement = data->GetPointData()->GetArray("displacement_of_point");
  if (!displacement)
    throw InputError(
        "pictures: the {} have no field 'displacement_of_point'. Give files written by voussoir (vtk/blocks_*.vtu, "
        "vtk/joints_*.vtp, vtk/fill_*.vtu)",
        what);
  const Vec3 base = base_displacement(data);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    Vec3 x, d;
    data->GetPoint(i, x.data());
    displacement->GetTuple(i, d.data());
    reference_.push_back(x - base - d);
    displacement_.push_back(d);
  }
}

vtkIdType Places::on_edge(vtkIdType a, vtkIdType b, const CutPlane& cut) {
  const auto [entry, fresh] = on_edges_.try_emplace(std::minmax(a, b), count());
  if (!fresh) return entry->second;
  const auto from = std::size_t(entry->first.first), to = std::size_t(entry->first.second);
  const double before = cut.depth(reference_[from]), share = before / (before - cut.depth(reference_[to]));
  reference_.push_back(reference_[from] + share * (reference_[to] - reference_[from]));
  displacement_.push_back(displacement_[from] + share * (displacement_[to] - displacement_[from]));
  return entry->second;
}

vtkSmartPointer<vtkPoints> Places::amplified(double amplification) const {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count());
  for (vtkIdType i = 0; i < count(); ++i)
    points->SetPoint(i, Vec3(reference(i) + amplification * displacement_[std::size_t(i)]).data());
  return points;
}

vtkSmartPointer<vtkDataArray> Places::displacements() const {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName("displacement_of_point");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(count());
  for (vtkIdType i = 0; i < count(); ++i) array->SetTuple(i, displacement_[std::size_t(i)].data());
  return array;
}

/// By Sutherland & Hodgman (1974); a point in the plane counts as behind it.
Loop cut_polygon(const Loop& polygon, Places& places, const CutPlane& cut, std::multimap<vtkIdType, vtkIdType>* rim) {
  Loop left;
  std::vector<vtkIdType> crossings;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const vtkIdType a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double da = cut.depth(places.reference(a)), db = cut.depth(places.reference(b));
    if (da >= 0.0) left.push_back(a);
    if ((da >= 0.0) == (db >= 0.0)) continue;
    if (da == 0.0 || db == 0.0) {
      crossings.push_back(da == 0.0 ? a : b);
      continue;
    }
    crossings.push_back(places.on_edge(a, b, cut));
    left.push_back(crossings.back());
  }
  if (rim && !crossings.empty()) add_rim(polygon, crossings, places, cut, *rim);
  return left;
}

bool in_plane(const Loop& polygon, const Places& places, const CutPlane& cut) {
  return std::all_of(polygon.begin(), polygon.end(),
                     [&](vtkIdType i) { return cut.depth(places.reference(i)) == 0.0; });
}

std::vector<Loop> cut_body(const std::vector<Loop>& faces, const std::vector<bool>& seen, Places& places,
                           const CutPlane& cut) {
  double nearest = 0.0, farthest = 0.0;
  for (const Loop& face : faces)
    for (const vtkIdType i : face) {
      nearest = std::min(nearest, cut.depth(places.reference(i)));
      farthest = std::max(farthest, cut.depth(places.reference(i)));
    }
  std::vector<Loop> left;
  if (farthest <= 0.0) return left;
  std::multimap<vtkIdType, vtkIdType> rim;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    Loop loop = nearest < 0.0 ? cut_polygon(faces[f], places, cut, &rim) : faces[f];
    if ((seen[f] || in_plane(faces[f], places, cut)) && loop.size() >= 3) left.push_back(std::move(loop));
  }
  for (Loop& loop : loops_of(std::move(rim))) left.push_back(std::move(loop));
  return left;
}

}  // namespace voussoir
