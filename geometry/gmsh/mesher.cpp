// The part of geometry/fill_gmsh that uses Gmsh: a separate library, which is loaded when there is
// something to mesh.
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/fill_gmsh.h"
#include "geometry/fill_mesh.h"
#include "geometry/fill_sweep.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

using DimTags = gmsh::vectorpair;  // Gmsh's entities: dimension and number

/// Gmsh while it is needed: quiet, on one thread, without the user's settings.
class GmshLibrary {
 public:
  GmshLibrary() {
    gmsh::initialize(0, nullptr, false);
    set("General.Terminal", 0);
    set("General.AbortOnError", 3);  // every error is thrown
    set("General.NumThreads", 1);
    gmsh::model::add("fill");
  }
  ~GmshLibrary() {
    try {
      gmsh::finalize();
    } catch (...) {  // nothing is left to be saved
    }
  }
  GmshLibrary(const GmshLibrary&) = delete;
  static void set(const char* option, double value) { gmsh::option::setNumber(option, value); }
};

/// Runs some work with Gmsh. An exception becomes a RunError with its text between `before` and `after`.
template <class Work>
auto with_gmsh(const std::string& before, const std::string& after, Work&& work) {
  std::string reason;
  try {
    const GmshLibrary gmsh_is_ready;
    return work();
  } catch (const std::exception& error) {
    reason = error.what();
  } catch (const std::string& error) {
    reason = error;
  } catch (...) {
    reason = "Gmsh gives no reason";
  }
  throw RunError("{}: {} {}", before, with_full_stop(reason.empty() ? "Gmsh gives no reason" : reason), after);
}

/// Level of the lower foot of the extrados.
double springing(const Ring& ring) {
  return std::min(ring.extrados.front().z(), ring.extrados.back().z());
}

bool reaches(const Ring& ring, const Box& box) {
  double top = springing(ring);
  for (const Vec3& p : ring.extrados) top = std::max(top, p.z());
  return box.high.z() > springing(ring) + 1e-9 && box.low.z() < top && box.high.x() > ring.extrados.front().x() &&
         box.low.x() < ring.extrados.back().x();
}

/// A face in the plane x-y of Gmsh, which is the plane x-z of the program.
std::pair<int, int> add_face(const Polygon& outline) {
  std::vector<int> points, lines;
  for (const Vec3& p : outline) points.push_back(gmsh::model::occ::addPoint(p.x(), p.z(), 0.0));
  for (std::size_t i = 0; i < points.size(); ++i) {
    lines.push_back(gmsh::model::occ::addLine(points[i], points[(i + 1) % points.size()]));
  }
  return {2, gmsh::model::occ::addPlaneSurface({gmsh::model::occ::addCurveLoop(lines)})};
}

/// The space below the extrados. Its foot is below the springing, so that only edges of the extrados are in a box.
std::pair<int, int> add_vault(const Ring& ring) {
  const double foot = springing(ring) - 1.0;
  Polygon outline = ring.extrados;
  outline.emplace_back(outline.back().x(), 0.0, foot);
  outline.emplace_back(outline.front().x(), 0.0, foot);
  return add_face(outline);
}

bool reaches(const Polygon& polygon, const Box& box) {
  const Box own = bounding_box(polygon);
  return own.low.x() < box.high.x() && own.high.x() > box.low.x() && own.low.z() < box.high.z() &&
         own.high.z() > box.low.z();
}

DimTags add_box(const Box& box, const FillSpace& space) {
  const double x0 = box.low.x(), x1 = box.high.x(), z0 = box.low.z(), z1 = box.high.z();
  DimTags face = {add_face({{x0, 0.0, z0}, {x1, 0.0, z0}, {x1, 0.0, z1}, {x0, 0.0, z1}})}, vaults;
  for (const Ring& ring : space.rings)
    if (reaches(ring, box)) vaults.push_back(add_vault(ring));
  for (const Polygon& polygon : space.beside)
    if (reaches(polygon, box)) vaults.push_back(add_face(polygon));
  if (vaults.empty()) return face;
  DimTags rest;
  std::vector<DimTags> origins;
  gmsh::model::occ::cut(face, vaults, rest, origins);
  return rest;
}

/// Faces of the section that reach equally far across and are of one material.
struct Part {
  double y0 = 0.0, y1 = 0.0;  // m
  std::int32_t material = 0;
  DimTags faces;
};

/// Faces that touch, as one.
DimTags fused(const DimTags& faces) {
  if (faces.size() < 2) return faces;
  DimTags out;
  std::vector<DimTags> origins;
  GmshLibrary::set("Geometry.OCCUnionUnify", 1);
  GmshLibrary::set("Geometry.OCCBooleanPreserveNumbering", 0);  // with it Gmsh keeps the faces beside their union
  gmsh::model::occ::fuse({faces.front()}, DimTags(faces.begin() + 1, faces.end()), out, origins);
  GmshLibrary::set("Geometry.OCCBooleanPreserveNumbering", 1);
  return out;
}

/// The section: within a part no edges are left between boxes that touch; parts that touch share their edges.
std::vector<Part> add_section(const FillSpace& space) {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < space.boxes.size(); ++i) {
    const Box& box = space.boxes[i];
    const std::int32_t material = space.materials.empty() ? 0 : space.materials[i];
    const auto alike = [&](const Part& p) {
      return p.material == material && std::abs(p.y0 - box.low.y()) < 1e-6 && std::abs(p.y1 - box.high.y()) < 1e-6;
    };
    auto part = std::find_if(parts.begin(), parts.end(), alike);
    if (part == parts.end()) part = parts.insert(parts.end(), {box.low.y(), box.high.y(), material, {}});
    for (const auto& face : add_box(box, space)) part->faces.push_back(face);
  }
  for (Part& part : parts) part.faces = fused(part.faces);
  DimTags all;
  std::vector<DimTags> origins;
  for (const Part& part : parts) all.insert(all.end(), part.faces.begin(), part.faces.end());
  if (parts.size() > 1) {
    DimTags pieces;
    gmsh::model::occ::fragment({all.front()}, DimTags(all.begin() + 1, all.end()), pieces, origins);
    auto origin = origins.begin();
    for (Part& part : parts) {
      DimTags own;
      for (std::size_t i = 0; i < part.faces.size(); ++i, ++origin)
        own.insert(own.end(), origin->begin(), origin->end());
      part.faces = own;
    }
  }
  gmsh::model::occ::synchronize();
  return parts;
}

/// Coordinates of all nodes of Gmsh, by their numbers.
std::map<std::size_t, Vec3> take_nodes() {
  std::vector<std::size_t> numbers;
  std::vector<double> x, ignored;
  gmsh::model::mesh::getNodes(numbers, x, ignored, -1, -1, false, false);
  std::map<std::size_t, Vec3> nodes;
  for (std::size_t i = 0; i < numbers.size(); ++i) nodes[numbers[i]] = Vec3(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
  return nodes;
}

/// Numbers of Gmsh's nodes as they are used, in its order, turned into our own, which count from 0.
std::map<std::size_t, std::int32_t> own_numbers(const std::vector<std::size_t>& used) {
  std::map<std::size_t, std::int32_t> own;
  for (const std::size_t number : used) own[number] = 0;
  std::int32_t next = 0;
  for (auto& [number, index] : own) index = next++;
  return own;
}

FillSection take_section(const std::vector<Part>& parts) {
  std::vector<std::size_t> all;
  std::vector<std::pair<const Part*, std::vector<std::size_t>>> corners;
  for (const Part& part : parts) {
    for (const auto& face : part.faces) {
      auto& [of, nodes] = corners.emplace_back(&part, std::vector<std::size_t>{});
      std::vector<std::size_t> elements;  // Gmsh fills only vectors that are empty
      gmsh::model::mesh::getElementsByType(2, elements, nodes, face.second);
      all.insert(all.end(), nodes.begin(), nodes.end());
    }
  }
  const std::map<std::size_t, Vec3> places = take_nodes();
  const std::map<std::size_t, std::int32_t> own = own_numbers(all);
  FillSection section;
  for (const auto& [number, index] : own) {
    const Vec3& p = places.at(number);
    section.nodes.emplace_back(p.x(), 0.0, p.y());
  }
  for (const auto& [part, nodes] : corners) {
    for (std::size_t i = 0; i + 2 < nodes.size(); i += 3) {
      section.triangles.push_back(
          {{own.at(nodes[i]), own.at(nodes[i + 1]), own.at(nodes[i + 2])}, part->y0, part->y1, part->material});
    }
  }
  return section;
}

std::vector<Side> outline_of(const std::pair<int, int>& face) {
  DimTags curves;
  gmsh::model::getBoundary({face}, curves, false, false);
  std::vector<Side> outline;
  for (const auto& curve : curves) {
    DimTags ends;
    gmsh::model::getBoundary({curve}, ends, false, false);
    Side side;
    for (std::size_t i = 0; i < 2; ++i) {
      std::vector<double> x;
      gmsh::model::getValue(0, ends.at(i).second, {}, x);
      side[i] = Vec3(x.at(0), 0.0, x.at(1));
    }
    outline.push_back(side);
  }
  return outline;
}

/// Puts nodes of equal triangles into the faces.
void add_lattice(const std::vector<Part>& parts, double edge) {
  std::vector<std::pair<int, std::vector<int>>> points;  // of each face
  for (const Part& part : parts) {
    for (const auto& face : part.faces) {
      std::vector<int>& own = points.emplace_back(face.second, std::vector<int>{}).second;
      for (const Vec3& p : lattice_inside(outline_of(face), edge))
        own.push_back(gmsh::model::occ::addPoint(p.x(), p.z(), 0.0));
    }
  }
  gmsh::model::occ::synchronize();
  for (const auto& [face, own] : points) gmsh::model::mesh::embed(0, own, 2, face);
}

/// Divides every line of the section into as few equal edges as keep the bound.
void divide_lines(double bound) {
  DimTags curves;
  gmsh::model::getEntities(curves, 1);
  for (const auto& [dimension, curve] : curves) {
    double length = 0.0;
    gmsh::model::occ::getMass(dimension, curve, length);
    gmsh::model::mesh::setTransfiniteCurve(curve, std::max(1, int(std::ceil(length / bound - 1e-9))) + 1);
  }
}

void ask_for(double size) {
  GmshLibrary::set("Mesh.MeshSizeMin", size);
  GmshLibrary::set("Mesh.MeshSizeMax", size);
  GmshLibrary::set("Mesh.MeshSizeFromPoints", 0);
  GmshLibrary::set("Mesh.MeshSizeFromCurvature", 0);
  GmshLibrary::set("Mesh.MeshSizeExtendFromBoundary", 0);
  GmshLibrary::set("Mesh.Algorithm", 6);  // frontal-Delaunay
}

FillMesh mesh(const FillSpace& space, const FillMeshing& meshing) {
  std::vector<double> ends;
  for (const Box& box : space.boxes) ends.push_back(box.low.y()), ends.push_back(box.high.y());
  const double layer = meshing.layer_share * meshing.edge;
  const double bound = section_bound(ends, meshing.edge, layer);
  FillSection section;
  with_gmsh("the fill could not be meshed by Gmsh",
            "Try another fill_edge or other dimensions, or backfill = \"rigid\"", [&] {
              const std::vector<Part> parts = add_section(space);
              add_lattice(parts, bound);
              divide_lines(bound);
              ask_for(meshing.rim_share * bound);
              gmsh::model::mesh::generate(2);
              section = take_section(parts);
            });
  shorten_edges(section, (1.0 + 1e-12) * bound);
  return sweep(section, meshing.edge, layer);
}

}  // namespace

}  // namespace voussoir

// The functions that the program looks up. All others are hidden, because Gmsh has its own build of Eigen.
extern "C" {
[[gnu::visibility("default")]] void voussoir_mesh_fill(const voussoir::FillSpace& space,
                                                       const voussoir::FillMeshing& meshing, voussoir::FillMesh& out) {
  out = voussoir::mesh(space, meshing);
}
}
