#include "tools/diagnosis/diagnosis_pictures.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "io/vtk/grid.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "tools/diagnosis/diagnosis_shapes.h"
#include "viz/mode_picture.h"
#include "viz/render.h"
#include "viz/sensor_picture.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

RenderOptions plain_options() {
  RenderOptions options;
  options.hide.clear();
  options.width = 1200;
  options.height = 700;
  return options;
}

/// Blocks coloured by their share of the correcting energy, undeformed.
PagePicture residual_map(const Assembly& assembly, const Location& location, const std::string& when, double top,
                         const std::string& png) {
  Snapshot snapshot = rest_snapshot(assembly);
  // As displacements, which a scale in mm then shows in per cent. The square root is drawn, as displacements go with
  // it; both pictures have the scale of the larger one.
  const double size = std::sqrt(location.size / std::max(top, 1e-300));
  for (std::size_t i = 0; i < location.blocks.size() && i < snapshot.displacement.size(); ++i)
    snapshot.displacement[i] = Vec3(0.1 * size * std::sqrt(std::max(location.blocks[i], 0.0)), 0.0, 0.0);
  RenderOptions options = plain_options();
  options.colour = "displacement";
  options.scale_title = "displacement that would correct the modes (% of the largest)";
  options.range = 100.0;
  options.amplification = 0.0;
  options.cracks = false;
  options.title = fmt::format("Where model and measurement disagree, {}", when);
  options.notes = {
      fmt::format("the corrections have {:.1f} % of the strain energy of the modes", 100.0 * location.size),
      "colours: amplitude of the correcting displacements"};
  render_picture(assembly, snapshot, options, png);
  return {options.title, options.notes[0], png};
}

PagePicture shape_picture(const Fit& fit, const ModeComparison& mode, std::size_t index, const std::string& when,
                          const std::string& png) {
  const int computed = fit.best.pairing.computed[index];
  RenderOptions options = plain_options();
  const double period = std::exp(-fit.best.response.log_frequency[computed]);
  options.title = fmt::format("Mode {} {}: {:.3f} s ({:.3f} Hz), {}", mode.name, when, period, 1.0 / period,
                              fit.best.response.words[std::size_t(computed)].text());
  Mode shape = computed_mode(fit.best, computed);
  shape.nodes.resize(0, 3);  // of the stones alone
  draw_mode(fit.best.assembly, shape, options,
            {fmt::format("measured {:.3f} s ± {:.3f} s ({:.3f} Hz)", mode.measured, mode.std, 1.0 / mode.measured), ""},
            png);
  return {options.title, fmt::format("measured {:.3f} s ({:.3f} Hz)", mode.measured, 1.0 / mode.measured), png};
}

}  // namespace

PagePicture sensor_picture(const Assembly& assembly, const std::vector<Sensor>& sensors, const std::string& png) {
  RenderOptions options = plain_options();
  options.title = "Positions of the sensors";
  draw_sensors(assembly, sensors, options, png);
  return {options.title,
          fmt::format("{}; arrows point in the direction of positive readings", counted(sensors.size(), "channel")),
          png};
}

std::vector<PagePicture> draw_diagnosis(const DiagnosisInput& input, const DiagnosisResult& result,
                                        const std::string& directory,
                                        const std::function<void(const std::string&)>& say) {
  constexpr std::size_t most = 4;  // modes
  std::vector<PagePicture> pictures;
  fs::create_directories(directory + "/images");
  const auto file = [&](const std::string& name) { return fmt::format("{}/images/{}.png", directory, name); };
  const double top = std::max(result.where.size, result.where_after.size);
  const std::vector<Sensor>& sensors = input.problem.features.sensors;
  try {
    if (!sensors.empty()) pictures.push_back(sensor_picture(result.before.best.assembly, sensors, file("sensors")));
    pictures.push_back(residual_map(result.before.best.assembly, result.where, "before", top, file("residual_before")));
    pictures.push_back(
        residual_map(result.after.best.assembly, result.where_after, "after", top, file("residual_after")));
    for (std::size_t i = 0; i < std::min(most, result.modes.size()); ++i) {
      if (result.before.best.pairing.computed[i] < 0 || result.after.best.pairing.computed[i] < 0) continue;
      for (const bool before : {true, false})
        pictures.push_back(shape_picture(before ? result.before : result.after, result.modes[i], i,
                                         before ? "before" : "after",
                                         file(fmt::format("mode_{}_{}", i + 1, before ? "before" : "after"))));
    }
  } catch (const RunError& error) {
    say(fmt::format("The program draws no further pictures: {}", error.what()));
  }
  return pictures;
}

}  // namespace voussoir
