#include "viz/viewer/viewer_frames.h"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "geometry/fill_mesh.h"
#include "io/vtk/files.h"
#include "io/vtk/grid.h"
#include "io/vtk/series.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

vtkDataArray* field_of(vtkFieldData* data, const char* name, const std::string& file) {
  vtkDataArray* array = data->GetArray(name);
  if (!array) throw InputError("{}: there is no field '{}'. Give files written by voussoir", file, name);
  return array;
}

Vec3 row(vtkDataArray* array, vtkIdType i) {
  Vec3 v;
  array->GetTuple(i, v.data());
  return v;
}

Vec3 base_of(vtkDataSet* data, const std::string& file) {
  return row(field_of(data->GetFieldData(), "base_displacement", file), 0);
}

/// Places of the points as built.
std::vector<Vec3> built_points(vtkDataSet* data, const std::string& file) {
  vtkDataArray* moved = field_of(data->GetPointData(), "displacement_of_point", file);
  const Vec3 base = base_of(data, file);
  std::vector<Vec3> places(std::size_t(data->GetNumberOfPoints()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    data->GetPoint(vtkIdType(i), places[i].data());
    places[i] -= row(moved, vtkIdType(i)) + base;
  }
  return places;
}

ViewerStone stone_of(vtkCell* cell, const std::vector<Vec3>& places) {
  ViewerStone stone;
  Polyhedron shape;
  std::map<vtkIdType, int> index;
  for (int f = 0; f < cell->GetNumberOfFaces(); ++f) {
    std::vector<int> loop;
    for (const vtkIdType id : *cell->GetFace(f)->GetPointIds()) {
      const auto [at, fresh] = index.emplace(id, int(shape.vertices.size()));
      if (fresh) shape.vertices.push_back(places[std::size_t(id)]);
      loop.push_back(at->second);
    }
    shape.faces.push_back(std::move(loop));
  }
  stone.centre = mass_properties(shape).centroid;
  stone.corners = std::move(shape.vertices);
  stone.faces = std::move(shape.faces);
  return stone;
}

std::vector<ViewerStone> stones_of(vtkUnstructuredGrid* grid, const std::string& file) {
  const std::vector<Vec3> places = built_points(grid, file);
  vtkDataArray *component = field_of(grid->GetCellData(), "component", file),
               *part = field_of(grid->GetCellData(), "part", file),
               *fixed = field_of(grid->GetCellData(), "fixed", file);
  std::vector<ViewerStone> stones;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
    stones.push_back(stone_of(grid->GetCell(i), places));
    stones.back().component = int(component->GetComponent(i, 0));
    stones.back().part = int(part->GetComponent(i, 0));
    stones.back().fixed = fixed->GetComponent(i, 0) != 0.0;
  }
  return stones;
}

/// The surface of a fill, and which node of the mesh each of its nodes is.
ViewerFill surface_of(vtkUnstructuredGrid* grid, const std::string& file, std::vector<vtkIdType>& nodes) {
  FillMesh mesh;
  mesh.nodes = built_points(grid, file);
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    vtkIdList* ids = grid->GetCell(c)->GetPointIds();
    if (ids->GetNumberOfIds() != 4) throw InputError("{}: cell {} is not a tetrahedron", file, c);
    mesh.tets.push_back({});
    for (int k = 0; k < 4; ++k) mesh.tets.back()[std::size_t(k)] = std::int32_t(ids->GetId(k));
  }
  find_surface(mesh);
  ViewerFill surface;
  std::map<std::int32_t, int> index;
  for (const auto& triangle : mesh.triangles) {
    surface.triangles.push_back({});
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [at, fresh] = index.emplace(triangle[k], int(nodes.size()));
      if (fresh) nodes.push_back(triangle[k]), surface.nodes.push_back(mesh.nodes[std::size_t(triangle[k])]);
      surface.triangles.back()[k] = at->second;
    }
  }
  return surface;
}

/// Puts a scene together, frame by frame.
class SceneBuilder {
 public:
  ViewerScene scene;

  /// `name` is the file of the blocks, for errors.
  void add_state(const PictureGrids& grids, const std::string& label, const std::string& name) {
    start(grids.blocks, grids.fill, name);
    ViewerFrame frame;
    frame.label = label;
    const Vec3 base = base_of(grids.blocks, name);
    vtkCellData* cells = grids.blocks->GetCellData();
    read_motion(frame, cells, "displacement", "rotation", base, name);
    if (grids.fill) read_nodes(frame, grids.fill, "displacement_of_point", name);
    if (grids.joints) read_joints(frame, cells, grids.joints, name);
    scene.frames.push_back(std::move(frame));
  }

  void add_shape(vtkUnstructuredGrid* blocks, vtkUnstructuredGrid* fill, const std::string& label,
                 const std::string& name) {
    start(blocks, fill, name);
    ViewerFrame frame;
    frame.label = label;
    read_motion(frame, blocks->GetCellData(), "mode_displacement", "mode_rotation", Vec3::Zero(), name);
    if (fill) read_nodes(frame, fill, "mode_shape", name);
    scene.frames.push_back(std::move(frame));
  }

 private:
  void start(vtkUnstructuredGrid* blocks, vtkUnstructuredGrid* fill, const std::string& name) {
    if (scene.frames.empty()) {
      scene.stones = stones_of(blocks, name);
      if (fill) scene.fill = surface_of(fill, name, nodes_), fill_points_ = fill->GetNumberOfPoints();
    }
    const vtkIdType points = fill ? fill->GetNumberOfPoints() : 0;
    if (scene.modes && blocks->GetNumberOfCells() > vtkIdType(scene.stones.size()))
      scene.stones = stones_of(blocks, name);
    const bool fewer = scene.modes && blocks->GetNumberOfCells() <= vtkIdType(scene.stones.size());
    if ((blocks->GetNumberOfCells() != vtkIdType(scene.stones.size()) && !fewer) || points != fill_points_)
      throw InputError(
          "{}: this frame has {} and {}, but the previous frame has {} and {}. Remove the files of the "
          "other run",
          name, counted(blocks->GetNumberOfCells(), "block"), counted(points, "fill node"), scene.stones.size(),
          fill_points_);
  }

  void read_motion(ViewerFrame& frame, vtkCellData* cells, const char* displacement, const char* rotation,
                   const Vec3& base, const std::string& name) {
    vtkDataArray *u = field_of(cells, displacement, name), *r = field_of(cells, rotation, name);
    for (vtkIdType i = 0; i < u->GetNumberOfTuples(); ++i) {
      frame.displacement.push_back(row(u, i) - base);
      frame.rotation.push_back(row(r, i));
    }
  }

  void read_nodes(ViewerFrame& frame, vtkUnstructuredGrid* fill, const char* field, const std::string& name) {
    vtkDataArray* u = field_of(fill->GetPointData(), field, name);
    for (const vtkIdType node : nodes_) frame.fill.push_back(row(u, node));
  }

  void read_joints(ViewerFrame& frame, vtkCellData* cells, vtkPolyData* joints, const std::string& name) {
    vtkDataArray *opened = field_of(cells, "max_joint_opening", name), *slid = field_of(cells, "max_joint_slip", name);
    for (vtkIdType i = 0; i < vtkIdType(scene.stones.size()); ++i)
      frame.values.push_back({opened->GetComponent(i, 0), slid->GetComponent(i, 0), 0.0, 0.0});
    vtkCellData* data = joints->GetCellData();
    const auto field = [&](const char* of) { return field_of(data, of, name); };
    vtkDataArray *a = field("block_a"), *b = field("block_b"), *area = field("area"), *opening = field("opening"),
                 *normal = field("normal_traction"), *shear = field("shear_traction");
    vtkDataArray *replaced = data->GetArray("replaced"), *tie = data->GetArray("tie");
    frame.forces.assign(scene.pairs.size(), {});
    for (vtkIdType j = 0; j < joints->GetNumberOfPolys(); ++j) {
      if (replaced && replaced->GetComponent(j, 0) != 0.0) continue;
      const double tension = normal->GetComponent(j, 0), along = std::abs(shear->GetComponent(j, 0));
      const std::array<int, 2> ends = {int(a->GetComponent(j, 0)), int(b->GetComponent(j, 0))};
      for (const int end : ends) {
        if (end >= int(scene.stones.size()))
          throw InputError("{}: a joint refers to block {}, but there are only {}", name, end,
                           counted(scene.stones.size(), "block"));
        if (end < 0 || (tie && tie->GetComponent(j, 0) != 0.0)) continue;  // the fill; bars carry no stress of stones
        ViewerValues& values = frame.values[std::size_t(end)];
        values[compression_value] = std::max(values[compression_value], -tension);
        values[shear_value] = std::max(values[shear_value], along);
      }
      ViewerForces& forces = frame.forces[pair_of(ends, frame)];
      forces[0] -= tension * area->GetComponent(j, 0);
      forces[1] += along * area->GetComponent(j, 0);
      forces[2] = std::max(forces[2], opening->GetComponent(j, 0));
    }
  }

  std::size_t pair_of(std::array<int, 2> ends, ViewerFrame& frame) {
    if (ends[1] >= 0 && ends[1] < ends[0]) std::swap(ends[0], ends[1]);
    const auto [at, fresh] = pairs_.emplace(ends, scene.pairs.size());
    if (fresh) scene.pairs.push_back(ends), frame.forces.push_back({});
    return at->second;
  }

  std::vector<vtkIdType> nodes_;  // of the fill's mesh: those of its surface
  vtkIdType fill_points_ = 0;
  std::map<std::array<int, 2>, std::size_t> pairs_;
};

/// `most` of `count` evenly apart, the first and the last among them.
std::vector<std::size_t> chosen(std::size_t count, std::size_t most) {
  std::vector<std::size_t> all;
  const std::size_t n = std::min(count, most);
  for (std::size_t i = 0; i < n; ++i) all.push_back(n == 1 ? count - 1 : i * (count - 1) / (n - 1));
  return all;
}

}  // namespace

ViewerScene snapshot_scene(const Assembly& assembly, const Snapshot& snapshot) {
  SceneBuilder builder;
  const auto blocks = block_grid(assembly, snapshot);
  const auto joints = joint_polydata(assembly, snapshot);
  const auto fill = snapshot.fill.empty() ? nullptr : fill_grid(assembly, snapshot);
  builder.add_state({blocks, joints, fill}, "", "the state");
  return std::move(builder.scene);
}

ViewerScene run_scene(const std::string& directory, std::size_t most) {
  const VtkSeries series(directory);
  const std::vector<PvdSeries::Frame>& frames = series.blocks().frames();
  if (frames.empty())
    throw InputError(
        "{} has no frames in vtk/blocks.pvd. Give a checkpoint of the run, or run the case with [output] fields_every",
        directory);
  SceneBuilder builder;
  for (const std::size_t i : chosen(frames.size(), most)) {
    const double time = frames[i].time;
    const std::string file = series.blocks().file_path(frames[i]), of_joints = series.joints().file_at(time),
                      of_fill = series.fill().file_at(time);
    const auto blocks = read_vtu(file);
    const auto joints = of_joints.empty() ? nullptr : read_vtp(of_joints);
    const auto fill = of_fill.empty() ? nullptr : read_vtu(of_fill);
    builder.add_state({blocks, joints, fill}, fmt::format("t = {:.3f} s", time), file);
  }
  return std::move(builder.scene);
}

ViewerScene shape_scene(const std::vector<ShapeSeries>& series) {
  SceneBuilder builder;
  builder.scene.modes = true;
  std::size_t shapes = 0;
  for (const ShapeSeries& s : series) shapes = std::max(shapes, s.labels.size());
  for (std::size_t i = 0; i < shapes; ++i)
    for (const ShapeSeries& s : series) {
      if (i >= s.labels.size()) continue;
      const PvdSeries blocks(s.blocks), fill(s.fill);
      if (i >= blocks.frames().size())
        throw InputError("{} has {}, but the list of modes has {}. Write both files again", s.blocks,
                         counted(blocks.frames().size(), "mode shape"), s.labels.size());
      const std::string file = blocks.file_path(blocks.frames()[i]), of_fill = fill.file_at(blocks.frames()[i].time);
      const auto shape = read_vtu(file), nodes = of_fill.empty() ? nullptr : read_vtu(of_fill);
      builder.add_shape(shape, nodes, s.labels[i], file);
    }
  for (ViewerFrame& frame : builder.scene.frames) {
    frame.displacement.resize(builder.scene.stones.size(), Vec3::Zero());
    frame.rotation.resize(builder.scene.stones.size(), Vec3::Zero());
  }
  return std::move(builder.scene);
}

}  // namespace voussoir
