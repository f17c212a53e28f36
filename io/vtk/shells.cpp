#include "io/vtk/shells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/disjoint_sets.h"
#include "solver/base/error.h"

namespace voussoir {
namespace {

using Edge = std::pair<int, int>;  // from, to

/// Faces of one object, with vertex numbers of the whole surface or welded ones.
struct Part {
  const std::vector<Vec3>* vertices = nullptr;
  std::vector<std::vector<int>> loops;
  std::vector<int> faces;  // their numbers in the surface
};

std::string place(const std::string& path, const std::string& name, std::size_t line) {
  std::string text = line ? fmt::format("{}:{}", path, line) : path;
  return name.empty() ? text + ": surface" : text + fmt::format(": object '{}'", name);
}

/// Groups the parts' faces by the sets, in the order of their first faces.
std::vector<Part> grouped(const Part& part, DisjointSets& sets, const std::vector<int>& key) {
  std::vector<Part> groups;
  std::map<std::size_t, std::size_t> known;
  for (std::size_t f = 0; f < part.loops.size(); ++f) {
    const auto [entry, fresh] = known.try_emplace(sets.of(std::size_t(key[f])), groups.size());
    if (fresh) groups.push_back({part.vertices, {}, {}});
    groups[entry->second].loops.push_back(part.loops[f]);
    groups[entry->second].faces.push_back(part.faces[f]);
  }
  return groups;
}

std::vector<Part> split_by_vertices(const Part& part) {
  DisjointSets sets(part.vertices->size());
  std::vector<int> key;
  for (const auto& loop : part.loops) {
    for (const int v : loop) sets.join(std::size_t(loop[0]), std::size_t(v));
    key.push_back(loop[0]);
  }
  return grouped(part, sets, key);
}

std::map<Edge, std::vector<int>> directed_edges(const Part& part) {
  std::map<Edge, std::vector<int>> edges;
  for (std::size_t f = 0; f < part.loops.size(); ++f) {
    const auto& loop = part.loops[f];
    for (std::size_t k = 0; k < loop.size(); ++k) edges[{loop[k], loop[(k + 1) % loop.size()]}].push_back(int(f));
  }
  return edges;
}

/// Each edge is run once in each direction: a closed surface, its faces all turned the same way.
bool closed(const Part& part) {
  const auto edges = directed_edges(part);
  return std::all_of(edges.begin(), edges.end(), [&](const auto& entry) {
    const auto back = edges.find({entry.first.second, entry.first.first});
    return entry.second.size() == 1 && back != edges.end() && back->second.size() == 1;
  });
}

Polyhedron polyhedron(const Part& part) {
  Polyhedron shape;
  std::map<int, int> number;
  for (const auto& loop : part.loops) {
    shape.faces.emplace_back();
    for (const int v : loop) {
      const auto [entry, fresh] = number.try_emplace(v, int(shape.vertices.size()));
      if (fresh) shape.vertices.push_back((*part.vertices)[v]);
      shape.faces.back().push_back(entry->second);
    }
  }
  return shape;
}

/// Number of the first vertex within `tolerance` of each, by a grid of cells of that size.
std::vector<int> welded(const std::vector<Vec3>& vertices, double tolerance) {
  using Cell = std::array<std::int64_t, 3>;
  std::map<Cell, std::vector<int>> grid;
  std::vector<int> first(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3 scaled = vertices[i] / tolerance;
    const Cell home = {std::int64_t(std::floor(scaled.x())), std::int64_t(std::floor(scaled.y())),
                       std::int64_t(std::floor(scaled.z()))};
    first[i] = int(i);
    for (int k = 0; k < 27 && first[i] == int(i); ++k) {
      const auto cell = grid.find({home[0] + k % 3 - 1, home[1] + k / 3 % 3 - 1, home[2] + k / 9 - 1});
      if (cell == grid.end()) continue;
      for (const int j : cell->second)
        if ((vertices[j] - vertices[i]).norm() <= tolerance) first[i] = j;
    }
    if (first[i] == int(i)) grid[home].push_back(int(i));
  }
  return first;
}

/// The loop with welded numbers, without corners that fell together; empty when no area is left.
std::vector<int> welded_loop(const std::vector<int>& loop, const std::vector<int>& first) {
  std::vector<int> out;
  for (const int v : loop)
    if (out.empty() || out.back() != first[v]) out.push_back(first[v]);
  while (out.size() > 1 && out.front() == out.back()) out.pop_back();
  if (out.size() < 3) out.clear();
  return out;
}

Polygon polygon_of(const Part& part, int face) {
  Polygon polygon;
  for (const int v : part.loops[face]) polygon.push_back((*part.vertices)[v]);
  return polygon;
}

/// Angle inside the solid between two of its faces that share the edge running a → b in the first one, 0 … 2π.
double inner_angle(const Part& part, const Edge& edge, int face, int other) {
  const Vec3 along = ((*part.vertices)[edge.second] - (*part.vertices)[edge.first]).normalized();
  const Vec3 normal = polygon_normal(polygon_of(part, face)), next = polygon_normal(polygon_of(part, other));
  // In the plane across the edge: `away` points from the edge into the first face, `there` into the other.
  const Vec3 away = normal.cross(along), there = along.cross(next);
  const double angle = std::atan2(-there.dot(normal), there.dot(away));
  return angle > 1e-6 ? angle : angle + 2.0 * pi;  // a face is never its own back's neighbour
}

/// Follows the faces over shared edges. Throws when an edge has no second face.
std::vector<Part> split_by_edges(const Part& part, const std::string& where) {
  const auto edges = directed_edges(part);
  DisjointSets sets(part.loops.size());
  std::size_t open = 0;
  Vec3 open_at = Vec3::Zero();
  for (const auto& [edge, faces] : edges)
    for (const int face : faces) {
      const auto back = edges.find({edge.second, edge.first});
      if (back == edges.end()) {
        if (open++ == 0) open_at = 0.5 * ((*part.vertices)[edge.first] + (*part.vertices)[edge.second]);
        continue;
      }
      const auto angle = [&, &e = edge](int other) { return inner_angle(part, e, face, other); };
      const int neighbour = *std::min_element(back->second.begin(), back->second.end(),
                                              [&](int a, int b) { return angle(a) < angle(b); });
      sets.join(std::size_t(face), std::size_t(neighbour));
    }
  if (open > 0)
    throw InputError(
        "{} is not closed: {} a face on one side only, the first near ({:g}, {:g}, {:g}). Close the holes, or give all "
        "faces of a stone the same orientation.",
        where, counted(open, "edge has", "edges have"), open_at.x(), open_at.y(), open_at.z());
  std::vector<int> key(part.loops.size());
  std::iota(key.begin(), key.end(), 0);
  return grouped(part, sets, key);
}

double diagonal(const std::vector<Vec3>& vertices) {
  Box box;
  for (const Vec3& v : vertices) box.low = box.low.cwiseMin(v), box.high = box.high.cwiseMax(v);
  return (box.high - box.low).norm();
}

/// Takes out faces that stand there before with the same corners in the same sense, which some programs write; their
/// number. A face and its back are two stones that meet.
int drop_repeated(Part& part) {
  std::set<std::vector<int>> known;
  Part once{part.vertices, {}, {}};
  for (std::size_t f = 0; f < part.loops.size(); ++f) {
    std::vector<int> loop = part.loops[f];
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    if (!known.insert(loop).second) continue;
    once.loops.push_back(part.loops[f]);
    once.faces.push_back(part.faces[f]);
  }
  const int dropped = int(part.loops.size() - once.loops.size());
  part = std::move(once);
  return dropped;
}

/// Welds what shared vertices do not close, turns it when it is inside-out as a whole, and follows its edges.
std::vector<Part> split_loose(Part loose, double tolerance, const std::string& where, std::vector<std::string>& notes) {
  const std::vector<int> first = welded(*loose.vertices, tolerance);
  Part part{loose.vertices, {}, {}};
  for (std::size_t f = 0; f < loose.loops.size(); ++f) {
    auto loop = welded_loop(loose.loops[f], first);
    if (loop.empty()) continue;
    part.loops.push_back(loop);
    part.faces.push_back(loose.faces[f]);
  }
  if (const int dropped = drop_repeated(part))
    notes.push_back(fmt::format("{}: {} was used once", where,
                                counted(dropped, "face occurs twice; it", "faces occur twice; each")));
  const bool inside_out = mass_properties(polyhedron(part)).volume < 0.0;
  const auto turn = [](Part& p) {
    for (auto& loop : p.loops) std::reverse(loop.begin(), loop.end());
  };
  if (inside_out) turn(part);
  auto parts = split_by_edges(part, where);
  if (inside_out) std::for_each(parts.begin(), parts.end(), turn);
  return parts;
}

Shell make_shell(const Part& part, const Surface& surface, const std::string& name, const std::string& path) {
  Shell shell{polyhedron(part), name, surface.face_lines[part.faces.front()], false};
  double volume = mass_properties(shell.shape).volume;
  if (volume < 0.0) {
    for (auto& loop : shell.shape.faces) std::reverse(loop.begin(), loop.end());
    shell.flipped = true;
    volume = -volume;
  }
  const double size = diagonal(shell.shape.vertices);
  if (!(volume > 1e-9 * size * size * size))
    throw InputError("{} encloses no volume ({:g} in a size of {:g}). Remove it, or give it a thickness.",
                     place(path, name, shell.line), volume, size);
  return shell;
}

}  // namespace

std::vector<Shell> split_shells(const Surface& surface, const std::string& path, std::vector<std::string>& notes) {
  const double tolerance = std::max(1e-6 * diagonal(surface.vertices), 1e-300);
  std::vector<Shell> shells;
  for (const FileObject& object : surface.objects) {
    Part whole{&surface.vertices, {}, object.faces}, loose{&surface.vertices, {}, {}};
    for (const int f : object.faces) whole.loops.push_back(surface.faces[f]);
    std::vector<Part> parts;
    for (Part& part : split_by_vertices(whole)) {
      if (closed(part)) {
        parts.push_back(std::move(part));
        continue;
      }
      loose.loops.insert(loose.loops.end(), part.loops.begin(), part.loops.end());
      loose.faces.insert(loose.faces.end(), part.faces.begin(), part.faces.end());
    }
    if (!loose.loops.empty())
      for (Part& part : split_loose(loose, tolerance, place(path, object.name, object.line), notes))
        parts.push_back(std::move(part));
    std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.faces[0] < b.faces[0]; });
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const std::string number = k > 0 ? fmt::format("#{}", k + 1) : "";
      shells.push_back(make_shell(parts[k], surface, object.name.empty() ? "" : object.name + number, path));
      shells.back().object = object.name;
      shells.back().layer = object.layer;
      shells.back().support = object.support;
    }
  }
  return shells;
}

}  // namespace voussoir
