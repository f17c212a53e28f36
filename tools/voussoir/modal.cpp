// voussoir modal.
#include <fmt/format.h>

#include <filesystem>

#include "io/case/remarks.h"
#include "io/hdf5/assembly_file.h"
#include "io/hdf5/h5.h"
#include "io/vtk/files.h"
#include "io/vtk/grid.h"
#include "io/vtk/series.h"
#include "solver/base/atomic_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/folder.h"
#include "solver/base/json_file.h"
#include "tools/modal/modal_paper.h"
#include "tools/modal/modal_report.h"
#include "tools/modal/modal_source.h"
#include "tools/voussoir/options.h"
#include "tools/voussoir/say_remarks.h"
#include "viz/mode_picture.h"
#include "viz/scene.h"
#include "viz/view.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

/// The options of the command line.
struct ModalRequest {
  std::string from, directory, against;
  bool state_asked = false, as_stored = false, quiet = false, pictures = true;
  int threads = 1;
  RenderOptions picture;
  std::function<void(ModalSettings&)> settings;
};

ModalSettings::State state_asked(const options::variables_map& values) {
  const std::string state = values["state"].as<std::string>();
  const auto& known = modal_states();
  const auto at = std::find(known.begin(), known.end(), state);
  if (at == known.end()) throw InputError("--state is {}. It must be intact or gravity", state);
  return ModalSettings::State(at - known.begin());
}

ModalRequest modal_request(const options::variables_map& values) {
  ModalRequest request;
  request.from = values["CASE"].as<std::string>();
  if (values.count("output")) request.directory = values["output"].as<std::string>();
  if (values.count("against")) request.against = values["against"].as<std::string>();
  request.state_asked = values.count("state") > 0;
  request.as_stored = values.count("as-stored") > 0;
  request.quiet = values.count("quiet") > 0;
  request.pictures = values.count("no-pictures") == 0;
  request.threads = threads_asked(values);
  request.picture.view = values["view"].as<std::string>();
  request.picture.width = values["width"].as<int>();
  request.picture.height = values["height"].as<int>();
  request.picture.hide = words_in(values["hide"].as<std::string>());
  request.settings = [values](ModalSettings& modal) {
    if (values.count("modes")) modal.modes = values["modes"].as<int>();
    if (values.count("geometric")) modal.geometric = true;
    if (values.count("state")) modal.state = state_asked(values);
  };
  return request;
}

/// DIR/modes of a run, NAME-modes of a case.
std::string default_directory(const std::string& from, const ModalSource& source) {
  if (!source.damaged) return source.name + "-modes";
  return (fs::is_directory(from) ? fs::path(from) : fs::weakly_canonical(from).parent_path().parent_path()) / "modes";
}

ModesFile modes_file(const ModalSource& source, const Modes& modes, const std::string& about) {
  ModesFile file;
  file.about = about;
  file.assembly_hash = assembly_hash(source.assembly);
  file.mass = modes.mass;
  file.places = block_places(source.assembly, source.model);
  file.nodes = source.assembly.fill.nodes;
  file.modes = modes.modes;
  const DampingSettings& damping = source.c.settings.damping;
  if (damping.kind != DampingSettings::Kind::none)
    for (const Mode& mode : modes.modes) file.damped.push_back(damped_mode(damping, mode.frequency));
  return file;
}

/// Removes the files of an earlier analysis in the same folder, which may have had more modes.
void remove_earlier(const std::string& directory) {
  std::error_code ignored;
  for (const char* folder : {"vtk", "images"})
    for (const auto& entry : fs::directory_iterator(fs::path(directory) / folder, ignored))
      if (entry.path().filename().string().starts_with("mode")) fs::remove(entry.path(), ignored);
}

void write_shapes(const std::string& directory, const Assembly& assembly, const std::vector<Mode>& modes) {
  PvdSeries series(directory + "/vtk/modes.pvd"), fill_series(directory + "/vtk/modes_fill.pvd");
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const std::string name = fmt::format("mode_{:02}.vtu", i + 1), of_fill = fmt::format("mode_fill_{:02}.vtu", i + 1);
    write_vtu(mode_grid(assembly, modes[i]), directory + "/vtk/" + name);
    series.add(double(i + 1), name);  // the collection's "time" is the mode's number
    if (assembly.fill.empty()) continue;
    write_vtu(mode_fill_grid(assembly, modes[i]), directory + "/vtk/" + of_fill);
    fill_series.add(double(i + 1), of_fill);
  }
}

std::string percent(double share) {
  return fmt::format("{:.0f}", 100.0 * share);
}

/// Draws the mode shapes. Throws only for wrong options; a display that does not start is reported and ignored.
void draw_shapes(const std::string& directory, const ModalRequest& request, const ModalSource& source,
                 const Modes& modes) {
  for (std::size_t i = 0; i < modes.modes.size(); ++i) {
    const Mode& mode = modes.modes[i];
    RenderOptions picture = request.picture;
    picture.title = fmt::format("{}: mode {}, {}", source.name, i + 1, mode.words.text());
    const Vec3 share = mode.effective / modes.mass;
    const std::string frequency = mode.frequency > 0.0
                                      ? fmt::format("T = {:.3f} s, f = {:.3f} Hz", mode.period(), mode.frequency)
                                      : "no frequency";
    draw_mode(source.assembly, mode, picture,
              {frequency, fmt::format("effective mass x {}, y {}, z {} %", percent(share.x()), percent(share.y()),
                                      percent(share.z()))},
              fmt::format("{}/images/mode_{:02}.png", directory, i + 1));
  }
}

/// Checks the options before the analysis begins, because it may take a while.
void check_request(const ModalRequest& request) {
  std::error_code ignored;
  if (request.state_asked && (fs::is_directory(request.from, ignored) || h5::File::is_hdf5(request.from)))
    throw InputError("--state applies to a case, but {} holds the state of a run. Leave the option out", request.from);
  find_view(request.picture.view);
  check_options(request.picture);
  Hidden hidden(request.picture.hide);
}

/// The results of an analysis.
struct Findings {
  Modes modes;
  ModesFile file;
  std::string text;  // for people
  nlohmann::json json;
};

void keep_lowest(Findings& f, std::size_t count) {
  count = std::min(count, f.modes.modes.size());
  f.modes.modes.resize(count);
  f.file.modes.resize(count);
  if (!f.file.damped.empty()) f.file.damped.resize(count);
}

std::string counts_text(const Assembly& assembly) {
  const std::string blocks = counted(assembly.blocks.size(), "block");
  if (assembly.fill.empty()) return blocks;
  return fmt::format("{}, a fill of {} and {}", blocks, counted(assembly.fill.nodes.size(), "node"),
                     counted(assembly.fill.tets.size(), "tetrahedron", "tetrahedra"));
}

/// The modes of the source. For a damaged one, also the modes of the intact assembly. Local modes of loosened stones
/// lie between those of the whole. The search therefore continues beyond the requested number until each intact mode
/// has a partner, up to three times that number.
Findings find(const ModalSource& source) {
  const int count = source.c.settings.modal.modes;
  const Array<double>* wrenches = source.wrenches ? &*source.wrenches : nullptr;
  Findings f;
  f.modes = find_modes(source.assembly, source.model, source.state, count, source.tangent, wrenches,
                       source.damaged ? std::max(2 * count, 20) : 0);
  std::string comparison;
  nlohmann::json intact_json;
  if (source.damaged) {
    const State untouched = initial_state(source.model);
    const Modes intact = find_modes(source.assembly, source.model, untouched, count, PatchTangent::intact);
    const ModesFile intact_file = modes_file(source, intact, "the same assembly, all joints intact");
    f.file = modes_file(source, f.modes, source.about);
    Pairing pairing = pair_modes(f.file, intact_file);
    const std::int64_t last = *std::max_element(pairing.ours.begin(), pairing.ours.end());
    keep_lowest(f, std::size_t(std::max(last + 1, std::int64_t(count))));
    pairing.assurance.conservativeResize(Eigen::Index(f.modes.modes.size()), Eigen::NoChange);
    comparison = fmt::format("\n{}", pairing_table(f.file, intact_file, pairing, "as it is", "intact"));
    intact_json = pairing_json(f.file, intact_file, pairing);
  } else {
    f.file = modes_file(source, f.modes, source.about);
  }
  f.json = modes_json(f.file, source.assembly, f.modes);
  f.text = fmt::format("{}\n{}, {:.2f} t that can move\n\n{}\n{}\n{}{}", source.about, counts_text(source.assembly),
                       1e-3 * f.modes.mass, modes_table(f.file), effort_text(f.modes.report),
                       loose_text(source.assembly, f.modes), comparison);
  if (source.damaged) f.json["intact"] = intact_json;
  const std::vector<PeriodCheck> periods = check_periods(source.c.expected_periods, f.modes.modes);
  if (periods.empty() || source.damaged) return f;
  f.text += fmt::format("\n{}", periods_table(periods));
  f.json["expected"] = periods_json(periods);
  return f;
}

int analyse(const ModalRequest& request) {
  check_request(request);
  std::optional<ModesFile> against;
  if (!request.against.empty()) against = read_modes(request.against);
  if (!request.quiet) fmt::print(stderr, "reading {}\n", request.from);
  const ModalSource source =
      modal_source(request.from, request.settings, request.as_stored, request.threads, request.quiet);
  if (against) check_same_structure(block_places(source.assembly, source.model), against->places);
  const std::vector<std::string> noticed = remarks(source.c, source.assembly);
  say_remarks(noticed, request.quiet);
  Findings f = find(source);
  f.json["remarks"] = noticed;
  if (against) {
    const Pairing pairing = pair_modes(f.file, *against);
    f.text += fmt::format("\nagainst {} ({})\n{}", request.against, against->about,
                          pairing_table(f.file, *against, pairing, "this", "against"));
    f.json["against"] = pairing_json(f.file, *against, pairing);
  }
  if (!request.quiet) fmt::print("{}", f.text);

  const std::string directory = request.directory.empty() ? default_directory(request.from, source) : request.directory;
  make_folder_of(directory + "/modes.json");
  remove_earlier(directory);
  write_modes(directory + "/modes.h5", f.file);
  write_json(directory + "/modes.json", f.json);
  write_atomically(directory + "/modes.txt", f.text);
  write_shapes(directory, source.assembly, f.modes.modes);
  if (request.pictures) draw_shapes(directory, request, source, f.modes);
  if (!request.quiet)
    fmt::print("\n{0}/modes.txt, modes.json, modes.h5, vtk/modes.pvd{1}\n", directory,
               request.pictures ? ", images/mode_01.png …" : "");
  return 0;
}

int modal(const std::vector<std::string>& arguments) {
  CommandLine line("modal", "modal CASE|DIR|CHECKPOINT [-o DIR]",
                   "voussoir modal cases/cs1-r.toml -o cs1-r-modes --modes 6");
  line.described.add_options()("output,o", options::value<std::string>()->value_name("DIR"),
                               "folder for tables, shapes and pictures (default: NAME-modes of a case, RUN/modes of a "
                               "run); with --paper a Markdown file for its tables")(
      "modes,n", whole_option("modes", 1, 10000)->value_name("N"),
      "number of modes (default: that of the case, otherwise 10)")(
      "state", options::value<std::string>()->value_name("WORD"),
      "state of the joints of a case: intact (bonded and elastic) or gravity (as they rest under gravity); default: "
      "that of the case, otherwise intact")("geometric", "add the geometric stiffness of the forces in the joints")(
      "as-stored", "of a run: take the state as it is, do not bring it to rest first")(
      "against", options::value<std::string>()->value_name("MODES.H5"),
      "pair the modes with those of another analysis")(
      "view,v", options::value<std::string>()->default_value("oblique"), "view: front, side, plan or oblique")(
      "hide", options::value<std::string>()->default_value("none"),
      "components left out of the pictures, separated by commas; none: show all")(
      "width", whole_option("width", 200, 8000)->default_value(1800), "width of the pictures, pixels")(
      "height", whole_option("height", 0, 8000)->default_value(1000),
      "height of the pictures, pixels; 0: as the content needs")("no-pictures", "leave out the pictures")(
      "paper", "compare the periods of the bridges cs1 and cs2 with the published ones");
  line.positional = {"CASE"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  if (values.count("paper")) {
    if (values.count("CASE"))
      throw InputError("--paper takes no case, because it reads the four bridges in cases/. Leave the case out");
    const auto state = values.count("state") ? state_asked(values) : ModalSettings::State::intact;
    return modal_paper(values.count("output") ? values["output"].as<std::string>() : "", state, threads_asked(values));
  }
  if (!values.count("CASE")) throw InputError("CASE is missing. Usage: voussoir {}", line.usage);
  return analyse(modal_request(values));
}

}  // namespace

Verb modal_verb() {
  return {"modal", "compute natural frequencies, periods, effective masses and mode shapes", modal};
}

}  // namespace voussoir
