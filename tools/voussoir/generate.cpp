// voussoir generate.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <map>

#include "geometry/joint_counts.h"
#include "geometry/joints.h"
#include "io/case/case.h"
#include "io/case/case_template.h"
#include "io/case/remarks.h"
#include "io/hdf5/assembly_file.h"
#include "io/hdf5/h5.h"
#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"
#include "tools/voussoir/assembly_table.h"
#include "tools/voussoir/options.h"
#include "tools/voussoir/say_remarks.h"
#include "viz/arrangement_picture.h"

namespace voussoir {

void print_assembly_table(const Assembly& assembly, const FillAim& aim) {
  struct Row {
    std::int64_t blocks = 0, fixed = 0;
    double mass = 0.0;
  };
  std::map<std::string, Row> rows;
  double mass = 0.0;
  std::int64_t smallest = -1, largest = -1;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Block& b = assembly.blocks[i];
    Row& row = rows[component_names()[std::size_t(b.component)]];
    ++row.blocks;
    if (b.fixed) {
      ++row.fixed;
      continue;
    }
    row.mass += b.mass;
    mass += b.mass;
    if (smallest < 0 || b.mass < assembly.blocks[smallest].mass) smallest = std::int64_t(i);
    if (largest < 0 || b.mass > assembly.blocks[largest].mass) largest = std::int64_t(i);
  }
  fmt::print("{:<12} {:>8} {:>8} {:>12}\n", "component", "blocks", "fixed", "mass (t)");
  for (const auto& [name, row] : rows)
    fmt::print("{:<12} {:>8} {:>8} {:>12.2f}\n", name, row.blocks, row.fixed, row.mass / 1000.0);
  fmt::print("{}, {}, {:.2f} t that can move\n", counted(assembly.blocks.size(), "block"),
             counted(assembly.joints.size(), "joint"), mass / 1000.0);
  fmt::print("{}\n", joints_text(assembly));
  for (const auto& [word, i] : {std::pair{"smallest", smallest}, std::pair{"largest", largest}})
    if (i >= 0) {
      const Block& b = assembly.blocks[i];
      fmt::print("{} block: number {} ({}), {:.1f} kg at ({:.2f}, {:.2f}, {:.2f}) m\n", word, i,
                 component_names()[std::size_t(b.component)], b.mass, b.centroid.x(), b.centroid.y(), b.centroid.z());
    }
  fmt::print("surface not covered by joints: {:.3f} m2\n", uncovered_surface(assembly));
  for (const std::string& line : fill_lines(assembly, aim)) fmt::print("{}\n", line);
}

namespace {

/// The mesh that the case requires for a deformable fill.
FillAim fill_aim(const Case& c) {
  const auto edge = c.generator_input.values.find("fill_edge");
  if (c.generator.empty() || edge == c.generator_input.values.end()) return {};
  const Generator& generator = find_generator(c.generator);
  const auto backfill = c.generator_input.choices.find("backfill");
  const bool filled = backfill == c.generator_input.choices.end() || backfill->second != "none";
  const auto skew = c.generator_input.values.find("skew");
  return {generator.fill_space && filled ? generator.fill_space(c.generator_input) : 0.0, edge->second,
          skew == c.generator_input.values.end() ? 0.0 : radians(skew->second)};
}

/// Draws the general arrangement beside the assembly file or at the path of --picture. Prints the names of the files.
void draw(const Assembly& assembly, const ArrangementNotes& notes, const std::string& assembly_file,
          const options::variables_map& values) {
  if (!values.count("picture")) return;
  std::filesystem::path stem = values["picture"].as<std::string>();
  if (stem.empty()) stem = assembly_file;
  if (const std::string ending = stem.extension().string();
      ending == ".svg" || ending == ".pdf" || ending == ".png" || ending == ".h5" || ending == ".hdf5")
    stem.replace_extension();
  write_arrangement(assembly, notes, stem.string());
  if (!values.count("quiet")) fmt::print("drawn in {0}.svg, {0}.pdf and {0}.png\n", stem.string());
}

/// The name on a drawing: that of the file, or that of its folder if the file is called case.toml.
std::string drawn_name(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  const std::string folder = std::filesystem::absolute(file).parent_path().filename().string();
  return stem == "case" && !folder.empty() ? folder : stem;
}

/// Completes an assembly that another program wrote: the reader finds the joints that the file does not state.
int complete(const std::string& file, const options::variables_map& values) {
  if (!values.count("output") && !values.count("picture"))
    throw InputError("{} is an assembly. Give -o FILE to write the complete assembly, or --picture to draw it", file);
  const bool stated = states_joints(file);
  const Assembly assembly = read_assembly(file);
  const std::string to = values.count("output") ? values["output"].as<std::string>() : "";
  if (!to.empty()) write_assembly(to, assembly);
  if (!values.count("quiet")) {
    print_assembly_table(assembly);
    fmt::print("{}{}\n", stated ? "the joints are those of the file" : "the program found the joints",
               to.empty() ? "" : "; written to " + to);
  }
  const std::filesystem::path path = file;
  draw(assembly, {drawn_name(path), "assembly " + path.filename().string()}, to.empty() ? path.filename().string() : to,
       values);
  return 0;
}

/// The lengths (m) in a list separated by commas.
std::vector<double> spans_in(const std::string& list) {
  std::vector<double> spans;
  for (const std::string& word : words_in(list)) {
    std::size_t read = 0;
    double span = 0.0;
    try {
      span = std::stod(word, &read);
    } catch (const std::logic_error&) {
      read = 0;
    }
    if (read == 0 || read != word.size())
      throw InputError("--spans contains '{}'. Give clear spans in m, separated by commas, for example 8,10,8",
                       shown(word));
    spans.push_back(span);
  }
  return spans;
}

CaseTemplate template_asked(const options::variables_map& values) {
  CaseTemplate wanted;
  if (values.count("spans")) wanted.clear_spans = spans_in(values["spans"].as<std::string>());
  if (values.count("shape")) wanted.shape = values["shape"].as<std::string>();
  if (values.count("width")) wanted.width = values["width"].as<double>();
  return wanted;
}

int generate(const std::vector<std::string>& arguments) {
  CommandLine line("generate", "generate CASE|ASSEMBLY [-o FILE] [--picture[=FILE]]",
                   "voussoir generate cases/cs1-f.toml -o cs1.h5 --picture");
  line.described.add_options()("output,o", options::value<std::string>()->value_name("FILE"),
                               "assembly file to write (default: the case's name with .h5)")(
      "picture", options::value<std::string>()->implicit_value("")->value_name("FILE"),
      "draw the general arrangement as FILE.svg, FILE.pdf and FILE.png (default: named after the assembly file)")(
      "keys", options::value<std::string>()->value_name("NAME"), "print the keys of a generator and stop")(
      "template", "print a case for a bridge with all keys and stop")(
      "spans", options::value<std::string>()->value_name("LIST"),
      "template: clear spans in m from left to right, separated by commas (default: 8,10,8)")(
      "shape", options::value<std::string>()->value_name("NAME"), "template: shape of all vaults (default: segmental)")(
      "width", options::value<double>()->value_name("W"),
      "template: width of the bridge, m (default: the generator's)");
  line.positional = {"CASE"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  if (values.count("keys")) {
    fmt::print("{}\n", describe(find_generator(values["keys"].as<std::string>(), "--keys")));
    return 0;
  }
  if (values.count("template")) {
    fmt::print("{}", case_template(template_asked(values)));
    return 0;
  }
  for (const char* key : {"spans", "shape", "width"})
    if (values.count(key)) throw InputError("--{} is an option of the template. Give --template with it", key);
  if (!values.count("CASE")) throw InputError("CASE is missing. Usage: voussoir {}", line.usage);
  const std::string file = values["CASE"].as<std::string>();
  if (values.count("output")) check_ending(values["output"].as<std::string>(), {".h5", ".hdf5"}, "an HDF5 assembly");
  if (h5::File::is_hdf5(file)) return complete(file, values);
  const auto start = std::chrono::steady_clock::now();
  const Case c = read_case(file, CaseUse::geometry);
  const Assembly assembly = make_assembly(c);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string to =
      values.count("output") ? values["output"].as<std::string>() : std::filesystem::path(file).stem().string() + ".h5";
  say_remarks(remarks(c, assembly), values.count("quiet") > 0);
  write_assembly(to, assembly);
  if (!values.count("quiet")) {
    print_assembly_table(assembly, fill_aim(c));
    fmt::print("generated in {:.2f} s, written to {}\n", seconds, to);
  }
  const std::string source = c.generator.empty()
                                 ? "assembly " + std::filesystem::path(c.assembly_file).filename().string()
                                 : "generator " + c.generator;
  draw(assembly, {drawn_name(file), source}, to, values);
  return 0;
}

}  // namespace

Verb generate_verb() {
  return {"generate", "build the blocks and joints of a case, draw them, or print a template of a case", generate};
}

}  // namespace voussoir
