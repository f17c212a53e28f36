#include "viz/annotation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace voussoir {
namespace {

void draw_colour_scale(Overlay& overlay, const Sheet& sheet, const Colouring& colouring) {
  const double s = sheet.letter, width = std::min(0.36 * sheet.width, 30 * s), height = 0.85 * s;
  const double left = 0.5 * (sheet.width - width), bottom = 2.0 * s;
  constexpr int steps = 200;
  const auto at = [&](double share) { return colouring.bottom + share * (colouring.top - colouring.bottom); };
  for (int i = 0; i < steps; ++i)  // slightly wider than a step, so that no gaps show
    overlay.rectangle(left + width * i / steps, bottom, width / steps + 0.6, height,
                      colour_on_scale(colouring, at((i + 0.5) / steps)));
  const double part = colouring.top / scale_steps(colouring.top);
  const int below = int(std::lround(-colouring.bottom / part)), ticks = below + scale_steps(colouring.top);
  for (int i = 0; i <= ticks; ++i) {
    const double x = left + width * i / ticks;
    overlay.line(x, bottom - 0.25 * s, x, bottom, 1.2);
    const std::string value = fmt::format("{:.4g}", part * (i - below));
    overlay.text(x, bottom - 1.45 * s, (colouring.exceeded && i == ticks ? "≥ " : "") + value, 0.9 * s, Align::centre);
  }
  const double right = left + width, top = bottom + height;
  overlay.line(left, bottom, right, bottom, 1.2);
  overlay.line(left, top, right, top, 1.2);
  overlay.line(left, bottom, left, top, 1.2);
  overlay.line(right, bottom, right, top, 1.2);
  overlay.text(0.5 * sheet.width, top + 0.35 * s, colouring.title, s, Align::centre);
}

void draw_legend(Overlay& overlay, const Sheet& sheet, const Colouring& colouring) {
  const double s = 0.95 * sheet.letter, gap = 1.3 * s;
  double total = -gap;
  for (const auto& [name, colour] : colouring.legend) total += 1.4 * s + Overlay::text_width(name, s) + gap;
  double x = 0.5 * (sheet.width - total);
  for (const auto& [name, colour] : colouring.legend) {
    overlay.rectangle(x - 1, 3.6 * s - 1, s + 2, s + 2, kInk);
    overlay.rectangle(x, 3.6 * s, s, s, colour);
    overlay.text(x + 1.4 * s, 3.5 * s, name, s);
    x += 1.4 * s + Overlay::text_width(name, s) + gap;
  }
}

void draw_length_scale(Overlay& overlay, const Sheet& sheet, double left) {
  const double s = sheet.letter;
  const double length = nice_below(0.13 * sheet.width * sheet.metres_per_pixel);
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

void draw_words(Overlay& overlay, const Sheet& sheet, const Words& words) {
  const double s = sheet.letter, right = sheet.width - 1.2 * s;
  const auto fitted = [&](double y, const std::string& text, double size) {  // beside the colour scale
    const double room = 0.29 * sheet.width, width = Overlay::text_width(text, size);
    overlay.text(right, y, text, width > room ? size * room / width : size, Align::right);
  };
  const double rise = words.hidden.empty() ? 0.0 : 1.4 * s;
  fitted(2.5 * s + rise, words.time, 1.1 * s);
  fitted(1.1 * s + rise, words.deform, s);
  if (!words.hidden.empty()) fitted(1.1 * s, words.hidden, s);
  const double top = sheet.height - 1.9 * s;
  overlay.text(1.2 * s, top, words.title, 1.25 * s, Align::left, kInk, true);
  double end = right;
  for (const auto& [line, colour] : words.lines) {
    overlay.text(end, top, line, 0.95 * s, Align::right);
    const double x = end - Overlay::text_width(line, 0.95 * s) - 1.0 * s;
    overlay.line(x - 1.8 * s, top + 0.6 * s, x, top + 0.6 * s, 0.16 * s, colour);
    end = x - 3.3 * s;
  }
}

}  // namespace

double letter_size(int width) {
  return std::clamp(width / 72.0, 11.0, 60.0);
}
double top_strip(const Sheet& sheet) {
  return 2.6 * sheet.letter;
}
double bottom_strip(const Sheet& sheet) {
  return 5.2 * sheet.letter;
}

void draw_annotation(Overlay& overlay, const Sheet& sheet, const View& view, const Colouring& colouring,
                     const Words& words) {
  draw_axes(overlay, sheet, view);
  if (sheet.metres_per_pixel > 0.0) draw_length_scale(overlay, sheet, 7.5 * sheet.letter);
  if (!colouring.title.empty()) draw_colour_scale(overlay, sheet, colouring);
  if (!colouring.legend.empty()) draw_legend(overlay, sheet, colouring);
  draw_words(overlay, sheet, words);
}

}  // namespace voussoir
