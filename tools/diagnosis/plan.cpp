#include "tools/diagnosis/plan.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "solver/base/counted.h"
#include "tools/diagnosis/detection_report.h"

namespace voussoir {

namespace {

using nlohmann::json;

std::string modes_table(const Features& features) {
  std::string text =
      heading("Modes that the plan assumes") + "<table>\n" +
      table_row({{"mode"}, {"direction"}, {"period, s", true}, {"frequency, Hz", true}, {"± %", true}}, "th");
  for (const MeasuredFeature& mode : features.modes)
    text += table_row({words_cell(mode.name),
                       words_cell(mode.direction),
                       {fmt::format("{:.4f}", 1.0 / mode.frequency), true},
                       {fmt::format("{:.3f}", mode.frequency), true},
                       {fmt::format("{:.2g}", 100.0 * mode.frequency_std), true}},
                      "td");
  return text + "</table>\n";
}

}  // namespace

PlanResult look_at_plan(const DiagnosisRequest& request, const MeasurementPlan& plan) {
  PlanResult result = {planned_input(request, plan), {}};
  const DiagnosisProblem& problem = result.input.problem;
  Fit as_planned;
  as_planned.hypothesis.materials = calibrations(problem.base);
  as_planned.best.x = Eigen::VectorXd::Zero(Eigen::Index(as_planned.hypothesis.size()));
  CandidateChoice choice;
  choice.without = request.settings.without;
  choice.damping = problem.damping > 0.0;
  const Origin& origin = *problem.origin;
  const int wanted = question_of(problem, origin.response()).wanted;
  const Vectors shared = material_vectors(origin, problem.base, as_planned.hypothesis, as_planned.best.x, wanted);
  result.detection =
      detection(problem, as_planned, origin, shared, candidates(problem.base, problem.features.sensors, choice),
                {request.settings.margin, request.settings.further_measurements, request.settings.threads});
  return result;
}

std::string plan_text(const PlanResult& result) {
  const Features& features = result.input.problem.features;
  std::string text =
      fmt::format("{}; the plan assumes that these modes are measured:\n", counted(features.sensors.size(), "sensor"));
  for (const MeasuredFeature& mode : features.modes)
    text += fmt::format("  {:>2} {:>12} {:8.4f} s {:7.3f} Hz ± {:.2g} %\n", mode.name, mode.direction,
                        1.0 / mode.frequency, mode.frequency, 100.0 * mode.frequency_std);
  text += detection_text(result.detection);
  for (const std::string& remark : result.input.measured.remarks) text += fmt::format("remark: {}\n", remark);
  return text;
}

json plan_json(const PlanResult& result) {
  json j;
  for (const MeasuredFeature& mode : result.input.problem.features.modes)
    j["modes"].push_back({{"mode", mode.name},
                          {"direction", mode.direction},
                          {"period", 1.0 / mode.frequency},
                          {"frequency", mode.frequency},
                          {"std", mode.frequency_std}});
  for (const Sensor& s : result.input.problem.features.sensors)
    j["sensors"].push_back({{"id", s.id},
                            {"position", {s.position.x(), s.position.y(), s.position.z()}},
                            {"direction", {s.direction.x(), s.direction.y(), s.direction.z()}}});
  add_detection(result.detection, j);
  j["remarks"] = result.input.measured.remarks;
  return j;
}

std::string plan_page(const PlanResult& result, const std::vector<PagePicture>& pictures) {
  const std::string name = std::filesystem::path(result.input.c.path).stem().string();
  std::string page = paragraph(fmt::format(
      "The effects that {} would show on {}, computed before anything is measured: {} in {}. The program assumes "
      "that periods and shapes will have the stated uncertainties.",
      std::filesystem::path(result.input.measured.directory).filename().string(), name,
      counted(result.input.problem.features.sensors.size(), "channel"),
      counted(result.input.problem.features.modes.size(), "mode")));
  page += pictures_section(pictures, "The plan") + modes_table(result.input.problem.features) +
          detection_section(result.detection, "Effects that they would show");
  return html_page(fmt::format("Measurement plan of {}", name), page);
}

}  // namespace voussoir
