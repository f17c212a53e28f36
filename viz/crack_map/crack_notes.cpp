#include "viz/crack_map/crack_notes.h"

#include <fmt/format.h>

#include <algorithm>

#include "solver/base/counted.h"
#include "viz/arrangement/notes.h"

namespace voussoir {

namespace {

constexpr double kTitleWidth = 104.0, kTableWidth = 203.0, kRow = 4.2, kInset = 2.5;  // mm
constexpr const char* kMapInk = "#1f1f24";
constexpr double kTextWidth = kTitleWidth - 1.0 - 2.0 * kInset;  // mm, in the title

std::vector<std::string> remark_lines(const CrackLegend& legend) {
  std::vector<std::string> lines;
  for (const std::string& remark : legend.remarks) {
    const std::vector<std::string> more = DrawingSheet::wrapped(remark, kTextWidth);
    lines.insert(lines.end(), more.begin(), more.end());
  }
  return lines;
}

struct ClassRow {
  std::size_t number = 0;  // of width_classes()
  std::string words;
};

/// The classes above the threshold, in words: "0.3 to 1 mm".
std::vector<ClassRow> class_rows(double threshold) {
  std::vector<ClassRow> rows;
  const auto& classes = width_classes();
  for (std::size_t k = width_class(threshold); k < classes.size(); ++k) {
    const double from = 1e3 * (rows.empty() ? threshold : classes[k].from);
    rows.push_back({k, k + 1 < classes.size() ? fmt::format("{:g} to {:g} mm", from, 1e3 * classes[k + 1].from)
                                              : fmt::format("{:g} mm and more", from)});
  }
  return rows;
}

std::string state_words(CrackState state) {
  return state == CrackState::ever ? "largest since the start" : "at present";
}

std::string count_words(const std::vector<Crack>& cracks, double threshold, bool ever) {
  std::size_t joints = 0;
  for (const Crack& c : cracks) joints += c.joints.size();
  if (cracks.empty()) return fmt::format("No joint has opened or slid by {:g} mm or more.", 1e3 * threshold);
  return fmt::format("{}{} of {}, at least {:g} mm wide", ever ? "" : "present width of ",
                     counted(cracks.size(), "crack"), counted(joints, "joint"), 1e3 * threshold);
}

void sample(DrawingSheet& sheet, double x, double y, const WidthClass& c, const char* dashes) {
  sheet.lines({{Vec3(x, y, 0.0), Vec3(x + 12.0, y, 0.0)}}, c.line, c.colour, dashes);
}

}  // namespace

SheetBox crack_title_size(const CrackLegend& legend) {
  const std::size_t rows = (class_rows(legend.threshold).size() + 3) / 2;
  return {0.0, 0.0, kTitleWidth, 41.0 + kRow * (double(rows) + 1.0 + double(remark_lines(legend).size()))};
}

void draw_crack_title(DrawingSheet& sheet, const SheetBox& box, const CrackLegend& legend, const SheetPlan& placement) {
  const SheetBox inner = {box.x + 1.0, box.y + 1.0, box.width - 1.0, box.height - 1.0};
  sheet.rectangle(inner, "#ffffff", kMapInk, 0.35);
  const double x = inner.x + kInset, right = inner.x + inner.width - kInset, room = right - x;
  double y = inner.y + 3.8;
  sheet.text(x, y, "Width of cracks", kSmallText, DrawingSheet::Align::start, true);
  const std::vector<ClassRow> rows = class_rows(legend.threshold);
  const auto place = [&](std::size_t i) {
    const std::size_t row = i / 2 + 1;
    return std::pair(x + (i % 2) * 0.5 * room, y + kRow * double(row));
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto [at_x, at_y] = place(i);
    sample(sheet, at_x, at_y - 0.9, width_classes()[rows[i].number], "");
    sheet.text(at_x + 14.0, at_y, rows[i].words);
  }
  const auto [dash_x, dash_y] = place(rows.size());
  sample(sheet, dash_x, dash_y - 0.9, width_classes()[1], "5 3");
  sheet.text(dash_x + 14.0, dash_y, "slip larger than opening");
  if (legend.any_fell) {
    const auto [fell_x, fell_y] = place(rows.size() + 1);
    sheet.rectangle({fell_x, fell_y - 2.5, 12.0, 3.0}, "#c8c8cc", "none");
    sheet.text(fell_x + 14.0, fell_y, "fallen stones");
  }
  const std::vector<std::string> remarks = remark_lines(legend);
  y = inner.y + inner.height - 34.0 - kRow * double(remarks.size());
  sheet.line(inner.x, y, inner.x + inner.width, y, 0.35);
  sheet.text(x, y + 5.2, DrawingSheet::fitting(legend.notes.name, room - 22.0, kHeadText), kHeadText,
             DrawingSheet::Align::start, true);
  sheet.text(right, y + 5.2, placement.paper.name, kPlainText, DrawingSheet::Align::end);
  sheet.text(
      x, y + 9.8,
      DrawingSheet::fitting("Crack map, " + state_words(legend.state) + "; " + legend.notes.source, room, kPlainText),
      kPlainText);
  sheet.text(x, y + 14.0,
             DrawingSheet::fitting(count_words(legend.cracks, legend.threshold, legend.state == legend.by), room));
  sheet.text(x, y + 19.4, "Scale " + scale_text(placement.scale), kPlainText, DrawingSheet::Align::start, true);
  draw_scale_bar(sheet, x + 3.0, y + 22.0, placement.scale);
  double line = y + 30.8;
  for (const std::string& remark : remarks) {
    sheet.text(x, line, remark);
    line += kRow;
  }
  sheet.text(x, line, "Drawn on the undeformed stones. voussoir " VOUSSOIR_VERSION);
}

SheetBox crack_table_size(const std::vector<Crack>& cracks) {
  const std::size_t rows = std::min(cracks.size(), kNumberedCracks);
  return rows == 0 ? SheetBox{} : SheetBox{0.0, 0.0, kTableWidth + 3.0, kRow * (double(rows) + 2.0) + 4.0};
}

void draw_crack_table(DrawingSheet& sheet, const SheetBox& box, const std::vector<Crack>& cracks) {
  using Align = DrawingSheet::Align;
  const double x = box.x + 1.0, right = x + kTableWidth;
  double y = box.y + 3.0;
  const auto row = [&](const std::array<std::string, 8>& cells, bool bold) {
    sheet.text(x + 4.0, y, cells[0], kSmallText, Align::end, bold);
    sheet.text(x + 6.0, y, DrawingSheet::fitting(cells[1], 98.0), kSmallText, Align::start, bold);
    sheet.text(x + 106.0, y, DrawingSheet::fitting(cells[2], 28.0), kSmallText, Align::start, bold);
    for (std::size_t k = 3; k < cells.size(); ++k)
      sheet.text(x + 147.0 + 14.0 * double(k - 3), y, cells[k], kSmallText, Align::end, bold);
  };
  row({"", "widest cracks: position", "direction", "length, m", "open, mm", "slip, mm", "open now", "slip now"}, true);
  sheet.line(x, y + 1.2, right, y + 1.2);
  for (std::size_t k = 0; k < std::min(cracks.size(), kNumberedCracks); ++k) {
    const Crack& c = cracks[k];
    const auto mm = [](double metres) { return metres >= kStoneFell ? std::string("fell") : width_text(metres); };
    y += kRow;
    row({fmt::format("{}", c.number), c.where, c.direction, fmt::format("{:.2f}", c.length), mm(c.ever.opening),
         mm(c.ever.slip), mm(c.now.opening), mm(c.now.slip)},
        false);
  }
  if (cracks.size() > kNumberedCracks) {
    y += kRow;
    sheet.text(x + 6.0, y, fmt::format("and {} more", cracks.size() - kNumberedCracks));
  }
}

}  // namespace voussoir
