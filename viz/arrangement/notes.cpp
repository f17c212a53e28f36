#include "viz/arrangement/notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "viz/arrangement/paint_view.h"

namespace voussoir {

namespace {

constexpr double kNoteWidth = 104.0, kLine = 4.2, kIndent = 2.5;  // mm
constexpr double kTitleHeight = 40.1, kRemark = 3.6;              // mm: name, source, counts, scale, three remarks
constexpr std::size_t most_materials = 12;
constexpr std::size_t most_rows = 12;  // of each table

struct LegendRow {
  Component component = Component::block;
  bool fixed = false;
  std::int64_t blocks = 0;
  std::vector<std::int32_t> materials;
};

/// Components in the order of their enumeration, with all fixed blocks in one row at the end.
std::vector<LegendRow> legend_rows(const Assembly& assembly) {
  std::map<std::pair<bool, Component>, LegendRow> rows;
  for (const Block& block : assembly.blocks) {
    LegendRow& row = rows[{block.fixed, block.fixed ? Component::base : block.component}];
    row.component = block.fixed ? Component::base : block.component;
    row.fixed = block.fixed;
    ++row.blocks;
    if (!block.fixed && std::ranges::find(row.materials, block.material) == row.materials.end())
      row.materials.push_back(block.material);
  }
  if (!assembly.fill.empty()) {
    LegendRow& row = rows[{false, Component::backfill}];
    row.component = Component::backfill;
    for (const std::int32_t m : assembly.fill.material)
      if (std::ranges::find(row.materials, m) == row.materials.end()) row.materials.push_back(m);
  }
  std::vector<LegendRow> list;
  for (auto& [key, row] : rows) list.push_back(std::move(row));
  return list;
}

std::vector<std::int32_t> materials_used(const Assembly& assembly) {
  std::vector<std::int32_t> used;
  for (const LegendRow& row : legend_rows(assembly))
    used.insert(used.end(), row.materials.begin(), row.materials.end());
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

std::string material_name(const Assembly& assembly, std::int32_t m) {
  return std::size_t(m) < assembly.materials.size() ? assembly.materials[std::size_t(m)].name : "";
}

std::string modulus_text(double pascals) {
  return pascals >= 1e9 ? fmt::format("{:.3g} GPa", pascals / 1e9) : fmt::format("{:.3g} MPa", pascals / 1e6);
}

std::string legend_text(const Assembly& assembly, const LegendRow& row) {
  if (row.fixed) return fmt::format("fixed, ground ({})", row.blocks);
  std::string text = component_names()[std::size_t(row.component)];
  std::vector<std::string> names;
  for (const std::int32_t m : row.materials)
    if (material_name(assembly, m) != text) names.push_back(material_name(assembly, m));
  if (!names.empty()) text += fmt::format(", {}", fmt::join(names, ", "));
  if (row.component == Component::backfill && !assembly.fill.empty())
    return text + fmt::format(" ({})", counted(assembly.fill.tets.size(), "tetrahedron", "tetrahedra"));
  return text + fmt::format(" ({})", row.blocks);
}

double moving_tonnes(const Assembly& assembly) {
  double mass = 0.0;
  for (const Block& block : assembly.blocks)
    if (!block.fixed) mass += block.mass;
  for (std::size_t t = 0; t < assembly.fill.tets.size(); ++t) {
    const auto& tet = assembly.fill.tets[t];
    const auto node = [&](int i) { return assembly.fill.nodes[std::size_t(tet[std::size_t(i)])]; };
    const double volume = (node(1) - node(0)).dot((node(2) - node(0)).cross(node(3) - node(0))) / 6.0;
    mass += volume * assembly.materials[std::size_t(assembly.fill.material[t])].density;
  }
  return mass / 1000.0;
}

std::string counts_text(const Assembly& assembly) {
  std::string text =
      fmt::format("{}, {}", counted(assembly.blocks.size(), "block"), counted(assembly.joints.size(), "joint"));
  if (!assembly.fill.empty())
    text += fmt::format(", {}", counted(assembly.fill.tets.size(), "tetrahedron", "tetrahedra"));
  const double mass = moving_tonnes(assembly);
  return text + fmt::format("; movable mass {:.{}f} t", mass, mass < 1.0 ? 3 : mass < 1000.0 ? 1 : 0);
}

using Row = std::vector<std::string>;

/// Rows by their first columns, "1" … "n"; equal neighbours become one: "2–5".
std::vector<Row> grouped(const std::vector<Row>& rows) {
  std::vector<Row> groups;
  std::vector<std::string> first;
  for (const Row& row : rows) {
    const bool same = !groups.empty() && std::equal(row.begin() + 1, row.end(), groups.back().begin() + 1);
    if (same) {
      groups.back()[0] = first.back() + "–" + row[0];
    } else {
      groups.push_back(row);
      first.push_back(row[0]);
    }
  }
  return groups;
}

std::string known(double value) {
  return std::isfinite(value) ? length_text(value) : "–";
}

std::vector<Row> span_rows(const Measures& m) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < m.spans.size(); ++i) {
    const MeasuredSpan& s = m.spans[i];
    const std::string left = known(s.left_thickness), right = known(s.right_thickness);
    rows.push_back({fmt::format("{}", i + 1), known(s.clear()), known(s.rise), known(s.crown_thickness),
                    left == right ? left : left + " / " + right,
                    s.deck > s.extrados + 1e-6 ? known(s.deck - s.extrados) : "–"});
  }
  return grouped(rows);
}

std::vector<Row> support_rows(const Measures& m) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < m.supports.size(); ++i) {
    const MeasuredSupport& s = m.supports[i];
    const bool end = i == 0 || i + 1 == m.supports.size();
    const std::string name = end ? s.name : fmt::format("{}", i);
    rows.push_back({name, known(s.thickness()), known(s.height()), known(s.base_x1 - s.base_x0)});
  }
  if (rows.size() < 3) return rows;
  std::vector<Row> piers = grouped({rows.begin() + 1, rows.end() - 1});
  for (Row& row : piers) row[0] = "pier " + row[0];
  piers.insert(piers.begin(), rows.front());
  piers.push_back(rows.back());
  return piers;
}

void cap(std::vector<Row>& rows, const char* what) {
  if (rows.size() <= most_rows) return;
  const std::size_t more = rows.size() - most_rows + 1;
  rows.resize(most_rows - 1);
  rows.push_back({fmt::format("and {} of {}", counted(more, "more type"), what)});
}

struct Table {
  Row heads;
  std::vector<double> widths;  // mm
  std::vector<Row> rows;
  double height() const { return rows.empty() ? 0.0 : kLine * (double(rows.size()) + 1.0) + 2.0; }
};

std::vector<Table> schedule_tables(const Measures& m) {
  std::vector<Table> tables;
  if (!m.spans.empty()) {
    Table spans = {{"span", "clear", "rise", "ring, crown", "springings", "fill"},
                   {13.0, 14.0, 14.0, 19.0, 27.0, 14.0},
                   span_rows(m)};
    cap(spans.rows, "spans");
    tables.push_back(spans);
  }
  if (!m.supports.empty()) {
    Table supports = {{"support", "thickness", "height", "at the base"}, {32.0, 22.0, 22.0, 22.0}, support_rows(m)};
    cap(supports.rows, "supports");
    tables.push_back(supports);
  }
  return tables;
}

void draw_table(DrawingSheet& sheet, double x, double y, const Table& table) {
  const auto row = [&](const Row& cells, double baseline, bool bold) {
    double at = x;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (c == 0)
        sheet.text(at, baseline, cells[c], kSmallText, DrawingSheet::Align::start, bold);
      else
        sheet.text(at + table.widths[c] - 1.0, baseline, cells[c], kSmallText, DrawingSheet::Align::end, bold);
      at += table.widths[c];
    }
  };
  double width = 0.0;
  for (const double w : table.widths) width += w;
  row(table.heads, y + 3.0, true);
  sheet.line(x, y + kLine, x + width, y + kLine);
  for (std::size_t r = 0; r < table.rows.size(); ++r) row(table.rows[r], y + 3.2 + kLine * double(r + 1), false);
}

}  // namespace

std::string scale_text(double scale) {
  return fmt::format("1:{:g}", scale);
}

void draw_scale_bar(DrawingSheet& sheet, double x, double y, double scale) {
  const double most = 0.05 * scale;  // m that take 50 mm
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  double length = power;
  for (const double step : {2.0, 5.0})
    if (step * power <= most) length = step * power;
  const double mm = 1000.0 * length / scale, half = 0.5 * mm;
  sheet.rectangle({x, y, half, 1.4}, "#1f1f24", "#1f1f24");
  sheet.rectangle({x + half, y, half, 1.4}, "#ffffff", "#1f1f24");
  const auto label = [&](double at, double value) {
    sheet.text(x + at, y + 4.4, fmt::format("{:g}", value), kSmallText, DrawingSheet::Align::middle);
  };
  label(0.0, 0.0), label(half, 0.5 * length), label(mm, length);
  sheet.text(x + mm + 3.0, y + 1.7, "m", kSmallText);
}

SheetBox title_block_size(const Assembly& assembly) {
  const std::size_t materials = std::min(materials_used(assembly).size(), most_materials + 1);
  const std::size_t rows = (legend_rows(assembly).size() + 1) / 2 + materials;
  return {0.0, 0.0, kNoteWidth, kTitleHeight + kLine * (double(rows) + 2.0) + 6.0};
}

void draw_title_block(DrawingSheet& sheet, const SheetBox& box, const Assembly& assembly, const ArrangementNotes& notes,
                      const SheetPlan& placement, const std::vector<std::string>& remarks) {
  const SheetBox inner = {box.x + 1.0, box.y + 1.0, box.width - 1.0, box.height - 1.0};
  sheet.rectangle(inner, "#ffffff", "#1f1f24", 0.35);
  const double x = inner.x + kIndent, right = inner.x + inner.width - kIndent, room = right - x;
  double y = inner.y + 3.6;
  sheet.text(x, y, "Legend", kSmallText, DrawingSheet::Align::start, true);
  y += 1.4;
  const std::vector<LegendRow> legend = legend_rows(assembly);
  for (std::size_t i = 0; i < legend.size(); ++i) {
    const std::size_t row = i / 2;
    const double left = x + (i % 2 == 0 ? 0.0 : 0.5 * room), top = y + kLine * double(row);
    paint_patch(sheet, {left, top + 0.4, 6.0, 3.0}, legend[i].component, legend[i].fixed);
    sheet.text(left + 7.5, top + 2.9,
               DrawingSheet::fitting(legend_text(assembly, legend[i]), 0.5 * room - 8.0, kSmallText));
  }
  const std::size_t legend_lines = (legend.size() + 1) / 2;
  y += kLine * double(legend_lines) + 3.2;
  sheet.text(x, y, "Materials", kSmallText, DrawingSheet::Align::start, true);
  std::vector<std::int32_t> used = materials_used(assembly);
  const std::size_t others = used.size() > most_materials ? used.size() - most_materials : 0;
  used.resize(used.size() - others);
  for (const std::int32_t m : used) {
    const Material& material = assembly.materials[std::size_t(m)];
    y += kLine;
    sheet.text(x, y,
               DrawingSheet::fitting(
                   fmt::format("{}: {:.4g} kg/m³, E {}, ft {:.3g}, c {:.3g} MPa, friction {:.3g}°", material.name,
                               material.density, modulus_text(material.youngs_modulus), material.tensile_strength / 1e6,
                               material.cohesion / 1e6, material.friction_angle * 180.0 / pi),
                   room, kSmallText));
  }
  if (others > 0) sheet.text(x, y + kLine, fmt::format("and {} more", others));
  const double head = inner.y + inner.height - kTitleHeight;
  sheet.line(inner.x, head, inner.x + inner.width, head, 0.35);
  sheet.text(x, head + 5.2, DrawingSheet::fitting(notes.name, room - 22.0, kHeadText), kHeadText,
             DrawingSheet::Align::start, true);
  sheet.text(right, head + 5.2, placement.paper.name, kPlainText, DrawingSheet::Align::end);
  sheet.text(x, head + 9.8, DrawingSheet::fitting("General arrangement; " + notes.source, room, kPlainText),
             kPlainText);
  sheet.text(x, head + 14.0, DrawingSheet::fitting(counts_text(assembly), room, kSmallText));
  std::string scale = "Scale " + scale_text(placement.scale);
  if (placement.across_scale != placement.scale) scale += ", cross sections " + scale_text(placement.across_scale);
  sheet.text(x, head + 19.4, scale, kPlainText, DrawingSheet::Align::start, true);
  draw_scale_bar(sheet, x + 3.0, head + 22.0, placement.scale);
  std::string remark = "Dimensions in m, measured from the blocks.";
  for (const std::string& more : remarks) remark += " " + more;
  double line = head + 30.8;
  for (const std::string& words : DrawingSheet::wrapped(remark, room)) {
    sheet.text(x, line, words);
    line += kRemark;
  }
}

SheetBox schedule_size(const Measures& measures) {
  double height = 0.0;
  for (const Table& table : schedule_tables(measures)) height += table.height() + 2.0;
  return {0.0, 0.0, height > 0.0 ? kNoteWidth + 2.0 : 0.0, height};
}

void draw_schedule(DrawingSheet& sheet, const SheetBox& box, const Measures& measures) {
  double y = box.y + 1.0;
  for (const Table& table : schedule_tables(measures)) {
    draw_table(sheet, box.x + 2.0, y, table);
    y += table.height() + 2.0;
  }
}

}  // namespace voussoir
