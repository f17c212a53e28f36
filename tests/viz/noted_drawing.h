// A drawing that notes what is drawn, for tests of sheets.
#pragma once
#include <gtest/gtest.h>

#include "viz/arrangement/sheet.h"

namespace voussoir::test {

/// What was drawn.
class Noted : public Drawing {
 public:
  struct Words {
    std::string text;
    SheetBox box;  // mm
  };
  std::vector<Words> words;
  std::size_t areas_drawn = 0, curves_drawn = 0;

  void curve(const Path&, const std::string&, double, const char*) override { ++curves_drawn; }
  void area(const Path&, const std::string&) override { ++areas_drawn; }
  void rectangle(double, double, double, double, const ShapeStyle&, std::string_view) override {}
  void marker(Marker, double, double, const std::string&, std::string_view, double) override {}
  void text(double x, double y, std::string_view what, const TextStyle& style) override {
    const double size = style.size / kPixelsPerMm, width = DrawingSheet::width_of(std::string(what), size);
    x /= kPixelsPerMm, y /= kPixelsPerMm;
    const std::string anchor = style.anchor;
    const double left = anchor == "start" ? x : anchor == "middle" ? x - 0.5 * width : x - width;
    // Letters without those that reach below the line.
    const SheetBox box = style.turn == 0.0 ? SheetBox{left, y - 0.7 * size, width, 0.7 * size}
                                           : SheetBox{x - 0.7 * size, y - 0.5 * width, 0.7 * size, width};
    words.push_back({std::string(what), box});
  }
  bool says(const std::string& text) const {
    return std::ranges::any_of(words, [&](const Words& w) { return w.text == text; });
  }
  std::string all() const {
    std::string text;
    for (const Words& w : words) text += w.text + "\n";
    return text;
  }
};

/// That no text of a sheet lies on another or beyond its frame.
template <class Sheet>
void expect_readable(const Sheet& sheet, const Noted& drawn, const std::string& of) {
  const SheetBox paper = {8.0, 8.0, sheet.width() / kPixelsPerMm - 16.0, sheet.height() / kPixelsPerMm - 16.0};
  for (std::size_t i = 0; i < drawn.words.size(); ++i) {
    const SheetBox& box = drawn.words[i].box;
    EXPECT_TRUE(box.x >= paper.x && box.y >= paper.y && box.x + box.width <= paper.x + paper.width &&
                box.y + box.height <= paper.y + paper.height)
        << of << ": " << drawn.words[i].text << " lies beyond the frame";
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(box.meets(drawn.words[j].box))
          << of << ": " << drawn.words[i].text << " lies on " << drawn.words[j].text;
  }
}

}  // namespace voussoir::test
