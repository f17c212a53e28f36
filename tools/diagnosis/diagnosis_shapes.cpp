#include "tools/diagnosis/diagnosis_shapes.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "io/vtk/files.h"
#include "io/vtk/grid.h"
#include "io/vtk/series.h"

namespace voussoir {

namespace fs = std::filesystem;

Mode computed_mode(const Evaluation& e, int computed) {
  Mode mode;
  mode.frequency = std::exp(e.response.log_frequency[computed]);
  mode.shape = BlockMotions::Zero(Eigen::Index(e.assembly.blocks.size()), 6);
  mode.nodes = NodeMotions::Zero(Eigen::Index(e.assembly.fill.nodes.size()), 3);
  const Eigen::VectorXd vector = e.response.vectors.col(computed);
  double largest = 0.0;
  for (std::size_t i = 0; i < e.assembly.blocks.size(); ++i) {
    const Vector6 part = part_of(vector, e.model.unknowns, i);
    mode.shape.row(Eigen::Index(i)) = part;
    largest = std::max(largest, part.head<3>().norm());
  }
  for (std::size_t n = 0; n < e.assembly.fill.nodes.size(); ++n)
    mode.nodes.row(Eigen::Index(n)) = part_of(vector, e.model.unknowns, e.model.unknowns.bodies + n).head<3>();
  mode.shape /= largest;
  mode.nodes /= largest;
  mode.words = e.response.words[std::size_t(computed)];
  return mode;
}

void write_diagnosis_shapes(const DiagnosisResult& result, const std::string& directory) {
  const fs::path folder = fs::path(directory) / "vtk";
  for (const bool before : {true, false}) {
    const Fit& fit = before ? result.before : result.after;
    const std::string when = before ? "before" : "after";
    const auto fresh = [&](const std::string& name) {
      PvdSeries series((folder / name).string());
      series.keep_first(0);
      return series;
    };
    PvdSeries series = fresh("modes_" + when + ".pvd"), fill_series = fresh("modes_" + when + "_fill.pvd");
    for (std::size_t i = 0; i < result.modes.size(); ++i) {
      if (result.before.best.pairing.computed[i] < 0 || result.after.best.pairing.computed[i] < 0) continue;
      const Mode mode = computed_mode(fit.best, fit.best.pairing.computed[i]);
      const std::string name = fmt::format("mode_{:02}_{}.vtu", i + 1, when);
      fs::create_directories(folder);
      write_vtu(mode_grid(fit.best.assembly, mode), (folder / name).string());
      series.add(double(i + 1), name);
      if (fit.best.assembly.fill.empty()) continue;
      const std::string of_fill = fmt::format("mode_{:02}_{}_fill.vtu", i + 1, when);
      write_vtu(mode_fill_grid(fit.best.assembly, mode), (folder / of_fill).string());
      fill_series.add(double(i + 1), of_fill);
    }
  }
}

}  // namespace voussoir
