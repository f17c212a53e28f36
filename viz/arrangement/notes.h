// Blocks of text of a drawing: title, legend, materials; the table of spans and supports.
#pragma once
#include "viz/arrangement/arrangement.h"
#include "viz/arrangement/measure.h"
#include "viz/arrangement/paper.h"

namespace voussoir {

/// Title, scale, counts, legend and materials.
SheetBox title_block_size(const Assembly& assembly);
void draw_title_block(DrawingSheet& sheet, const SheetBox& box, const Assembly& assembly, const ArrangementNotes& notes,
                      const SheetPlan& placement, const std::vector<std::string>& remarks);

/// The table of spans and supports with their dimensions; equal neighbours share one row. Its size is zero if there
/// are no spans.
SheetBox schedule_size(const Measures& measures);
void draw_schedule(DrawingSheet& sheet, const SheetBox& box, const Measures& measures);

/// A scale bar of a round length, 20 to 50 mm long.
void draw_scale_bar(DrawingSheet& sheet, double x, double y, double scale);

/// "1:125", "1:12.5".
std::string scale_text(double scale);

}  // namespace voussoir
