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

}  // namespace

void draw_mode(const Assembly& assembly, const Mode& mode, RenderOptions options,
               const std::array<std::string, 2>& notes, const std::string& png, double share) {
  constexpr double small = 1e-7;  // m: a mode is small displacements drawn large, so stones turn without growing
  Snapshot snapshot = rest_snapshot(assembly);
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Vec3 turn = small * mode.shape.row(Eigen::Index(i)).tail<3>();
    snapshot.displacement[i] = small * mode.shape.row(Eigen::Index(i)).head<3>();
    snapshot.rotation[i] = Eigen::Quaterniond(1.0, 0.5 * turn.x(), 0.5 * turn.y(), 0.5 * turn.z()).normalized();
  }
  options.colour = "mode";
  options.amplification = share * diagonal(assembly) / small;
  options.outline = true;
  options.cracks = false;
  options.notes = notes;
  render_picture(block_grid(assembly, snapshot), joint_polydata(assembly, rest_snapshot(assembly)), options, png);
}

}  // namespace voussoir
