#include "tools/run/run_page.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/case/case.h"
#include "io/hdf5/history_file.h"
#include "solver/base/atomic_file.h"
#include "solver/base/constants.h"
#include "solver/base/error.h"
#include "solver/base/json_file.h"
#include "solver/motion/intensity.h"
#include "tools/run/crack_section.h"
#include "tools/run/damage_words.h"
#include "tools/run/gravity_report.h"
#include "tools/run/steps_report.h"
#include "viz/page/html.h"
#include "viz/page/line_chart.h"
#include "viz/page/palette.h"
#include "viz/page/svg.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

struct RunFiles {
  std::string directory, name;
  Case c;
  nlohmann::json summary;
  History history;
};

RunFiles run_files(const std::string& directory) {
  std::error_code ignored;
  if (!fs::exists(directory + "/case.toml", ignored))
    throw InputError("{} is no run directory: it has no case.toml; give the folder that voussoir run wrote", directory);
  if (!fs::exists(directory + "/summary.json", ignored))
    throw InputError("{} has no summary.json: the run has not ended; go on with: voussoir resume {}", directory,
                     directory);
  RunFiles files;
  files.directory = directory;
  files.name = fs::weakly_canonical(directory).filename().string();
  files.c = read_case(directory + "/case.toml");
  files.summary = json_if_any(directory + "/summary.json");
  if (!files.summary.is_object()) throw InputError("{}/summary.json is damaged: run the case again", directory);
  if (fs::exists(directory + "/history.h5", ignored)) files.history = History::load(directory + "/history.h5");
  return files;
}

std::string row_of(const std::string& what, const std::string& value) {
  return fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(what), escaped(value));
}

std::string stages_text(const Case& c) {
  std::string text;
  for (const StageSettings& stage : c.settings.stages)
    text += (text.empty() ? "" : "; ") + stage.label +
            (stage.timed() ? fmt::format(", {:g} s", stage.duration) : std::string());
  return text;
}

/// The joints with the widest opening, in a sentence.
std::string verdict(const RunFiles& run) {
  const nlohmann::json damage = run.summary.value("damage", nlohmann::json::object());
  std::string worst;
  double most = -1.0;
  for (const auto& [name, entry] : damage.items())
    if (const double opening = entry.value("largest_opening", 0.0); opening > most) most = opening, worst = name;
  std::string text;
  if (run.summary.contains("fallen"))
    text =
        fmt::format("<p><strong>The bridge fell</strong> at {:.2f} s.</p>\n", run.summary["fallen"].value("time", NAN));
  if (run.summary.contains("collapse"))
    text += fmt::format("<p><strong>Collapse load.</strong> {}</p>\n",
                        escaped(run.summary["collapse"].value("headline", std::string())));
  if (!worst.empty())
    text += fmt::format("<p><strong>Worst: {}.</strong> {}.</p>\n", escaped(worst),
                        escaped("Damage " + damage_sentence(damage[worst])));
  return text.empty() ? "" : fmt::format("<div class=\"verdict found\">\n{}</div>\n", text);
}

std::string facts(const RunFiles& run) {
  const nlohmann::json& s = run.summary;
  std::string text = "<dl>\n";
  text += row_of("bridge", run.c.generator.empty() ? "assembly from a file" : run.c.generator);
  text += row_of("blocks, joints", fmt::format("{}, {}", s.value("blocks", 0), s.value("joints", 0)));
  if (s.contains("joint_kinds"))
    text += row_of("of the joints", fmt::format("{} bonded, {} dry", s["joint_kinds"].value("bonded", 0),
                                                s["joint_kinds"].value("dry", 0)));
  text += row_of("stages", stages_text(run.c));
  for (const EffectSetting& effect : run.c.effects) text += row_of("effect", effect.text());
  text += row_of("simulated", fmt::format("{:.3f} s in {} steps of {:.3g} s", s.value("end_time", 0.0),
                                          s.value("steps", 0), s.value("time_step", 0.0)));
  text += row_of("wall time",
                 fmt::format("{:.0f} s with {} thread(s)", s.value("wall_seconds", 0.0), s.value("threads", 1)));
  text += row_of("largest energy error", fmt::format("{:.2e} of the work done", s.value("energy_error", NAN)));
  if (s.contains("equilibrium"))
    text += row_of("equilibrium before",
                   s["equilibrium"].value("converged", false)
                       ? fmt::format("reached, out-of-balance force {:.1e} of an average block's weight",
                                     s["equilibrium"].value("out_of_balance", NAN))
                       : "not reached");
  return text + row_of("program", "voussoir " + s.value("program_version", std::string("?"))) + "</dl>\n";
}

Cell millimetres(double metres) {
  return {std::isfinite(metres) ? fmt::format("{:.2f}", 1e3 * metres) : "none", true};
}

/// Values that were probably meant in another unit.
std::string remarks_section(const RunFiles& run) {
  const nlohmann::json remarks = run.summary.value("remarks", nlohmann::json::array());
  if (remarks.empty()) return "";
  return heading("Remarks on the case") + list(remarks.get<std::vector<std::string>>());
}

std::string damage_section(const RunFiles& run) {
  const nlohmann::json damage = run.summary.value("damage", nlohmann::json::object());
  if (damage.empty()) return "";
  std::string text = heading("Damage by joints") + "<table>\n";
  text += table_row({words_cell("joints within, or between"), words_cell("damage")}, "th");
  for (const auto& [name, entry] : damage.items())
    text += table_row({words_cell(name), words_cell(damage_sentence(entry))}, "td");
  text += "</table>\n";
  std::string classes;
  double from = 0.0;
  for (const DamageClass& c : damage_classes()) {
    classes += fmt::format(
        "{}{} {}", classes.empty() ? "" : ", ", c.word,
        std::isfinite(c.below) ? fmt::format("below {:g} mm", 1e3 * c.below) : fmt::format("from {:g} mm", 1e3 * from));
    from = c.below;
  }
  return text +
         note(
             "Words by the largest opening of a joint since the start, as widths of cracks after Burland, Broms & "
             "de Mello (1977): " +
             classes + ". Joints between two components are counted by themselves.");
}

std::string demand_section(const RunFiles& run) {
  const nlohmann::json demand = run.summary.value("demand", nlohmann::json::object());
  const nlohmann::json places = demand.value("places", nlohmann::json::object());
  if (places.empty()) return "";
  std::string text = heading("Displacements relative to the base") + "<table>\n";
  text += table_row({words_cell("place"), words_cell("axis"), {"largest (mm)", true}, {"at the end (mm)", true}}, "th");
  for (const auto& [name, place] : places.items())
    text += table_row({words_cell(name), words_cell(place.value("axis", std::string())),
                       millimetres(place.value("largest", NAN)), millimetres(place.value("residual", NAN))},
                      "td");
  for (const auto& [kind, words] :
       {std::pair{"keystone_x", "mean of the keystones, x"}, std::pair{"spandrel_y", "mean of the spandrel walls, y"}})
    if (demand.contains(kind))
      text += table_row({words_cell(words), words_cell(""), millimetres(demand[kind].value("largest_mean", NAN)),
                         millimetres(demand[kind].value("residual_mean", NAN))},
                        "td", "best");
  return text + "</table>\n";
}

/// Channels of the history as one chart; empty when none of them is there.
std::string channels_chart(const RunFiles& run, const std::string& title, const std::string& label,
                           const std::vector<std::pair<std::string, std::string>>& channels, double factor) {
  if (run.history.rows() < 2) return "";
  LineChart chart;
  chart.title = title, chart.x_label = "time (s)", chart.y_label = label;
  chart.height = 300.0;
  for (const auto& [path, name] : channels) {
    if (!run.history.has(path)) continue;
    const std::size_t k = chart.curves.size();
    ChartCurve curve{name, run.history.time(), run.history.values(path), colour_code(line_colour(k)), 1.2, ""};
    if (k >= kLineColours) curve.dashes = "5 3";
    for (double& y : curve.y) y *= factor;
    chart.curves.push_back(curve);
  }
  return figure(line_chart(chart));
}

std::vector<std::pair<std::string, std::string>> demand_channels(const RunFiles& run, const std::string& kind) {
  std::vector<std::pair<std::string, std::string>> channels;
  for (const Channel& channel : run.history.channels())
    if (channel.path.starts_with("demand/" + kind)) {
      const std::string name = channel.path.substr(7);
      channels.emplace_back(channel.path, name.substr(0, name.size() - 2));  // without its axis
    }
  return channels;
}

/// 5 % response spectra of the ground as the history has it.
std::string ground_spectra(const RunFiles& run) {
  if (run.history.rows() < 20) return "";
  const std::vector<double>& time = run.history.time();
  LineChart chart;
  chart.title = "Response spectra of the base motion, 5 % damping";
  chart.x_label = "period (s)", chart.y_label = "pseudo-acceleration (g)";
  chart.height = 300.0, chart.log_x = true, chart.y_low = 0.0;
  // Stages without motion come before time begins to run evenly.
  const double dt = (time.back() - time[1]) / double(time.size() - 2);
  std::vector<double> periods;
  for (int k = 0; k <= 80; ++k) periods.push_back(std::max(0.05, 4.0 * dt) * std::pow(60.0, k / 80.0));
  for (int axis = 0; axis < 3; ++axis) {
    const std::string path = fmt::format("base/acceleration_{}", "xyz"[axis]);
    if (!run.history.has(path)) continue;
    const std::vector<double>& a = run.history.values(path);
    if (std::ranges::all_of(a, [](double v) { return v == 0.0; })) continue;
    ChartCurve curve{std::string(1, "xyz"[axis]),
                     periods,
                     response_spectrum(a, dt, periods),
                     colour_code(line_colour(std::size_t(axis))),
                     1.6,
                     ""};
    for (double& v : curve.y) v /= standard_gravity;
    chart.curves.push_back(curve);
  }
  return figure(line_chart(chart));
}

/// What was found on the way of quasi-static stages, in words and charts.
std::string steps_section(const RunFiles& run) {
  const std::vector<StageSettings>& stages = run.c.settings.stages;
  const nlohmann::json all = steps_json(stages, run.history);
  if (all.empty()) return "";
  std::string text = heading("From equilibrium to equilibrium") + "<table>\n";
  text += table_row({words_cell("stage"),
                     words_cell("path"),
                     {"largest force (kN)", true},
                     {"at (mm)", true},
                     {"last force (kN)", true},
                     {"at (mm)", true}},
                    "th");
  for (const nlohmann::json& one : all) {
    const auto number = [&](const char* key, double factor) {
      return Cell{fmt::format("{:.4g}", factor * one.value(key, NAN)), true};
    };
    text += table_row({words_cell(fmt::format("{}. {}", one.value("stage", 0), one.value("label", std::string()))),
                       words_cell(one.value("whole", false) ? "to its end"
                                                            : fmt::format("equilibrium lost beyond the share {:.4g}",
                                                                          one.value("share", 0.0))),
                       number("largest_force", 1e-3), number("largest_force_at", 1e3), number("force", 1e-3),
                       number("displacement", 1e3)},
                      "td");
  }
  text +=
      "</table>\n" + note("Each row of history.h5 of these stages is an equilibrium; steps.csv has them as a table.");
  for (LineChart chart :
       {capacity_chart(stages, run.history), deck_chart(stages, run.history), reaction_chart(stages, run.history)})
    if (!chart.curves.empty()) text += figure(line_chart(chart));
  return text;
}

std::string histories_section(const RunFiles& run) {
  std::string text =
      channels_chart(run, "Acceleration of the base", "acceleration (g)",
                     {{"base/acceleration_x", "x"}, {"base/acceleration_y", "y"}, {"base/acceleration_z", "z"}},
                     1.0 / standard_gravity);
  text += ground_spectra(run);
  text += channels_chart(run, "Keystones, longitudinal", "x relative to the base (mm)",
                         demand_channels(run, "keystone"), 1e3);
  text += channels_chart(run, "Spandrel walls, transverse", "y relative to the base (mm)",
                         demand_channels(run, "spandrel"), 1e3);
  for (const Channel& channel : run.history.channels())
    if (channel.path.starts_with("sensors/") && channel.path.ends_with("/displacement"))
      text += channels_chart(run, "Sensor " + channel.path.substr(8, channel.path.size() - 21), "displacement (mm)",
                             {{channel.path, ""}}, 1e3);
  std::vector<std::pair<std::string, std::string>> damage;
  for (const Channel& channel : run.history.channels())
    if (channel.path.starts_with("damage/"))
      damage.emplace_back(channel.path, channel.path.substr(7, channel.path.rfind('/') - 7));
  text += channels_chart(run, "Lost bond by joints within a component, or between two",
                         "share of the bonded joint area (%)", damage, 100.0);
  text += channels_chart(run, "Energy since the start", "energy (kJ)",
                         {{"energy/kinetic", "kinetic"},
                          {"energy/elastic", "elastic"},
                          {"energy/friction", "friction"},
                          {"energy/fracture", "fracture"},
                          {"energy/plastic", "plastic, fill"},
                          {"energy/joint_damping", "joint damping"},
                          {"energy/external_work", "work of loads and base"}},
                         1e-3);
  return text.empty() ? "" : heading("Histories") + text;
}

std::vector<PagePicture> pictures_of(const RunFiles& run) {
  struct Known {
    const char *file, *title, *caption;
  };
  constexpr Known known[] = {
      {"opening_oblique", "Joints opened", "largest opening since the start, deformed shape at the end"},
      {"opening_front", "Joints opened, front", "largest opening since the start, deformed shape at the end"},
      {"slip_oblique", "Joints slid", "largest slip since the start, deformed shape at the end"},
      {"slip_front", "Joints slid, front", "largest slip since the start, deformed shape at the end"},
      {"plastic_oblique", "Fill: plastic strain", "section along the middle"},
      {"yield_oblique", "Fill: yielded zones", "section along the middle"},
      {"mechanism_front", "Mechanism of collapse", "displacements enlarged"},
      {"collapse_curve", "Load and displacement", "each point an equilibrium; in collapse_curve.csv too"}};
  std::vector<PagePicture> pictures;
  std::error_code ignored;
  for (const Known& k : known)
    if (const std::string path = fmt::format("{}/images/{}.png", run.directory, k.file); fs::exists(path, ignored))
      pictures.push_back({k.title, k.caption, path});
  for (const PlotSpec& plot : run.c.plots)
    if (const std::string path = fmt::format("{}/images/{}.png", run.directory, plot.name); fs::exists(path, ignored))
      pictures.push_back({plot.title, "", path});
  return pictures;
}

}  // namespace

void write_run_page(const std::string& directory) {
  const RunFiles run = run_files(directory);
  const std::string body = verdict(run) + facts(run) + remarks_section(run) +
                           gravity_section(run.summary.value("gravity", nlohmann::json::array())) + steps_section(run) +
                           damage_section(run) + crack_section(run.directory, run.summary) + demand_section(run) +
                           pictures_section(pictures_of(run)) + histories_section(run);
  write_atomically(directory + "/report.html", html_page("Run " + run.name, body));
}

}  // namespace voussoir
