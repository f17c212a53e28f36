#include "viz/mode_picture.h"

#include "io/vtk/grid.h"

namespace voussoir {

namespace {

double diagonal(const Assembly& assembly) {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const Block& block : assembly.blocks) {
    const Box box = block_box(block);
    low = low.cwiseMin(box.low), high = high.cwiseMax(box.high);
  }
  return (high - low).norm();
}

/// With the patches between stones and fill, which cover faces as joints do.
Snapshot at_rest(const Assembly& assembly) {
  Snapshot rest = rest_snapshot(assembly);
  for (const FillJoint& joint : assembly.fill_joints) {
    PatchSnapshot patch;
    patch.a = joint.block, patch.b = -1;
    patch.polygon = joint.polygon;
    patch.normal = joint.normal;
    patch.area = joint.area;
    rest.patches.push_back(std::move(patch));
  }
  return rest;
}

}  // namespace

void draw_mode(const Assembly& assembly, const Mode& mode, RenderOptions options,
               const std::array<std::string, 2>& notes, const std::string& png, double share) {
  constexpr double small = 1e-7;  // m; the mode has small displacements and is drawn enlarged, so that stones rotate
                                  // without changing size
  Snapshot snapshot = rest_snapshot(assembly);
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Vec3 turn = small * mode.shape.row(Eigen::Index(i)).tail<3>();
    snapshot.displacement[i] = small * mode.shape.row(Eigen::Index(i)).head<3>();
    snapshot.rotation[i] = Eigen::Quaterniond(1.0, 0.5 * turn.x(), 0.5 * turn.y(), 0.5 * turn.z()).normalized();
  }
  if (mode.nodes.rows() == Eigen::Index(assembly.fill.nodes.size()))
    for (std::size_t i = 0; i < assembly.fill.nodes.size(); ++i)
      snapshot.fill.displacement[i] = small * mode.nodes.row(Eigen::Index(i));
  else
    snapshot.fill = {};  // a mode of the stones alone
  options.colour = "mode";
  options.amplification = share * diagonal(assembly) / small;
  options.outline = true;
  options.cracks = false;
  options.notes = notes;
  const auto blocks = block_grid(assembly, snapshot);
  const auto joints = joint_polydata(assembly, at_rest(assembly));
  const auto fill = snapshot.fill.empty() ? nullptr : fill_grid(assembly, snapshot);
  render_picture(PictureGrids{blocks, joints, fill}, options, png);
}

}  // namespace voussoir
