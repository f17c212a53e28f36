// voussoir render.
#include "viz/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/hdf5/assembly_file.h"
#include "io/vtk/grid.h"
#include "io/vtk/series.h"
#include "solver/base/error.h"
#include "solver/step/make_snapshot.h"
#include "tools/run/stored_state.h"
#include "tools/run/thrust.h"
#include "tools/voussoir/options.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

RenderOptions render_options(const options::variables_map& values) {
  RenderOptions o;
  o.amplification = values["amplification"].as<double>();
  if (values.count("resultants") && values["amplification"].defaulted()) o.amplification = 1.0;
  o.colour = values["colour"].as<std::string>();
  o.view = values["view"].as<std::string>();
  o.hide = values.count("hide") ? words_in(values["hide"].as<std::string>()) : usually_hidden(o.colour);
  if (values.count("cut")) o.cut = values["cut"].as<std::string>();
  o.cracks = values.count("no-cracks") == 0;
  o.crack_mm = values["crack"].as<double>();
  o.range = values["range"].as<double>();
  o.width = values["width"].as<int>();
  o.height = values["height"].as<int>();
  o.undeformed = values.count("undeformed") > 0;
  o.title = values["title"].as<std::string>();
  return o;
}

/// The stored frame nearest to the time asked for (default: the last).
void render_frame(const std::string& directory, const options::variables_map& values, const RenderOptions& o,
                  const std::string& png) {
  const VtkSeries series(directory);
  const auto& frames = series.blocks().frames();
  if (frames.empty())
    throw InputError("{} has no frames in vtk/blocks.pvd: give a checkpoint, or a run with output", directory);
  auto best = frames.end() - 1;
  if (values.count("time"))
    best =
        std::min_element(frames.begin(), frames.end(), [t = values["time"].as<double>()](const auto& a, const auto& b) {
          return std::abs(a.time - t) < std::abs(b.time - t);
        });
  render_picture(PictureFiles{series.blocks().file_path(*best), series.joints().file_at(best->time),
                              series.fill().file_at(best->time)},
                 o, png);
}

/// The kind of the stage that a checkpoint was written in, or between two stages that of the one before.
StageSettings::Kind stage_of(CheckpointHeader header, const SolverSettings& settings) {
  const std::int64_t at = header.numbers["stage_begun"] > 0.0 ? header.stage : header.stage - 1;
  if (settings.stages.empty()) return StageSettings::Kind::gravity;
  return settings.stages[std::size_t(std::clamp(at, std::int64_t(0), std::int64_t(settings.stages.size()) - 1))].kind;
}

/// A checkpoint, or an assembly as built.
void render_file(const std::string& file, RenderOptions o, bool resultants, const std::string& png) {
  if (!is_checkpoint_of_run(file)) {
    if (resultants)
      throw InputError("{} is no checkpoint: resultants take a run that ends at rest, or a checkpoint of it", file);
    const Assembly assembly = read_assembly(file);
    render_picture(assembly, rest_snapshot(assembly), o, png);
    return;
  }
  const StoredState stored = read_stored_state(file);
  if (resultants)
    o.resultants = bed_joints_of_state(stored.assembly, stored.model, stored.state,
                                       stage_of(stored.header, stored.c.settings), file);
  render_picture(stored.assembly, make_snapshot(stored.model, stored.state), o, png);
}

int render(const std::vector<std::string>& arguments) {
  CommandLine line("render", "render DIR|CHECKPOINT|ASSEMBLY [-o PNG]",
                   "voussoir render demo --view front --colour slip --amplification 20 -o slip.png");
  line.described.add_options()("output,o", options::value<std::string>()->value_name("PNG"),
                               "picture (default: DIR/images/…, or beside the file)")(
      "time,t", real_option("time", -1e9, 1e9)->value_name("T"),
      "stored frame nearest to this time (s); default: the last")(
      "amplification,a", real_option("amplification", -1e6, 1e6)->default_value(2.0), "of the displacements")(
      "colour,c", options::value<std::string>()->default_value("opening"),
      "opening, slip, displacement, mode (share of the largest), component or stone; of the joints normal, shear, "
      "utilisation or eccentricity; of a deformable fill plastic (shear strain), yield or stress")(
      "view,v", options::value<std::string>()->default_value("oblique"), "front, side, plan or oblique")(
      "hide", options::value<std::string>()->value_name("NAMES"),
      "components left out, by commas; none: show all; default: backfill, a deformable one too, unless it is coloured")(
      "cut", options::value<std::string>()->value_name("PLANE"),
      "leave out what lies before a plane: an axis and a place in m, such as y=0.5, or the axis alone for the middle")(
      "no-cracks", "do not mark cracked joints")("crack", real_option("crack", 0.0, 1e6)->default_value(1.0),
                                                 "opening or slip that counts as a crack, mm; 0: a lost bond too")(
      "range", real_option("range", 0.0, 1e9)->default_value(0.0),
      "top of the colour scale, mm (plastic: %, stress: kPa, normal and shear: MPa); 0: from the data")(
      "resultants", "arrows of the resultants in the bed joints of vaults, and their lines of thrust; a state at rest")(
      "width", whole_option("width", 200, 8000)->default_value(1800), "pixels")(
      "height", whole_option("height", 0, 8000)->default_value(1000), "pixels; 0: as needed")(
      "undeformed", "thin outline of the undeformed stones")("title", options::value<std::string>()->default_value(""),
                                                             "words above the picture");
  line.positional = line.required = {"DIR"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const std::string from = values["DIR"].as<std::string>();
  const RenderOptions o = render_options(values);
  std::error_code ignored;  // a name that cannot be looked up names no file
  const bool directory = fs::is_directory(from, ignored);
  if (!directory && !fs::exists(from, ignored)) throw InputError("there is no file or folder {}", from);
  const bool resultants = values.count("resultants") > 0;
  const std::string name = fmt::format("{}_{}.png", resultants ? "resultants" : o.colour, o.view);
  std::string png = directory ? from + "/images/" + name : fs::path(from).stem().string() + ".png";
  if (values.count("output")) png = values["output"].as<std::string>();
  // -o DIR, as every verb takes it: the picture goes in there.
  if (fs::is_directory(png, ignored) || png.ends_with('/')) png = (fs::path(png) / name).string();
  check_ending(png, {".png"}, "a PNG picture");
  if (resultants && values.count("time"))
    throw InputError("--resultants takes the state of a checkpoint: give its file instead of --time");
  if (directory && !resultants)
    render_frame(from, values, o, png);
  else
    render_file(directory ? newest_checkpoint(from) : from, o, resultants, png);
  if (!values.count("quiet")) fmt::print("{}\n", png);
  return 0;
}

}  // namespace

Verb render_verb() {
  return {"render", "off-screen pictures: deformed shape, damage, views", render};
}

}  // namespace voussoir
