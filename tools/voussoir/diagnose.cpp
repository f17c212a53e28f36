// voussoir diagnose.
#include <fmt/format.h>

#include <filesystem>

#include "solver/base/atomic_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/json_file.h"
#include "tools/diagnosis/diagnose_case.h"
#include "tools/diagnosis/diagnosis_files.h"
#include "tools/diagnosis/diagnosis_pictures.h"
#include "tools/diagnosis/measured_features.h"
#include "tools/diagnosis/plan.h"
#include "tools/voussoir/options.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

int diagnose_and_write(const DiagnosisRequest& request) {
  const auto say = [&](const std::string& line) {
    if (!request.quiet) fmt::print("{}\n", line), std::fflush(stdout);
  };
  const DiagnosisInput input = diagnosis_input(request);
  check_diagnosis_folder(input.c, request.directory);
  say(fmt::format("{} at {}; model error {:.1f} % of frequencies, {:.1f} % of shapes",
                  counted(input.problem.features.modes.size(), "measured mode"), sensors_used(input.problem.features),
                  100.0 * input.problem.error.frequency, 100.0 * input.problem.error.shape));
  const DiagnosisResult result = diagnose_case(input, request, say);
  write_diagnosis(input, result, request.directory, request.page, say);
  say(diagnosis_text(input, result));
  return 0;
}

/// Evaluates a plan of sensors before anything is measured.
int look_and_write(const DiagnosisRequest& request, const MeasurementPlan& plan) {
  const auto say = [&](const std::string& line) {
    if (!request.quiet) fmt::print("{}\n", line), std::fflush(stdout);
  };
  const PlanResult result = look_at_plan(request, plan);
  fs::create_directories(request.directory);
  write_json(request.directory + "/plan.json", plan_json(result));
  if (request.page) {
    std::vector<PagePicture> pictures;
    const DiagnosisProblem& problem = result.input.problem;
    try {
      fs::create_directories(request.directory + "/images");
      pictures.push_back(
          sensor_picture(problem.base, problem.features.sensors, request.directory + "/images/sensors.png"));
    } catch (const RunError& error) {
      say(fmt::format("no picture was drawn: {}", error.what()));
    }
    write_atomically(request.directory + "/plan.html", plan_page(result, pictures));
  }
  say(plan_text(result));
  return 0;
}

int diagnose_run(const std::vector<std::string>& arguments) {
  CommandLine line("diagnose", "diagnose CASE --measured DIR | --plan FILE [-o DIR]",
                   "voussoir diagnose cases/cs1-f.toml --measured measured -o diagnosis");
  DiagnosisRequest request;
  MeasurementPlan plan;
  std::string without, held;
  line.described.add_options()("measured", options::value<std::string>(&request.measured)->value_name("DIR"),
                               "folder of measurements: modes.csv, sensors.csv, shapes.csv, records/")(
      "output,o", options::value<std::string>(&request.directory)->value_name("DIR"),
      "folder to write to (default: CASE-diagnosis)")(
      "hold-back", options::value<std::string>(&held),
      "names of modes that are predicted and not fitted, separated by commas")(
      "without", options::value<std::string>(&without), "names of effects that are not tried, separated by commas")(
      "effects", whole_option("effects", 0, 100, &request.settings.effects)->default_value(3),
      "largest number of effects to add")(
      "fits", whole_option("fits", 1, 10000, &request.settings.fits)->default_value(request.settings.fits),
      "number of candidates that are fitted fully in a round")(
      "model-error",
      real_option("model-error", 1e-9, 0.999, &request.model_error)->default_value(request.model_error, "0.005"),
      "error of the frequencies of a correct model, as a share, in addition to the error of the mesh")(
      "most-modes", whole_option("most-modes", 1, 30, &request.most_modes)->default_value(request.most_modes),
      "largest number of modes used of those identified from recordings, the lowest first")(
      "run-seconds", real_option("run-seconds", 0.0, 3600.0, &request.run_seconds)->default_value(request.run_seconds),
      "seconds of the first recording with the ground's motion that the explicit solver computes, with the case and "
      "with the corrected case; 0: no run")(
      "no-least-amounts", "do not compute the least amounts of the effects that these data would have shown")(
      "plan", options::value<std::string>(&plan.sensors)->value_name("FILE"),
      "planned sensors, in place of measurements (format of sensors.csv): compute the least amounts that they would "
      "show")("plan-modes", whole_option("plan-modes", 1, 30, &plan.modes)->default_value(plan.modes),
              "with --plan: number of the lowest modes to count on")(
      "plan-noise", real_option("plan-noise", 1e-6, 0.5, &plan.noise)->default_value(plan.noise),
      "with --plan: standard deviation of the periods, as a share; that of the shapes is twice as large")(
      "no-page", "no HTML page and no pictures");
  line.positional = {"CASE"};
  line.required = {"CASE"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  if (request.measured.empty() == plan.sensors.empty())
    throw InputError(
        "voussoir diagnose needs either --measured DIR (a folder of measurements) or --plan FILE (planned sensors). {} "
        "given",
        plan.sensors.empty() ? "Neither is" : "Both are");
  for (const char* option : {"plan-modes", "plan-noise"})
    if (plan.sensors.empty() && !values[option].defaulted())
      throw InputError(
          "--{} belongs to --plan, which is not given. Give --plan FILE instead of --measured, or leave the option out",
          option);
  request.c = read_case(values["CASE"].as<std::string>(), CaseUse::geometry);
  if (request.directory.empty()) request.directory = fs::path(request.c.path).stem().string() + "-diagnosis";
  request.settings.without = words_in(without);
  for (const std::string& name : request.settings.without) find_effect(name);
  request.hold_back = words_in(held);
  request.settings.threads = threads_asked(values);
  request.settings.detectable = values.count("no-least-amounts") == 0;
  request.quiet = values.count("quiet") > 0;
  request.page = values.count("no-page") == 0;
  return plan.sensors.empty() ? diagnose_and_write(request) : look_and_write(request, plan);
}

}  // namespace

Verb diagnose_verb() {
  return {"diagnose", "compare a case with measurements and find the effect that it lacks", diagnose_run};
}

}  // namespace voussoir
