// Diagnosis, rating and the tables of campaigns. What has a JSON form of its own is handed over as that text.
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "solver/base/json_file.h"
#include "tools/campaign/table.h"
#include "tools/diagnosis/diagnose_case.h"
#include "tools/diagnosis/diagnosis_files.h"
#include "tools/python/module/arrays.h"
#include "tools/python/module/module.h"
#include "tools/rate/rate_report.h"
#include "tools/rate/strip.h"

namespace voussoir::python {

namespace {

/// Says a line and lets Ctrl-C come through; with `none` it only does the latter.
std::function<void(const std::string&)> teller(const py::object& say) {
  return [say](const std::string& line) {
    const py::gil_scoped_acquire mine;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!say.is_none()) say(line);
  };
}

struct DiagnosisWanted {
  std::vector<std::string> hold_back, without;
  int effects = 3;
  double model_error = 0.005;
  bool least_amounts = true;
  double run_seconds = 10.0;
  int threads = 1;
};

/// JSON, words and the corrected case; in `directory`, unless it is empty, also what the verb writes there.
py::tuple diagnosis(const Case& c, const std::string& measured, const std::string& directory, bool page,
                    const DiagnosisWanted& wanted, const py::object& say) {
  DiagnosisRequest request;
  request.c = c;
  request.measured = measured, request.directory = directory;
  request.model_error = wanted.model_error;
  request.hold_back = wanted.hold_back;
  request.settings.without = wanted.without;
  for (const std::string& name : wanted.without) find_effect(name);
  request.settings.effects = wanted.effects;
  request.settings.detectable = wanted.least_amounts;
  request.settings.threads = wanted.threads;
  request.run_seconds = wanted.run_seconds;
  const auto tell = teller(say);
  std::string json, text, corrected;
  {
    const py::gil_scoped_release others;
    const DiagnosisInput input = diagnosis_input(request);
    if (!directory.empty()) check_diagnosis_folder(c, directory);
    const DiagnosisResult result = diagnose_case(input, request, tell);
    json = json_text(diagnosis_json(input, result)), text = diagnosis_text(input, result);
    corrected = result.corrected_text;
    if (!directory.empty()) write_diagnosis(input, result, directory, page, tell);
  }
  return py::make_tuple(json, text, corrected);
}

/// JSON and words. `strip` in m; 0: the whole bridge.
py::tuple rating(const Case& given, RateRequest request, const std::vector<std::string>& vehicles, double strip,
                 const py::object& say) {
  for (const std::string& name : vehicles) request.vehicles.push_back(read_vehicle(name));
  if (request.vehicles.empty()) throw InputError("name at least one vehicle; vehicles() lists them");
  const auto tell = teller(say);
  std::string json, text;
  {
    const py::gil_scoped_release others;
    const Case c = strip > 0.0 ? strip_case(given, strip) : without_loading_test(given);
    if (strip > 0.0 && !request.effective_width) {
      const double cover =
          given.generator_input.values.contains("fill_over_crown") ? given.generator_input("fill_over_crown") : 0.0;
      double widest = 0.0;
      for (const Vehicle& v : request.vehicles) widest = std::max(widest, vehicle_width(v));
      request.effective_width = effective_width(widest, cover, c.generator_input("width"));
    }
    RateObservers observers;
    observers.rated = [&](const RatedPlace& at, std::size_t done, std::size_t planned) {
      tell(fmt::format("{:3} of {:3}  {}: {}", done, planned, request.vehicles[at.vehicle].name,
                       factor_text(at, request)));
    };
    const Rating found = rate(c, make_assembly(c), request, observers);
    json = json_text(rating_json(found, request)), text = rating_text(found, request);
  }
  return py::make_tuple(json, text);
}

/// {column: texts or numbers}
py::dict campaign_table(const std::string& path) {
  const CampaignTable table = read_table(path);
  py::dict d;
  const std::pair<const char*, std::string CampaignRun::*> texts[] = {
      {"run", &CampaignRun::run},     {"case", &CampaignRun::case_name}, {"record", &CampaignRun::record},
      {"event", &CampaignRun::event}, {"sample", &CampaignRun::sample},  {"reason", &CampaignRun::reason}};
  for (const auto& [name, text] : texts) {
    py::list values;
    for (const CampaignRun& run : table.runs) values.append(run.*text);
    d[name] = values;
  }
  py::list status;
  for (const CampaignRun& run : table.runs) status.append(run_status_name(run.status));
  d["status"] = status;
  d["scale"] = column<double>(table.runs, [](const CampaignRun& run) { return run.scale; });
  d["seconds"] = column<double>(table.runs, [](const CampaignRun& run) { return run.seconds; });
  for (const NumberColumn& c : table.columns) d[c.name.c_str()] = column<double>(c.values, [](double v) { return v; });
  return d;
}

}  // namespace

void bind_analyses(py::module_& m) {
  m.def(
      "_diagnose", [](const Case& c, const std::string& measured, const std::string& directory, bool page,
                      std::vector<std::string> hold_back, std::vector<std::string> without, int effects,
                      double model_error, bool least_amounts, double run_seconds, int threads, const py::object& say) {
        return diagnosis(
            c, measured, directory, page,
            {std::move(hold_back), std::move(without), effects, model_error, least_amounts, run_seconds, threads}, say);
      });
  m.def("_rate", [](const Case& c, const std::vector<std::string>& vehicles, std::vector<double> lanes, bool both_ways,
                    double step, int refinements, double most, double tolerance, double strip,
                    std::optional<double> effective_width, int threads, const py::object& say) {
    RateRequest request;
    request.lanes = std::move(lanes);
    request.both_ways = both_ways, request.step = step, request.refinements = refinements;
    request.most = most, request.tolerance = tolerance, request.threads = threads;
    request.effective_width = effective_width;
    return rating(c, std::move(request), vehicles, strip, say);
  });
  m.def("vehicles", &shipped_vehicles, "Names of the vehicles of the library (docs/vehicles.md).");
  m.def("_campaign_table", &campaign_table);
}

}  // namespace voussoir::python
