// Pictures of a state for reports and papers: deformed shape, damage, cracks; drawn off-screen from stored results.
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

/// A number at a place of the picture, m as drawn (displacements included).
struct Mark {
  Vec3 at = Vec3::Zero();
  std::string name;
};

struct RenderOptions {
  double amplification = 2.0;      // of the displacements relative to the base; 1: true, 0: undeformed
  std::string colour = "opening";  // opening, slip (largest since the start), displacement, component, stone;
                                   // mode: displacement over the largest; of the joints normal, shear,
                                   // utilisation, eccentricity; of a deformable fill plastic, yield, stress
  bool cracks = true;              // mark the joints that lost their bond, opened or slipped
  double crack_mm = 1.0;           // mm: a joint that opened or slipped more counts as cracked; 0: or lost its bond
  std::vector<std::string> hide = {"backfill"};  // components left out; backfill: a deformable fill, too
  std::string cut;                               // "y=0.5" or "y": see viz/cut.h; empty: none
  std::string view = "oblique";                  // front, side, plan, oblique
  int width = 1800, height = 1000;               // pixels; height 0: as the content needs
  std::string scale_title;                       // of the colour scale; empty: what the colour is
  double range = 0.0;                            // mm, %, MPa or kPa, top of the colour scale; 0: from the data
  bool undeformed = false;                       // thin outlines of the undeformed stones
  bool outline = false;                          // or of the undeformed whole only (needs the joints)
  std::string title;
  std::array<std::string, 2> notes;  // two lines in the lower right; empty: time and amplification
  std::vector<Mark> marks;           // drawn over everything, too
  std::vector<Arrow> arrows;         // drawn over everything
  std::vector<BedJoint> resultants;  // arrows and lines of thrust over everything; true deformations only
};

/// Throws InputError for a size, range or amplification that cannot be.
void check_options(const RenderOptions& options);

/// What a picture leaves out if nothing else is asked for: the backfill, unless it is what is coloured.
std::vector<std::string> usually_hidden(const std::string& colour);

/// What a picture is drawn from: the grids of block_grid(), joint_polydata() and fill_grid(), or of their files.
/// Without joints there are no cracks.
struct PictureGrids {
  vtkUnstructuredGrid* blocks = nullptr;
  vtkPolyData* joints = nullptr;        // may be null
  vtkUnstructuredGrid* fill = nullptr;  // may be null
};
/// The files of a stored frame; empty: there is none.
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

/// Top of the colour scale that a picture of this frame would choose by itself, in the scale's unit; 0 where the
/// colours are a legend. For pictures that shall have one scale.
double picture_scale(const PictureFiles& files, const RenderOptions& options);

}  // namespace voussoir
