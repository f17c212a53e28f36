#include "viz/crack_map/crack_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "viz/arrangement/paint_view.h"
#include "viz/crack_map/crack_notes.h"
#include "viz/page/svg.h"

namespace voussoir {

namespace {

constexpr double kPatternWidths[kLineKinds] = {0.1, 0.14, 0.3};  // mm
constexpr const char* kPatternInks[kLineKinds] = {"#b9b5b0", "#96918b", "#55524e"};

ViewSize size_of(const CrackView& view) {
  const Box box = view.extent();
  ViewSize size{box.high.x() - box.low.x(), box.high.y() - box.low.y(), 7.0, 7.0, 12.0, 11.0};
  size.title = DrawingSheet::width_of(view.title, kHeadText) + 4.0;
  return size;
}

std::vector<FlatLine> placed(std::vector<FlatLine> lines, const SheetPlace& place) {
  for (auto& [a, b] : lines) a = place.at(a), b = place.at(b);
  return lines;
}

/// A step of 1, 2 or 5 times a power of ten, m, at least `least`.
double tick_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * power >= least) return step * power;
  return 10.0 * power;
}

/// Numbers below a view: x, or the length along an intrados.
void draw_scale(DrawingSheet& sheet, const SheetPlace& place, const CrackView& view, double foot) {
  const double step = tick_step(14.0 / place.mm);
  for (double value = std::ceil(view.u_from / step - 1e-9) * step; value <= view.u_to + 1e-9; value += step) {
    const double x = place.x(view.mirrored ? -value : value);
    sheet.line(x, foot + 1.0, x, foot + 2.4);
    sheet.text(x, foot + 5.2, tick_text(std::round(value * 1e6) / 1e6), kSmallText, DrawingSheet::Align::middle);
  }
  const double end = view.mirrored ? place.x(-view.u_from) : place.x(view.u_to);
  sheet.text(end + 2.0, foot + 2.6, view.u_name + ", m");
}

}  // namespace

CrackMap::CrackMap(const Assembly& assembly, const Snapshot& snapshot, const CrackMapNotes& notes, double threshold,
                   CrackState by)
    : assembly_(assembly), notes_(notes), threshold_(threshold), by_(by) {
  gaps_ = joint_gaps(assembly, snapshot);
  const Measures measures = measure(assembly);
  const std::vector<Intrados> vaults = find_intrados(measures);
  cracks_ = find_cracks(assembly, gaps_, vaults, threshold, by);
  const CrackedAssembly cracked{assembly, cracks_, fallen_blocks(assembly, snapshot)};
  any_fell_ = std::ranges::any_of(cracked.fell, [](bool fell) { return fell; });
  const std::vector<std::int64_t> before = fixed_at_faces(assembly, measures);
  const bool bridge = !vaults.empty();
  stack_.push_back(seen_view(cracked, seen_from_front(), before, "Elevation y−"));
  stack_.push_back(seen_view(cracked, seen_from_above(), {}, "Plan, from above"));
  stack_.push_back(seen_view(cracked, seen_from_behind(), before, "Elevation y+, from behind"));
  for (const Intrados& vault : vaults) across_.push_back(unrolled_view(cracked, vault));
  if (bridge)
    remarks_.push_back("Intrados seen from above: s along it from the left springing, y+ upwards.");
  else
    remarks_.push_back("No intrados: the model has no vaults (stones of the component arch with a span).");
  Content content;
  content.one_scale = true;
  for (const CrackView& view : stack_) content.stack.push_back(size_of(view));
  for (const CrackView& view : across_) content.across.push_back(size_of(view));
  if (!cracks_.empty()) content.notes.push_back(crack_table_size(cracks_));
  content.notes.push_back(crack_title_size({notes_, cracks_, threshold_, by_, by_, any_fell_, remarks_}));
  placement_ = place_on_paper(content);
}

double CrackMap::width() const {
  return kPixelsPerMm * placement_.paper.width;
}
double CrackMap::height() const {
  return kPixelsPerMm * placement_.paper.height;
}
int CrackMap::pixels() const {
  return int(std::lround(placement_.paper.width * placement_.paper.pixels));
}

bool CrackMap::has_changed() const {
  return std::ranges::any_of(cracks_, [&](const Crack& crack) {
    return std::ranges::any_of(crack.joints, [&](std::size_t i) {
      const auto& [ever, now] = gaps_[i];
      return now.width() < threshold_ || width_class(now.width()) != width_class(ever.width()) ||
             now.slides() != ever.slides();
    });
  });
}

bool CrackMap::shown(const CrackTrace& trace, CrackState state) const {
  return gap(trace, state).width() >= threshold_;
}

void CrackMap::draw_traces(DrawingSheet& sheet, const SheetPlace& place, const CrackView& view,
                           CrackState state) const {
  std::map<std::pair<std::size_t, bool>, std::vector<FlatLine>> lines;  // thin ones first
  for (const CrackTrace& trace : view.traces)
    if (shown(trace, state)) {
      const JointGap wide = gap(trace, state);
      lines[{width_class(wide.width()), wide.slides()}].push_back(trace.line);
    }
  for (const auto& [kind, of] : lines) {
    const WidthClass& drawn = width_classes()[kind.first];
    sheet.lines(placed(of, place), drawn.line, drawn.colour, kind.second ? "5 3" : "");
  }
}

/// The number of each of the widest cracks at its longest trace.
void CrackMap::draw_numbers(DrawingSheet& sheet, const SheetPlace& place, const CrackView& view,
                            CrackState state) const {
  std::map<std::size_t, FlatLine> longest;
  const auto length = [](const FlatLine& line) { return (line.second - line.first).norm(); };
  for (const CrackTrace& trace : view.traces) {
    if (trace.crack >= kNumberedCracks || !shown(trace, state)) continue;
    const auto [at, fresh] = longest.try_emplace(trace.crack, trace.line);
    if (!fresh && length(trace.line) > length(at->second)) at->second = trace.line;
  }
  for (const auto& [crack, line] : longest) {
    const Vec3 middle = place.at(0.5 * (line.first + line.second));
    const std::string number = fmt::format("{}", cracks_[crack].number);
    const double half = 0.5 * DrawingSheet::width_of(number) + 0.7;
    for (const auto& [aside, below] : {std::pair{2.6, -1.6},
                                       {-2.6, -1.6},
                                       {2.6, 3.6},
                                       {-2.6, 3.6},
                                       {5.5, -3.5},
                                       {-5.5, -3.5},
                                       {5.5, 5.5},
                                       {-5.5, 5.5},
                                       {0.0, -5.0},
                                       {0.0, 7.0}}) {
      const double x = middle.x() + aside, y = middle.y() + below;
      if (!sheet.try_text(x, y, number)) continue;
      sheet.rectangle({x - half, y - 0.85 * kSmallText, 2.0 * half, 1.1 * kSmallText}, "none", "#1f1f24", 0.13);
      break;
    }
  }
}

void CrackMap::draw_view(DrawingSheet& sheet, const SheetBox& box, const CrackView& view, CrackState state) const {
  const Box content = view.extent();
  const SheetPlace place = place_in(box, size_of(view), content, placement_.scale);
  std::vector<Drawing::Path> fallen;
  for (const Polygon& face : view.fallen) {
    Drawing::Path path;
    for (const Vec3& corner : face) path.emplace_back(place.x(corner.x()), place.y(corner.y()));
    fallen.push_back(std::move(path));
  }
  if (!fallen.empty()) sheet.areas(fallen, "#c8c8cc");
  for (std::size_t k = 0; k < kLineKinds; ++k)
    sheet.lines(placed(view.pattern[k], place), kPatternWidths[k], kPatternInks[k]);
  draw_traces(sheet, place, view, state);
  sheet.title(box, place.x(0.5 * (content.low.x() + content.high.x())), view.title);
  draw_scale(sheet, place, view, place.y(content.low.y()));
  draw_numbers(sheet, place, view, state);
}

void CrackMap::draw(Drawing& drawing, CrackState state) const {
  const PaperSize& paper = placement_.paper;
  DrawingSheet sheet(drawing);
  sheet.rectangle({0.0, 0.0, paper.width, paper.height}, "#ffffff", "none");
  sheet.rectangle({8.0, 8.0, paper.width - 16.0, paper.height - 16.0}, "none", "#1f1f24", 0.5);
  for (std::size_t i = 0; i < stack_.size(); ++i) draw_view(sheet, placement_.stack[i], stack_[i], state);
  for (std::size_t i = 0; i < across_.size(); ++i) draw_view(sheet, placement_.across[i], across_[i], state);
  if (placement_.notes.size() > 1) draw_crack_table(sheet, placement_.notes.front(), cracks_);
  draw_crack_title(sheet, placement_.notes.back(), {notes_, cracks_, threshold_, state, by_, any_fell_, remarks_},
                   placement_);
}

std::string CrackMap::svg(CrackState state) const {
  SvgDrawing drawing(width(), height(), "Crack map of " + notes_.name);
  draw(drawing, state);
  return drawing.finished();
}

}  // namespace voussoir
