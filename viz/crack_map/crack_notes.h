// Blocks of text of a crack map: title with legend, and the table of the widest cracks.
#pragma once
#include "viz/arrangement/paper.h"
#include "viz/crack_map/crack_map.h"

namespace voussoir {

constexpr std::size_t kNumberedCracks = 10;  // on the map and in its table

struct CrackLegend {
  const CrackMapNotes& notes;
  const std::vector<Crack>& cracks;
  double threshold = 0.0;  // m
  // The state that is drawn, and the state in which the cracks were found.
  CrackState state = CrackState::ever, by = CrackState::ever;
  bool any_fell = false;
  std::vector<std::string> remarks;
};

SheetBox crack_title_size(const CrackLegend& legend);
void draw_crack_title(DrawingSheet& sheet, const SheetBox& box, const CrackLegend& legend, const SheetPlan& placement);

SheetBox crack_table_size(const std::vector<Crack>& cracks);
void draw_crack_table(DrawingSheet& sheet, const SheetBox& box, const std::vector<Crack>& cracks);

}  // namespace voussoir
