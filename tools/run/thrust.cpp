#include "tools/run/thrust.h"

#include <fmt/format.h>

#include <cmath>

#include "solver/base/error.h"
#include "viz/page/line_chart.h"

namespace voussoir {

RestForces rest_at_end(const Simulation& run) {
  if (!run.collapse().last.empty()) return run.collapse().last;
  const auto ended = std::size_t(run.position().stage);
  if (ended == 0 || run.settings().stages[ended - 1].timed()) return {};
  return forces_at_rest(run.model(), run.state());
}

std::vector<BedJoint> bed_joints_of_state(const Assembly& assembly, const Model& model, const State& state,
                                          StageSettings::Kind stage, const std::string& file) {
  if (stage == StageSettings::Kind::collapse)
    throw InputError(
        "{} was written by a collapse stage. Its stones are falling, so it is not an equilibrium. The last equilibrium "
        "is on the page of the run and in joints.csv. To draw resultants, give stage_*.h5 of the stage before",
        file);
  constexpr double still = 1e-6;  // m/s, velocity below which a state counts as at rest
  const RestForces rest = forces_at_rest(model, state);
  double fastest = 0.0;
  for (const Vec3& v : rest.snapshot.velocity) fastest = std::max(fastest, v.norm());
  if (fastest > still)
    throw InputError(
        "{} is not at rest: its stones move with up to {:.2g} m/s, but resultants need an equilibrium. Give a "
        "checkpoint of a gravity or quasi-static stage (checkpoints/stage_*.h5), or add such a stage at the end of the "
        "case",
        file, fastest);
  std::vector<BedJoint> beds = bed_joints(assembly, rest);
  if (beds.empty()) throw InputError("{} has no vault (stones of the component arch), so it has no resultants", file);
  return beds;
}

namespace {

std::string number_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : std::string();
}

bool same_ring(const BedJoint& a, const BedJoint& b) {
  return a.vault == b.vault && a.ring == b.ring;
}

/// A curve in the plane x-z through a point of each bed joint, interrupted between rings.
template <class Point>
ChartCurve through(const std::vector<BedJoint>& beds, const Point& point) {
  ChartCurve curve;
  for (std::size_t i = 0; i < beds.size(); ++i) {
    if (i > 0 && !same_ring(beds[i - 1], beds[i])) curve.x.push_back(std::nan("")), curve.y.push_back(std::nan(""));
    const Vec3 at = point(beds[i]);
    curve.x.push_back(at.x()), curve.y.push_back(at.z());
  }
  return curve;
}

/// Edges of the rings, and their bed joints.
void add_outline(LineChart& chart, const std::vector<BedJoint>& beds) {
  for (const double side : {-0.5, 0.5}) {
    ChartCurve edge = through(beds, [&](const BedJoint& bed) { return Vec3(bed.centre + side * bed.depth * bed.d); });
    if (side < 0.0) edge.name = "rings, intrados and extrados";
    edge.colour = kFrameColour, edge.width = 1.2;
    chart.curves.push_back(edge);
  }
  for (const BedJoint& bed : beds) {
    const Vec3 half = 0.5 * bed.depth * bed.d, low = bed.centre - half, high = bed.centre + half;
    ChartCurve joint;
    joint.x = {low.x(), high.x()}, joint.y = {low.z(), high.z()};
    joint.colour = kGridColour, joint.width = 1.0;
    chart.curves.push_back(joint);
  }
}

/// Sets the height of the chart so that both axes have the same scale.
void give_one_scale(LineChart& chart, const std::vector<BedJoint>& beds) {
  constexpr double beside = 96.0, above_and_below = 78.0;  // px, space for axes and titles
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
  for (const BedJoint& bed : beds)
    for (const double side : {-0.5, 0.5}) {
      const Vec3 at = bed.centre + side * bed.depth * bed.d;
      const double xz[2] = {at.x(), at.z()};
      for (int c = 0; c < 2; ++c) low[c] = std::min(low[c], xz[c]), high[c] = std::max(high[c], xz[c]);
    }
  const double margin = 0.04 * (high[0] - low[0]);
  chart.x_low = low[0] - margin, chart.x_high = high[0] + margin;
  chart.y_low = low[1] - margin, chart.y_high = high[1] + margin;
  const double scale = (chart.width - beside) / (*chart.x_high - *chart.x_low);
  chart.height = above_and_below + scale * (*chart.y_high - *chart.y_low);
}

}  // namespace

std::string bed_joint_table(const std::vector<BedJoint>& beds) {
  std::string text =
      "vault,ring,joint,x_m,y_m,z_m,normal_N,shear_N,shear_across_N,eccentricity_m,eccentricity_over_depth,"
      "eccentricity_across_m,depth_m,width_m,utilisation,largest_compression_Pa,d_x,d_y,d_z\n";
  for (const BedJoint& b : beds) {
    text += fmt::format("{},{},{}", b.vault, b.ring, b.number);
    for (const double value : {b.centre.x(), b.centre.y(), b.centre.z(), b.normal, b.shear, b.shear_across,
                               b.eccentricity, b.eccentricity / b.depth, b.eccentricity_across, b.depth, b.width,
                               b.utilisation, b.largest_compression, b.d.x(), b.d.y(), b.d.z()})
      text += fmt::format(",{}", number_text(value));
    text += "\n";
  }
  return text;
}

std::vector<BedJoint> bed_joints_from_table(const TextFile& file) {
  const CsvTable table(file,
                       {"vault", "ring", "joint", "x_m", "y_m", "z_m", "normal_N", "shear_N", "shear_across_N",
                        "eccentricity_m", "eccentricity_over_depth", "eccentricity_across_m", "depth_m", "width_m",
                        "utilisation", "largest_compression_Pa"},
                       {"d_x", "d_y", "d_z"});
  std::vector<BedJoint> beds;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto value = [&](const char* column) { return table.number(i, column).value_or(no_number); };
    const auto axis = [&](const char* column) { return table.number(i, column).value_or(0.0); };
    BedJoint b;
    b.vault = std::int32_t(table.required_number(i, "vault")), b.ring = std::int32_t(table.required_number(i, "ring"));
    b.number = std::int32_t(table.required_number(i, "joint"));
    b.centre = {table.required_number(i, "x_m"), table.required_number(i, "y_m"), table.required_number(i, "z_m")};
    b.d = {axis("d_x"), axis("d_y"), axis("d_z")};
    b.depth = table.required_number(i, "depth_m"), b.width = table.required_number(i, "width_m");
    b.normal = value("normal_N"), b.shear = value("shear_N"), b.shear_across = value("shear_across_N");
    b.eccentricity = value("eccentricity_m"), b.eccentricity_across = value("eccentricity_across_m");
    b.utilisation = value("utilisation"), b.largest_compression = value("largest_compression_Pa");
    b.g = Vec3::Zero();  // the components across are not drawn
    beds.push_back(b);
  }
  return beds;
}

std::string thrust_chart(const std::vector<ThrustLine>& lines) {
  if (lines.empty() || lines.front().beds.empty()) return "";
  LineChart chart;
  chart.title = "Lines of thrust";
  chart.x_label = "x, m", chart.y_label = "z, m";
  add_outline(chart, lines.front().beds);
  constexpr const char* dashes[] = {"", "8 3", "2 3"};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    ChartCurve line = through(lines[i].beds, [](const BedJoint& bed) { return bed.thrust(); });
    line.name = lines[i].name;
    line.colour = colour_code(line_colour(i)), line.width = 2.2, line.dashes = dashes[i % 3];
    chart.curves.push_back(line);
  }
  give_one_scale(chart, lines.front().beds);
  return line_chart(chart);
}

}  // namespace voussoir
