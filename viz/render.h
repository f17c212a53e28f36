// Pictures of a state for reports and papers: deformed shape, damage, cracks. They are drawn off-screen from stored
// results.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "solver/statics/bed_joints.h"
#include "solver/step/snapshot.h"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace voussoir {

/// A named arrow over the picture: see viz/arrows.h.
struct Arrow {
  Vec3 from = Vec3::Zero();        // m
  Vec3 direction = Vec3::UnitX();  // unit
  std::string name;
};

/// A number at a point of the picture, m, including the drawn displacements.
struct Mark {
  Vec3 at = Vec3::Zero();
  std::string name;
};

struct RenderOptions {
  double amplification = 2.0;      // of the displacements relative to the base; 1: true, 0: undeformed
  std::string colour = "opening";  // opening, slip (largest since the start), displacement, component, stone;
                                   // mode: displacement over the largest; of the joints normal, shear,
                                   // utilisation, eccentricity; of a deformable fill plastic, yield, stress
  bool cracks = true;              // mark joints that lost their bond, opened or slipped
  double crack_mm = 1.0;           // mm; a joint with more opening or slip counts as cracked; 0: also one that lost
                                   // its bond
  std::vector<std::string> hide = {"backfill"};  // components left out; backfill includes a deformable fill
  std::string cut;                               // "y=0.5" or "y": see viz/cut.h; empty: none
  std::string view = "oblique";                  // front, side, plan, oblique
  int width = 1800, height = 1000;               // pixels; height 0: according to the content
  std::string scale_title;                       // title of the colour scale; empty: the coloured quantity
  double range = 0.0;                            // mm, %, MPa or kPa, upper end of the colour scale; 0: from the data
  bool undeformed = false;                       // thin outlines of the undeformed stones
  bool outline = false;                          // only the outline of the undeformed whole (needs the joints)
  std::string title;
  std::array<std::string, 2> notes;  // two lines in the lower right; empty: time and amplification
  std::vector<Mark> marks;           // drawn over everything
  std::vector<Arrow> arrows;         // drawn over everything
  std::vector<BedJoint> resultants;  // arrows and thrust lines, drawn over everything; only for true deformations
};

/// Throws InputError for an invalid size, range or amplification.
void check_options(const RenderOptions& options);

/// The components that a picture leaves out by default: the backfill, unless it is coloured.
std::vector<std::string> usually_hidden(const std::string& colour);

/// The input of a picture: the grids of block_grid(), joint_polydata() and fill_grid(), or of their files. Without
/// joints no cracks are drawn.
struct PictureGrids {
  vtkUnstructuredGrid* blocks = nullptr;
  vtkPolyData* joints = nullptr;        // may be null
  vtkUnstructuredGrid* fill = nullptr;  // may be null
};
/// The files of a stored frame; empty: none.
struct PictureFiles {
  std::string blocks, joints, fill;
};

/// Draws into a PNG file. Needs no display: see viz/display.h. Throws InputError for an unknown option or a grid
/// without the needed fields, RunError when the file cannot be written.
void render_picture(const PictureGrids& grids, const RenderOptions& options, const std::string& png);
/// The same from a state in memory or read from a checkpoint.
void render_picture(const Assembly& assembly, const Snapshot& snapshot, const RenderOptions& options,
                    const std::string& png);
/// The same from a stored frame.
void render_picture(const PictureFiles& files, const RenderOptions& options, const std::string& png);

/// Upper end of the colour scale that a picture of this frame chooses by itself, in the unit of the scale; 0 if the
/// colours have a legend. For pictures with a common scale. Throws InputError for the colourings of the joints.
double picture_scale(const PictureFiles& files, const RenderOptions& options);

}  // namespace voussoir
