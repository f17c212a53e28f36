// The pictures that every finished run draws.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "solver/base/atomic_file.h"
#include "tools/run/history_rows.h"
#include "tools/run/numbered_hinges.h"
#include "tools/run/plot_chart.h"
#include "tools/run/run_session.h"
#include "tools/run/steps_report.h"
#include "viz/arrangement/arrangement.h"
#include "viz/chart_picture.h"
#include "viz/crack_map/crack_files.h"
#include "viz/render.h"

namespace voussoir {

namespace {

void draw_state(const std::string& images, const Assembly& assembly, const Snapshot& snapshot) {
  RenderOptions o;
  for (const char* view : {"oblique", "front"}) {
    o.view = view;
    for (const char* colour : {"opening", "slip"}) {
      o.colour = colour;
      render_picture(assembly, snapshot, o, fmt::format("{}/{}_{}.png", images, colour, view));
    }
  }
}

/// Pictures of a deformable fill (plastic strain, yielded zones) in the section along the middle of the bridge.
void draw_fill(const std::string& images, const Assembly& assembly, const Snapshot& snapshot) {
  RenderOptions o;
  o.cut = std::string("y");
  for (const char* colour : {"plastic", "yield"}) {
    o.colour = colour;
    o.hide = usually_hidden(colour);
    for (const char* view : {"oblique", "front"}) {
      o.view = view;
      render_picture(assembly, snapshot, o, fmt::format("{}/{}_{}.png", images, colour, view));
    }
  }
}

/// The position in a picture of a point of a block, given by its coordinates as built.
Vec3 drawn_at(const Assembly& assembly, const Snapshot& snapshot, std::int64_t block, const Vec3& x,
              double amplification) {
  const auto i = std::size_t(block);
  const Vec3& centroid = assembly.blocks[i].centroid;
  const Vec3 now =
      centroid + snapshot.displacement[i] + snapshot.rotation[i] * (x - centroid) - snapshot.base_displacement;
  return x + amplification * (now - x);
}

/// The mechanism of collapse. Displacements are enlarged to a third of a block. With a deformable fill it is drawn in
/// the section along the middle.
void draw_mechanism(const std::string& images, const Simulation& run, const Snapshot& snapshot) {
  const Model& model = run.model();
  const double moved = largest_displacement(model, initial_state(model).pose, run.state().pose);
  const StageSettings& stage = run.settings().stages.back();
  RenderOptions o;
  o.view = "front";
  o.colour = "displacement";
  o.amplification = std::max(1.0, std::round(model.typical_size / 3.0 / moved));
  o.crack_mm = 30.0 * stage.collapse.displacement * model.typical_size;
  o.undeformed = true;
  o.hide = {};
  if (!model.fill.empty()) o.cut = std::string("y");  // soil between walls of plane strain, or behind spandrels
  const std::vector<NumberedHinge> all = numbered_hinges(run.assembly(), run.collapse().mechanism, model.typical_size);
  constexpr std::size_t most_numbers = 12;  // more would cover each other
  const std::vector<NumberedHinge> largest = largest_hinges(all, most_numbers);
  for (const NumberedHinge& hinge : largest)
    o.marks.push_back(
        {drawn_at(run.assembly(), snapshot, hinge.a, hinge.place, o.amplification), std::to_string(hinge.number)});
  o.title = fmt::format("Beyond multiplier {:.4g}", run.collapse().multiplier);
  if (largest.size() < all.size())
    o.title += fmt::format("; the {} of {} joints that move most are numbered", largest.size(), all.size());
  render_picture(run.assembly(), snapshot, o, images + "/mechanism_front.png");
}

/// The outlines of the stones as built, and their displacements, scaled so that the largest is three quarters of a
/// block.
void draw_way(const std::string& file, const Simulation& run, const Snapshot& snapshot) {
  const Model& model = run.model();
  const double moved = largest_displacement(model, initial_state(model).pose, run.state().pose);
  const double shown = 0.75 * model.typical_size / std::max(moved, 1e-12);
  RenderOptions o;
  o.colour = "displacement";
  const double digit = std::pow(10.0, std::floor(std::log10(shown)) - 1.0);  // the second one
  o.amplification = std::min(std::round(shown / digit) * digit, 1e4);
  o.undeformed = true;
  o.cracks = false;
  o.title = "Moving stones:";
  for (const std::int32_t body : run.moving())
    o.title +=
        fmt::format("{} {}", body == run.moving().front() ? " blocks" : ",", model.block_of_body[std::size_t(body)]);
  render_picture(run.assembly(), snapshot, o, file);
}

/// The crack map and the table of cracks, if there are cracks.
void draw_cracks(const std::string& directory, const Assembly& assembly, const Snapshot& snapshot) {
  const std::string name = std::filesystem::weakly_canonical(directory).filename().string();
  const std::vector<JointGaps> gaps = joint_gaps(assembly, snapshot);
  if (std::ranges::none_of(gaps, [](const JointGaps& g) { return g.ever.width() >= kCrackThreshold; })) return;
  const CrackMap map(assembly, snapshot, {name, fmt::format("state at {:.3f} s", snapshot.time)});
  if (map.cracks().empty()) return;
  std::vector<CrackState> states = {CrackState::ever};
  if (map.has_changed()) states.push_back(CrackState::now);
  write_crack_map(map, states, {"svg", "pdf"}, directory + "/images/crack_map");
  write_atomically(directory + "/cracks.csv", crack_table(map.cracks()));
}

/// The size of all charts of a run.
LineChart run_chart(const std::string& title, const std::string& x_label, const std::string& y_label) {
  return {.title = title, .x_label = x_label, .y_label = y_label, .width = 900.0, .height = 540.0};
}

void add_curve(LineChart& chart, const std::string& name, std::vector<double> x, std::vector<double> y) {
  chart.curves.push_back({.name = name, .x = std::move(x), .y = std::move(y)});
}

void write_run_chart(LineChart chart, const std::string& png) {
  number_curves(chart);
  write_picture(chart, png);
}

/// Equilibria on the way to the collapse load.
void draw_curve(const std::string& images, const Collapse& collapse) {
  std::vector<double> along, largest, multiplier;
  for (const CollapsePoint& p : collapse.curve) {
    along.push_back(1e3 * p.along), largest.push_back(1e3 * p.largest);
    multiplier.push_back(p.multiplier);
  }
  LineChart chart = run_chart("Load and displacement", "Displacement since the multiplier was zero, mm", "Multiplier");
  add_curve(chart, "loaded points, along the load", along, multiplier);
  add_curve(chart, "largest of any block", largest, multiplier);
  for (ChartCurve& c : chart.curves) c.dots = true;
  write_run_chart(chart, images + "/collapse_curve.png");
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& v : values) v *= factor;
  return values;
}

void draw_charts(const std::string& images, const Assembly& assembly, const History& history) {
  if (history.rows() < 2 || history.time().back() <= history.time().front()) return;
  const auto add = [&](LineChart& chart, const std::string& name, const std::string& path, double factor) {
    add_curve(chart, name, history.time(), scaled(history.values(path), factor));
  };
  LineChart energies = run_chart("Energy", "Time, s", "Energy, kJ");
  for (const char* name : {"kinetic", "elastic", "friction", "fracture", "joint_damping", "external_work"})
    add(energies, name, std::string("energy/") + name, 1e-3);
  write_run_chart(energies, images + "/energy.png");
  LineChart keystones = run_chart("Keystones", "Time, s", "Longitudinal displacement relative to the base, mm");
  LineChart spandrels = run_chart("Spandrel walls", "Time, s", "Transverse displacement relative to the base, mm");
  for (const DemandPoint& point : demand_points(assembly))
    add(point.axis == 0 ? keystones : spandrels, point.group, demand_channel(point), 1e3);
  if (!keystones.curves.empty()) write_run_chart(keystones, images + "/keystones.png");
  if (!spandrels.curves.empty()) write_run_chart(spandrels, images + "/spandrels.png");
}

/// Of quasi-static stages.
void draw_steps(const std::string& images, const Case& c, const History& history) {
  const std::vector<StageSettings>& stages = c.settings.stages;
  for (auto& [chart, name] :
       {std::pair{capacity_chart(stages, history), "capacity"}, std::pair{deck_chart(stages, history), "deck"}})
    if (!chart.curves.empty()) {
      LineChart sized = chart;
      sized.width = run_chart("", "", "").width, sized.height = run_chart("", "", "").height;
      write_run_chart(sized, fmt::format("{}/{}.png", images, name));
    }
}

void draw_plot(const std::string& images, const PlotSpec& plot, const History& history) {
  if (history.rows() < 2) return;
  LineChart chart = plot_chart(plot, history);
  chart.width = run_chart("", "", "").width, chart.height = run_chart("", "", "").height;
  write_run_chart(chart, fmt::format("{}/{}.png", images, plot.name));
}

/// The drawing that the page of the run holds.
void draw_arrangement(const std::string& images, const Case& c, const Assembly& assembly) {
  const std::string name = std::filesystem::path(images).parent_path().filename().string();
  const Arrangement drawing(assembly,
                            {name, c.generator.empty() ? "assembly from a file" : "generator " + c.generator});
  write_atomically(images + "/arrangement.svg", drawing.svg());
}

}  // namespace

std::string make_pictures(const std::string& directory, const Case& c, const Simulation& run, const Snapshot& snapshot,
                          const History& history) {
  const std::string images = directory + "/images";
  try {
    draw_cracks(directory, run.assembly(), snapshot);
    draw_state(images, run.assembly(), snapshot);
    if (!snapshot.fill.empty()) draw_fill(images, run.assembly(), snapshot);
    if (run.collapse().found) draw_mechanism(images, run, snapshot);
    if (run.collapse().curve.size() > 1) draw_curve(images, run.collapse());
    draw_charts(images, run.assembly(), history);
    draw_steps(images, c, history);
    for (const PlotSpec& plot : c.plots) draw_plot(images, plot, history);
    draw_arrangement(images, c, run.assembly());
    return {};
  } catch (const std::exception& e) {  // an error in the pictures must not end the run
    return e.what();
  }
}

std::string draw_moving(const std::string& directory, const Simulation& run, const Snapshot& snapshot) {
  try {
    draw_way(directory + "/images/moving.png", run, snapshot);
    return {};
  } catch (const std::exception& e) {
    return e.what();
  }
}

}  // namespace voussoir
