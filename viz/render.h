// Pictures of a state for reports and papers: deformed shape, damage, cracks; drawn off-screen from stored results.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "solver/step/snapshot.h"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace voussoir {

struct RenderOptions {
  double amplification = 2.0;      // of the displacements relative to the base; 1: true, 0: undeformed
  std::string colour = "opening";  // opening, slip (largest since the start), displacement, component, stone;
                                   // mode: displacement over the largest
  bool cracks = true;              // mark the joints that lost their bond, opened or slipped
  double crack_mm = 1.0;           // mm: a joint that opened or slipped more counts as cracked; 0: or lost its bond
  std::vector<std::string> hide = {"backfill"};  // components left out
  std::string view = "oblique";                  // front, side, plan, oblique
  int width = 1800, height = 1000;               // pixels; height 0: as the content needs
  std::string scale_title;                       // of the colour scale; empty: what the colour is
  double range_mm = 0.0;                         // mm, top of the colour scale; 0: from the data
  bool undeformed = false;                       // thin outlines of the undeformed stones
  bool outline = false;                          // or of the undeformed whole only (needs the joints)
  std::string title;
  std::array<std::string, 2> notes;  // two lines in the lower right; empty: time and amplification
};

/// Throws InputError for a size, range or amplification that cannot be.
void check_options(const RenderOptions& options);

/// Draws the grids of block_grid() and joint_polydata() (or of their files) into a PNG file. `joints` may be null: no
/// cracks. Needs no display: see viz/display.h. Throws InputError for an unknown option or a grid without the needed
/// fields, RunError when the file cannot be written.
void render_picture(vtkUnstructuredGrid* blocks, vtkPolyData* joints, const RenderOptions& options,
                    const std::string& png);
/// The same from a state in memory or read from a checkpoint.
void render_picture(const Assembly& assembly, const Snapshot& snapshot, const RenderOptions& options,
                    const std::string& png);
/// The same from a stored frame; an empty `vtp` means no cracks.
void render_picture(const std::string& vtu, const std::string& vtp, const RenderOptions& options,
                    const std::string& png);

}  // namespace voussoir
