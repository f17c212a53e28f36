#include "viz/marks.h"

#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkNew.h>

#include "viz/cut.h"
#include "viz/projection.h"

namespace voussoir {

namespace {

constexpr Colour kHolds = {0.0, 0.447, 0.698}, kHasYielded = {0.835, 0.369, 0.0};  // Okabe & Ito (2008)
constexpr double rounding = 1e-9;                                                  // m

bool is_tie_cell(vtkPolyData* joints, vtkIdType i) {
  vtkDataArray* tie = joints->GetCellData()->GetArray("tie");
  return tie && tie->GetComponent(i, 0) != 0.0;
}

bool has_yielded(vtkPolyData* joints, vtkIdType i) {
  vtkDataArray* yielded = joints->GetCellData()->GetArray("tie_yielded");
  return yielded && yielded->GetComponent(i, 0) > rounding;
}

}  // namespace

void draw_marks(Overlay& overlay, vtkRenderer* renderer, const Sheet& sheet, const std::vector<Mark>& marks) {
  const Projection seen(renderer->GetActiveCamera(), sheet);
  const double s = sheet.letter;
  for (const Mark& mark : marks) {
    const Spot at = seen(mark.at);
    const double radius = std::max(0.85 * s, 0.5 * Overlay::text_width(mark.name, s) + 0.35 * s);
    overlay.disc(at.x(), at.y(), radius + 0.14 * s, kInk);
    overlay.disc(at.x(), at.y(), radius, {1, 1, 1});
    overlay.text(at.x(), at.y() - 0.36 * s, mark.name, s, Align::centre, kInk, true);
  }
}

void draw_ties(Overlay& overlay, vtkRenderer* renderer, const Sheet& sheet, vtkPolyData* joints, double amplification) {
  if (words_of_ties(joints).empty()) return;
  const Projection seen(renderer->GetActiveCamera(), sheet);
  const auto points = Places(joints, "joints have").amplified(amplification);
  const double s = sheet.letter;
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < joints->GetNumberOfPolys(); ++i) {
    if (!is_tie_cell(joints, i)) continue;
    joints->GetPolys()->GetCellAtId(i, corners);
    if (corners->GetNumberOfIds() < 4) continue;
    const auto middle = [&](int a, int b) {
      return Vec3(0.5 * (Vec3(points->GetPoint(corners->GetId(a))) + Vec3(points->GetPoint(corners->GetId(b)))));
    };
    const Spot from = seen(middle(0, 1)), to = seen(middle(2, 3));  // tie_anchors()
    const Colour colour = has_yielded(joints, i) ? kHasYielded : kHolds;
    overlay.line(from.x(), from.y(), to.x(), to.y(), 0.34 * s, {1, 1, 1});
    overlay.line(from.x(), from.y(), to.x(), to.y(), 0.2 * s, colour);
    for (const Spot& end : {from, to}) overlay.disc(end.x(), end.y(), 0.24 * s, colour);
  }
}

std::vector<std::pair<std::string, Colour>> words_of_ties(vtkPolyData* joints) {
  bool holding = false, yielded = false;
  for (vtkIdType i = 0; i < joints->GetNumberOfPolys(); ++i)
    if (is_tie_cell(joints, i)) (has_yielded(joints, i) ? yielded : holding) = true;
  std::vector<std::pair<std::string, Colour>> words;
  if (holding) words.emplace_back("ties", kHolds);
  if (yielded) words.emplace_back("ties that have yielded", kHasYielded);
  return words;
}

}  // namespace voussoir
