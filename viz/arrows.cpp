#include "viz/arrows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/base/constants.h"

namespace voussoir {

namespace {

constexpr double arrow_length = 2.6;  // letters

struct Rectangle {
  Spot low, high;
  bool meets(const Rectangle& o) const {
    return (low.array() < o.high.array()).all() && (o.low.array() < high.array()).all();
  }
};

/// Names that have been placed.
class Names {
 public:
  Names(Overlay& overlay, const Sheet& sheet) : overlay_(overlay), sheet_(sheet) {}
  /// Marks an area that names must not cover.
  void keep_free(const Rectangle& r) { taken_.push_back(r); }
  /// Writes a name near `spot`, starting in the direction `towards` (unit vector) from it.
  void place(const Spot& spot, const Spot& towards, const std::string& name, const Colour& colour) {
    const double s = 0.85 * sheet_.letter, width = Overlay::text_width(name, s) + 0.4 * s, height = 1.25 * s;
    const auto around = [&](const Spot& centre) {
      const Spot half(0.5 * width, 0.5 * height);
      return Rectangle{centre - half, centre + half};
    };
    const Spot first = spot + (0.5 * std::hypot(width * towards.x(), height * towards.y()) + 0.15 * s) * towards;
    Rectangle found = around(first);
    constexpr int rings = 8, angles = 12;
    for (int i = 0; i < rings * angles && !is_free(found); ++i) {
      const int ring = 1 + i / angles;
      const double angle = 2.0 * pi * (i % angles) / angles, away = 0.9 * s * ring;
      found = around(first + away * (Eigen::Rotation2Dd(angle) * towards));
    }
    const Spot centre = 0.5 * (found.low + found.high);
    if ((centre - first).norm() > height) overlay_.line(spot.x(), spot.y(), centre.x(), centre.y(), 0.07 * s, colour);
    overlay_.rectangle(found.low.x(), found.low.y(), width, height, {1, 1, 1});
    overlay_.text(centre.x(), found.low.y() + 0.05 * s, name, s, Align::centre, kInk);
    taken_.push_back(found);
  }

 private:
  bool is_free(const Rectangle& r) const {
    const bool inside = r.low.x() > 0.0 && r.low.y() > 0.0 && r.high.x() < sheet_.width && r.high.y() < sheet_.height;
    return inside && std::none_of(taken_.begin(), taken_.end(), [&](const Rectangle& t) { return r.meets(t); });
  }

  Overlay& overlay_;
  const Sheet& sheet_;
  std::vector<Rectangle> taken_;
};

/// An arrow along the line of sight: its point or its feathers.
void draw_end_on(Overlay& overlay, const Spot& at, bool towards, double s, const Colour& colour) {
  overlay.disc(at.x(), at.y(), 0.65 * s, colour);
  overlay.disc(at.x(), at.y(), 0.48 * s, {1, 1, 1});
  if (towards) return overlay.disc(at.x(), at.y(), 0.18 * s, colour);
  const double r = 0.34 * s;
  overlay.line(at.x() - r, at.y() - r, at.x() + r, at.y() + r, 0.14 * s, colour);
  overlay.line(at.x() - r, at.y() + r, at.x() + r, at.y() - r, 0.14 * s, colour);
}

void draw_key(Overlay& overlay, const Sheet& sheet, const std::vector<Arrow>& arrows) {
  const std::array<std::pair<Vec3, const char*>, 4> keys = {{{Vec3::UnitX(), "longitudinal, x"},
                                                             {Vec3::UnitY(), "transverse, y"},
                                                             {Vec3::UnitZ(), "vertical, z"},
                                                             {Vec3::Ones().normalized(), "slanting"}}};
  const double s = 0.95 * sheet.letter, y = sheet.height - 1.9 * sheet.letter;
  double x = sheet.width - 1.2 * s;
  for (std::size_t i = keys.size(); i-- > 0;) {
    const Colour colour = arrow_colour(keys[i].first);
    if (std::none_of(arrows.begin(), arrows.end(), [&](auto& a) { return arrow_colour(a.direction) == colour; }))
      continue;
    overlay.text(x, y, keys[i].second, s, Align::right);
    x -= Overlay::text_width(keys[i].second, s) + 0.5 * s;
    draw_shaft(overlay, {x - 2.2 * s, y + 0.55 * s}, {1.0, 0.0}, 2.2 * s, 0.9 * s, colour);
    x -= 3.6 * s;
  }
}

}  // namespace

void draw_shaft(Overlay& overlay, const Spot& from, const Spot& along, double length, double s, const Colour& colour) {
  const double head = std::min(0.8 * s, 0.6 * length);  // of a short arrow smaller
  const Spot side(-along.y(), along.x()), neck = from + (length - head) * along, tip = from + length * along;
  const Spot a = neck + 0.44 * head * side, b = neck - 0.44 * head * side;
  overlay.line(from.x(), from.y(), tip.x() - 0.6 * head * along.x(), tip.y() - 0.6 * head * along.y(), 0.38 * s,
               {1, 1, 1});
  overlay.line(from.x(), from.y(), neck.x(), neck.y(), 0.2 * s, colour);
  overlay.polygon({{tip.x(), tip.y()}, {a.x(), a.y()}, {b.x(), b.y()}}, colour);
}

Colour arrow_colour(const Vec3& direction) {
  constexpr double along = 0.999;
  const std::array<Colour, 3> colours = {{{0.0, 0.447, 0.698}, {0.835, 0.369, 0.0}, {0.0, 0.620, 0.451}}};
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(direction[axis]) > along * direction.norm()) return colours[std::size_t(axis)];
  return kInk;
}

double arrow_strip(const Sheet& sheet) {
  return (arrow_length + 1.2) * sheet.letter;
}

void draw_arrows(Overlay& overlay, vtkRenderer* renderer, const Sheet& sheet, const View& view,
                 const std::vector<Arrow>& arrows) {
  constexpr double end_on = 0.1;  // share of the length of an arrow that remains on the sheet
  const Projection seen(renderer->GetActiveCamera(), sheet);
  const double s = sheet.letter, length = arrow_length * s;
  Names names(overlay, sheet);
  names.keep_free({{0.0, sheet.height - top_strip(sheet)}, {double(sheet.width), double(sheet.height)}});
  std::vector<std::pair<Spot, Spot>> tips;  // and directions
  for (const Arrow& a : arrows) {
    const Spot from = seen(a.from);
    const Spot flat(a.direction.dot(view.right), a.direction.dot(view.up));
    if (flat.norm() < end_on) {
      draw_end_on(overlay, from, a.direction.dot(view.forward) < 0.0, s, arrow_colour(a.direction));
      tips.emplace_back(from + Spot(0.0, 0.65 * s), Spot(0.0, 1.0));
      continue;
    }
    Spot along = seen(a.from + 0.1 * a.direction) - from;  // in perspective not that of the view's axes
    along.normalize();
    draw_shaft(overlay, from, along, length, s, arrow_colour(a.direction));
    tips.emplace_back(from + length * along, along);
  }
  for (const auto& [tip, along] : tips) {  // names do not cover arrows' heads
    const Spot half(0.3 * s, 0.3 * s), middle = tip - 0.5 * s * along;
    names.keep_free({middle - half, middle + half});
  }
  for (std::size_t i = 0; i < arrows.size(); ++i)
    names.place(tips[i].first, tips[i].second, arrows[i].name, arrow_colour(arrows[i].direction));
  draw_key(overlay, sheet, arrows);
}

}  // namespace voussoir
