#include "viz/annotation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "viz/offscreen.h"

namespace voussoir {
namespace {

constexpr double kFoot = 5.2, kRow = 1.5, kLegendText = 0.95, kSample = 1.4, kGap = 1.3;  // letters
constexpr double kScaleFrom = 7.5;                                                        // letters, length scale
constexpr double kScaleShare = 0.13, kCornerShare = 0.29, kLinesShare = 0.6;              // of the width

/// A height that fonts have; others are rounded, and text becomes wider than its room.
double font_below(double size) {
  return std::floor(size * kOversampling) / kOversampling;
}

/// At most `size`, and so small that the text takes no more than `room`.
double fitted_size(const std::string& text, double size, double room) {
  const double width = Overlay::text_width(text, size);
  return width > room ? font_below(size * room / width) : size;
}

double right_margin(const Sheet& sheet) {
  return sheet.width - 1.2 * sheet.letter;
}

/// The words in the lower right corner, from below, each with its font height in letters.
std::vector<std::pair<std::string, double>> corner_words(const Words& words) {
  std::vector<std::pair<std::string, double>> lines;
  for (const auto& line : {std::pair{words.hidden, 1.0}, {words.deform, 1.0}, {words.time, 1.1}})
    if (!line.first.empty()) lines.push_back(line);
  return lines;
}

/// The free width at the foot between the length scale and the words in the corner, pixels.
struct Room {
  double left = 0.0, right = 0.0;
  double width() const { return right - left; }
};

Room free_room(const Sheet& sheet, const Words& words) {
  const double s = sheet.letter;
  double widest = 0.0;
  for (const auto& [line, size] : corner_words(words)) widest = std::max(widest, Overlay::text_width(line, size * s));
  return {kScaleFrom * s + kScaleShare * sheet.width + s,
          right_margin(sheet) - std::min(widest, kCornerShare * sheet.width) - s};
}

/// The width of the sheet within its margins.
Room whole_room(const Sheet& sheet) {
  return {1.2 * sheet.letter, right_margin(sheet)};
}

using Legend = std::vector<std::pair<std::string, Colour>>;

double legend_width(const Legend& legend, double size) {
  double width = -kGap * size;
  for (const auto& [name, colour] : legend) width += (kSample + kGap) * size + Overlay::text_width(name, size);
  return width;
}

/// At most the usual height of the letters, and so small that every entry fits into a row of its own.
double legend_size(const Sheet& sheet, const Legend& legend) {
  double size = kLegendText * sheet.letter;
  for (const auto& entry : legend) {
    const double width = legend_width({entry}, kLegendText * sheet.letter), room = whole_room(sheet).width();
    if (width > room) size = std::min(size, font_below(kLegendText * sheet.letter * room / width));
  }
  return size;
}

std::vector<Legend> legend_rows(const Legend& legend, double size, double room) {
  std::vector<Legend> rows(1);
  for (const auto& entry : legend) {
    rows.back().push_back(entry);
    if (rows.back().size() == 1 || legend_width(rows.back(), size) <= room) continue;
    rows.back().pop_back();
    rows.push_back({entry});
  }
  return rows;
}

/// In the middle of the sheet, or as near to it as the room allows.
void draw_row(Overlay& overlay, const Sheet& sheet, const Legend& row, double size, const Room& room, double y) {
  const double width = legend_width(row, size), s = size;
  double x = std::max(std::min(0.5 * (sheet.width - width), room.right - width), room.left);
  for (const auto& [name, colour] : row) {
    overlay.rectangle(x - 1, y + 0.1 * s - 1, s + 2, s + 2, kInk);
    overlay.rectangle(x, y + 0.1 * s, s, s, colour);
    overlay.text(x + kSample * s, y, name, s);
    x += (kSample + kGap) * s + Overlay::text_width(name, s);
  }
}

void draw_legend(Overlay& overlay, const Sheet& sheet, const Legend& legend, const Words& words) {
  const double size = legend_size(sheet, legend);
  if (sheet.raised == 0.0) return draw_row(overlay, sheet, legend, size, free_room(sheet, words), 3.5 * size);
  double y = kFoot * sheet.letter + sheet.raised;
  for (const Legend& row : legend_rows(legend, size, whole_room(sheet).width()))
    draw_row(overlay, sheet, row, size, whole_room(sheet), y -= kRow * sheet.letter);
}

/// The numbers of a scale, from its lower end.
std::vector<std::string> scale_numbers(const Colouring& colouring) {
  const double part = colouring.top / scale_steps(colouring.top);
  const int below = int(std::lround(-colouring.bottom / part)), last = below + scale_steps(colouring.top);
  std::vector<std::string> numbers;
  for (int i = 0; i <= last; ++i) numbers.push_back(fmt::format("{:.4g}", part * (i - below)));
  if (colouring.exceeded) numbers.back().insert(0, "≥ ");
  return numbers;
}

void draw_scale_title(Overlay& overlay, const Sheet& sheet, const std::string& title, const Words& words, double y) {
  const Room room = sheet.raised > 0.0 ? whole_room(sheet) : free_room(sheet, words);
  const double size = fitted_size(title, sheet.letter, room.width()), half = 0.5 * Overlay::text_width(title, size);
  const double x = std::max(std::min(0.5 * sheet.width, room.right - half), room.left + half);
  overlay.text(x, sheet.raised > 0.0 ? kFoot * sheet.letter : y, title, size, Align::centre);
}

void draw_colour_scale(Overlay& overlay, const Sheet& sheet, const Colouring& colouring, const Words& words) {
  const Room room = free_room(sheet, words);
  const double s = sheet.letter, height = 0.85 * s, bottom = 2.0 * s, aside = 2.0 * s;  // half a number overhangs
  const double width = std::min({0.36 * sheet.width, 30 * s, room.width() - 2.0 * aside});
  const double left = std::max(std::min(0.5 * (sheet.width - width), room.right - aside - width), room.left + aside);
  constexpr int steps = 200;
  const auto at = [&](double share) { return colouring.bottom + share * (colouring.top - colouring.bottom); };
  for (int i = 0; i < steps; ++i)  // slightly wider than a step, so that no gaps show
    overlay.rectangle(left + width * i / steps, bottom, width / steps + 0.6, height,
                      colour_on_scale(colouring, at((i + 0.5) / steps)));
  const std::vector<std::string> numbers = scale_numbers(colouring);
  const double apart = width / double(numbers.size() - 1);
  double size = 0.9 * s;
  for (const std::string& number : numbers) size = std::min(size, fitted_size(number, 0.9 * s, 0.9 * apart));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double x = left + apart * double(i);
    overlay.line(x, bottom - 0.25 * s, x, bottom, 1.2);
    overlay.text(x, bottom - 1.45 * s, numbers[i], size, Align::centre);
  }
  const double right = left + width, top = bottom + height;
  overlay.line(left, bottom, right, bottom, 1.2);
  overlay.line(left, top, right, top, 1.2);
  overlay.line(left, bottom, left, top, 1.2);
  overlay.line(right, bottom, right, top, 1.2);
  draw_scale_title(overlay, sheet, colouring.title, words, top + 0.35 * s);
}

void draw_length_scale(Overlay& overlay, const Sheet& sheet, double left) {
  const double s = sheet.letter;
  const double length = nice_below(kScaleShare * sheet.width * sheet.metres_per_pixel);
  const double pixels = length / sheet.metres_per_pixel, y = 1.1 * s;
  overlay.rectangle(left, y, pixels, 0.3 * s, kInk);
  overlay.rectangle(left + 0.5 * pixels, y + 0.06 * s, 0.5 * pixels - 0.06 * s, 0.18 * s, {1, 1, 1});
  overlay.text(left + 0.5 * pixels, y + 0.5 * s, fmt::format("{:g} m", length), s, Align::centre);
}

/// The three axes in the view; an axis towards or away from the reader is left out.
void draw_axes(Overlay& overlay, const Sheet& sheet, const View& view) {
  const double s = sheet.letter, size = 2.4 * s;
  const std::array<std::pair<Vec3, const char*>, 3> axes = {
      {{Vec3::UnitX(), "x"}, {Vec3::UnitY(), "y"}, {Vec3::UnitZ(), "z"}}};
  double low_x = 0.0, low_y = 0.0;  // extent to the left and downwards
  for (const auto& [axis, name] : axes) {
    low_x = std::min(low_x, axis.dot(view.right));
    low_y = std::min(low_y, axis.dot(view.up));
  }
  const double x0 = 2.0 * s - (size + s) * low_x, y0 = 1.2 * s - (size + s) * low_y;
  for (const auto& [axis, name] : axes) {
    const double dx = axis.dot(view.right), dy = axis.dot(view.up), length = std::hypot(dx, dy);
    if (length < 0.1) continue;
    const double x1 = x0 + size * dx, y1 = y0 + size * dy, ux = dx / length, uy = dy / length;
    overlay.line(x0, y0, x1, y1, 0.11 * s);
    const double head = 0.5 * s, half = 0.2 * s;
    overlay.polygon(
        {{x1 + head * ux, y1 + head * uy}, {x1 - half * uy, y1 + half * ux}, {x1 + half * uy, y1 - half * ux}}, kInk);
    overlay.text(x1 + (head + 0.55 * s) * ux, y1 + (head + 0.55 * s) * uy - 0.6 * s, name, s, Align::centre);
  }
}

void draw_corner(Overlay& overlay, const Sheet& sheet, const Words& words) {
  double y = 1.1 * sheet.letter;
  for (const auto& [line, size] : corner_words(words)) {
    const double fitted = fitted_size(line, size * sheet.letter, kCornerShare * sheet.width);
    overlay.text(right_margin(sheet), y, line, fitted, Align::right);
    y += 1.4 * sheet.letter;
  }
}

/// The title, and the legend of the lines on its right.
void draw_head(Overlay& overlay, const Sheet& sheet, const Words& words) {
  const double s = sheet.letter, top = sheet.height - 1.9 * s, left = 1.2 * s;
  double wide = 0.0;
  for (const auto& [line, colour] : words.lines) wide += Overlay::text_width(line, kLegendText * s) + 4.3 * s;
  const double room = words.title.empty() ? right_margin(sheet) - left : kLinesShare * sheet.width;
  const double factor = std::min(1.0, room / std::max(wide, 1.0)), small = factor * s;
  double end = right_margin(sheet);
  for (const auto& [line, colour] : words.lines) {
    overlay.text(end, top, line, kLegendText * small, Align::right);
    const double x = end - Overlay::text_width(line, kLegendText * small) - small;
    overlay.line(x - 1.8 * small, top + 0.6 * small, x, top + 0.6 * small, 0.16 * small, colour);
    end = x - 3.3 * small;
  }
  constexpr double bold = 1.15;  // of the width of plain letters, at most
  const double size = fitted_size(words.title, 1.25 * s, (end - left) / bold);
  overlay.text(left, top, words.title, size, Align::left, kInk, true);
}

}  // namespace

double letter_size(int width) {
  return std::clamp(width / 72.0, 11.0, 60.0);
}
double top_strip(const Sheet& sheet) {
  return 2.6 * sheet.letter;
}
double bottom_strip(const Sheet& sheet) {
  return kFoot * sheet.letter + sheet.raised;
}

double raised_height(const Sheet& sheet, const Colouring& colouring, const Words& words) {
  const double room = free_room(sheet, words).width(), row = kRow * sheet.letter;
  if (!colouring.title.empty()) return Overlay::text_width(colouring.title, sheet.letter) > room ? row : 0.0;
  if (colouring.legend.empty()) return 0.0;
  const double size = legend_size(sheet, colouring.legend);
  if (legend_width(colouring.legend, size) <= room) return 0.0;
  return row * double(legend_rows(colouring.legend, size, whole_room(sheet).width()).size());
}

void draw_annotation(Overlay& overlay, const Sheet& sheet, const View& view, const Colouring& colouring,
                     const Words& words) {
  draw_axes(overlay, sheet, view);
  if (sheet.metres_per_pixel > 0.0) draw_length_scale(overlay, sheet, kScaleFrom * sheet.letter);
  if (!colouring.title.empty()) draw_colour_scale(overlay, sheet, colouring, words);
  if (!colouring.legend.empty()) draw_legend(overlay, sheet, colouring.legend, words);
  draw_corner(overlay, sheet, words);
  draw_head(overlay, sheet, words);
}

}  // namespace voussoir
