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

/// Renders the stored frame nearest to --time (default: the last).
void render_frame(const std::string& directory, const options::variables_map& values, const RenderOptions& o,
                  const std::string& png) {
  const VtkSeries series(directory);
  const auto& frames = series.blocks().frames();
  if (frames.empty())
    throw InputError("{} has no frames in vtk/blocks.pvd. Give a checkpoint, or a run that has written frames",
                     directory);
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

/// The kind of the stage in which a checkpoint was written. Between two stages it is that of the earlier one.
StageSettings::Kind stage_of(CheckpointHeader header, const SolverSettings& settings) {
  const std::int64_t at = header.numbers["stage_begun"] > 0.0 ? header.stage : header.stage - 1;
  if (settings.stages.empty()) return StageSettings::Kind::gravity;
  return settings.stages[std::size_t(std::clamp(at, std::int64_t(0), std::int64_t(settings.stages.size()) - 1))].kind;
}

/// A checkpoint, or an assembly as built.
void render_file(const std::string& file, RenderOptions o, bool resultants, const std::string& png) {
  if (!is_checkpoint_of_run(file)) {
    if (resultants)
      throw InputError("{} is not a checkpoint. --resultants needs a run that ends at rest, or a checkpoint of it",
                       file);
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
  line.described.add_options()(
      "output,o", options::value<std::string>()->value_name("PNG"),
      "picture, or a folder for it (default: DIR/images/COLOUR_VIEW.png, or named after the file)")(
      "time,t", real_option("time", -1e9, 1e9)->value_name("T"),
      "stored frame nearest to this time, s (default: the last)")(
      "amplification,a", real_option("amplification", -1e6, 1e6)->default_value(2.0),
      "factor on the displacements relative to the base")(
      "colour,c", options::value<std::string>()->default_value("opening"),
      "quantity shown in colour: opening, slip, displacement, mode (displacement as a share of the largest), "
      "component, stone; of the joints: normal, shear, utilisation, eccentricity; of a deformable fill: plastic (shear "
      "strain), yield, stress")("view,v", options::value<std::string>()->default_value("oblique"),
                                "view: front, side, plan or oblique")(
      "hide", options::value<std::string>()->value_name("NAMES"),
      "components left out of the picture, separated by commas; none: show all (default: backfill, including a "
      "deformable one; nothing with plastic, yield and stress)")(
      "cut", options::value<std::string>()->value_name("PLANE"),
      "section: leave out everything on the viewer's side of a plane, given as an axis and a coordinate in m (y=0.5) "
      "or as an axis alone for the middle")("no-cracks", "do not mark cracked joints")(
      "crack", real_option("crack", 0.0, 1e6)->default_value(1.0),
      "opening or slip that counts as a crack, mm; 0: a lost bond counts too")(
      "range", real_option("range", 0.0, 1e9)->default_value(0.0),
      "top of the colour scale, mm (plastic: %, stress: kPa, normal and shear: MPa); 0: from the data")(
      "resultants", "draw the resultants of the bed joints of vaults and the lines of thrust; needs a state at rest")(
      "width", whole_option("width", 200, 8000)->default_value(1800), "width of the picture, pixels")(
      "height", whole_option("height", 0, 8000)->default_value(1000),
      "height of the picture, pixels; 0: as the content needs")("undeformed",
                                                                "draw thin outlines of the undeformed stones")(
      "title", options::value<std::string>()->default_value(""), "title above the picture");
  line.positional = line.required = {"DIR"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const std::string from = values["DIR"].as<std::string>();
  const RenderOptions o = render_options(values);
  std::error_code ignored;  // a path that cannot be examined is not a file
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
    throw InputError("--resultants takes its state from a checkpoint. Give the checkpoint file and leave out --time");
  if (directory && !resultants)
    render_frame(from, values, o, png);
  else
    render_file(directory ? newest_checkpoint(from) : from, o, resultants, png);
  if (!values.count("quiet")) fmt::print("{}\n", png);
  return 0;
}

}  // namespace

Verb render_verb() {
  return {"render", "draw pictures of a stored frame, a checkpoint or an assembly", render};
}

}  // namespace voussoir
