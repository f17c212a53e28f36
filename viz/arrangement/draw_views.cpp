// The views of a general arrangement drawing with their dimensions: elevation, section along the middle, plan, cross
// sections.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "solver/base/constants.h"
#include "viz/arrangement/arrangement_parts.h"
#include "viz/arrangement/notes.h"

namespace voussoir {

namespace {

constexpr double kViewTitle = 7.0;  // mm, above a view
constexpr double kMark = 7.0;       // mm, of the mark of a section

/// Points of a chain of dimensions: known positions in order and apart, with the texts between them.
struct Chain {
  std::vector<ChainStop> stops;
  std::vector<std::string> texts;

  /// `text` is between the previous point and this one. Zero lengths are left out.
  void add(double at, double from, const std::string& text = "") {
    if (!std::isfinite(at)) return;
    if (!stops.empty() && std::abs(stops.back().at - at) < 0.02) return;
    if (!stops.empty()) texts.push_back(text);
    stops.push_back({at, from});
  }
};

/// The levels of a vertical chain, from the lowest, with the lengths between them.
void chain_of_levels(DrawingSheet& sheet, const SheetPlace& place, double x, double from,
                     const std::vector<double>& levels, bool outside_left) {
  Chain chain;
  double before = kNotKnown;
  for (const double level : levels) {
    if (!std::isfinite(level)) continue;
    if (std::isfinite(before) && level < before + 1e-6) continue;
    chain.add(place.y(level), from, length_text(level - before));
    before = level;
  }
  sheet.chain_along_y(x, chain.stops, chain.texts, outside_left);
}

/// The same along a horizontal line.
void chain_of_places(DrawingSheet& sheet, const SheetPlace& place, double y, double from,
                     const std::vector<double>& places) {
  Chain chain;
  double before = kNotKnown;
  for (const double u : places) {
    if (!std::isfinite(u)) continue;
    if (std::isfinite(before) && u < before + 1e-6) continue;
    chain.add(place.x(u), from, length_text(u - before));
    before = u;
  }
  sheet.chain_along_x(y, chain.stops, chain.texts);
}

/// The convex outline of points (u, v), counter-clockwise (Andrew 1979).
Polygon convex_outline(Polygon points) {
  std::ranges::sort(points, {}, [](const Vec3& p) { return std::pair(p.x(), p.y()); });
  const auto turn = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  };
  Polygon outline;
  for (const bool back : {false, true}) {
    const std::size_t first = outline.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3& p = points[back ? points.size() - 1 - i : i];
      while (outline.size() >= first + 2 && turn(outline[outline.size() - 2], outline.back(), p) <= 1e-9)
        outline.pop_back();
      outline.push_back(p);
    }
    if (!outline.empty()) outline.pop_back();
  }
  return outline;
}

ViewSize size_of(const FlatView& view, double left, double right, double above, double below) {
  const Box box = extent_of(view.faces);
  return {box.high.x() - box.low.x(), box.high.y() - box.low.y(), left, right, above, below};
}

}  // namespace

ViewSize elevation_size(const FlatView& view) {
  return size_of(view, 24.0, 24.0, kViewTitle + kMark + 3.0, 2.0 * kDimensionRow + 7.0);
}
ViewSize lengthwise_size(const FlatView& view) {
  return size_of(view, 6.0, 26.0, kViewTitle + 4.5, 3.0);
}
ViewSize plan_size(const FlatView& view) {
  return size_of(view, 6.0, 24.0, kViewTitle + kMark + 3.0, 6.0);
}
std::string section_title(char letter, const std::string& of) {
  return fmt::format("{0}–{0} {1}", letter, of);
}
ViewSize section_size(const FlatView& view, const std::string& title) {
  ViewSize size = size_of(view, 7.0, 17.0, kViewTitle + kDimensionRow + 4.0, 2.0 * kDimensionRow + 6.0);
  size.title = DrawingSheet::width_of(title, kHeadText) + 4.0;
  return size;
}

/// Spans, piers and ends below the elevation; rises, rings and heights of piers in the openings.
void ArrangementParts::draw_spans(DrawingSheet& sheet, const SheetPlace& place) const {
  for (std::size_t i = 0; i < m.spans.size(); ++i) {
    const MeasuredSpan& s = m.spans[i];
    sheet.line(place.x(s.left.x()), place.y(s.left.y()), place.x(s.right.x()), place.y(s.right.y()), 0.13, "9 3 2 3");
    const double share = (s.crown.x() - s.left.x()) / s.clear();
    const double chord = place.y(s.left.y() + share * (s.right.y() - s.left.y()));
    const double x = place.x(s.crown.x()), y = place.y(s.crown.y());
    const std::string rise = "rise " + length_text(s.rise);
    if (chord - y > 5.0) {
      const bool inside = chord - y > DrawingSheet::width_of(rise) + 1.0;
      sheet.chain_along_y(x, {{chord, x}, {y, x}}, {inside ? rise : ""}, true);
      if (!inside) sheet.try_text(x, chord + 0.5 + kSmallText, rise);
    }
    if (!std::isfinite(s.crown_thickness)) continue;
    const std::string ring = "ring " + length_text(s.crown_thickness);
    const double text_x = x + 3.0, text_end = text_x + DrawingSheet::width_of(ring) + 1.0;
    double text_y = y + 2.0 + kSmallText;  // below the intrados over its whole length
    for (std::size_t k = 0; k + 1 < s.intrados.size(); ++k) {
      const Vec3 &a = s.intrados[k], &b = s.intrados[k + 1];
      if (place.x(b.x()) > text_x && place.x(a.x()) < text_end)
        text_y = std::max(text_y, place.y(std::min(a.y(), b.y())) + 1.0 + kSmallText);
    }
    if (text_end < place.x(s.right.x()) && text_y < chord - 1.0 &&
        sheet.try_text(text_x, text_y, ring, DrawingSheet::Align::start)) {
      const double ring_y = place.y(s.crown.y() + 0.5 * s.crown_thickness);
      sheet.arrow(text_x + 0.6, text_y - 0.9 * kSmallText, x + 1.2, ring_y, 0.13);
    }
  }
  for (std::size_t i = 1; i + 1 < m.supports.size(); ++i) {
    const MeasuredSupport& p = m.supports[i];
    const double x = place.x(p.base_x1) + 3.6;
    if (place.x(m.spans[i].right.x()) - x < 8.0) continue;
    sheet.chain_along_y(x, {{place.y(p.base), place.x(p.base_x1)}, {place.y(p.springing), place.x(p.x1)}},
                        {length_text(p.height())}, false);
  }
}

/// Heights at both ends of the elevation: from the base to the springing, the deck and the top; beyond, the whole.
void ArrangementParts::draw_heights(DrawingSheet& sheet, const SheetPlace& place, double left, double right) const {
  const double near_left = left - 5.0, near_right = right + 5.0;
  const double top = m.moving.high.z(), low = m.lowest_base();
  if (m.supports.empty()) {
    chain_of_levels(sheet, place, near_left, left, {m.moving.low.z(), top}, true);
    return;
  }
  const double inset = 1e-3 * (m.ends.second - m.ends.first);
  const auto levels = [&](const MeasuredSupport& s, double x, double end) {
    return std::vector<double>{s.base, s.springing, deck_at(x), parapet_at(end)};
  };
  const std::vector<double> first = levels(m.supports.front(), m.ends.first + inset, m.moving.low.x());
  const std::vector<double> last = levels(m.supports.back(), m.ends.second - inset, m.moving.high.x());
  chain_of_levels(sheet, place, near_left, left, first, true);
  chain_of_levels(sheet, place, near_right, right, last, false);
  // Deck over the lowest base on the left, the top over it on the right.
  if (const double deck = deck_at(m.ends.first + inset); deck > low)
    sheet.chain_along_y(near_left - kDimensionRow - 2.0,
                        {{place.y(low), near_left + 1.5}, {place.y(deck), near_left + 1.5}},
                        {"deck " + length_text(deck - low)}, true);
  sheet.chain_along_y(near_right + kDimensionRow + 2.0,
                      {{place.y(low), near_right - 1.5}, {place.y(top), near_right - 1.5}},
                      {"overall " + length_text(top - low)}, false);
}

void ArrangementParts::draw_section_marks(DrawingSheet& sheet, const SheetPlace& place, double top) const {
  for (const SectionAt& s : sections) {
    const double x = place.x(s.x);
    sheet.line(x, top - 1.0, x, top - kMark + 1.0, 0.5);
    sheet.arrow(x, top - kMark + 1.0, x + 5.0, top - kMark + 1.0, 0.3);
    sheet.text(x - 1.0, top - kMark + 2.4, std::string(1, s.letter), kPlainText, DrawingSheet::Align::end, true);
  }
}

void ArrangementParts::draw_elevation(DrawingSheet& sheet, const SheetBox& box) const {
  const Box content = extent_of(elevation.faces);
  const SheetPlace place = place_in(box, elevation_size(elevation), content, placement.scale);
  paint_view(sheet, elevation, place);
  sheet.title(box, place.x(0.5 * (content.low.x() + content.high.x())), "Elevation");
  draw_section_marks(sheet, place, place.y(content.high.y()));
  const double left = place.x(content.low.x()), right = place.x(content.high.x());
  const double foot = place.y(content.low.y());
  std::vector<double> places;
  if (!m.supports.empty()) places.push_back(m.ends.first);
  for (const MeasuredSpan& s : m.spans) places.push_back(s.left.x()), places.push_back(s.right.x());
  if (!m.supports.empty()) places.push_back(m.ends.second);
  chain_of_places(sheet, place, foot + 5.5, foot, places);
  const double whole = m.spans.empty() ? foot + 5.5 : foot + 5.5 + kDimensionRow + 1.5;
  chain_of_places(sheet, place, whole, foot, {m.moving.low.x(), m.moving.high.x()});
  draw_heights(sheet, place, left, right);
  draw_spans(sheet, place);
  // The slope of the deck, from end to end.
  const double inset = 1e-3 * (m.ends.second - m.ends.first);
  const double x0 = m.ends.first + inset, x1 = m.ends.second - inset;
  const double rise = deck_at(x1) - deck_at(x0);
  if (bridges_over() && std::abs(rise) > 1e-3 * (x1 - x0)) {
    const double y = place.y(content.high.y()) - 3.0, down = rise > 0.0 ? -1.0 : 1.0;
    double middle = 0.5 * (left + right);
    for (const double share : {0.5, 0.6, 0.4, 0.7, 0.3, 0.8, 0.2}) {  // away from the marks of the sections
      middle = left + share * (right - left);
      if (std::ranges::all_of(sections,
                              [&](const SectionAt& s) { return std::abs(place.x(s.x) + 1.0 - middle) > 13.0; }))
        break;
    }
    sheet.arrow(middle - 7.0 * down, y, middle + 7.0 * down, y);
    sheet.try_text(middle, y - 0.8, fmt::format("{:.2g} %", 100.0 * std::abs(rise) / (x1 - x0)));
  }
}

/// The section along the middle: fill and backing, which the elevation hides.
void ArrangementParts::draw_lengthwise(DrawingSheet& sheet, const SheetBox& box) const {
  const Box content = extent_of(lengthwise.faces);
  const SheetPlace place = place_in(box, lengthwise_size(lengthwise), content, placement.scale);
  paint_view(sheet, lengthwise, place);
  sheet.title(box, place.x(0.5 * (content.low.x() + content.high.x())), "Section along the middle");
  for (const MeasuredSpan& s : m.spans) {
    if (!(s.deck > s.extrados + 1e-6)) continue;
    const double x = place.x(s.crown.x()), y = place.y(s.deck);
    sheet.chain_along_y(x, {{place.y(s.extrados), x}, {y, x}}, {""}, true);
    const std::string fill = "fill " + length_text(s.deck - s.extrados);
    sheet.try_text(x + 2.0, y - 1.2, fill, DrawingSheet::Align::start);
  }
  const auto backing = extent_of(along, Component::backing);
  if (backing) {
    double low = 1e300;
    for (const MeasuredSpan& s : m.spans) low = std::min({low, s.left.y(), s.right.y()});
    const double right = place.x(content.high.x()), top = backing->high.y();
    sheet.chain_along_y(right + 5.0, {{place.y(low), right}, {place.y(top), right}}, {length_text(top - low)}, false);
    sheet.try_text(right + 6.5, place.y(low) + kSmallText, "backing over the", DrawingSheet::Align::start);
    sheet.try_text(right + 6.5, place.y(low) + 2.1 * kSmallText, "lowest springing", DrawingSheet::Align::start);
  }
}

/// Piers and abutments where they end at the springing, as what lies below.
void ArrangementParts::draw_supports_below(DrawingSheet& sheet, const SheetPlace& place) const {
  std::map<double, std::vector<FlatFace>> levels;
  for (const MeasuredSupport& s : m.supports)
    if (!levels.contains(s.springing))
      levels[s.springing] = cut_faces(assembly, seen_from_above(), 0.01 * s.height() - s.springing);
  // Without walls that extend beyond the ends, which nothing hides.
  const auto under_deck = [&](const FlatFace& face, const MeasuredSupport& s) {
    const Vec3 middle = polygon_centroid(face.corners);
    const double x = middle.x() - (middle.y() - m.middle) * std::tan(m.skew);
    return x > s.x0 - 1e-6 && x < s.x1 + 1e-6;
  };
  for (const MeasuredSupport& s : m.supports) {
    // The support: the stones above its base in the section along the middle.
    const auto own = std::ranges::find_if(along, [&](const FlatFace& face) {
      const Vec3 middle = polygon_centroid(face.corners);
      return (face.component == Component::pier || face.component == Component::abutment) && !face.fixed &&
             middle.x() > s.x0 && middle.x() < s.x1 && middle.y() < s.springing;
    });
    if (own == along.end()) continue;
    Polygon points;
    for (const FlatFace& face : levels[s.springing])
      if (face.component == own->component && face.part == own->part && under_deck(face, s))
        points.insert(points.end(), face.corners.begin(), face.corners.end());
    const Polygon outline = convex_outline(points);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec3 a = place.at(outline[i]), b = place.at(outline[(i + 1) % outline.size()]);
      sheet.line(a.x(), a.y(), b.x(), b.y(), 0.25, "6 3");
    }
  }
}

void ArrangementParts::draw_plan(DrawingSheet& sheet, const SheetBox& box) const {
  const Box content = extent_of(plan.faces);
  const SheetPlace place = place_in(box, plan_size(plan), content, placement.scale);
  paint_view(sheet, plan, place);
  sheet.title(box, place.x(0.5 * (content.low.x() + content.high.x())), "Plan");
  draw_section_marks(sheet, place, place.y(content.high.y()));
  if (bridges_over()) draw_supports_below(sheet, place);
  const double right = place.x(content.high.x());
  const std::vector<FlatFace>& across = sections.front().pieces;
  const auto first = extent_of(across, Component::parapet, 0), second = extent_of(across, Component::parapet, 1);
  double low = m.moving.low.y(), high = m.moving.high.y();
  if (!m.spans.empty()) {  // lower parts that extend farther, such as battered piers, are in their own sections
    Box there;
    for (const FlatFace& face : across)
      if (!face.fixed) {
        const Box own = bounding_box(face.corners);
        there.low = there.low.cwiseMin(own.low), there.high = there.high.cwiseMax(own.high);
      }
    if (there.low.x() < there.high.x()) low = -there.high.x(), high = -there.low.x();
  }
  // u of a cross section is −y.
  if (first && second) {
    const double lower = -first->low.x(), upper = -second->high.x();
    const double outer_low = -first->high.x(), outer_high = -second->low.x();
    chain_of_levels(sheet, place, right + 5.0, right, {outer_low, lower, upper, outer_high}, false);
    chain_of_levels(sheet, place, right + 5.0 + kDimensionRow + 2.0, right, {outer_low, outer_high}, false);
  } else {
    chain_of_levels(sheet, place, right + 5.0, right, {low, high}, false);
  }
  if (m.spans.empty() || std::abs(m.skew) < 0.002) return;
  // Skew: the angle between the springing line and the transverse direction.
  const MeasuredSpan& s = m.spans.front();
  const double x = place.x(s.left.x()), y = place.y(m.middle), half = 0.5 * place.mm * (high - low);
  sheet.line(x, y - half, x, y + half, 0.2, "9 3 2 3");
  sheet.line(x - half * std::tan(m.skew), y + half, x + half * std::tan(m.skew), y - half, 0.2);
  const double radius = 0.8 * half;
  double before_x = x, before_y = y - radius;
  for (int k = 1; k <= 12; ++k) {
    const double angle = m.skew * k / 12.0, to_x = x + radius * std::sin(angle), to_y = y - radius * std::cos(angle);
    sheet.line(before_x, before_y, to_x, to_y, 0.18);
    before_x = to_x, before_y = to_y;
  }
  const std::string words = fmt::format("skew {:.3g}°", std::abs(m.skew) * 180.0 / pi);
  sheet.try_text(m.skew > 0.0 ? before_x + 1.0 : before_x - 1.0, before_y + 1.0, words,
                 m.skew > 0.0 ? DrawingSheet::Align::start : DrawingSheet::Align::end);
}

void ArrangementParts::draw_section(DrawingSheet& sheet, const SheetBox& box, const SectionAt& section) const {
  const Box content = extent_of(section.view.faces);
  const std::string title = section_title(section.letter, section.of);
  const SheetPlace place = place_in(box, section_size(section.view, title), content, placement.across_scale);
  paint_view(sheet, section.view, place);
  sheet.title(box, place.x(0.5 * (content.low.x() + content.high.x())), title);
  const double right = place.x(content.high.x());
  const double top = place.y(content.high.y()), foot = place.y(content.low.y());
  const auto& pieces = section.pieces;
  Box moving;
  for (const FlatFace& piece : pieces)
    if (!piece.fixed) {
      const Box own = bounding_box(piece.corners);
      moving.low = moving.low.cwiseMin(own.low), moving.high = moving.high.cwiseMax(own.high);
    }
  if (moving.low.x() > moving.high.x()) return;
  // Widths: between the parapets, and out to out.
  const auto parapet = [&](int part) { return extent_of(pieces, Component::parapet, part); };
  const auto spandrel = [&](int part) { return extent_of(pieces, Component::spandrel, part); };
  if (parapet(0) && parapet(1)) {  // part 0 is at y−, on the right
    chain_of_places(sheet, place, top - 5.0, top,
                    {parapet(1)->low.x(), parapet(1)->high.x(), parapet(0)->low.x(), parapet(0)->high.x()});
  }
  // Below: spandrel walls at their lowest course there, and the width of the whole section.
  if (spandrel(0) && spandrel(1)) {
    chain_of_places(sheet, place, foot + 5.5, foot,
                    {spandrel(1)->low.x(), spandrel(1)->high.x(), spandrel(0)->low.x(), spandrel(0)->high.x()});
  }
  const bool second_row = spandrel(0) && spandrel(1);
  chain_of_places(sheet, place, foot + 5.5 + (second_row ? kDimensionRow + 1.5 : 0.0), foot,
                  {moving.low.x(), moving.high.x()});
  // Heights.
  const double deck = m.spans.empty() ? kNotKnown : top_over(pieces, 0.5 * (moving.low.x() + moving.high.x()));
  const double crest = parapet(0) ? parapet(0)->high.y() : kNotKnown;
  if (section.span) {
    const MeasuredSpan& s = *section.span;
    const double over = s.deck > s.extrados + 1e-6 ? s.deck : kNotKnown;
    chain_of_levels(sheet, place, right + 5.0, right, {s.crown.y(), s.extrados, over, crest}, false);
  } else if (section.support) {
    const auto backing = extent_of(pieces, Component::backing);
    const double backed = backing ? backing->high.y() : kNotKnown;
    chain_of_levels(sheet, place, right + 5.0, right,
                    {section.support->base, section.support->springing, backed, deck, crest}, false);
  } else {
    chain_of_levels(sheet, place, right + 5.0, right, {moving.low.y(), moving.high.y()}, false);
  }
}

}  // namespace voussoir
