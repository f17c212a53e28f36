// voussoir-blind: hides effects in measurements, runs the diagnosis with only the case and the measurements, and
// scores the result.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <boost/program_options.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <mutex>
#include <thread>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/program.h"
#include "tools/blind/invariance.h"
#include "tools/blind/score.h"

namespace fs = std::filesystem;

namespace voussoir {
namespace {

struct Request {
  std::string directory = "blind", suite = "first";
  int jobs = int(std::max(1u, std::thread::hardware_concurrency())), first = 1, last = 0;  // last 0: all
  bool list = false, invariance = false;
};

/// False if --help was given.
bool read_request(int argc, char** argv, Request& r) {
  namespace po = boost::program_options;
  po::options_description described("Options");
  described.add_options()("help,h", "print this text")(
      "suite", po::value<std::string>(&r.suite)->default_value(r.suite),
      "suite of trials; first: defined by hand; second, third: drawn by the same rule from two seeds")(
      "output,o", po::value<std::string>(&r.directory)->default_value(r.directory), "output folder")(
      "jobs,j", po::value<int>(&r.jobs)->default_value(r.jobs), "number of trials at a time, with one thread each")(
      "first", po::value<int>(&r.first)->default_value(r.first), "number of the first trial")(
      "last", po::value<int>(&r.last)->default_value(r.last), "number of the last trial; 0: the last of the suite")(
      "list", po::bool_switch(&r.list), "print what is hidden in each bridge, and run nothing")(
      "invariance", po::bool_switch(&r.invariance),
      "also diagnose copies of the measurements that are rounded, scaled, reordered or in another unit; the verdicts "
      "must not change");
  po::variables_map values;
  po::store(po::parse_command_line(argc, argv, described), values);
  po::notify(values);
  if (values.count("help")) std::cout << "Usage: voussoir-blind [--suite NAME] [-o DIR] [--jobs N]\n\n" << described;
  return !values.count("help");
}

void list_trials(const Suite& suite, const Request& r) {
  for (int n = r.first; n <= r.last; ++n) {
    const BlindTrial& t = suite.trials[std::size_t(n - 1)];
    fmt::print("{:2} {} sensors {}, noise {:g} %: {} ({})\n", n, t.bridge, t.sensors, 100.0 * t.noise,
               hidden_text(t, t.effects), truth_text(t));
  }
}

/// Runs trials of a suite in parallel, in the order of their numbers.
class Runner {
 public:
  Runner(const Suite& suite, const Request& request) : suite_(suite), request_(request) {
    outcomes_.resize(std::size_t(request.last - request.first + 1));
    copies_.resize(outcomes_.size());
    program_ = (fs::canonical("/proc/self/exe").parent_path() / "voussoir").string();
  }
  void run() {
    std::vector<std::thread> workers;
    for (int worker = 0; worker < request_.jobs; ++worker)
      workers.emplace_back([this] {
        for (std::size_t i = next_++; i < outcomes_.size(); i = next_++) run_one(i);
      });
    for (std::thread& worker : workers) worker.join();
  }
  std::string report() const {
    std::string text =
        fmt::format("{}\n{}\n{}", scores_table(outcomes_, suite_), confusion_table(outcomes_), trials_table(outcomes_));
    if (request_.invariance) text += fmt::format("\n{}", invariance_table(copies_));
    return text;
  }

 private:
  void run_one(std::size_t i) {
    const std::size_t number = std::size_t(request_.first) + i;
    Outcome& o = outcomes_[i];
    o.number = number;
    o.trial = &suite_.trials[number - 1];
    o.effects = o.trial->effects;
    const auto begin = std::chrono::steady_clock::now();
    try {
      const std::string folder = fmt::format("{}/{:02}", request_.directory, number);
      const TrialRun run = run_trial(*o.trial, program_, folder);
      score(run, suite_.confident, o);
      copies_[i].number = number;
      if (request_.invariance) copies_[i] = compare_copies(*o.trial, number, run.diagnosis, program_, folder);
    } catch (const std::exception& e) {
      o.said = fmt::format("failed: {}", e.what());
    }
    o.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const std::lock_guard lock(printing_);
    fmt::print("{:2} {:4} {:40} {:.1f} {} ({:.0f} s)\n", number, o.trial->bridge, hidden_text(*o.trial, o.effects),
               o.score, o.said, o.seconds);
    std::fflush(stdout);
  }

  const Suite& suite_;
  const Request& request_;
  std::string program_;
  std::vector<Outcome> outcomes_;
  std::vector<Invariance> copies_;
  std::atomic<std::size_t> next_{0};
  std::mutex printing_;
};

int run(int argc, char** argv) {
  Request request;
  if (!read_request(argc, argv, request)) return 0;
  const Suite suite = find_suite(request.suite);
  const int count = int(suite.trials.size());
  if (request.last == 0) request.last = count;
  if (request.first < 1 || request.last > count || request.first > request.last || request.jobs < 1)
    throw InputError("--first and --last must be trials from 1 to {}, and --jobs must be at least 1", count);
  if (request.list) {
    list_trials(suite, request);
    return 0;
  }
  const auto begin = std::chrono::steady_clock::now();
  Runner runner(suite, request);
  runner.run();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const std::string report = fmt::format("{}\n{:.0f} s of wall-clock time, {} at a time\n", runner.report(), seconds,
                                         counted(request.jobs, "trial"));
  fs::create_directories(request.directory);
  std::ofstream(request.directory + "/blind.md") << report;
  fmt::print("\n{}", report);
  return 0;
}

}  // namespace
}  // namespace voussoir

int main(int argc, char** argv) {
  return voussoir::run_program("voussoir-blind", voussoir::run, argc, argv);
}
