#include "tools/bench/search.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>

#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "tools/bench/machine.h"
#include "tools/diagnosis/diagnosis_input.h"
#include "tools/hide/hide.h"

namespace voussoir {

namespace {

namespace fs = std::filesystem;

/// A temporary folder that the destructor removes.
struct ScratchFolder {
  fs::path path = fs::temp_directory_path() / fmt::format("voussoir-bench-search-{}", ::getpid());
  ScratchFolder() { fs::create_directories(path); }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
};

template <class Work>
auto timed(SearchCost::Seconds& seconds, const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  const double processor = processor_time();
  auto result = work();
  seconds.processor = processor_time() - processor;
  seconds.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

/// A case, and measurements of its bridge with both abutments restrained, on blocks of the same size.
DiagnosisRequest measured_scene(const SearchScene& scene, const ScratchFolder& folder) {
  HideRequest hidden;
  hidden.case_file = folder.path / "bridge.toml";
  write_atomically(hidden.case_file,
                   fmt::format("[bridge]\ngenerator = \"{}\"\nabutments = \"free\"\nblock_scale = {}\n",
                               scene.generator, scene.scale));
  hidden.effects = {{"abutment_restraint", "both", {{"stiffness_share", 0.5}}}};
  hidden.sensors = "rich";
  hidden.modes = 10;
  hidden.mesh = 1.0;
  DiagnosisRequest request;
  request.c = read_case(hidden.case_file, CaseUse::geometry);
  request.measured = folder.path / "measured";
  write_measured(hide(hidden).measured, request.measured);
  return request;
}

}  // namespace

const std::vector<SearchScene>& search_scenes() {
  static const std::vector<SearchScene> list = {
      {"diagnosis-cs1",
       "search for the effect that CS1 lacks, with ten modes at its sensors (diagnosis-cs1@2: block_scale = 2)", "cs1",
       1.0},
      {"diagnosis-cs2", "the same for CS2", "cs2", 1.0}};
  return list;
}

std::optional<SearchScene> find_search(const std::string& name) {
  const std::size_t at = name.find('@');
  for (SearchScene scene : search_scenes()) {
    if (scene.name != name.substr(0, at)) continue;
    if (at == std::string::npos) return scene;
    char* end = nullptr;
    scene.scale = std::strtod(name.c_str() + at + 1, &end);
    if (*end != '\0' || !(scene.scale > 0.0))
      throw InputError("scene '{}': the block_scale is '{}'. It must be a positive number, as in diagnosis-cs1@2", name,
                       name.substr(at + 1));
    scene.name = name;
    return scene;
  }
  return std::nullopt;
}

SearchCost time_search(const SearchScene& scene, int threads) {
  const ScratchFolder folder;
  DiagnosisRequest request = measured_scene(scene, folder);
  request.settings.threads = threads;
  SearchCost cost;
  const DiagnosisInput input = timed(cost.input, [&] { return diagnosis_input(request); });
  const Diagnosis d =
      timed(cost.search, [&] { return diagnose(input.problem, request.settings, [](const std::string&) {}); });
  cost.unknowns = input.problem.origin->model().unknowns.count;
  cost.sensors = input.problem.features.sensors.size();
  cost.modes = input.problem.features.modes.size();
  cost.rounds = d.rounds.size() + d.nameless.size();
  for (const auto* rounds : {&d.rounds, &d.nameless})
    for (const Round& round : *rounds) cost.screened += round.screened.size(), cost.fitted += round.trials.size();
  cost.verdict = verdict_name(d.verdict);
  return cost;
}

}  // namespace voussoir
