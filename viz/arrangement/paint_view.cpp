#include "viz/arrangement/paint_view.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "viz/arrangement/hidden_lines.h"
#include "viz/page/palette.h"

namespace voussoir {

namespace {

constexpr double kLineWidths[kLineKinds] = {0.1, 0.25, 0.5};  // mm
constexpr const char* kLineInks[kLineKinds] = {"#6b645c", "#2e2a27", "#1f1f24"};
constexpr double kResolution = 0.8;   // mm, resolution of the end of the visible part of a line
constexpr double kGroundHatch = 1.7;  // mm between the lines
constexpr double kFillHatch = 2.4;    // mm, likewise; of what is filled in and cut

enum class Hatch { none, ground, fill };

Hatch hatch_of(Component component, bool fixed) {
  if (fixed) return Hatch::ground;
  return component == Component::backfill || component == Component::infill ? Hatch::fill : Hatch::none;
}

Colour colour_of(const FlatFace& face, bool section) {
  Colour colour = face.fixed ? kFixed : component_colour(face.component);
  if (section && !face.cut)
    for (double& c : colour) c += 0.72 * (1.0 - c);
  return colour;
}

/// The part of a line {p : p·across = offset} within a convex face: from where to where along it.
bool clip(const FlatFace& face, const Vec3& along, const Vec3& across, double offset, double& from, double& to) {
  from = 1e300, to = -1e300;
  for (std::size_t i = 0; i < face.corners.size(); ++i) {
    const Vec3 &a = face.corners[i], &b = face.corners[(i + 1) % face.corners.size()];
    const double da = a.dot(across) - offset, db = b.dot(across) - offset;
    if ((da >= 0.0) == (db >= 0.0)) continue;
    const double at = (a + da / (da - db) * (b - a)).dot(along);
    from = std::min(from, at), to = std::max(to, at);
  }
  return from < to;
}

/// Hatch lines of one kind over the faces that have it; those of neighbouring faces are continuous.
std::vector<FlatLine> hatch(const FlatView& view, const InFront& front, const SheetPlace& place, Hatch kind,
                            bool section) {
  const double spacing = (kind == Hatch::ground ? kGroundHatch : kFillHatch) / place.mm, half = std::sqrt(0.5);
  const double lean = kind == Hatch::ground ? 1.0 : -1.0;
  const Vec3 along(half, lean * half, 0.0), across(-lean * half, half, 0.0);
  std::map<std::int64_t, std::vector<std::pair<double, double>>> parts;
  for (std::size_t f = 0; f < view.faces.size(); ++f) {
    const FlatFace& face = view.faces[f];
    if (hatch_of(face.component, face.fixed) != kind || (section && !face.cut)) continue;
    if (kind == Hatch::fill && !face.cut) continue;
    double low = 1e300, high = -1e300;
    for (const Vec3& p : face.corners) low = std::min(low, p.dot(across)), high = std::max(high, p.dot(across));
    if ((high - low) / spacing > 4000.0) continue;
    for (auto k = std::int64_t(std::ceil(low / spacing)); double(k) * spacing < high; ++k) {
      double from, to;
      const double offset = double(k) * spacing;
      if (!clip(face, along, across, offset, from, to)) continue;
      const FlatLine line = {from * along + offset * across, to * along + offset * across};
      for (const FlatLine& seen : visible_parts(front, f, line, 2.0 * kResolution / place.mm))
        parts[k].emplace_back(seen.first.dot(along), seen.second.dot(along));
    }
  }
  std::vector<FlatLine> lines;
  for (auto& [k, spans] : parts) {
    std::sort(spans.begin(), spans.end());
    const Vec3 foot = double(k) * spacing * across;
    std::pair<double, double> run = spans.front();
    for (const auto& [from, to] : spans) {
      if (from > run.second + 1e-6 * front.size()) {
        lines.emplace_back(foot + run.first * along, foot + run.second * along);
        run = {from, to};
      }
      run.second = std::max(run.second, to);
    }
    lines.emplace_back(foot + run.first * along, foot + run.second * along);
  }
  return lines;
}

std::vector<FlatLine> on_sheet(std::vector<FlatLine> lines, const SheetPlace& place) {
  for (auto& [from, to] : lines) from = place.at(from), to = place.at(to);
  return lines;
}

/// Triangles of one surface would show thin gaps between them, so each is drawn slightly larger.
Drawing::Path outline_on_sheet(const FlatFace& face, const SheetPlace& place) {
  Drawing::Path path;
  const Vec3 middle = place.at(polygon_centroid(face.corners));
  for (const Vec3& corner : face.corners) {
    Vec3 p = place.at(corner);
    if (face.block < 0) p += 0.06 * (p - middle).normalized();
    path.emplace_back(p.x(), p.y());
  }
  return path;
}

}  // namespace

SheetPlace place_in(const SheetBox& box, const ViewSize& size, const Box& content, double scale) {
  SheetPlace place;
  place.mm = 1000.0 / scale;
  place.x0 = box.x + size.left_at(scale) - place.mm * content.low.x();
  place.y0 = box.y + size.above + place.mm * content.high.y();
  return place;
}

void paint_view(DrawingSheet& sheet, const FlatView& view, const SheetPlace& place) {
  if (view.faces.empty()) return;
  const InFront front(view);
  const bool section = std::ranges::any_of(view.faces, [](const FlatFace& f) { return f.cut; });
  std::map<std::string, int> numbers;
  std::vector<int> colour;
  std::vector<std::string> codes;
  for (const FlatFace& face : view.faces) {
    const auto [entry, fresh] = numbers.try_emplace(colour_code(colour_of(face, section)), int(numbers.size()));
    if (fresh) codes.push_back(entry->first);
    colour.push_back(entry->second);
  }
  std::vector<Drawing::Path> run;
  int now = -1;
  const auto finish = [&] {
    if (!run.empty()) sheet.areas(run, codes[std::size_t(now)]);
    run.clear();
  };
  for (const std::size_t f : painting_order(view, front, colour)) {
    if (colour[f] != now) finish(), now = colour[f];
    run.push_back(outline_on_sheet(view.faces[f], place));
  }
  finish();
  sheet.lines(on_sheet(hatch(view, front, place, Hatch::fill, section), place), 0.13, "#736650");
  sheet.lines(on_sheet(hatch(view, front, place, Hatch::ground, section), place), 0.13, "#55555a");
  const auto lines = visible_lines(view, front, kResolution / place.mm);
  for (std::size_t k = 0; k < kLineKinds; ++k) sheet.lines(on_sheet(lines[k], place), kLineWidths[k], kLineInks[k]);
}

void paint_patch(DrawingSheet& sheet, const SheetBox& box, Component component, bool fixed) {
  FlatFace face;
  face.component = component, face.fixed = fixed, face.cut = true;
  face.corners = {{box.x, -box.y - box.height, 0.0},
                  {box.x + box.width, -box.y - box.height, 0.0},
                  {box.x + box.width, -box.y, 0.0},
                  {box.x, -box.y, 0.0}};
  paint_view(sheet, {seen_from_front(), {face}}, SheetPlace{});
}

}  // namespace voussoir
