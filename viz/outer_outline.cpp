// The outline of an assembly as one body: edges between faces that no joint covers.
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <map>

#include "viz/scene.h"

namespace voussoir {

namespace {

constexpr double beside = 2e-3;  // m, distance inside a face at which the program checks for a joint
constexpr double level = 1e-3;   // m, largest distance of a joint from the plane
constexpr int piece_count = 4;   // of an edge, each shown or not

/// A convex polygon with its plane.
struct Flat {
  Polygon corners;
  Vec3 normal = Vec3::Zero();

  explicit Flat(Polygon polygon) : corners(std::move(polygon)) {
    for (std::size_t i = 0; i < corners.size(); ++i)
      normal += (corners[i] - corners[0]).cross(corners[(i + 1) % corners.size()] - corners[0]);
    normal.normalize();
  }
  bool covers(const Vec3& x) const {
    if (std::abs(normal.dot(x - corners[0])) > level) return false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3 side = corners[(i + 1) % corners.size()] - corners[i];
      if (normal.dot(side.cross(x - corners[i])) < -1e-4 * side.norm()) return false;
    }
    return true;
  }
};

Polygon corners_of(vtkPolyData* data, vtkIdList* ids, const Vec3& base) {
  vtkDataArray* displacement = data->GetPointData()->GetArray("displacement_of_point");
  Polygon polygon;
  for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k) {
    Vec3 x, d = Vec3::Zero();
    data->GetPoint(ids->GetId(k), x.data());
    if (displacement) displacement->GetTuple(ids->GetId(k), d.data());
    polygon.push_back(x - d - base);
  }
  return polygon;
}

/// The joints of each block, in the undeformed place.
std::map<vtkIdType, std::vector<Flat>> joints_by_block(vtkPolyData* joints) {
  Vec3 base = Vec3::Zero();
  if (vtkDataArray* array = joints->GetFieldData()->GetArray("base_displacement")) array->GetTuple(0, base.data());
  vtkDataArray *a = joints->GetCellData()->GetArray("block_a"), *b = joints->GetCellData()->GetArray("block_b");
  std::map<vtkIdType, std::vector<Flat>> of;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; a && b && c < joints->GetNumberOfPolys(); ++c) {
    joints->GetPolys()->GetCellAtId(c, ids);
    const Flat flat(corners_of(joints, ids, base));
    of[vtkIdType(a->GetComponent(c, 0))].push_back(flat);
    of[vtkIdType(b->GetComponent(c, 0))].push_back(flat);
  }
  return of;
}

using Edge = std::pair<vtkIdType, vtkIdType>;  // points, the lower first

}  // namespace

vtkSmartPointer<vtkPolyData> outer_outline(vtkPolyData* faces, vtkPolyData* joints) {
  const std::map<vtkIdType, std::vector<Flat>> covering = joints_by_block(joints);
  vtkDataArray* block = faces->GetCellData()->GetArray("block");
  // For each edge: its pieces without a joint on all faces so far, and the normal of the first face.
  struct Bare {
    unsigned pieces = (1u << piece_count) - 1;
    Vec3 normal = Vec3::Zero();
    bool crease = false;
  };
  std::map<Edge, Bare> edges;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < faces->GetNumberOfPolys(); ++c) {
    faces->GetPolys()->GetCellAtId(c, ids);
    Polygon polygon;
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k) polygon.push_back(Vec3::Map(faces->GetPoint(ids->GetId(k))));
    const Flat face(polygon);
    const auto own = covering.find(block ? vtkIdType(block->GetComponent(c, 0)) : c);
    const vtkIdType n = ids->GetNumberOfIds();
    for (vtkIdType k = 0; k < n; ++k) {
      const Vec3 &from = polygon[std::size_t(k)], &to = polygon[std::size_t((k + 1) % n)];
      const Vec3 inward = face.normal.cross(to - from).normalized();
      const vtkIdType first = ids->GetId(k), second = ids->GetId((k + 1) % n);
      const bool forward = first < second;
      Bare& bare = edges[std::minmax({first, second})];
      if (bare.normal == Vec3::Zero()) bare.normal = face.normal;
      bare.crease = bare.crease || bare.normal.dot(face.normal) < 0.99;
      for (int i = 0; i < piece_count && own != covering.end(); ++i) {
        const double along = (i + 0.5) / piece_count;
        const Vec3 x = from + (forward ? along : 1.0 - along) * (to - from) + beside * inward;
        for (const Flat& joint : own->second)
          if (joint.covers(x)) bare.pieces &= ~(1u << i);
      }
    }
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  for (const auto& [edge, bare] : edges) {
    if (!bare.crease) continue;
    Vec3 from, to;
    faces->GetPoint(edge.first, from.data());
    faces->GetPoint(edge.second, to.data());
    for (int i = 0; i < piece_count; ++i) {
      if (!(bare.pieces >> i & 1u)) continue;
      lines->InsertNextCell(2);
      lines->InsertCellPoint(points->InsertNextPoint(Vec3(from + double(i) / piece_count * (to - from)).data()));
      lines->InsertCellPoint(points->InsertNextPoint(Vec3(from + double(i + 1) / piece_count * (to - from)).data()));
    }
  }
  auto outline = vtkSmartPointer<vtkPolyData>::New();
  outline->SetPoints(points);
  outline->SetLines(lines);
  return outline;
}

}  // namespace voussoir
