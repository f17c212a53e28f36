#include "viz/arrangement/paper.h"

#include <algorithm>
#include <cmath>

namespace voussoir {

namespace {

constexpr double kEdge = 8.0, kPad = 4.0;  // mm: from the edge of the sheet to the frame, and within the frame
constexpr double kSmallest = 300.0;        // 1 : 300, on a sheet that is not the largest

/// 1 : 1, 1 : 2, 1 : 5, 1 : 10, 1 : 12.5 …
std::vector<double> scales() {
  std::vector<double> all = {1.0, 2.0, 5.0};
  for (double power = 10.0; power < 1e7; power *= 10.0)
    for (const double step : {1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 7.5}) all.push_back(step * power);
  return all;
}

/// Blocks of text, below one another or side by side.
struct Notes {
  double width = 0.0, height = 0.0;
  std::vector<SheetBox> boxes;  // from the upper left of all
};

Notes beside(const std::vector<SheetBox>& sizes) {
  Notes notes;
  for (const SheetBox& size : sizes) notes.height = std::max(notes.height, size.height);
  for (const SheetBox& size : sizes) {  // their feet on one line
    notes.boxes.push_back({notes.width, notes.height - size.height, size.width, size.height});
    notes.width += size.width;
  }
  return notes;
}

Notes below(const std::vector<SheetBox>& sizes) {
  Notes notes;
  for (const SheetBox& size : sizes) notes.width = std::max(notes.width, size.width);
  for (const SheetBox& size : sizes) {
    notes.boxes.push_back({notes.width - size.width, notes.height, size.width, size.height});
    notes.height += size.height;
  }
  return notes;
}

/// A rectangle of views, in a common frame of its own.
struct Cluster {
  double width = 0.0, height = 0.0;
  std::vector<SheetBox> boxes;
};

Cluster stacked(const std::vector<ViewSize>& views, double scale) {
  Cluster cluster;
  double left = 0.0, right = 0.0;
  for (const ViewSize& v : views) {
    left = std::max(left, v.left_at(scale));
    right = std::max(right, v.wide(scale) - v.left_at(scale));
  }
  cluster.width = left + right;
  for (const ViewSize& v : views) {
    cluster.boxes.push_back({left - v.left_at(scale), cluster.height, v.wide(scale), v.high(scale)});
    cluster.height += v.high(scale);
  }
  return cluster;
}

Cluster in_a_row(const std::vector<ViewSize>& views, double scale) {
  Cluster cluster;
  for (const ViewSize& v : views) cluster.height = std::max(cluster.height, v.high(scale));
  for (const ViewSize& v : views) {
    cluster.boxes.push_back({cluster.width, 0.0, v.wide(scale), v.high(scale)});
    cluster.width += v.wide(scale);
  }
  return cluster;
}

enum class Way { below_all, two_rows, column, tall };

/// Shifts all boxes.
std::vector<SheetBox> moved(std::vector<SheetBox> boxes, double x, double y) {
  for (SheetBox& box : boxes) box.x += x, box.y += y;
  return boxes;
}

/// The placement in one of the ways, if it fits.
std::optional<SheetPlan> placed(const Content& content, const PaperSize& paper, double scale, double across_scale,
                                Way way, const Notes& notes) {
  const double width = paper.width - 2.0 * (kEdge + kPad), height = paper.height - 2.0 * (kEdge + kPad);
  const double x0 = kEdge + kPad, y0 = kEdge + kPad, x1 = x0 + width, y1 = y0 + height;
  const Cluster stack = stacked(content.stack, scale), across = in_a_row(content.across, across_scale);
  SheetPlan p{paper, scale, across_scale, {}, {}, {}};
  const auto at_right_foot = [&] { return moved(notes.boxes, x1 - notes.width, y1 - notes.height); };
  switch (way) {
    case Way::below_all: {  // stack; sections and notes below
      const double foot = std::max(across.height, notes.height), free = height - stack.height - foot;
      if (stack.width > width || across.width + notes.width > width || free < 0.0) return std::nullopt;
      const double gap = free / 3.0;
      p.stack = moved(stack.boxes, x0 + 0.5 * (width - stack.width), y0 + gap);
      p.across = moved(across.boxes, x0 + 0.5 * (width - notes.width - across.width), y1 - foot);
      p.notes = at_right_foot();
      return p;
    }
    case Way::two_rows: {  // stack beside notes and, above these, sections
      const double side = std::max(across.width, notes.width), free = height - across.height - notes.height;
      if (stack.width + side > width || stack.height > height || free < 0.0) return std::nullopt;
      const double gap = 0.5 * (width - stack.width - side);
      p.stack = moved(stack.boxes, x0 + 0.5 * gap, y0 + 0.5 * (height - stack.height));
      p.across = moved(across.boxes, x1 - 0.5 * gap - 0.5 * (side + across.width), y0 + 0.5 * free);
      p.notes = at_right_foot();
      return p;
    }
    case Way::column: {  // stack and sections beside the notes
      const double side = width - notes.width, free = height - stack.height - across.height;
      if (std::max(stack.width, across.width) > side || notes.height > height || free < 0.0) return std::nullopt;
      p.stack = moved(stack.boxes, x0 + 0.5 * (side - stack.width), y0 + free / 3.0);
      p.across = moved(across.boxes, x0 + 0.5 * (side - across.width), y1 - across.height - free / 3.0);
      p.notes = at_right_foot();
      return p;
    }
    case Way::tall: {  // the first of the stack beside the sections, the rest of it beside the notes
      if (content.stack.empty()) return std::nullopt;
      const Cluster first = stacked({content.stack.front()}, scale);
      const Cluster rest = stacked({content.stack.begin() + 1, content.stack.end()}, scale);
      const double head = std::max(first.height, across.height), foot = std::max(rest.height, notes.height);
      if (first.width + across.width > width || rest.width + notes.width > width || head + foot > height)
        return std::nullopt;
      const double free = height - head - foot;
      const double gap = (width - first.width - across.width) / 3.0;
      p.stack = moved(first.boxes, x0 + gap, y0 + 0.5 * free + head - first.height);
      for (const SheetBox& box : moved(rest.boxes, x0 + gap, y1 - foot)) p.stack.push_back(box);
      p.across = moved(across.boxes, x0 + 2.0 * gap + first.width, y0 + 0.5 * free + head - across.height);
      p.notes = at_right_foot();
      return p;
    }
  }
  return std::nullopt;
}

std::optional<SheetPlan> any_placed(const Content& content, const PaperSize& paper, double scale, double across_scale) {
  for (const Way way : {Way::below_all, Way::two_rows, Way::column, Way::tall})
    for (const Notes& notes : {beside(content.notes), below(content.notes)})
      if (auto p = placed(content, paper, scale, across_scale, way, notes)) return p;
  return std::nullopt;
}

}  // namespace

SheetPlan place_on_paper(const Content& content) {
  // By area; elongated ones as in ISO 5457.
  static constexpr PaperSize papers[] = {{"A3", 420.0, 297.0, 6.0},   {"A4×3", 630.0, 297.0, 5.5},
                                         {"A2", 594.0, 420.0, 5.5},   {"A4×4", 841.0, 297.0, 5.0},
                                         {"A3×3", 891.0, 420.0, 5.0}, {"A1", 841.0, 594.0, 5.0}};
  const std::vector<double> all = scales();
  for (const PaperSize& paper : papers) {
    const bool last = &paper == std::rbegin(papers).operator->();
    for (std::size_t i = 0; i < all.size() && (last || all[i] <= kSmallest); ++i) {
      std::optional<SheetPlan> best = any_placed(content, paper, all[i], all[i]);
      if (!best) continue;
      for (std::size_t j = i; !content.one_scale && j-- > 0 && all[j] >= 0.5 * all[i];)
        if (auto larger = any_placed(content, paper, all[i], all[j])) best = larger;
      return *best;
    }
  }
  // Nothing fits but the notes: one over the other, at the smallest scale.
  SheetPlan p{*std::rbegin(papers), all.back(), all.back(), {}, {}, {}};
  p.stack = stacked(content.stack, p.scale).boxes;
  p.across = in_a_row(content.across, p.scale).boxes;
  p.notes = beside(content.notes).boxes;
  return p;
}

}  // namespace voussoir
