#include "viz/resultants_overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viz/arrows.h"
#include "viz/projection.h"

namespace voussoir {

namespace {

constexpr Colour kForce = {0.0, 0.32, 0.55}, kThrust = {0.835, 0.369, 0.0};  // Okabe & Ito (2008)

bool has_thrust(const BedJoint& bed) {
  constexpr double far = 2.0;  // depths from the middle: almost no compression
  return bed.normal > 0.0 && std::abs(bed.eccentricity) < far * bed.depth &&
         std::abs(bed.eccentricity_across) < far * bed.width;
}

/// Along each ring, broken where there is no thrust.
std::vector<std::vector<Spot>> lines_of_thrust(const std::vector<BedJoint>& beds, const Projection& seen) {
  std::vector<std::vector<Spot>> lines;
  const BedJoint* before = nullptr;
  for (const BedJoint& bed : beds) {
    const bool goes_on = before && before->vault == bed.vault && before->ring == bed.ring;
    before = has_thrust(bed) ? &bed : nullptr;
    if (!before) continue;
    if (!goes_on) lines.emplace_back();
    lines.back().push_back(seen(bed.thrust()));
  }
  return lines;
}

/// Distance in pixels between neighbours on the lines: the median.
double usual_distance(const std::vector<std::vector<Spot>>& lines) {
  std::vector<double> distances;
  for (const std::vector<Spot>& line : lines)
    for (std::size_t i = 1; i < line.size(); ++i) distances.push_back((line[i] - line[i - 1]).norm());
  if (distances.empty()) return 0.0;
  std::ranges::nth_element(distances, distances.begin() + std::ptrdiff_t(distances.size() / 2));
  return distances[distances.size() / 2];
}

void draw_lines(Overlay& overlay, const std::vector<std::vector<Spot>>& lines, double s) {
  for (const auto& [width, colour] : {std::pair{0.36 * s, Colour{1, 1, 1}}, {0.18 * s, kThrust}})
    for (const std::vector<Spot>& line : lines)
      for (std::size_t i = 1; i < line.size(); ++i)
        overlay.line(line[i - 1].x(), line[i - 1].y(), line[i].x(), line[i].y(), width, colour);
}

/// On the right above the picture, in a line of its own: the arrow of a round force, and the line.
void draw_resultants_key(Overlay& overlay, const Sheet& sheet, double pixels_per_newton, double largest) {
  const double s = 0.95 * sheet.letter, y = sheet.height - 3.7 * sheet.letter;
  double x = sheet.width - 1.2 * s;
  const auto word = [&](const std::string& words) {
    overlay.text(x, y, words, s, Align::right);
    x -= Overlay::text_width(words, s) + 0.5 * s;
  };
  word("thrust line");
  overlay.line(x - 2.0 * s, y + 0.55 * s, x, y + 0.55 * s, 0.18 * s, kThrust);
  x -= 3.2 * s;
  const double round = nice_below(largest), length = pixels_per_newton * round;
  word(round >= 1e6 ? fmt::format("{:g} MN", 1e-6 * round) : fmt::format("{:g} kN", 1e-3 * round));
  draw_shaft(overlay, {x - length, y + 0.55 * s}, {1.0, 0.0}, length, 0.8 * s, kForce);
}

}  // namespace

double resultants_strip(const Sheet& sheet) {
  return 1.8 * sheet.letter;
}

void draw_resultants(Overlay& overlay, vtkRenderer* renderer, const Sheet& sheet, const View& view,
                     const std::vector<BedJoint>& beds) {
  const Projection seen(renderer->GetActiveCamera(), sheet);
  const double s = sheet.letter;
  const std::vector<std::vector<Spot>> lines = lines_of_thrust(beds, seen);
  double largest = 0.0;
  for (const BedJoint& bed : beds)
    if (has_thrust(bed)) largest = std::max(largest, bed.force().norm());
  if (largest == 0.0) return;
  const double longest = std::clamp(0.9 * usual_distance(lines), 3.5 * s, 7.0 * s);
  const double pixels_per_newton = longest / largest;
  draw_lines(overlay, lines, s);
  const BedJoint* last = nullptr;  // with an arrow
  for (const BedJoint& bed : beds) {
    if (!has_thrust(bed)) continue;
    const Spot at = seen(bed.thrust());
    const bool beside = last && last->vault == bed.vault && last->ring == bed.ring;
    if (beside && (at - seen(last->thrust())).norm() < longest) continue;
    last = &bed;
    const Spot along = pixels_per_newton * Spot(bed.force().dot(view.right), bed.force().dot(view.up));
    const double length = along.norm();
    if (length < 0.3 * s) continue;  // it points at the reader
    draw_shaft(overlay, at - 0.5 * along, along / length, length, 0.8 * s, kForce);
  }
  draw_resultants_key(overlay, sheet, pixels_per_newton, largest);
}

}  // namespace voussoir
