// Parts of a general arrangement drawing: arrangement.cpp lays them out, draw_views.cpp draws the views.
#pragma once
#include <string>
#include <vector>

#include "viz/arrangement/arrangement.h"
#include "viz/arrangement/measure.h"
#include "viz/arrangement/paint_view.h"
#include "viz/arrangement/paper.h"

namespace voussoir {

struct ArrangementParts {
  struct SectionAt {
    char letter = 'A';
    double x = 0.0;  // m
    std::string of;  // "crown of span 1"
    FlatView view;
    std::vector<FlatFace> pieces;
    const MeasuredSpan* span = nullptr;        // through its crown
    const MeasuredSupport* support = nullptr;  // through its middle
  };

  const Assembly& assembly;
  ArrangementNotes notes;
  Measures m;
  FlatView elevation, lengthwise, plan;
  std::vector<FlatFace> along;  // the section along the middle
  std::vector<SectionAt> sections;
  std::vector<std::int64_t> left_out;
  bool with_lengthwise = false;
  SheetPlan placement;

  ArrangementParts(const Assembly& a, ArrangementNotes n) : assembly(a), notes(std::move(n)), m(measure(a)) {}
  void find_sections();
  void lay_out();
  Content content(bool lengthwise_too) const;

  void draw_elevation(DrawingSheet& sheet, const SheetBox& box) const;
  void draw_lengthwise(DrawingSheet& sheet, const SheetBox& box) const;
  void draw_plan(DrawingSheet& sheet, const SheetBox& box) const;
  void draw_section(DrawingSheet& sheet, const SheetBox& box, const SectionAt& section) const;
  void draw_spans(DrawingSheet& sheet, const SheetPlace& place) const;
  void draw_heights(DrawingSheet& sheet, const SheetPlace& place, double left, double right) const;
  void draw_section_marks(DrawingSheet& sheet, const SheetPlace& place, double top) const;
  void draw_supports_below(DrawingSheet& sheet, const SheetPlace& place) const;
  double parapet_at(double x) const;  // z of its top at an end, x

  bool bridges_over() const;  // there are stones or fill above the vaults
  double deck_at(double x) const { return bridges_over() ? top_over(along, x) : kNotKnown; }
};

/// The space of the views on paper, with titles and dimensions.
ViewSize elevation_size(const FlatView& view);
ViewSize lengthwise_size(const FlatView& view);
ViewSize plan_size(const FlatView& view);
ViewSize section_size(const FlatView& view, const std::string& title);
std::string section_title(char letter, const std::string& of);

}  // namespace voussoir
