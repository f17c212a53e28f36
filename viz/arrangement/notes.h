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

/// Spans and supports with what was measured, equal neighbours in one row. Of no size where there are no spans.
SheetBox schedule_size(const Measures& measures);
void draw_schedule(DrawingSheet& sheet, const SheetBox& box, const Measures& measures);

/// "1:125", "1:12.5".
std::string scale_text(double scale);

}  // namespace voussoir
