// The crack map of an assembly in the form that inspectors use: both elevations, the deck and the unrolled intrados of
// each vault at one scale, with the cracked joints by width, a legend and a table of the widest cracks.
#pragma once
#include <string>
#include <vector>

#include "viz/arrangement/paint_view.h"
#include "viz/arrangement/paper.h"
#include "viz/crack_map/crack_view.h"

namespace voussoir {

struct CrackMapNotes {
  std::string name;    // name of the object: "demo"
  std::string source;  // its origin: "state at 12.5 s"
};

class CrackMap {
 public:
  /// Cracks are found and numbered in the state `by`. draw() shows their joints whose width is at least `threshold` (m)
  /// in the state that it draws. The assembly must outlive this object.
  CrackMap(const Assembly& assembly, const Snapshot& snapshot, const CrackMapNotes& notes,
           double threshold = kCrackThreshold, CrackState by = CrackState::ever);
  /// The widest first; empty if nothing exceeds the threshold.
  const std::vector<Crack>& cracks() const { return cracks_; }
  /// Whether a drawing of the present state differs from that of the largest values.
  bool has_changed() const;
  double width() const;   // px; at 96 px per inch the print is true to scale
  double height() const;  // px
  int pixels() const;     // px, width of a readable picture
  void draw(Drawing& drawing, CrackState state) const;
  std::string svg(CrackState state) const;

 private:
  void draw_view(DrawingSheet& sheet, const SheetBox& box, const CrackView& view, CrackState state) const;
  void draw_traces(DrawingSheet& sheet, const SheetPlace& place, const CrackView& view, CrackState state) const;
  void draw_numbers(DrawingSheet& sheet, const SheetPlace& place, const CrackView& view, CrackState state) const;
  bool shown(const CrackTrace& trace, CrackState state) const;
  JointGap gap(const CrackTrace& trace, CrackState state) const { return gaps_[trace.joint].in(state); }

  const Assembly& assembly_;
  CrackMapNotes notes_;
  double threshold_;
  CrackState by_;
  std::vector<JointGaps> gaps_;  // of the assembly's joints
  std::vector<Crack> cracks_;
  std::vector<CrackView> stack_, across_;
  std::vector<std::string> remarks_;
  bool any_fell_ = false;
  SheetPlan placement_;
};

}  // namespace voussoir
