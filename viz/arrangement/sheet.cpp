#include "viz/arrangement/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace voussoir {

namespace {

const std::string ink = "#1f1f24";

double px(double mm) {
  return kPixelsPerMm * mm;
}

}  // namespace

std::string length_text(double metres) {
  if (std::abs(metres) < 1.0 && std::abs(metres * 100.0 - std::round(metres * 100.0)) > 0.05)
    return fmt::format("{:.3f}", metres);
  return fmt::format("{:.2f}", metres);
}

/// Character widths of Helvetica and fonts with the same metrics (Arial, Liberation Sans), with a margin.
double DrawingSheet::width_of(const std::string& words, double size) {
  static const std::string narrow = " .,:;|!'()[]/fijlrtI-", wide = "mwMW%";
  double width = 0.0;
  for (const char c : words) {
    if ((c & 0xC0) == 0x80) continue;  // not the first byte of a character
    width += narrow.find(c) != std::string::npos ? 0.32 : wide.find(c) != std::string::npos ? 0.88 : 0.58;
  }
  return size * width;
}

std::string DrawingSheet::fitting(const std::string& words, double room, double size) {
  std::size_t most = characters(words);
  while (most > 4 && width_of(shortened(words, most), size) > room) --most;
  return shortened(words, most);
}

std::vector<std::string> DrawingSheet::wrapped(const std::string& words, double room, double size) {
  std::vector<std::string> lines;
  std::istringstream text(words);
  for (std::string word; text >> word;) {
    if (!lines.empty() && width_of(lines.back() + " " + word, size) <= room)
      lines.back() += " " + word;
    else
      lines.push_back(word);
  }
  return lines;
}

void DrawingSheet::line(double x1, double y1, double x2, double y2, double width, const char* dashes) {
  drawing_.line(px(x1), px(y1), px(x2), px(y2), ink, px(width), dashes);
}

void DrawingSheet::lines(const std::vector<std::pair<Vec3, Vec3>>& lines, double width, const std::string& colour,
                         const char* dashes) {
  if (lines.empty()) return;
  Drawing::Path path;
  for (const auto& [from, to] : lines) {
    path.emplace_back(px(from.x()), px(from.y()));
    path.emplace_back(px(to.x()), px(to.y()));
    path.emplace_back(NAN, NAN);
  }
  drawing_.curve(path, colour, px(width), dashes);
}

void DrawingSheet::areas(const std::vector<Drawing::Path>& outlines, const std::string& colour) {
  std::vector<Drawing::Path> placed = outlines;
  for (Drawing::Path& path : placed)
    for (auto& [x, y] : path) x = px(x), y = px(y);
  drawing_.areas(placed, colour);
}

void DrawingSheet::rectangle(const SheetBox& box, const std::string& fill, const std::string& stroke, double width) {
  drawing_.rectangle(px(box.x), px(box.y), px(box.width), px(box.height), {fill, stroke, px(width), {}});
}

SheetBox DrawingSheet::box_of(double x, double y, const std::string& words, double size, Align align, bool upright) {
  const double width = width_of(words, size), above = 0.8 * size, height = 1.05 * size;
  if (upright) return {x - above, y - 0.5 * width, height, width};
  const double left = align == Align::start ? x : align == Align::middle ? x - 0.5 * width : x - width;
  return {left, y - above, width, height};
}

bool DrawingSheet::free(const SheetBox& box) const {
  return std::ranges::none_of(texts_, [&](const SheetBox& other) { return box.meets(other); });
}

void DrawingSheet::put(double x, double y, const std::string& words, double size, Align align, bool bold,
                       bool upright) {
  TextStyle style;
  style.anchor = upright || align == Align::middle ? "middle" : align == Align::start ? "start" : "end";
  style.bold = bold;
  style.size = px(size);
  style.turn = upright ? -90.0 : 0.0;
  drawing_.text(px(x), px(y), words, style);
  texts_.push_back(box_of(x, y, words, size, align, upright));
}

void DrawingSheet::text(double x, double y, const std::string& words, double size, Align align, bool bold,
                        bool upright) {
  if (!words.empty()) put(x, y, words, size, align, bold, upright);
}

bool DrawingSheet::try_text(double x, double y, const std::string& words, Align align, bool upright) {
  const SheetBox box = box_of(x, y, words, kSmallText, align, upright);
  if (!free(box)) return false;
  rectangle({box.x - 0.2, box.y - 0.1, box.width + 0.4, box.height + 0.2}, "#ffffff", "none");
  put(x, y, words, kSmallText, align, false, upright);
  return true;
}

void DrawingSheet::title(const SheetBox& box, double middle, const std::string& words) {
  const double y = box.y + 5.0, half = 0.5 * width_of(words, kHeadText);
  text(middle, y, words, kHeadText, Align::middle, true);
  line(middle - half, y + 1.3, middle + half, y + 1.3, 0.25);
}

void DrawingSheet::tick(double x, double y) {
  line(x - 0.5 * kTickLength, y + 0.5 * kTickLength, x + 0.5 * kTickLength, y - 0.5 * kTickLength, 0.35);
}

void DrawingSheet::chain_along_x(double y, const std::vector<ChainStop>& stops, const std::vector<std::string>& texts) {
  if (stops.size() < 2) return;
  line(stops.front().at - 1.0, y, stops.back().at + 1.0, y);
  for (const ChainStop& stop : stops) {
    const double way = y > stop.from ? 1.0 : -1.0;
    if (std::abs(y - stop.from) > 1.0) line(stop.at, stop.from + 0.8 * way, stop.at, y + 1.2 * way);
    tick(stop.at, y);
  }
  std::vector<std::size_t> narrow;
  for (std::size_t i = 0; i < texts.size() && i + 1 < stops.size(); ++i) {
    const double middle = 0.5 * (stops[i].at + stops[i + 1].at), room = stops[i + 1].at - stops[i].at;
    if (texts[i].empty()) continue;
    if (width_of(texts[i]) > room - 0.6 || !try_text(middle, y - 0.7, texts[i])) narrow.push_back(i);
  }
  for (const std::size_t i : narrow) {
    const double middle = 0.5 * (stops[i].at + stops[i + 1].at), below = y + 0.7 + 0.85 * kSmallText;
    // Below the line, beside an outer stop, and farther below with a line that leads there.
    bool done = try_text(middle, below, texts[i]);
    if (!done && i == 0) done = try_text(stops[0].at - 1.6, y - 0.7, texts[i], Align::end);
    if (!done && i + 2 == stops.size()) done = try_text(stops.back().at + 1.6, y - 0.7, texts[i], Align::start);
    for (const double aside : {1.0, -1.0}) {
      const double x = middle + aside * (0.5 * (stops[i + 1].at - stops[i].at) + 0.5 * width_of(texts[i]) + 1.0);
      if (!done && try_text(x, below, texts[i])) {
        line(middle, y, x - aside * 0.4 * width_of(texts[i]), below - 0.8 * kSmallText);
        done = true;
      }
    }
    if (!done) ++left_out_;
  }
}

void DrawingSheet::chain_along_y(double x, const std::vector<ChainStop>& stops, const std::vector<std::string>& texts,
                                 bool outside_left) {
  if (stops.size() < 2) return;
  const auto [least, most] = std::ranges::minmax(stops, {}, &ChainStop::at);
  line(x, least.at - 1.0, x, most.at + 1.0);
  for (const ChainStop& stop : stops) {
    const double way = x > stop.from ? 1.0 : -1.0;
    if (std::abs(x - stop.from) > 1.0) line(stop.from + 0.8 * way, stop.at, x + 1.2 * way, stop.at);
    tick(x, stop.at);
  }
  std::vector<std::size_t> narrow;
  for (std::size_t i = 0; i < texts.size() && i + 1 < stops.size(); ++i) {
    const double middle = 0.5 * (stops[i].at + stops[i + 1].at), room = std::abs(stops[i + 1].at - stops[i].at);
    if (texts[i].empty()) continue;
    if (width_of(texts[i]) > room - 0.6 || !try_text(x - 0.7, middle, texts[i], Align::middle, true))
      narrow.push_back(i);
  }
  for (const std::size_t i : narrow) {
    const double middle = 0.5 * (stops[i].at + stops[i + 1].at), baseline = middle + 0.28 * kSmallText;
    const double beside = outside_left ? x - 1.3 : x + 1.3;
    const Align align = outside_left ? Align::end : Align::start;
    bool done = false;
    for (const double shift : {0.0, -0.6, 0.6, -1.1, 1.1, -1.7, 1.7})
      done = done || try_text(beside, baseline + shift * kSmallText, texts[i], align);
    if (!done) ++left_out_;
  }
}

void DrawingSheet::arrow(double x1, double y1, double x2, double y2, double width) {
  line(x1, y1, x2, y2, width);
  const double length = std::hypot(x2 - x1, y2 - y1);
  if (length < 1e-9) return;
  const double dx = (x2 - x1) / length, dy = (y2 - y1) / length, head = 2.2, half = 0.6;
  areas({{{x2, y2},
          {x2 - head * dx - half * dy, y2 - head * dy + half * dx},
          {x2 - head * dx + half * dy, y2 - head * dy - half * dx}}},
        ink);
}

}  // namespace voussoir
