// Scenes of view.html from what ParaView's files and grids hold.
#pragma once
#include "solver/step/snapshot.h"
#include "viz/render.h"
#include "viz/viewer/viewer_scene.h"

namespace voussoir {

/// An assembly as built, or in a state: one frame.
ViewerScene snapshot_scene(const Assembly& assembly, const Snapshot& snapshot);

/// The stored frames of a run directory: all of them, or `most` evenly apart with the first and the last. Throws
/// InputError where there are none, or where one does not belong to the others.
ViewerScene run_scene(const std::string& directory, std::size_t most);

/// Shapes of a collection that `voussoir modal` wrote (vtk/modes.pvd), with the words that stand for each.
struct ShapeSeries {
  std::string blocks, fill;         // .pvd files; a fill's may be missing
  std::vector<std::string> labels;  // of the frames in order
};
/// One frame a shape, those of several series one after the other by turns. Throws InputError for a file that is
/// missing, and where the series have other stones; one may have more after those of the others, which stand still
/// there (a support that an effect brings).
ViewerScene shape_scene(const std::vector<ShapeSeries>& series);

}  // namespace voussoir
