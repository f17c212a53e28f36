#include "viz/arrangement/arrangement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/counted.h"
#include "viz/arrangement/arrangement_parts.h"
#include "viz/arrangement/notes.h"
#include "viz/page/svg.h"

namespace voussoir {

void ArrangementParts::find_sections() {
  const auto add = [&](double x, double to, const std::string& of) -> SectionAt& {
    SectionAt section;
    section.letter = char('A' + char(sections.size()));
    section.x = x, section.of = of;
    section.view = flat_view(assembly, seen_from_left(), ViewCut{x, to});
    section.pieces = cut_faces(assembly, seen_from_left(), x);
    sections.push_back(std::move(section));
    return sections.back();
  };
  if (m.spans.empty()) {
    add(0.5 * (m.moving.low.x() + m.moving.high.x()), 1e300, "middle");
    return;
  }
  std::size_t longest = 0;
  for (std::size_t i = 1; i < m.spans.size(); ++i)
    if (m.spans[i].clear() > m.spans[longest].clear() + 1e-6) longest = i;
  const MeasuredSpan& span = m.spans[longest];
  // Up to the far side of the next support.
  const double next = m.supports.empty() ? 1e300 : m.supports[longest + 1].base_x1;
  add(span.crown.x(), next, fmt::format("crown of span {}", longest + 1)).span = &span;
  if (m.supports.empty()) return;
  // The highest pier; of a single span the left abutment, at the springing.
  std::size_t which = m.supports.size() > 2 ? 1 : 0;
  for (std::size_t i = 1; i + 1 < m.supports.size(); ++i)
    if (m.supports[i].height() > m.supports[which].height() + 1e-6) which = i;
  const MeasuredSupport& support = m.supports[which];
  const bool pier = m.supports.size() > 2;
  const bool named = support.name.find(' ') != std::string::npos;
  const std::string of = pier ? fmt::format("pier {}", which) : named ? support.name : "support " + support.name;
  add(0.5 * (support.x0 + support.x1), support.base_x1, of).support = &support;
}

Content ArrangementParts::content(bool lengthwise_too) const {
  Content c;
  c.stack.push_back(elevation_size(elevation));
  if (lengthwise_too) c.stack.push_back(lengthwise_size(lengthwise));
  c.stack.push_back(plan_size(plan));
  for (const SectionAt& s : sections) c.across.push_back(section_size(s.view, section_title(s.letter, s.of)));
  if (const SheetBox schedule = schedule_size(m); schedule.height > 0.0) c.notes.push_back(schedule);
  c.notes.push_back(title_block_size(assembly));
  return c;
}

void ArrangementParts::lay_out() {
  left_out = fixed_at_faces(assembly, m);
  elevation = flat_view(assembly, seen_from_front(), std::nullopt, left_out);
  plan = flat_view(assembly, seen_from_above());
  along = cut_faces(assembly, seen_from_front(), m.middle);
  find_sections();
  placement = place_on_paper(content(false));
  if (m.spans.empty()) return;
  lengthwise = flat_view(assembly, seen_from_front(), ViewCut{m.middle});
  const SheetPlan more = place_on_paper(content(true));
  with_lengthwise = more.scale == placement.scale && more.paper.width == placement.paper.width;
  if (with_lengthwise) placement = more;
}

bool ArrangementParts::bridges_over() const {
  return std::ranges::any_of(m.spans, [](const MeasuredSpan& s) { return s.deck > s.extrados + 1e-6; });
}

double ArrangementParts::parapet_at(double x) const {
  const double near = 1e-3 * (m.moving.high.x() - m.moving.low.x());
  double top = kNotKnown;
  for (const Block& block : assembly.blocks)
    if (block.component == Component::parapet && !block.fixed)
      for (const Polyhedron& cell : block.cells)
        for (const Vec3& p : cell.vertices)
          if (std::abs(p.x() - x) < near && !(p.z() <= top)) top = p.z();
  return top;
}

Arrangement::Arrangement(const Assembly& assembly, const ArrangementNotes& notes)
    : parts_(std::make_unique<ArrangementParts>(assembly, notes)) {
  parts_->lay_out();
}

Arrangement::~Arrangement() = default;

double Arrangement::width() const {
  return kPixelsPerMm * parts_->placement.paper.width;
}

double Arrangement::height() const {
  return kPixelsPerMm * parts_->placement.paper.height;
}

int Arrangement::pixels() const {
  return int(std::lround(parts_->placement.paper.width * parts_->placement.paper.pixels));
}

void Arrangement::draw(Drawing& drawing) const {
  const ArrangementParts& p = *parts_;
  const PaperSize& paper = p.placement.paper;
  DrawingSheet sheet(drawing);
  sheet.rectangle({0.0, 0.0, paper.width, paper.height}, "#ffffff", "none");
  sheet.rectangle({8.0, 8.0, paper.width - 16.0, paper.height - 16.0}, "none", "#1f1f24", 0.5);
  p.draw_elevation(sheet, p.placement.stack.front());
  if (p.with_lengthwise) p.draw_lengthwise(sheet, p.placement.stack[1]);
  p.draw_plan(sheet, p.placement.stack.back());
  for (std::size_t i = 0; i < p.sections.size(); ++i) p.draw_section(sheet, p.placement.across[i], p.sections[i]);
  if (p.placement.notes.size() > 1) draw_schedule(sheet, p.placement.notes.front(), p.m);
  std::vector<std::string> remarks;
  if (!p.left_out.empty()) remarks.push_back("Elevation without the fixed blocks at its faces.");
  if (std::abs(p.m.skew) > 0.002) remarks.push_back("Spans and supports along the middle.");
  if (sheet.left_out() > 0)
    remarks.push_back(
        fmt::format("{} left out for lack of space.", counted(sheet.left_out(), "dimension is", "dimensions are")));
  draw_title_block(sheet, p.placement.notes.back(), p.assembly, p.notes, p.placement, remarks);
}

std::string Arrangement::svg() const {
  SvgDrawing drawing(width(), height(), "General arrangement of " + parts_->notes.name);
  draw(drawing);
  return drawing.finished();
}

}  // namespace voussoir
