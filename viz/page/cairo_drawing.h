// Drawings as files: PDF, true to size in print, and PNG. Needs no display.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "viz/page/drawing.h"

namespace voussoir {

using DrawOn = std::function<void(Drawing&)>;

/// One PDF file with a page of width × height px for each drawing; 96 px are an inch, so what is drawn to a scale is
/// printed to it. The same drawings give the same bytes. Throws RunError when the file cannot be written.
void write_pdf(const std::vector<DrawOn>& pages, double width, double height, const std::string& pdf);

/// A PNG file `pixels` wide of a drawing of width × height px, text and lines in proportion. Throws RunError when the
/// file cannot be written.
void write_png(const DrawOn& draw_on, double width, double height, const std::string& png, int pixels);

}  // namespace voussoir
