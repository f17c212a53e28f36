// voussoir cracks.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "io/hdf5/h5.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"
#include "solver/step/make_snapshot.h"
#include "tools/run/stored_state.h"
#include "tools/voussoir/options.h"
#include "viz/crack_map/crack_files.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kListed = 20;

void print_cracks(const std::vector<Crack>& cracks, double threshold) {
  if (cracks.empty()) {
    fmt::print("no joint has opened or slid by {:g} mm or more\n", 1e3 * threshold);
    return;
  }
  fmt::print("{:>4}  {:>10} {:>10} {:>10}  {}\n", "", "open, mm", "slid, mm", "long, m", "where, direction");
  for (std::size_t k = 0; k < std::min(cracks.size(), kListed); ++k) {
    const Crack& c = cracks[k];
    fmt::print("{:>4}  {:>10} {:>10} {:>10.2f}  {}; {}\n", c.number,
               c.ever.fallen() ? "fell" : width_text(c.ever.opening), width_text(c.ever.slip), c.length, c.where,
               c.direction);
  }
  if (cracks.size() > kListed) fmt::print("and {} more\n", cracks.size() - kListed);
}

std::vector<std::string> formats_in(const std::string& list) {
  const std::vector<std::string> formats = words_in(list);
  for (const std::string& format : formats)
    if (format != "svg" && format != "pdf" && format != "png")
      throw InputError("--format contains '{}'. Give svg, pdf, png or several, separated by commas", shown(format));
  if (formats.empty()) throw InputError("--format is empty. Give svg, pdf, png or several, separated by commas");
  return formats;
}

/// The stem of the files of -o: in a folder, "crack_map"; an ending is removed and selects the format.
std::string stem_of(const std::string& output, std::vector<std::string>& formats, bool formats_given) {
  std::error_code ignored;
  if (output.ends_with('/') || fs::is_directory(output, ignored)) return (fs::path(output) / "crack_map").string();
  fs::path stem = output;
  for (const char* format : {"svg", "pdf", "png"})
    if (stem.extension() == std::string(".") + format) {
      if (!formats_given) formats = {format};
      return stem.replace_extension().string();
    }
  return output;
}

int cracks(const std::vector<std::string>& arguments) {
  CommandLine line("cracks", "cracks RUN|CHECKPOINT [-o STEM]", "voussoir cracks demo -o demo-cracks --threshold 1");
  line.described.add_options()("output,o", options::value<std::string>()->value_name("STEM"),
                               "files STEM.svg, STEM.pdf, STEM.png and STEM.csv, or a folder for them (default: "
                               "RUN/images/crack_map and RUN/cracks.csv, or named after the checkpoint)")(
      "threshold",
      real_option("threshold", 0.001, 1000.0)->default_value(1e3 * kCrackThreshold, "0.3")->value_name("MM"),
      "opening or slip that counts as a crack, mm")("now", "show only the present opening and slip")(
      "ever", "show only the largest opening and slip since the start (default: both, if they differ)")(
      "format", options::value<std::string>()->default_value("svg,pdf,png")->value_name("LIST"),
      "formats, separated by commas: svg, pdf, png");
  line.positional = line.required = {"RUN"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  if (values.count("now") && values.count("ever"))
    throw InputError("--now and --ever are both given. Give only one of them, or leave out both to get both");
  std::vector<std::string> formats = formats_in(values["format"].as<std::string>());
  const std::string from = values["RUN"].as<std::string>();
  std::error_code ignored;
  if (!fs::exists(from, ignored)) throw InputError("there is no file or folder {}", from);
  const bool directory = fs::is_directory(from, ignored);
  if (!directory && !h5::File::is_hdf5(from))
    throw InputError("{} is not a checkpoint. Give a run directory or one of its checkpoints", from);
  const StoredState stored = read_stored_state(directory ? newest_checkpoint(from) : from);
  const double threshold = 1e-3 * values["threshold"].as<double>();
  const CrackState by = values.count("now") ? CrackState::now : CrackState::ever;
  const CrackMap map(stored.assembly, make_snapshot(stored.model, stored.state),
                     {fs::path(stored.run).filename().string(), fmt::format("state at {:.3f} s", stored.header.time)},
                     threshold, by);
  std::vector<CrackState> states = {by};
  if (!values.count("now") && !values.count("ever") && map.has_changed()) states.push_back(CrackState::now);
  std::string stem = directory ? from + "/images/crack_map" : fs::path(from).stem().string() + "_cracks";
  if (values.count("output"))
    stem = stem_of(values["output"].as<std::string>(), formats, !values["format"].defaulted());
  std::vector<std::string> files = write_crack_map(map, states, formats, stem);
  files.push_back(values.count("output") || !directory ? stem + ".csv" : from + "/cracks.csv");
  write_atomically(files.back(), crack_table(map.cracks()));
  if (values.count("quiet")) return 0;
  print_cracks(map.cracks(), threshold);
  fmt::print("{}\n", fmt::join(files, "\n"));
  return 0;
}

}  // namespace

Verb cracks_verb() {
  return {"cracks", "draw the crack map of a run and list its cracks", cracks};
}

}  // namespace voussoir
