// voussoir view.
#include <fmt/format.h>

#include <filesystem>

#include "io/hdf5/assembly_file.h"
#include "io/hdf5/h5.h"
#include "io/hdf5/modes_file.h"
#include "io/vtk/grid.h"
#include "io/vtk/series.h"
#include "solver/base/atomic_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/folder.h"
#include "solver/base/json_file.h"
#include "solver/step/make_snapshot.h"
#include "tools/run/run_page.h"
#include "tools/run/stored_state.h"
#include "tools/voussoir/options.h"
#include "viz/viewer/viewer_frames.h"
#include "viz/viewer/viewer_page.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

std::string mode_label(std::size_t number, const Mode& mode) {
  const std::string period =
      mode.frequency > 0.0 ? fmt::format("{:.3f} s ({:.2f} Hz)", mode.period(), mode.frequency) : "no period";
  return fmt::format("mode {}: {}, {}", number, period, mode.words.text());
}

/// The scene of an eigenvalue analysis: the shapes from the files for ParaView, the labels from modes.h5.
ViewerScene modes_scene(const fs::path& folder) {
  const ModesFile file = read_modes((folder / "modes.h5").string());
  ShapeSeries series{(folder / "vtk/modes.pvd").string(), (folder / "vtk/modes_fill.pvd").string(), {}};
  if (!fs::exists(series.blocks))
    throw InputError("{} has no mode shapes of stones, because {} is missing. voussoir modal writes both files",
                     (folder / "modes.h5").string(), series.blocks);
  for (std::size_t i = 0; i < file.modes.size(); ++i) series.labels.push_back(mode_label(i + 1, file.modes[i]));
  ViewerScene scene = shape_scene({series});
  scene.what = "modes of " + file.about;
  return scene;
}

/// "mode 2 before: 0.412 s, transverse, 1st order (measured 0.398 s)"; the shape's time is the mode's number.
std::string diagnosed_label(const nlohmann::json& modes, const PvdSeries::Frame& frame, const std::string& when) {
  const auto number = std::size_t(frame.time);
  if (number < 1 || number > modes.size())
    throw InputError("diagnosis.json has {}, but there is a shape of mode {}. Run voussoir diagnose again",
                     counted(modes.size(), "mode"), number);
  const nlohmann::json& mode = modes[number - 1];
  return fmt::format("mode {} {}: {:.3f} s, {} (measured {:.3f} s)", mode.value("mode", std::to_string(number)), when,
                     mode.value(when, 0.0), mode.value("computed_" + when, std::string()), mode.value("measured", 0.0));
}

/// The scene of a diagnosis: each mode before and after.
ViewerScene diagnosis_scene(const fs::path& folder) {
  const nlohmann::json diagnosis = read_json((folder / "diagnosis.json").string());
  std::vector<ShapeSeries> series;
  for (const char* when : {"before", "after"}) {
    const auto file = [&](const char* what) {
      return (folder / fmt::format("vtk/modes_{}{}.pvd", when, what)).string();
    };
    ShapeSeries shapes{file(""), file("_fill"), {}};
    if (!fs::exists(shapes.blocks))
      throw InputError(
          "{} has no mode shapes ({} is missing). Either no mode was found in both models, or an older version wrote "
          "the folder. In the latter case run voussoir diagnose again",
          folder.string(), shapes.blocks);
    const PvdSeries stored(shapes.blocks);
    for (const PvdSeries::Frame& frame : stored.frames())
      shapes.labels.push_back(diagnosed_label(diagnosis.value("modes", nlohmann::json::array()), frame, when));
    series.push_back(std::move(shapes));
  }
  ViewerScene scene = shape_scene(series);
  scene.what = "modes before and after the diagnosis";
  return scene;
}

ViewerScene folder_scene(const std::string& directory, std::size_t most) {
  const fs::path folder = directory;
  std::error_code ignored;
  if (fs::exists(folder / "vtk/blocks.pvd", ignored)) {
    ViewerScene scene = run_scene(directory, most);
    const std::size_t stored = VtkSeries(directory).blocks().frames().size();
    scene.what = stored == scene.frames.size()
                     ? fmt::format("run, {}", counted(stored, "frame"))
                     : fmt::format("run, {} of {}", scene.frames.size(), counted(stored, "frame"));
    return scene;
  }
  if (fs::exists(folder / "diagnosis.json", ignored)) return diagnosis_scene(folder);
  if (fs::exists(folder / "modes.h5", ignored)) return modes_scene(folder);
  throw InputError(
      "{} has nothing to view: it has no frames of a run (vtk/blocks.pvd), no modes (modes.h5) and no diagnosis "
      "(diagnosis.json)",
      directory);
}

ViewerScene file_scene(const std::string& file) {
  if (!h5::File::is_hdf5(file))
    throw InputError(
        "{} cannot be viewed. Give the folder of a run, of modes or of a diagnosis, an assembly (.h5) or a "
        "checkpoint{}",
        file, file.ends_with(".toml") ? ". voussoir generate makes an assembly from a case" : "");
  if (is_checkpoint_of_run(file)) {
    const StoredState stored = read_stored_state(file);
    ViewerScene scene = snapshot_scene(stored.assembly, make_snapshot(stored.model, stored.state));
    scene.what =
        fmt::format("checkpoint of {} at {:.3f} s", fs::path(stored.run).filename().string(), stored.header.time);
    return scene;
  }
  const h5::File h5 = h5::File::open(file);
  if (h5.has_attribute("/", "format") && h5.text("/", "format") == "voussoir-modes")
    return modes_scene(fs::path(file).parent_path());
  const Assembly assembly = read_assembly(file);
  ViewerScene scene = snapshot_scene(assembly, rest_snapshot(assembly));
  scene.what = fmt::format("assembly of {}, as built", counted(assembly.blocks.size(), "block"));
  return scene;
}

/// "demo" for demo/ as well as for demo.h5.
std::string name_of(const std::string& from) {
  const fs::path path = fs::weakly_canonical(from);
  return path.extension() == ".h5" ? path.stem().string() : path.filename().string();
}

/// Writes the page of the run again, with a link to this page, if both are in the same folder.
void link_from_report(const std::string& directory, const std::string& html) {
  std::error_code ignored;
  if (fs::exists(directory + "/summary.json", ignored) && fs::exists(directory + "/report.html", ignored) &&
      fs::equivalent(html, directory + "/view.html", ignored))
    write_run_page(directory);
}

int view(const std::vector<std::string>& arguments) {
  CommandLine line("view", "view RUN|MODEL|MODES|DIAGNOSIS [-o HTML]", "voussoir view demo -o view.html");
  line.described.add_options()(
      "output,o", options::value<std::string>()->value_name("HTML"),
      "page to write, or a folder for it (default: view.html in the folder, or named after the file)")(
      "frames", whole_option("frames", 1, 100000)->default_value(60),
      "largest number of frames; of a run with more frames, the page has this many, evenly spaced")(
      "title", options::value<std::string>()->default_value(""),
      "title of the page (default: the name of the folder or file)");
  line.positional = line.required = {"RUN"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const std::string from = values["RUN"].as<std::string>();
  std::error_code ignored;
  const bool directory = fs::is_directory(from, ignored);
  if (!directory && !fs::exists(from, ignored)) throw InputError("there is no file or folder {}", from);
  const std::string name = directory ? "view.html" : name_of(from) + "_view.html";
  std::string html = directory ? (fs::path(from) / name).string() : name;
  if (values.count("output")) html = values["output"].as<std::string>();
  if (fs::is_directory(html, ignored) || html.ends_with('/')) html = (fs::path(html) / name).string();
  check_ending(html, {".html"}, "a page");
  require_viewer();
  ViewerScene scene = directory ? folder_scene(from, std::size_t(values["frames"].as<int>())) : file_scene(from);
  scene.title = values["title"].as<std::string>();
  if (scene.title.empty()) scene.title = name_of(from);
  const std::string page = viewer_page(scene);
  make_folder_of(html);
  write_atomically(html, page);
  if (directory) link_from_report(from, html);
  if (!values.count("quiet"))
    fmt::print("{}: {}, {}, {:.1f} MB\n", html, counted(scene.stones.size(), "block"),
               counted(scene.frames.size(), "frame"), 1e-6 * double(page.size()));
  return 0;
}

}  // namespace

Verb view_verb() {
  return {"view", "write a page that shows a model in three dimensions in a browser", view};
}

}  // namespace voussoir
