// voussoir rate.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "io/vtk/series.h"
#include "solver/base/atomic_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/folder.h"
#include "solver/base/json_file.h"
#include "tools/rate/mexe_file.h"
#include "tools/rate/passages.h"
#include "tools/rate/place_store.h"
#include "tools/rate/rate_page.h"
#include "tools/rate/rate_report.h"
#include "tools/rate/strip.h"
#include "tools/run/run_directory.h"
#include "tools/run/run_session.h"
#include "tools/run/stop_request.h"
#include "tools/run/thrust.h"
#include "tools/voussoir/options.h"
#include "viz/render.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;

Words list_of(const options::variables_map& values, const char* name) {
  return values.count(name) ? values[name].as<Words>() : Words{};
}

/// The vehicle itself, or one of its variants; for "all", the vehicle and each variant.
std::vector<Vehicle> with_variants(const Vehicle& vehicle, const std::string& variant) {
  if (variant.empty()) return {vehicle};
  if (variant != "all") return {variant_named(vehicle, variant)};
  std::vector<Vehicle> all = {vehicle};
  for (const VehicleVariant& v : vehicle.variants) all.push_back(variant_named(vehicle, v.name));
  return all;
}

struct Amplification {
  std::string name;  // name of a dynamic factor of the vehicle; empty: none
  double span = 0.0, cover = -1.0;
};

/// The vehicle with the factor. A factor of the critical axle alone gives one vehicle for each axle.
std::vector<Vehicle> with_factor(const Vehicle& vehicle, const Amplification& by) {
  if (by.name.empty()) return {vehicle};
  const DynamicFactor& factor = factor_named(vehicle, by.name);
  if (factor.formula != DynamicFactor::Formula::value && (by.span <= 0.0 || by.cover < 0.0))
    throw InputError("--factor {} depends on span and cover. Give --span and --cover, in m", by.name);
  const double value = dynamic_factor(factor, by.span, by.cover);
  std::vector<Vehicle> all;
  if (!factor.critical_axle_only) {
    all.push_back(amplified(vehicle, value));
    all.back().name += fmt::format(" x {:g}", value);
    return all;
  }
  for (std::size_t i = 0; i < vehicle.axles.size(); ++i) {
    all.push_back(amplified(vehicle, value, i));
    all.back().name += fmt::format(", axle {} x {:g}", i + 1, value);
  }
  return all;
}

std::vector<Vehicle> vehicles_asked(const options::variables_map& values) {
  Amplification by;
  if (values.count("factor")) by.name = values["factor"].as<std::string>();
  if (values.count("span")) by.span = values["span"].as<double>();
  if (values.count("cover")) by.cover = values["cover"].as<double>();
  const std::string variant = values.count("variant") ? values["variant"].as<std::string>() : std::string();
  const Words names = list_of(values, "vehicle");
  if (names.empty()) throw InputError("--vehicle NAME is missing. 'voussoir vehicles' lists the names");
  std::vector<Vehicle> all;
  for (const std::string& name : names)
    for (const Vehicle& v : with_variants(read_vehicle(name), variant))
      for (Vehicle& loaded : with_factor(v, by)) all.push_back(std::move(loaded));
  return all;
}

std::vector<double> lanes_asked(const std::vector<double>& lanes) {
  for (const double y : lanes)
    if (!(std::abs(y) <= 100.0)) throw InputError("--lane is {}. It must be from -100 to 100 m", y);
  return lanes;
}

/// Remarks on the dynamic factor, and on figures of the vehicles that nobody has checked.
std::vector<std::string> vehicle_remarks(const options::variables_map& values, const std::vector<Vehicle>& vehicles) {
  std::vector<std::string> remarks = {
      values.count("factor") ? fmt::format("The dynamic factor \"{}\" is applied", values["factor"].as<std::string>())
                             : std::string("No dynamic factor is applied. --factor NAME applies one")};
  for (const Vehicle& vehicle : vehicles)
    if (!vehicle.not_checked.empty())
      remarks.push_back(fmt::format("{}: nobody has checked the following against the source: {}", vehicle.name,
                                    fmt::join(vehicle.not_checked, ", ")));
  return remarks;
}

double widest(const std::vector<Vehicle>& vehicles) {
  double width = 0.0;
  for (const Vehicle& v : vehicles) width = std::max(width, vehicle_width(v));
  return width;
}

/// The case that is rated: without its loading test, or as a strip. Adds the assumptions to `remarks`.
Case loaded_case(const Case& c, const options::variables_map& values, RateRequest& request,
                 std::vector<std::string>& remarks) {
  const char* const beam = "The beam of the loading test, and all stages from that test on, are left out";
  if (!values.count("strip")) {
    if (is_loading_test(c)) remarks.push_back(beam);
    return without_loading_test(c);
  }
  const double cover =
      c.generator_input.values.contains("fill_over_crown") ? c.generator_input("fill_over_crown") : 0.0;
  remarks = strip_remarks(c);
  if (is_loading_test(c)) remarks.push_back(beam);
  Case strip = strip_case(c, values["strip"].as<double>());
  request.effective_width = values.count("effective-width")
                                ? values["effective-width"].as<double>()
                                : effective_width(widest(request.vehicles), cover, c.generator_input("width"));
  remarks.push_back(fmt::format(
      "The model is a strip in plane strain. The load of a vehicle is spread over {:.3g} m of width{}",
      *request.effective_width, values.count("effective-width") ? "" : " (wheels + 1.5 m + cover, CS 454)"));
  return strip;
}

/// Reports on standard error, unless they are not wanted.
class Reports {
 public:
  explicit Reports(bool quiet) : quiet_(quiet), line_(quiet) {}
  void show(const Progress& progress) { line_.show(progress); }
  void say(const std::string& text) {
    line_.end();
    if (!quiet_) fmt::print(stderr, "{}\n", text);
  }

 private:
  bool quiet_;
  ProgressLine line_;
};

RateObservers observers_of(const RateRequest& request, const PlaceStore& store, Reports& reports) {
  RateObservers o;
  o.begins = [&](std::size_t planned) {
    const std::size_t vehicles = request.vehicles.size();
    reports.say(fmt::format("{} of {}. The program computes the stages of the case first", counted(planned, "position"),
                            counted(vehicles, "vehicle")));
  };
  o.progress = [&](const Progress& progress) { reports.show(progress); };
  o.recall = [&](RatedPlace& at) { return store.recall(at); };
  o.rated = [&](const RatedPlace& at, std::size_t done, std::size_t planned) {
    store.keep(at);
    reports.say(fmt::format("{:3} of {:3}  {}  front at x = {:.2f} m, y = {:.2f} m: {}", done, planned,
                            request.vehicles[at.vehicle].name, at.place.x, at.place.y, factor_text(at, request)));
  };
  o.stop = &stop_request();
  return o;
}

/// The section along the bridge under the vehicle, from the last stored frame.
std::string draw_working(const Case& c, const std::string& folder) {
  const VtkSeries series(folder);
  const std::string png = folder + "/images/working_front.png";
  if (series.blocks().frames().empty()) return png;
  const auto& last = series.blocks().frames().back();
  RenderOptions o;
  o.view = "front", o.colour = "displacement", o.cut = "y", o.hide = {};
  o.amplification = 50.0, o.crack_mm = 0.1;
  o.title = "Under the vehicle, " + fs::path(c.path).stem().string();
  render_picture(PictureFiles{series.blocks().file_path(last), series.joints().file_at(last.time),
                              series.fill().file_at(last.time)},
                 o, png);
  return png;
}

/// Results of the runs at the worst position.
struct WorstRuns {
  std::vector<PagePicture> pictures;
  std::vector<ThrustLine> thrust;  // under the vehicle with factor 1, then under the largest load found
};

/// Runs the worst position of all again, to collapse and at factor 1, with pictures and pages. Nothing if it was
/// stopped.
std::optional<WorstRuns> run_worst(const Case& c, const RateRequest& request, const Rating& rating,
                                   const std::string& out, Reports& reports) {
  const RatedPlace& at = rating.places[worst_of_all(rating)];
  WorstRuns all;
  for (const bool to_collapse : {true, false}) {
    const Case more = with_vehicle(c, request, at, to_collapse);
    const std::string folder = out + (to_collapse ? "/worst" : "/working");
    RunRequest run;
    run.directory = folder, run.threads = request.threads, run.quiet = true;
    const DirectoryLock lock = prepare_directory(more, folder, true);
    reports.say(fmt::format("{}: {}", folder,
                            to_collapse ? "run to collapse at the worst position" : "under the vehicle with factor 1"));
    RunSession session(run);
    session.run();
    if (session.end() == SessionEnd::stopped) return std::nullopt;
    all.thrust.insert(all.thrust.begin(),
                      {to_collapse ? "largest load found" : "under the vehicle with factor 1", session.bed_joints()});
    const std::string file = to_collapse ? folder + "/images/mechanism_front.png" : draw_working(more, folder);
    std::error_code ignored;
    if (fs::exists(file, ignored))
      all.pictures.push_back(
          {to_collapse ? "Beyond the collapse load" : "Under the vehicle with factor 1",
           to_collapse
               ? "Run directory worst: displacements, and joints of the mechanism in red"
               : "Run directory working: displacements, and joints that opened or slipped more than 0.1 mm in red",
           read_text(file)});
  }
  return all;
}

/// Shares of the adequacy factor with which the vehicle passes; the usual rule takes the half.
constexpr double passage_shares[] = {0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};

/// Empty if it was stopped.
std::vector<PassageSeries> pass_repeatedly(const Case& c, const Assembly& assembly, const RateRequest& request,
                                           const Rating& rating, int count, Reports& reports) {
  const RatedPlace& worst = rating.places[rating.worst.front()];
  PassageRequest asked;
  asked.rate = request;
  asked.rate.lanes = {worst.place.y};
  asked.towards_right = worst.place.towards_right;
  asked.passages = count;
  asked.stop = &stop_request();
  for (const double share : passage_shares) asked.factors.push_back(share * worst.factor);
  reports.say(fmt::format("{} with each of {}", counted(count, "passage"), counted(asked.factors.size(), "factor")));
  return passages(c, assembly, asked, [&](const std::string& text) { reports.say(text); });
}

/// Writes the table and the chart of the repeated passages. False if it was stopped.
bool add_passages(const std::vector<PassageSeries>& all, double adequacy, const std::string& out, bool quiet,
                  RatePageWords& words) {
  if (all.empty()) return false;
  write_atomically(out + "/passages.csv", passages_csv(all));
  write_atomically(out + "/images/ratchet.svg", ratchet_chart(all));
  if (!quiet) fmt::print("{}\n", passages_text(all, adequacy));
  words.passages = all;
  return true;
}

/// Adds the pictures of the two runs, and writes the chart of their thrust lines. False if it was stopped.
bool add_runs(std::optional<WorstRuns> runs, const std::string& out, RatePageWords& words) {
  if (!runs) return false;
  words.pictures = std::move(runs->pictures);
  words.thrust = thrust_chart(runs->thrust);
  if (!words.thrust.empty()) write_atomically(out + "/images/thrust.svg", words.thrust);
  return true;
}

/// Says how far a rating came that was stopped. Returns the exit status.
int stopped(const Rating& rating) {
  fmt::print(stderr, "interrupted after {} of {}. The same command continues the rating.\n", rating.places.size(),
             counted(rating.planned, "position"));
  return 1;
}

int rate_bridge(const std::vector<std::string>& arguments) {
  CommandLine line("rate", "rate CASE --vehicle NAME [--vehicle …] [-o DIR] [--strip W]",
                   "voussoir rate cases/bridges/prestwood.toml --vehicle cs454-normal-single --strip 0.3 -o rated");
  line.described.add_options()("output,o", options::value<std::string>()->value_name("DIR"),
                               "folder to write to (default: rate-CASE)")(
      "vehicle", options::value<Words>()->value_name("NAME"),
      "a vehicle that 'voussoir vehicles' lists, or a vehicle file; may be repeated")(
      "variant", options::value<std::string>()->value_name("NAME"),
      "a variant of the vehicles, such as lift-off; all: each variant, and the vehicle itself")(
      "factor", options::value<std::string>()->value_name("NAME"),
      "name of a dynamic factor of the vehicles (default: none is applied)")(
      "span", real_option("span", 0.1, 1000.0)->value_name("L"), "span for dynamic factors that depend on it, m")(
      "cover", real_option("cover", 0.0, 100.0)->value_name("H"),
      "cover over the crown for dynamic factors that depend on it, m")(
      "lane", options::value<std::vector<double>>()->value_name("Y"),
      "y of the centre line of the vehicle, m; may be repeated (default: 0)")(
      "step", real_option("step", 0.01, 100.0)->value_name("M"),
      "distance between positions, m (default: a tenth of the shortest span)")(
      "from", real_option("from", -1e4, 1e4)->value_name("X"),
      "smallest x of the middle of the axles, m (default: all vaults)")(
      "to", real_option("to", -1e4, 1e4)->value_name("X"),
      "largest x of the middle of the axles, m (default: all vaults)")(
      "refine", whole_option("refine", 0, 10)->value_name("N")->default_value(2),
      "number of halvings of the distance around the worst position")("one-way", "the vehicle faces right only")(
      "strip", real_option("strip", 0.05, 5.0)->value_name("W"),
      "model a strip of this width, m, in plane strain (default: the whole bridge)")(
      "effective-width", real_option("effective-width", 0.1, 100.0)->value_name("B"),
      "with --strip: width that carries one vehicle, m (default: wheels + 1.5 m + cover)")(
      "most", real_option("most", 0.01, 1e6)->value_name("F")->default_value(30.0), "largest factor of the search")(
      "tolerance", real_option("tolerance", 1e-6, 1e3)->value_name("T")->default_value(0.05, "0.05"),
      "tolerance of the factor")("mexe", options::value<std::string>()->value_name("FILE"),
                                 "input of the MEXE method (docs/rating.md); its result is printed as well")(
      "passages", whole_option("passages", 3, 10'000)->value_name("N"),
      "move the first vehicle over the bridge N times with 0.3 to 0.9 of its adequacy factor")(
      "no-runs", "leave out the two runs of the worst position and their pictures");
  line.positional = line.required = {"CASE"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const std::string file = values["CASE"].as<std::string>();
  const bool quiet = values.count("quiet") > 0;
  RateRequest request;
  request.vehicles = vehicles_asked(values);
  if (values.count("lane")) request.lanes = lanes_asked(values["lane"].as<std::vector<double>>());
  if (values.count("step")) request.step = values["step"].as<double>();
  if (values.count("from")) request.from = values["from"].as<double>();
  if (values.count("to")) request.to = values["to"].as<double>();
  request.refinements = values["refine"].as<int>();
  request.both_ways = values.count("one-way") == 0;
  request.most = values["most"].as<double>(), request.tolerance = values["tolerance"].as<double>();
  request.threads = threads_asked(values);
  Reports reports(quiet);
  reports.say(fmt::format("reading {}", file));
  RatePageWords words;
  if (values.count("mexe")) words.beside = mexe_text(mexe(read_mexe(values["mexe"].as<std::string>())));
  const Case given = read_case(file);
  const Case c = loaded_case(given, values, request, words.remarks);
  for (const std::string& remark : vehicle_remarks(values, request.vehicles)) words.remarks.push_back(remark);
  const std::string name = fs::path(file).stem().string();
  const std::string out = values.count("output") ? values["output"].as<std::string>() : "rate-" + name;
  words.title = "Rating: " + name;
  const Assembly assembly = make_assembly(c);
  stop_on_signals();
  const PlaceStore store(out + "/places", c, assembly, request);
  const Rating rating = rate(c, assembly, request, observers_of(request, store, reports));
  if (rating.places.empty()) return stopped(rating);
  make_folder_of(out + "/rate.json");
  write_json(out + "/rate.json", rating_json(rating, request));
  write_atomically(out + "/rate.csv", rating_csv(rating, request));
  make_folder_of(out + "/images/rate.svg");
  write_atomically(out + "/images/rate.svg", influence_chart(rating, request));
  bool whole = rating.complete();
  if (whole && values.count("passages"))
    whole = add_passages(pass_repeatedly(c, assembly, request, rating, values["passages"].as<int>(), reports),
                         rating.places[rating.worst.front()].factor, out, quiet, words);
  if (whole && !values.count("no-runs")) whole = add_runs(run_worst(c, request, rating, out, reports), out, words);
  write_atomically(out + "/report.html", rate_page(rating, request, words));
  if (!quiet)
    fmt::print("{}{}\n{}/report.html, rate.csv, rate.json\n", rating_text(rating, request), words.beside, out);
  if (!whole) return stopped(rating);
  store.clear();
  return 0;
}

}  // namespace

Verb rate_verb() {
  return {"rate", "find which vehicles a bridge can carry (adequacy factors at the worst positions)", rate_bridge};
}

}  // namespace voussoir
