#include "tools/run/run_page.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "solver/base/atomic_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/json_file.h"
#include "tools/run/crack_section.h"
#include "tools/run/gravity_report.h"
#include "tools/run/page_sections.h"
#include "tools/run/stress_section.h"
#include "viz/page/html.h"
#include "viz/page/svg.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

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

std::string facts(const RunFiles& run) {
  const nlohmann::json& s = run.summary;
  std::string text = "<dl>\n";
  text += row_of("bridge", run.c.generator.empty() ? "assembly from a file" : run.c.generator);
  text += row_of("blocks, joints", fmt::format("{}, {}", s.value("blocks", 0), s.value("joints", 0)));
  if (s.contains("joint_kinds"))
    text += row_of("kinds of joints", fmt::format("{} bonded, {} dry", s["joint_kinds"].value("bonded", 0),
                                                  s["joint_kinds"].value("dry", 0)));
  text += row_of("stages", stages_text(run.c));
  for (const EffectSetting& effect : run.c.effects) text += row_of("effect", effect.text());
  if (s.value("steps", 0) > 0)
    text += row_of("simulated", fmt::format("{:.3f} s in {} of {:.3g} s", s.value("end_time", 0.0),
                                            counted(s.value("steps", 0), "time step"), s.value("time_step", 0.0)));
  text += row_of("wall-clock time", fmt::format("{:.0f} s with {}", s.value("wall_seconds", 0.0),
                                                counted(s.value("threads", 1), "thread")));
  if (s.value("energy_error", 0.0) > 0.0)
    text += row_of("largest energy error", fmt::format("{:.2e} times the work done", s.value("energy_error", NAN)));
  if (s.contains("equilibrium"))
    text += row_of("equilibrium under gravity",
                   s["equilibrium"].value("converged", false)
                       ? fmt::format("reached; the out-of-balance force is {:.1e} times the mean weight of a block",
                                     s["equilibrium"].value("out_of_balance", NAN))
                       : "not reached");
  return text + row_of("program", "voussoir " + s.value("program_version", std::string("?"))) + "</dl>\n";
}

/// The remarks on the case: values that were probably meant in another unit.
std::string remarks_section(const RunFiles& run) {
  const nlohmann::json remarks = run.summary.value("remarks", nlohmann::json::array());
  if (remarks.empty()) return "";
  return heading("Remarks on the case") + list(remarks.get<std::vector<std::string>>());
}

/// Whether a picture of slips shows any slip.
bool shows_something(const RunFiles& run, std::string_view file) {
  if (!file.starts_with("slip")) return true;
  for (const auto& [name, entry] : run.of("damage").items())
    if (entry.value("largest_slip", 0.0) > unmoved) return true;
  return false;
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
      {"mechanism_front", "Mechanism of collapse", "displacements enlarged"}};
  std::vector<PagePicture> pictures;
  std::error_code ignored;
  for (const Known& k : known)
    if (const std::string path = fmt::format("{}/images/{}.png", run.directory, k.file); fs::exists(path, ignored))
      if (shows_something(run, k.file)) pictures.push_back({k.title, k.caption, path});
  return pictures;
}

/// A link to the page of voussoir view, if that is in the same folder.
std::string view_link(const RunFiles& run) {
  std::error_code ignored;
  if (!fs::exists(run.directory + "/view.html", ignored)) return "";
  return "<p><a href=\"view.html\">The run in three dimensions</a> (view.html).</p>\n";
}

}  // namespace

void write_run_page(const std::string& directory) {
  const RunFiles run = read_run(directory);
  const std::string body = verdict_section(run) + view_link(run) + facts(run) + remarks_section(run) +
                           collapse_section(run) + steps_section(run) + motion_section(run) +
                           pictures_section(pictures_of(run)) + reactions_section(run) + places_section(run) +
                           ties_section(run) + damage_section(run) + crack_section(run.directory, run.summary) +
                           demand_section(run) + stress_section(run.directory) +
                           gravity_section(run.summary.value("gravity", nlohmann::json::array())) + plots_section(run) +
                           histories_section(run) + model_section(run) + provenance_section(run);
  write_atomically(directory + "/report.html", html_page("Run " + run.name, body));
}

}  // namespace voussoir
