// Scenes of view.html from the files and grids for ParaView.
#pragma once
#include "solver/step/snapshot.h"
#include "viz/render.h"
#include "viz/viewer/viewer_scene.h"

namespace voussoir {

/// One frame: an assembly as built, or in a state.
ViewerScene snapshot_scene(const Assembly& assembly, const Snapshot& snapshot);

/// The stored frames of a run directory: all of them, or `most` at even distances, including the first and the last.
/// Throws InputError if there are none, or if one does not belong to the others.
ViewerScene run_scene(const std::string& directory, std::size_t most);

/// The mode shapes of a collection written by `voussoir modal` (vtk/modes.pvd), with a label for each.
struct ShapeSeries {
  std::string blocks, fill;         // .pvd files; that of a fill may be missing
  std::vector<std::string> labels;  // labels of the frames in order
};
/// One frame for each shape; shapes of several series alternate. Throws InputError for a missing file, and if the
/// series have different stones. One series may have additional stones at its end, which are at rest in the others (a
/// support added by an effect).
ViewerScene shape_scene(const std::vector<ShapeSeries>& series);

}  // namespace voussoir
