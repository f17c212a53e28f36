// The pictures every finished run leaves behind.
#include <fmt/format.h>

#include "tools/voussoir/run_session.h"
#include "viz/plot.h"
#include "viz/render.h"

namespace voussoir {

namespace {

void draw_state(const std::string& images, const Assembly& assembly, const Snapshot& snapshot) {
  RenderOptions o;
  for (const char* view : {"oblique", "front"}) {
    o.view = view;
    for (const char* colour : {"opening", "slip"}) {
      o.colour = colour;
      render_picture(assembly, snapshot, o, fmt::format("{}/{}_{}.png", images, colour, view));
    }
  }
}

Series channel(const History& history, const std::string& name, const std::string& path, double factor) {
  Series s{name, history.time(), history.values(path)};
  for (double& y : s.y) y *= factor;
  return s;
}

void draw_charts(const std::string& images, const Assembly& assembly, const History& history) {
  if (history.rows() < 2) return;
  std::vector<Series> energies;
  for (const char* name : {"kinetic", "elastic", "friction", "fracture", "joint_damping", "base_work"})
    energies.push_back(channel(history, name, std::string("energy/") + name, 1e-3));
  plot_lines(energies, "time (s)", "energy (kJ)", "Energy", images + "/energy.png");
  std::vector<Series> keystones, spandrels;
  for (const DemandPoint& point : demand_points(assembly)) {
    const std::string path = fmt::format("demand/{} {}", point.group, "xyz"[point.axis]);
    (point.axis == 0 ? keystones : spandrels).push_back(channel(history, point.group, path, 1e3));
  }
  if (!keystones.empty())
    plot_lines(keystones, "time (s)", "longitudinal displacement relative to the base (mm)", "Keystones",
               images + "/keystones.png");
  if (!spandrels.empty())
    plot_lines(spandrels, "time (s)", "transverse displacement relative to the base (mm)", "Spandrel walls",
               images + "/spandrels.png");
}

}  // namespace

std::string make_pictures(const std::string& directory, const Assembly& assembly, const Snapshot& snapshot,
                          const History& history) {
  try {
    draw_state(directory + "/images", assembly, snapshot);
    draw_charts(directory + "/images", assembly, history);
    return {};
  } catch (const std::exception& e) {  // a run is not lost because its pictures cannot be drawn
    return e.what();
  }
}

}  // namespace voussoir
