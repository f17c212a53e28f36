// Generators of block assemblies. A new one is a new file in geometry/ and one line in generator.cpp.
#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// One key a generator understands in the case's [bridge] table.
struct Parameter {
  std::string name;              // key in the case file
  double value = 0.0;            // default
  double low = 0.0, high = 0.0;  // allowed range, inclusive
  std::string unit;              // "m", "deg", "-" …
  std::string help;              // one line
  bool integer = false;
};
/// One key whose value is a word out of a list; the first is the default.
struct Choice {
  std::string name;
  std::vector<std::string> words;
  std::string help;
  bool material = false;  // the word is the name of any of the input's materials
};

/// One key whose value is a list of pairs of numbers in m, [[x, z], …]; it may be left out.
struct Profile {
  std::string name;
  std::string help;
  std::string pair = "[x, z]";               // what a pair says
  bool is_line = true;                       // in the plane x-z, of two points or more from left to right
  std::vector<std::string> instead_of = {};  // keys of the same table that may not stand beside it, and say nothing
};

/// Keys of a table of their own: a list [[bridge.NAME]] of `least` to `most` entries, or, where `most` is 1, the table
/// [bridge.NAME]. In a GeneratorInput they have dotted names, which count from 1 in lists: "span.1.rise",
/// "abutment.left.length".
struct KeyTable {
  std::string name;
  std::string help;  // one line
  std::size_t least = 1, most = 1;
  std::vector<Parameter> parameters;
  std::vector<Choice> choices;
  std::vector<Profile> profiles;
  bool is_list() const { return most > 1; }
  std::string heading() const;  // "[[bridge.span]]"
  /// "span.1.", of entry 0.
  std::string prefix(std::size_t entry) const;
};

/// Values of a generator's keys (all present: defaults filled in), and the materials and joint overrides of the case.
struct GeneratorInput {
  std::map<std::string, double> values;
  std::map<std::string, std::string> choices;
  std::map<std::string, Polygon> profiles;     // pairs as (first, 0, second), m; those that are given
  std::map<std::string, std::size_t> entries;  // of each list of tables
  std::map<std::string, Material> materials;   // by name, defaults filled in; also those that only a choice names
  /// Stiffness and strength that the case sets for a pair of materials: key "masonry-infill" (names in either order).
  struct JointOverride {
    double kn = -1.0, ks = -1.0;  // Pa/m; negative: not set
    bool has_law = false;
    JointLaw law;
  };
  std::map<std::string, JointOverride> joints;
  double gap_tolerance = 1e-4;  // m
  double operator()(const std::string& key) const { return values.at(key); }
};

struct Generator {
  std::string name;
  std::string help;  // one line
  std::vector<Parameter> parameters;
  std::vector<Choice> choices;
  std::vector<KeyTable> tables;
  std::vector<Material> materials;  // defaults
  /// Space that a deformable fill takes up, m3, from the keys alone; none: not known.
  std::function<double(const GeneratorInput&)> fill_space;
  std::function<Assembly(const GeneratorInput&)> build;  // finished: blocks, joints, stiffness, laws, groups
};

const std::vector<Generator>& generators();
/// Throws InputError listing the known names when there is none of that name; `where` is where it was given.
const Generator& find_generator(const std::string& name, const char* where = "[bridge] generator =");
/// All keys of an input, by their dotted names: the generator's own, then those of its tables, entry by entry.
struct Keys {
  std::vector<Parameter> parameters;
  std::vector<Choice> choices;
  std::vector<Profile> profiles;
};
Keys keys_of(const Generator& generator, const GeneratorInput& input);
/// The materials of the input's own that a choice names, each with the generator's material whose values it has where
/// it says nothing: the default of the first key that names it.
std::map<std::string, std::string> own_materials(const Generator& generator, const GeneratorInput& input);
/// Throws InputError for a choice that names a material which the input does not have.
void check_named_materials(const Generator& generator, const GeneratorInput& input);
/// Keys that are dimensions of the bridge, which a survey can have wrong; not those that only say how it is cut into
/// blocks or loaded.
bool is_dimension(const Parameter& parameter);
/// The defaults of a generator as an input to build().
GeneratorInput default_input(const Generator& generator);

/// Throws InputError for the first key that is unknown, missing, out of its range or not a whole number where it must
/// be one, and for a choice that is not in its list of words. build() calls it first.
void check_input(const Generator& generator, const GeneratorInput& input);

/// The keys of a generator as Markdown tables (name, default, range, unit, meaning), for --help and the documentation.
std::string describe(const Generator& generator);

}  // namespace voussoir
