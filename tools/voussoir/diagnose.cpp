// voussoir diagnose.
#include <fmt/format.h>

#include <filesystem>

#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "tools/diagnosis/diagnosis_page.h"
#include "tools/diagnosis/diagnosis_pictures.h"
#include "tools/diagnosis/diagnosis_report.h"
#include "tools/voussoir/options.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

/// The corrected case: the case's own text with what was found. Faults of sensors are the measurement's, not its.
std::string corrected_text(const DiagnosisInput& input, const std::vector<EffectSetting>& all) {
  std::vector<EffectSetting> model;
  std::string faults;
  for (const EffectSetting& effect : all) {
    if (effect.name == "sensor_fault")
      faults += fmt::format("# of the measurement: {}\n", effect.text());
    else
      model.push_back(effect);
  }
  return fmt::format("{}\n# Added by voussoir diagnose from {}.\n{}{}", input.c.text, input.measured.directory, faults,
                     effects_text(model));
}

/// The hypothesis' faults of sensors and motions of supports alone: what the corrected assembly does not hold.
Fit rerun(const DiagnosisProblem& full, Assembly corrected, double damping, const Fit& found) {
  DiagnosisProblem problem = full;
  problem.base = std::move(corrected);
  problem.damping = damping;
  Hypothesis faults;
  std::vector<double> x;
  auto at = Eigen::Index(found.hypothesis.materials.size());
  for (const Candidate& c : found.hypothesis.effects) {
    using Kind = Candidate::Kind;
    const bool fault = c.kind == Kind::gain || c.kind == Kind::swap || c.kind == Kind::clock || c.kind == Kind::motion;
    if (fault) faults.effects.push_back(c);
    for (std::size_t i = 0; i < c.parameters.size(); ++i, ++at)
      if (fault) x.push_back(found.best.x[at]);
  }
  return fit(problem, faults, Eigen::Map<const Eigen::VectorXd>(x.data(), Eigen::Index(x.size())), 0);
}

/// Case and records so that the folder stands alone.
void write_corrected(const Case& corrected, const std::string& text, const std::string& directory) {
  const bool files = !corrected.assembly_file.empty() ||
                     std::any_of(corrected.motions.begin(), corrected.motions.end(),
                                 [](const MotionSource& m) { return m.kind == MotionSource::Kind::record; });
  if (!files) return write_atomically(directory + "/corrected.toml", text);
  write_resolved_case(corrected, directory);
  fs::rename(directory + "/case.toml", directory + "/corrected.toml");
}

int diagnose_case(const DiagnosisRequest& request) {
  const auto say = [&](const std::string& line) {
    if (!request.quiet) fmt::print("{}\n", line), std::fflush(stdout);
  };
  const DiagnosisInput input = diagnosis_input(request);
  say(fmt::format("{} measured modes at {}; model error {:.1f} % of frequencies, {:.1f} % of shapes",
                  input.full.features.modes.size(), sensors_used(input.full.features),
                  100.0 * input.coarse.error.frequency, 100.0 * input.coarse.error.shape));
  if (input.coarsened) say(fmt::format("effects are looked for with block_scale {:.2f}", input.block_scale));
  DiagnosisResult result;
  result.diagnosis = diagnose(input.coarse, request.settings, say);
  Diagnosis& d = result.diagnosis;
  result.before = input.coarsened ? fit(input.full, {}, {}, 0) : d.plain;
  // The same effects on the case's own mesh, whose stiffness is a little different: these values are the ones to
  // report.
  if (input.coarsened) {
    say("fitting the values anew on the case's own mesh");
    d.best = fit(input.full, d.best.hypothesis, d.best.best.x, 3);
  }
  const std::string text = corrected_text(input, d.best.hypothesis.settings(d.best.best.x));
  const Case corrected = parse_case(text, input.c.path, CaseUse::geometry);
  result.corrected = text;
  result.after = rerun(input.full, make_assembly(corrected), corrected.settings.damping.ratio, d.best);
  result.modes = compare_modes(input.full, result.before, result.after);
  result.where = locate(input.full, result.before.best);
  result.where_after = locate(input.full, result.after.best);
  try {
    result.recorded = run_recorded(input, d.best, request.run_seconds, request.settings.threads, say);
  } catch (const std::runtime_error& error) {
    say(fmt::format("no runs under the recorded motion: {}", error.what()));
  }
  fs::create_directories(request.directory);
  write_corrected(corrected, text, request.directory);
  write_atomically(request.directory + "/diagnosis.json", diagnosis_json(input, result).dump(2) + "\n");
  if (request.page) {
    const std::vector<PagePicture> pictures = draw_diagnosis(input, result, request.directory, say);
    write_atomically(request.directory + "/diagnosis.html", diagnosis_page(input, result, pictures));
  }
  say(diagnosis_text(input, result));
  return 0;
}

int diagnose_run(const std::vector<std::string>& arguments) {
  CommandLine line("diagnose", "diagnose CASE --measured DIR [-o DIR]",
                   "voussoir diagnose cases/cs1-f.toml --measured measured -o diagnosis");
  DiagnosisRequest request;
  std::string without, held;
  line.described.add_options()("measured", options::value<std::string>(&request.measured)->value_name("DIR"),
                               "folder with modes.csv, sensors.csv, shapes.csv, records/")(
      "output,o", options::value<std::string>(&request.directory)->value_name("DIR"),
      "where to (default: CASE-diagnosis)")("hold-back", options::value<std::string>(&held),
                                            "modes that are not fitted but predicted, by commas")(
      "without", options::value<std::string>(&without), "effects that are not tried, by commas")(
      "effects", whole_option("effects", 0, 100, &request.settings.effects)->default_value(3), "most that are added")(
      "fits", whole_option("fits", 1, 10000, &request.settings.fits)->default_value(request.settings.fits),
      "candidates that are fitted fully in a round")(
      "model-error", real_option("model-error", 1e-9, 0.999, &request.model_error)->default_value(request.model_error),
      "of a right model's frequencies, share, beside its mesh")(
      "unknowns", whole_option("unknowns", 1, 100'000'000, &request.unknowns)->default_value(request.unknowns),
      "of the mesh that effects are looked for on, at most")(
      "most-modes", whole_option("most-modes", 1, 30, &request.most_modes)->default_value(request.most_modes),
      "of those found in recordings: the lowest are used")(
      "run-seconds", real_option("run-seconds", 0.0, 3600.0, &request.run_seconds)->default_value(request.run_seconds),
      "of a recording with the ground's motion for which the explicit solver is run before and after; 0: not")(
      "no-page", "no HTML page and no pictures");
  line.positional = {"CASE"};
  line.required = {"CASE", "measured"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  request.case_file = values["CASE"].as<std::string>();
  if (request.directory.empty()) request.directory = fs::path(request.case_file).stem().string() + "-diagnosis";
  request.settings.without = words_in(without);
  for (const std::string& name : request.settings.without) find_effect(name);
  request.hold_back = words_in(held);
  request.settings.threads = threads_asked(values);
  request.quiet = values.count("quiet") > 0;
  request.page = values.count("no-page") == 0;
  return diagnose_case(request);
}

}  // namespace

Verb diagnose_verb() {
  return {"diagnose", "where model and measurement disagree, which effect is missing, the corrected case",
          diagnose_run};
}

}  // namespace voussoir
