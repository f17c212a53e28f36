// Generators of block assemblies. A new generator needs a new file in geometry/ and one line in generator.cpp.
#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// A numeric key of a generator in the [bridge] table of a case.
struct Parameter {
  std::string name;              // key in the case file
  double value = 0.0;            // default
  double low = 0.0, high = 0.0;  // allowed range, inclusive
  std::string unit;              // "m", "deg", "-" …
  std::string help;              // one line
  bool integer = false;
};
/// A key whose value is a word of a list; the first word is the default.
struct Choice {
  std::string name;
  std::vector<std::string> words;
  std::string help;
  bool material = false;  // the value is the name of any material of the input
};

/// An optional key whose value is a list of pairs of numbers in m, [[x, z], …].
struct Profile {
  std::string name;
  std::string help;
  std::string pair = "[x, z]";               // meaning of a pair
  bool is_line = true;                       // a line in the plane x-z: two points or more from left to right
  std::vector<std::string> instead_of = {};  // keys of the same table that it replaces; they must not be given
};

/// Keys of a separate table: a list [[bridge.NAME]] with `least` to `most` entries or, if `most` is 1, the table
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
  /// The beginning of the dotted names of an entry (from 0): "span.1.".
  std::string prefix(std::size_t entry) const;
};

/// Values of all keys of a generator, with defaults for keys that are not given, and the materials and joint overrides
/// of the case.
struct GeneratorInput {
  std::map<std::string, double> values;
  std::map<std::string, std::string> choices;
  std::map<std::string, Polygon> profiles;     // pairs as (first, 0, second), m; only the given ones
  std::map<std::string, std::size_t> entries;  // number of entries of each list of tables
  std::map<std::string, Material> materials;   // by name, with defaults; also materials that only a choice names
  /// Stiffness and strength of the joints between two materials: key "masonry-infill" (names in either order).
  struct JointOverride {
    double kn = -1.0, ks = -1.0;  // Pa/m; negative: not set
    bool has_law = false;
    JointLaw law;
  };
  std::map<std::string, JointOverride> joints;
  double gap_tolerance = 1e-4;  // m
  /// The value of a key. Throws std::out_of_range if `values` does not have it.
  double operator()(const std::string& key) const { return values.at(key); }
};

struct Generator {
  std::string name;
  std::string help;  // one line
  std::vector<Parameter> parameters;
  std::vector<Choice> choices;
  std::vector<KeyTable> tables;
  std::vector<Material> materials;  // defaults
  /// Volume of a deformable fill, m3, from the keys alone; empty: not known.
  std::function<double(const GeneratorInput&)> fill_space;
  std::function<Assembly(const GeneratorInput&)> build;  // makes blocks, joints, stiffness, laws and groups
};

const std::vector<Generator>& generators();
/// Throws InputError with the known names if there is no such generator; `where` is the place of the name in messages.
const Generator& find_generator(const std::string& name, const char* where = "[bridge] generator =");
/// All keys of an input by their dotted names: the keys of the generator, then those of its tables, entry by entry.
struct Keys {
  std::vector<Parameter> parameters;
  std::vector<Choice> choices;
  std::vector<Profile> profiles;
};
Keys keys_of(const Generator& generator, const GeneratorInput& input);
/// The materials that choices name and that the generator does not have. Each comes with the material of the generator
/// from which it takes its missing values: the default of the first key that names it.
std::map<std::string, std::string> own_materials(const Generator& generator, const GeneratorInput& input);
/// Throws InputError if a choice names a material that the input does not have.
void check_named_materials(const Generator& generator, const GeneratorInput& input);
/// Whether a key is a dimension of the bridge, which a survey may have wrong, and not the size of blocks or a load.
bool is_dimension(const Parameter& parameter);
/// The defaults of a generator as input for build().
GeneratorInput default_input(const Generator& generator);

/// Throws InputError for the first key that is unknown, missing, out of range or not a whole number although it must
/// be, for a choice that is not in its list of words, for a wrong number of entries of a list of tables, for materials
/// that are missing or have values out of range, and for gap_tolerance. build() calls this function first.
void check_input(const Generator& generator, const GeneratorInput& input);

/// The keys of a generator as Markdown tables (name, default, range, unit, meaning), for --help and the documentation.
std::string describe(const Generator& generator);

}  // namespace voussoir
