#include "viz/render.h"

#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "io/vtk/files.h"
#include "io/vtk/grid.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "viz/actors.h"
#include "viz/annotation.h"
#include "viz/arrows.h"
#include "viz/colouring.h"
#include "viz/display.h"
#include "viz/joint_colours.h"
#include "viz/marks.h"
#include "viz/offscreen.h"
#include "viz/resultants_overlay.h"
#include "viz/scene.h"

namespace voussoir {
namespace {

constexpr const char* kFillName = "backfill";
constexpr Colour kPaleLine = {0.74, 0.74, 0.76};  // stones around the joints that are coloured

/// The content to which the picture is fitted: all stones except those farther from the undeformed whole than a share
/// of its size. Otherwise a falling stone would reduce the bridge to a dot.
struct Content {
  vtkNew<vtkPoints> points;
  std::set<vtkIdType> gone;  // blocks
};

double diagonal(vtkPoints* points) {
  double box[6];
  points->GetBounds(box);
  return std::hypot(box[1] - box[0], box[3] - box[2], box[5] - box[4]);
}

/// Adds the points of faces that are not too far away; `undeformed` is the undeformed box.
void add_content(Content& content, vtkPolyData* faces, const Box& undeformed) {
  constexpr double far = 0.3;
  vtkDataArray* block = faces->GetCellData()->GetArray("block");
  const Vec3 reach = Vec3::Constant(far * (undeformed.high - undeformed.low).norm());
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < faces->GetNumberOfPolys(); ++c) {
    faces->GetPolys()->GetCellAtId(c, corners);
    for (const vtkIdType i : *corners.GetPointer()) {
      const Vec3 p(faces->GetPoint(i));
      if (((p - undeformed.low + reach).array() >= 0.0).all() && ((undeformed.high + reach - p).array() >= 0.0).all())
        content.points->InsertNextPoint(p.data());
      else if (block)
        content.gone.insert(vtkIdType(block->GetComponent(c, 0)));
    }
  }
}

/// Of the points that belong to a face.
void widen(Box& box, vtkPolyData* faces) {
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < faces->GetNumberOfPolys(); ++c) {
    faces->GetPolys()->GetCellAtId(c, corners);
    for (const vtkIdType i : *corners.GetPointer()) {
      const Vec3 p(faces->GetPoint(i));
      box.low = box.low.cwiseMin(p), box.high = box.high.cwiseMax(p);
    }
  }
}

bool has_component(vtkDataArray* component, const std::string& name) {
  for (vtkIdType i = 0; i < component->GetNumberOfTuples(); ++i)
    if (component_names()[std::size_t(component->GetComponent(i, 0))] == name) return true;
  return false;
}

Words words_of(const PictureGrids& grids, const RenderOptions& options, const std::optional<CutPlane>& cut, bool cracks,
               std::size_t gone) {
  Words words;
  words.title = options.title;
  vtkUnstructuredGrid* blocks = grids.blocks;
  vtkDataArray* time = blocks->GetFieldData()->GetArray("TimeValue");
  if (time && time->GetComponent(0, 0) > 0.0) words.time = fmt::format("t = {:.2f} s", time->GetComponent(0, 0));
  words.deform = options.amplification == 0.0   ? "undeformed"
                 : options.amplification == 1.0 ? "true deformations"
                                                : fmt::format("deformations × {:g}", options.amplification);
  if (!options.notes[0].empty()) words.time = options.notes[0], words.deform = options.notes[1];
  std::vector<std::string> left_out;  // only what there is to hide
  if (vtkDataArray* component = blocks->GetCellData()->GetArray("component"))
    for (const std::string& name : options.hide)
      if (has_component(component, name) || (grids.fill && name == kFillName)) left_out.push_back(name);
  if (!left_out.empty()) words.hidden = fmt::format("hidden: {}", fmt::join(left_out, ", "));
  if (cut) words.hidden += (words.hidden.empty() ? "" : "; ") + cut->words();
  if (gone > 0) words.hidden += fmt::format("{}{} far away", words.hidden.empty() ? "" : "; ", counted(gone, "stone"));
  if (options.outline) words.lines.emplace_back("outline: undeformed", kInk);
  if (cracks)
    words.lines.emplace_back(options.crack_mm > 0.0 ? fmt::format("opened or slipped > {:.3g} mm", options.crack_mm)
                                                    : std::string("bond lost, opened or slipped"),
                             kCrack);
  if (grids.joints)
    for (const auto& line : words_of_ties(grids.joints)) words.lines.push_back(line);
  return words;
}

/// Free height above the content, pixels.
double above(const Sheet& sheet, const RenderOptions& options) {
  return top_strip(sheet) + (options.arrows.empty() ? 0.0 : arrow_strip(sheet)) +
         (options.resultants.empty() ? 0.0 : resultants_strip(sheet));
}

Sheet make_sheet(const RenderOptions& options, const View& view, vtkPoints* points, const Colouring& colouring,
                 const Words& words) {
  Sheet sheet{options.width, options.height, letter_size(options.width)};
  sheet.raised = raised_height(sheet, colouring, words);
  if (sheet.height == 0) {
    const double content = 0.94 * sheet.width / content_aspect(view, points);
    const double needed = content + above(sheet, options) + bottom_strip(sheet) + sheet.letter;
    sheet.height = int(std::clamp(std::round(needed), 0.2 * sheet.width, 1.6 * sheet.width));
  }
  return sheet;
}

void place_camera(vtkRenderer* renderer, const View& view, vtkPoints* points, const RenderOptions& options,
                  Sheet& sheet) {
  const Frame frame{0.03, 0.97, bottom_strip(sheet) / sheet.height, 1.0 - above(sheet, options) / sheet.height};
  fit_camera(renderer->GetActiveCamera(), view, points, frame, double(sheet.width) / sheet.height);
  if (!view.perspective) sheet.metres_per_pixel = 2.0 * renderer->GetActiveCamera()->GetParallelScale() / sheet.height;
}

void add_cracks(vtkRenderer* renderer, vtkPolyData* joints, const Hidden& hidden, const std::optional<CutPlane>& cut,
                const RenderOptions& options, double lift) {
  CrackRule rule;
  rule.opening = rule.slip = 1e-3 * options.crack_mm;
  // After an earthquake most bonds are lost somewhere. Visible cracks are the joints that have moved.
  if (options.crack_mm > 0.0) rule.bonded = 0.0;
  const auto cracks = crack_patches(joints, hidden, options.amplification, rule, cut);
  if (cracks->GetNumberOfPolys() == 0) return;
  add_crack_faces(renderer, cracks);
  add_lines(renderer, borders(cracks), 2.2, kCrack, lift);
}

ColouredJoints coloured_joints(const PictureGrids& grids, const Hidden& hidden, const std::optional<CutPlane>& cut,
                               const RenderOptions& options) {
  if (!grids.joints)
    throw InputError("pictures: the colouring by {} needs joints, but this frame stores none", options.colour);
  const auto shown = [&](vtkIdType i) { return is_shown_as_joint(grids.joints, i); };
  const auto faces = joint_faces(grids.joints, hidden, options.amplification, shown, cut);
  return colour_joints(faces, options.colour, options.range);
}

/// Draws joints as faces in front of the lines of the whole. Faces seen edge-on become lines in their colour.
void add_joints(vtkRenderer* renderer, const ColouredJoints& joints, const View& view, double lift) {
  add_faces(renderer, joints.faces, 0.75);  // their orientations differ, and their colours must be readable
  add_edge_on(renderer, joints.faces, view, 2.0 * lift);
  add_lines(renderer, borders(joints.faces), 0.6, kOutline, lift);
  add_lines(renderer, borders(joints.bare), 0.5, kPaleLine, 0.0);
}

/// Thinner lines for more stones, so that a whole bridge does not turn black.
double outline_width(vtkIdType faces) {
  return std::clamp(0.9 * std::pow(3000.0 / double(faces), 0.2), 0.5, 0.9);
}

/// Visible faces.
struct Shapes {
  vtkSmartPointer<vtkPolyData> stones;
  vtkSmartPointer<vtkPolyData> fill;  // null: none to be seen
  vtkIdType faces() const { return stones->GetNumberOfPolys() + (fill ? fill->GetNumberOfPolys() : 0); }
};

Shapes shapes(const PictureGrids& grids, const Hidden& hidden, double amplification,
              const std::optional<CutPlane>& cut) {
  Shapes s{deformed_faces(grids.blocks, hidden, amplification, cut), nullptr};
  if (!grids.fill) return s;
  s.fill = deformed_faces(grids.fill, hidden, amplification, cut);
  if (s.fill->GetNumberOfPolys() == 0) s.fill = nullptr;
  return s;
}

/// As built.
Box visible_box(const PictureGrids& grids, const Hidden& hidden) {
  const Shapes whole = shapes(grids, hidden, 0.0, {});
  Box box;
  widen(box, whole.stones);
  if (whole.fill) widen(box, whole.fill);
  return box;
}

/// `outline`: the undeformed outline is drawn too.
Content content_of(const Shapes& now, const Shapes& rest, bool outline) {
  Box box;
  Content content;
  content.points->SetDataTypeToDouble();
  for (vtkPolyData* faces : {rest.stones.Get(), rest.fill.Get()})
    if (faces) widen(box, faces);
  for (vtkPolyData* faces : {now.stones.Get(), now.fill.Get()})
    if (faces) add_content(content, faces, box);
  if (!outline && content.points->GetNumberOfPoints() > 0) return content;
  for (vtkPolyData* faces : {rest.stones.Get(), rest.fill.Get()})
    if (faces) add_content(content, faces, box);
  return content;
}

}  // namespace

void check_options(const RenderOptions& options) {
  if (!std::isfinite(options.amplification))
    throw InputError("pictures: the amplification is {}. It must be a finite number", options.amplification);
  if (!options.resultants.empty() && options.amplification != 1.0)
    throw InputError(
        "pictures: the amplification is {:g}. It must be 1 for resultants, because they are drawn at the joints",
        options.amplification);
  if (!(options.range >= 0.0))
    throw InputError("pictures: the range of the colour scale is {}. It must be at least 0", options.range);
  if (options.width < 200 || (options.height != 0 && options.height < 150))
    throw InputError(
        "pictures: {} × {} pixels is too small. The size must be at least 200 × 150 (height 0: chosen by the program)",
        options.width, options.height);
}

std::vector<std::string> usually_hidden(const std::string& colour) {
  if (colours_fill(colour)) return {};
  return {kFillName};
}

void render_picture(const PictureGrids& grids, const RenderOptions& options, const std::string& png) {
  check_options(options);
  const View view = find_view(options.view);
  const Hidden hidden(options.hide);
  const std::optional<CutPlane> cut = find_cut(options.cut, view, visible_box(grids, hidden));
  const Shapes now = shapes(grids, hidden, options.amplification, cut);
  if (now.faces() == 0)
    throw InputError("pictures: nothing is left to draw. Hide fewer components than {}", fmt::join(options.hide, ", "));
  const bool of_joints = colours_joints(options.colour);  // the stones would hide them
  const bool cracks = options.cracks && grids.joints && !of_joints;

  const Display display;
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  const Shapes rest = shapes(grids, hidden, 0.0, cut);
  const Content content = content_of(now, rest, options.outline || options.undeformed);
  ColouredJoints joints;
  if (of_joints) joints = coloured_joints(grids, hidden, cut, options);
  Colouring colouring =
      of_joints ? joints.colouring : colour_faces(now.stones, now.fill, options.colour, options.range);
  if (!options.scale_title.empty()) colouring.title = options.scale_title;
  const Words words = words_of(grids, options, cut, cracks, content.gone.size());
  Sheet sheet = make_sheet(options, view, content.points, colouring, words);
  place_camera(renderer, view, content.points, options, sheet);
  add_lights(renderer, view);
  const double lift = 1e-3 * diagonal(content.points);
  if (of_joints) add_joints(renderer, joints, view, lift);
  for (vtkPolyData* faces : {now.stones.Get(), now.fill.Get()}) {
    if (!faces || of_joints) continue;
    add_faces(renderer, faces);
    add_lines(renderer, outlines(faces), outline_width(now.faces()), kOutline, lift);
  }
  if (of_joints) add_lines(renderer, outlines(now.stones), 0.5, kPaleLine, 0.0);
  if (options.undeformed) add_lines(renderer, outlines(rest.stones), 0.8, kFaint, -lift);
  if (options.outline && grids.joints) add_lines(renderer, outer_outline(rest.stones, grids.joints), 1.6, kInk, -lift);
  if (cracks) add_cracks(renderer, grids.joints, hidden, cut, options, 2.0 * lift);
  renderer->ResetCameraClippingRange();

  Overlay overlay(renderer);
  draw_annotation(overlay, sheet, view, colouring, words);
  if (grids.joints) draw_ties(overlay, renderer, sheet, grids.joints, options.amplification);
  draw_marks(overlay, renderer, sheet, options.marks);
  if (!options.arrows.empty()) draw_arrows(overlay, renderer, sheet, view, options.arrows);
  if (!options.resultants.empty()) draw_resultants(overlay, renderer, sheet, view, options.resultants);
  const auto window = offscreen_window(sheet.width, sheet.height);
  window->AddRenderer(renderer);
  write_png(window, png);
}

double picture_scale(const PictureFiles& files, const RenderOptions& options) {
  const auto blocks = read_vtu(files.blocks);
  const auto fill = files.fill.empty() ? nullptr : read_vtu(files.fill);
  const PictureGrids grids{blocks, nullptr, fill};
  const Hidden hidden(options.hide);
  const std::optional<CutPlane> cut = find_cut(options.cut, find_view(options.view), visible_box(grids, hidden));
  const Shapes now = shapes(grids, hidden, options.amplification, cut);
  return colour_faces(now.stones, now.fill, options.colour, 0.0).top;
}

void render_picture(const Assembly& assembly, const Snapshot& snapshot, const RenderOptions& options,
                    const std::string& png) {
  const auto blocks = block_grid(assembly, snapshot);
  const auto joints = joint_polydata(assembly, snapshot);
  const auto fill = snapshot.fill.empty() ? nullptr : fill_grid(assembly, snapshot);
  render_picture(PictureGrids{blocks, joints, fill}, options, png);
}

void render_picture(const PictureFiles& files, const RenderOptions& options, const std::string& png) {
  const auto blocks = read_vtu(files.blocks);
  const auto joints = files.joints.empty() ? nullptr : read_vtp(files.joints);
  const auto fill = files.fill.empty() ? nullptr : read_vtu(files.fill);
  render_picture(PictureGrids{blocks, joints, fill}, options, png);
}

}  // namespace voussoir
