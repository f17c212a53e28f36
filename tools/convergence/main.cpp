// voussoir-convergence: dependence of results on integration points, joint stiffness, time step and load rate, as
// tables and pictures.
#include <fmt/format.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <filesystem>
#include <iostream>

#include "solver/base/error.h"
#include "solver/base/program.h"
#include "tools/convergence/studies.h"
#include "viz/chart_picture.h"

namespace voussoir {
namespace {

constexpr const char* help_example = "\nexample:\n  voussoir-convergence --study step -o pictures > step.md\n";

std::string known_studies() {
  std::string text;
  for (const NamedStudy& study : convergence_studies()) text += fmt::format("  {:<12}{}\n", study.name, study.help);
  return text;
}

void show(const NamedStudy& named, const std::string& folder, bool blank_before) {
  const Study study = named.run();
  fmt::print("{}{}", blank_before ? "\n" : "", markdown(study));
  std::cout.flush();
  if (folder.empty()) return;
  for (StudyChart drawn : study.charts) {
    number_curves(drawn.chart);
    for (ChartCurve& curve : drawn.chart.curves) curve.dots = drawn.chart.log_x;
    write_picture(drawn.chart, fmt::format("{}/convergence_{}.png", folder, drawn.name));
  }
}

int run(int argc, char** argv) {
  namespace po = boost::program_options;
  po::options_description described(
      "Usage: voussoir-convergence [--study NAME]… [-o DIR]\n\nPrints errors against integration points, joint "
      "stiffness, time step and load rate as Markdown tables");
  described.add_options()("help,h", "print this text")("study,s", po::value<std::vector<std::string>>(),
                                                       "name of a study; may be repeated; default: all studies")(
      "output,o", po::value<std::string>()->default_value(""),
      "folder for pictures (convergence_*.png); default: no pictures");
  po::variables_map values;
  try {
    po::store(po::command_line_parser(argc, argv).options(described).run(), values);
    po::notify(values);
  } catch (const po::error& e) {
    throw InputError("{}. See voussoir-convergence --help", e.what());
  }
  if (values.count("help")) return std::cout << described << "\nstudies:\n" << known_studies() << help_example, 0;
  std::vector<std::string> wanted;
  if (values.count("study")) wanted = values["study"].as<std::vector<std::string>>();
  for (const std::string& name : wanted) {
    const auto& all = convergence_studies();
    if (std::none_of(all.begin(), all.end(), [&](const NamedStudy& s) { return s.name == name; }))
      throw InputError("unknown study '{}'. The studies are\n{}", name, known_studies());
  }
  const auto folder = values["output"].as<std::string>();
  if (!folder.empty()) std::filesystem::create_directories(folder);
  bool shown = false;
  for (const NamedStudy& study : convergence_studies()) {
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), study.name) == wanted.end()) continue;
    show(study, folder, shown);
    shown = true;
  }
  return 0;
}

}  // namespace
}  // namespace voussoir

int main(int argc, char** argv) {
  return voussoir::run_program("voussoir-convergence", voussoir::run, argc, argv);
}
