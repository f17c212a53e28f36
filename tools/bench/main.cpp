// voussoir-bench: measures the time of a time step, phase by phase, and compares it with the limits of the machine. It
// also measures the time of a diagnosis.
#include <fmt/format.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/json_file.h"
#include "solver/base/program.h"
#include "solver/contact/search.h"
#include "tools/bench/machine.h"
#include "tools/bench/phases.h"
#include "tools/bench/search.h"

namespace voussoir {
namespace {

struct Options {
  std::vector<std::string> scenes;
  int threads = 1;
  double seconds = 5.0;
  std::int64_t steps = 0;  // replaces `seconds` if not 0
  double reserve = 0.0;    // GB
  bool quiet = false;
  std::string keep;
};

struct Measured {
  double step = 0.0, processor = 0.0;  // s, wall-clock time and processor time of a time step
  Progressed all;
};

/// The next number of time steps after which patches may be clipped again. Pieces that end elsewhere would interrupt a
/// sweep through memory. Large scenes, whose pieces have few time steps, would suffer more from this than small ones.
std::int64_t whole_sweeps(double steps) {
  return std::int64_t(std::ceil(steps / double(clip_interval))) * clip_interval;
}

/// Medians over the pieces of a run that has the required number of time steps, or lasts the required time.
Measured measure(Running& scene, double movable, const Options& o) {
  const std::int64_t piece = whole_sweeps(1000000.0 / movable);
  const auto goes_on = [&](const Measured& m, std::size_t pieces) {
    return o.steps > 0 ? m.all.steps < o.steps : pieces < 3 || (m.all.seconds < o.seconds && pieces < 200);
  };
  const std::int64_t now = scene.state.step(), quarter = piece / 4;
  advance_scene(scene, whole_sweeps(double(now + quarter)) - now);  // warm caches, settled threads
  Measured m;
  std::vector<double> steps, processor;
  while (goes_on(m, steps.size())) {
    const Progressed p = advance_scene(scene, piece);
    steps.push_back(p.seconds / double(p.steps));
    processor.push_back(p.processor_seconds / double(p.steps));
    m.all.steps += p.steps, m.all.intact += p.intact, m.all.points += p.points, m.all.searches += p.searches;
    m.all.seconds += p.seconds, m.all.search_seconds += p.search_seconds;
    m.all.examined += p.examined, m.all.changed += p.changed, m.all.listed += p.listed;
  }
  const auto median = [](std::vector<double>& v) {
    std::sort(v.begin(), v.end());
    return v[v.size() / 2];
  };
  m.step = median(steps), m.processor = median(processor);
  return m;
}

/// Shortest time (s) in which the machine can do the work: for its bytes or its operations, whichever takes longer.
double least_time(const Work& work, double bandwidth, double peak) {
  return std::max(work.bytes / bandwidth, work.operations / peak);
}

nlohmann::json phase_rows(const std::vector<Phase>& phases, double bandwidth, double peak, bool quiet) {
  nlohmann::json rows = nlohmann::json::array();
  if (!quiet)
    fmt::print("  {:<22} {:>10} {:>10} {:>9} {:>10} {:>10} {:>9}\n", "phase, one thread", "items/step", "µs/step",
               "ns/item", "MB/step", "Mop/step", "of limit");
  for (const Phase& p : phases) {
    const double least = least_time(p.work, bandwidth, peak);
    const double share = p.seconds > 0.0 ? least / p.seconds : 0.0;
    rows.push_back({{"phase", p.name},
                    {"items", p.items},
                    {"seconds", p.seconds},
                    {"bytes", p.work.bytes},
                    {"operations", p.work.operations},
                    {"limit_share", share}});
    if (quiet || p.items <= 0.0) continue;
    fmt::print("  {:<22} {:>10.4g} {:>10.1f} {:>9.1f} {:>10} {:>10} {:>9}\n", p.name, p.items, 1e6 * p.seconds,
               1e9 * p.seconds / p.items, least > 0.0 ? fmt::format("{:.3f}", 1e-6 * p.work.bytes) : "–",
               least > 0.0 ? fmt::format("{:.3f}", 1e-6 * p.work.operations) : "–",
               least > 0.0 ? fmt::format("{:.0f} %", 100.0 * share) : "–");
  }
  return rows;
}

nlohmann::json run_scene(const Scene& scene, const Options& o, double peak) {
  const auto running = begin_scene(scene, o.threads, o.keep);
  Running& r = *running;
  const double movable =
      double(std::count_if(r.model.bodies.begin(), r.model.bodies.end(), [](const Body& b) { return !b.fixed; }));
  const Measured m = measure(r, movable, o);
  const std::vector<Phase> phases = step_phases(r, whole_sweeps(300000.0 / movable));
  Work work;
  for (const Phase& p : phases) work.bytes += p.work.bytes, work.operations += p.work.operations;
  const double bandwidth = copy_bandwidth(work.bytes, o.threads);
  const double one = o.threads == 1 ? bandwidth : copy_bandwidth(work.bytes, 1);
  const double joints = double(r.model.joints.size());
  const double intact = double(m.all.intact) / double(std::max<std::int64_t>(1, m.all.intact + m.all.points));
  const SideCosts side = side_costs(r);
  const double limit = least_time(work, bandwidth, peak * o.threads) / m.step;
  if (!o.quiet) {
    fmt::print(
        "\n{}: {:.0f} blocks, {:.0f} joints, {}, {}, {} of {:.3g} s\n  {:.3f} µs per block and time step ({:.3f} of "
        "processor time), {:.1f} ns per joint; {:.1f} % intact; {:.0f} % of the limit; {:.4f} simulated s per "
        "wall-clock s\n",
        scene.name, movable, joints, counted(r.state.contact_count(), "contact"), counted(o.threads, "thread"),
        counted(m.all.steps, "time step"), r.stepper.dt, 1e6 * m.step / movable, 1e6 * m.processor / movable,
        1e9 * m.step / joints, 100 * intact, 100 * limit, r.stepper.dt / m.step);
    if (m.all.searches > 0)
      fmt::print(
          "  contact searches: one in {:.1f} time steps, {:.3g} ms each, {:.0f} pairs examined; {:.0f} % change "
          "contacts, {:.1f} % make a new list of pairs\n",
          double(m.all.steps) / double(m.all.searches), 1e3 * m.all.search_seconds / double(m.all.searches),
          double(m.all.examined) / double(m.all.searches), 100.0 * double(m.all.changed) / double(m.all.searches),
          100.0 * double(m.all.listed) / double(m.all.searches));
    fmt::print("  copy bandwidth in {:.1f} MB {:.1f} GB/s\n", 1e-6 * work.bytes, 1e-9 * bandwidth);
    if (!r.account.empty()) fmt::print("  {}\n", r.account);
  }
  const nlohmann::json rows = phase_rows(phases, one, peak, o.quiet);
  if (!o.quiet)
    fmt::print(
        "  contact search over all bodies {:.4g} ms, row of history {:.4g} ms, checkpoint {:.4g} ms\n"
        "  per block: generation {:.3g} µs, model {:.3g} µs, time step {:.3g} µs, first search {:.3g} µs, equilibrium "
        "{:.4g} µs, model and state {:.2f} kB\n",
        1e3 * side.search, 1e3 * side.history, 1e3 * side.checkpoint, 1e6 * r.generation / movable,
        1e6 * r.modelling / movable, 1e6 * r.choosing / movable, 1e6 * r.search / movable,
        1e6 * r.equilibrium / movable, 1e-3 * bytes_held(r) / movable);
  return {{"blocks", movable},
          {"joints", joints},
          {"steps", m.all.steps},
          {"threads", o.threads},
          {"us_per_block_step", 1e6 * m.step / movable},
          {"us_per_block_step_processor", 1e6 * m.processor / movable},
          {"ns_per_joint_step", 1e9 * m.step / joints},
          {"intact_share", intact},
          {"bytes_per_step", work.bytes},
          {"operations_per_step", work.operations},
          {"copy_bandwidth", bandwidth},
          {"contacts", r.state.contact_count()},
          {"searches_per_step", double(m.all.searches) / double(m.all.steps)},
          {"limit_share", limit},
          {"sim_seconds_per_wall_second", r.stepper.dt / m.step},
          {"time_step", r.stepper.dt},
          {"phases", rows},
          {"search_seconds", side.search},
          {"history_seconds", side.history},
          {"checkpoint_seconds", side.checkpoint},
          {"generation_seconds", r.generation},
          {"model_seconds", r.modelling},
          {"time_step_seconds", r.choosing},
          {"first_search_seconds", r.search},
          {"equilibrium_seconds", r.equilibrium},
          {"bytes_held", bytes_held(r)},
          {"peak_memory", peak_memory()}};
}

nlohmann::json run_search(const SearchScene& scene, const Options& o) {
  const SearchCost c = time_search(scene, o.threads);
  if (!o.quiet)
    fmt::print(
        "\n{}: {}, {}, {}, {}; {} screened, {} fitted in {}: {}\n  input {:.1f} s ({:.1f} s of processor time), search "
        "{:.1f} s ({:.1f}); largest memory {:.2f} GB\n",
        scene.name, counted(c.unknowns, "unknown"), counted(c.sensors, "sensor"), counted(c.modes, "mode"),
        counted(o.threads, "thread"), counted(c.screened, "candidate"), c.fitted, counted(c.rounds, "round"), c.verdict,
        c.input.wall, c.input.processor, c.search.wall, c.search.processor, 1e-9 * peak_memory());
  return {{"unknowns", c.unknowns},
          {"sensors", c.sensors},
          {"modes", c.modes},
          {"threads", o.threads},
          {"screened", c.screened},
          {"fitted", c.fitted},
          {"rounds", c.rounds},
          {"verdict", c.verdict},
          {"input_seconds", c.input.wall},
          {"input_processor_seconds", c.input.processor},
          {"search_seconds", c.search.wall},
          {"search_processor_seconds", c.search.processor},
          {"peak_memory", peak_memory()}};
}

Options parse(int argc, char** argv, bool& done, std::string& folder) {
  namespace po = boost::program_options;
  po::options_description described(
      "voussoir-bench [SCENE…] [--threads N]: measures the cost of a time step, phase by phase");
  described.add_options()("help,h", "print this help")("list", "list the scenes and stop")(
      "threads,j", po::value<int>()->default_value(1), "number of threads")(
      "seconds", po::value<double>()->default_value(5.0), "shortest wall-clock time for each scene, s")(
      "steps", po::value<std::int64_t>()->default_value(0),
      "smallest number of time steps for each scene, in place of --seconds; the same for any number of threads and for "
      "any program")("reserve", po::value<double>()->default_value(0.0),
                     "memory to take from the system before the measurement, GB; for large scenes, because the host of "
                     "a virtual machine may need seconds to provide each GB")(
      "keep", po::value<std::string>()->default_value(""),
      "folder for the states of scenes, from which a later call begins")(
      "output,o", po::value<std::string>()->default_value("."), "folder for bench.json")(
      "scene", po::value<std::vector<std::string>>(), "scenes (default: the walls of up to 1040 blocks)")(
      "quiet,q", "print no tables");
  po::positional_options_description places;
  places.add("scene", -1);
  po::variables_map values;
  try {
    po::store(po::command_line_parser(argc, argv).options(described).positional(places).run(), values);
    po::notify(values);
  } catch (const po::error& e) {
    throw InputError("{}. See voussoir-bench --help", e.what());
  }
  done = true;
  Options o;
  if (values.count("help")) return std::cout << described << "\n", o;
  if (values.count("list")) {
    for (const Scene& scene : scenes()) fmt::print("{:<18} {}\n", scene.name, scene.help);
    for (const SearchScene& scene : search_scenes()) fmt::print("{:<18} {}\n", scene.name, scene.help);
    return o;
  }
  done = false;
  if (values.count("scene")) o.scenes = values["scene"].as<std::vector<std::string>>();
  if (o.scenes.empty())
    for (const Scene& scene : scenes())
      if (scene.name.find("wall-10") == 0 && scene.name.find('k') == std::string::npos) o.scenes.push_back(scene.name);
  o.threads = values["threads"].as<int>();
  if (o.threads < 1) throw InputError("--threads is {}. It must be at least 1", o.threads);
  o.seconds = values["seconds"].as<double>();
  o.steps = values["steps"].as<std::int64_t>();
  if (o.steps < 0) throw InputError("--steps is {}. It must be 0 (as many as fit into --seconds) or more", o.steps);
  o.reserve = values["reserve"].as<double>();
  if (!(o.reserve >= 0.0 && o.reserve < 1e6))
    throw InputError("--reserve is {}. It must be a number of gigabytes from 0 to 1e6", o.reserve);
  o.quiet = values.count("quiet") > 0;
  o.keep = values["keep"].as<std::string>();
  folder = values["output"].as<std::string>();
  return o;
}

int run(int argc, char** argv) {
  bool done = false;
  std::string folder;
  const Options o = parse(argc, argv, done, folder);
  if (done) return 0;
  bool stepped = false;
  for (const std::string& name : o.scenes)  // before anything is timed
    if (!find_search(name)) find_scene(name), stepped = true;
  reserve_memory(1e9 * o.reserve);
  const double peak = stepped ? multiply_add_peak(1) : 0.0;
  if (stepped && !o.quiet)
    fmt::print("multiply–add peak {:.1f} Gop/s on one thread, copy bandwidth in memory {:.1f} GB/s on {}\n",
               1e-9 * peak, 1e-9 * copy_bandwidth(512e6, o.threads), counted(o.threads, "thread"));
  nlohmann::json all = nlohmann::json::object();
  for (const std::string& name : o.scenes) {
    const std::optional<SearchScene> scene = find_search(name);
    all[name] = scene ? run_search(*scene, o) : run_scene(find_scene(name), o, peak);
    write_json(folder + "/bench.json", all);
  }
  return 0;
}

}  // namespace
}  // namespace voussoir

int main(int argc, char** argv) {
  return voussoir::run_program("voussoir-bench", voussoir::run, argc, argv);
}
