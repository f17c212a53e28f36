#include "io/vtk/import_steps.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <string_view>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"
#include "solver/base/suggestion.h"

namespace voussoir {
namespace {

double lowest_point(const Block& block) {
  return block_box(block).low.z();
}

void fix_lowest(Assembly& assembly, double within) {
  double lowest = 1e300;
  for (const Block& block : assembly.blocks) lowest = std::min(lowest, lowest_point(block));
  for (Block& block : assembly.blocks) block.fixed = lowest_point(block) <= lowest + within;
}

/// A hint for a model that lies on its side: with another axis up it has few lowest stones; empty if no axis helps.
/// Programs without z up have y up.
std::string other_way_up(const Assembly& assembly, const std::string& up, std::int64_t lowest) {
  if (up != "z" && !up.empty()) return "";
  for (const char* word : {"y", "x"}) {
    Assembly turned = assembly;
    for (Block& block : turned.blocks)
      for (Polyhedron& cell : block.cells)
        for (Vec3& v : cell.vertices) v = turn_of(word) * v;
    fix_lowest(turned, 1e-3);
    const auto count =
        std::count_if(turned.blocks.begin(), turned.blocks.end(), [](const Block& b) { return b.fixed; });
    if (2 * count <= lowest)
      return fmt::format("; with --up {0} there would be {1}: give --up {0} if this axis points up in the file", word,
                         count);
  }
  return "";
}

/// One entry of a list such as "0,3,plinth": a number, or the name of an object (all its stones).
void fix_named(Import& import, const std::string& entry, const std::string& list) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(entry.data(), entry.data() + entry.size(), number);
  if (error == std::errc{} && end == entry.data() + entry.size() && number < import.names.size()) {
    import.assembly.blocks[number].fixed = true;
    return;
  }
  bool found = false;
  for (std::size_t i = 0; i < import.names.size(); ++i) {
    if (import.names[i] != entry && import.objects[i] != entry) continue;
    import.assembly.blocks[i].fixed = found = true;
  }
  if (!found)
    throw InputError(
        "fixed stones '{}': there is no stone '{}'. Give numbers from 0 to {}, names of objects, 'lowest' or 'none'.",
        list, entry, import.names.size() - 1);
}

void fix_asked(Import& import, const ImportOptions& options) {
  if (options.fixed == "lowest") return fix_lowest(import.assembly, std::max(1e-3, options.search.gap));
  if (options.fixed == "none") return;
  for (std::size_t at = 0; at <= options.fixed.size();) {
    const std::size_t comma = std::min(options.fixed.find(',', at), options.fixed.size());
    fix_named(import, options.fixed.substr(at, comma - at), options.fixed);
    at = comma + 1;
  }
}

/// A drawing in another unit than thought.
std::string odd_size(const Assembly& assembly) {
  Box box;
  for (const Block& block : assembly.blocks) {
    const Box own = block_box(block);
    box.low = box.low.cwiseMin(own.low), box.high = box.high.cwiseMax(own.high);
  }
  const double size = (box.high - box.low).maxCoeff();
  if (size > 2000.0)
    return fmt::format(
        "the model is {:.4g} m long or high; if that is wrong, set its unit with --units (mm, cm, in, ft)", size);
  if (size < 0.02)
    return fmt::format("the model is {:.3g} m long or high; if that is wrong, set its unit with --units", size);
  return "";
}

}  // namespace

Mat3 turn_of(const std::string& up) {
  Mat3 turn = Mat3::Identity();
  if (up == "z") return turn;
  if (up == "y") turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  if (up == "x") turn << 0, 0, -1, 0, 1, 0, 1, 0, 0;
  if (up == "-x") turn << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  if (up == "-y") turn << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  if (up == "-z") turn << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  if (turn.isIdentity()) throw InputError("--up is '{}'. It must be x, y, z, -x, -y or -z.", up);
  return turn;
}

void note_strangers(const std::vector<Shell>& shells, const std::vector<NameRow>& meant, const std::vector<bool>& used,
                    const NameMap& map, std::vector<std::string>& notes) {
  const auto listed = [](const std::set<std::string>& names) {
    std::string text;
    std::size_t i = 0;
    for (const std::string& name : names) {
      if (i == 5) return fmt::format("{}, … ({} in all)", text, names.size());
      text += fmt::format("{}'{}'", i++ > 0 ? ", " : "", shown(name));
    }
    return text;
  };
  for (const bool layers : {true, false}) {
    std::set<std::string> idle;
    for (std::size_t i = 0; i < used.size(); ++i)
      if (!used[i] && map.rows[i].layer == layers) idle.insert(map.rows[i].pattern);
    if (!idle.empty())
      notes.push_back(
          fmt::format("{}: no {} fits {}", map.path, layers ? "layer of the drawing" : "object", listed(idle)));
  }
  std::set<std::string> strangers;
  for (std::size_t i = 0; i < shells.size(); ++i)
    if (meant[i].pattern.empty()) strangers.insert(shells[i].object.empty() ? "(no name)" : shells[i].object);
  if (!strangers.empty())
    notes.push_back(fmt::format("{}: the map has no row for the objects {}", map.path, listed(strangers)));
}

void give_places(Import& import) {
  for (std::size_t i = 0; i < import.meant.size(); ++i) {
    Block& block = import.assembly.blocks[i];
    block.component = import.meant[i].component.value_or(block.component);
    block.part = import.meant[i].part.value_or(block.part);
  }
}

namespace {

/// The materials that there are, and of each stone which one is given to it by its object; −1: none.
class MaterialsOfStones {
 public:
  MaterialsOfStones(const Import& import, const ImportOptions& options, const std::string& path)
      : import_(import), options_(options), path_(path) {
    for (const MaterialOfObjects& m : options.materials) add(m.material);
    for (const Material& m : options.map.materials) add(m);
    of_stone_.assign(import.objects.size(), -1);
    by_lists();
    by_map();
  }
  std::vector<Material> materials_;
  std::vector<std::int32_t> of_stone_;

 private:
  void add(const Material& m) {
    if (find(m.name) >= 0)
      throw InputError("{}: the material {} is also in the table of --materials. Give it once.", options_.map.path,
                       m.name);
    materials_.push_back(m);
  }

  std::int32_t find(const std::string& name) const {
    for (std::size_t m = 0; m < materials_.size(); ++m)
      if (materials_[m].name == name) return std::int32_t(m);
    return -1;
  }

  void set(std::size_t stone, std::int32_t material) {
    std::int32_t& own = of_stone_[stone];
    if (own >= 0 && own != material)
      throw InputError("{}: object '{}' fits two materials, {} and {}. Name it once.", path_, import_.objects[stone],
                       materials_[std::size_t(own)].name, materials_[std::size_t(material)].name);
    own = material;
  }

  void by_lists() {
    for (std::size_t m = 0; m < options_.materials.size(); ++m)
      for (const std::string& pattern : options_.materials[m].objects) {
        bool used = false;
        for (std::size_t i = 0; i < import_.objects.size(); ++i) {
          if (!fits_pattern(import_.objects[i], pattern)) continue;
          set(i, std::int32_t(m));
          used = true;
        }
        if (!used)
          throw InputError("{}: material {} is for '{}', but no object has such a name", path_,
                           options_.materials[m].material.name, pattern);
      }
  }

  void by_map() {
    for (std::size_t i = 0; i < import_.objects.size(); ++i) {
      const std::optional<std::string>& name = import_.meant[i].material;
      if (!name) continue;
      const std::int32_t material = find(*name);
      if (material < 0 && *name == options_.material.name) continue;  // that of all others
      std::vector<std::string> known = {options_.material.name};
      for (const Material& m : materials_) known.push_back(m.name);
      if (material < 0)
        throw InputError("{}: the material '{}' of object '{}' is not known{}", options_.map.path, shown(*name),
                         import_.objects[i], suggestion(*name, known));
      set(i, material);
    }
  }

  const Import& import_;
  const ImportOptions& options_;
  const std::string& path_;
};

}  // namespace

void give_materials(Import& import, const ImportOptions& options, const std::string& path) {
  MaterialsOfStones found(import, options, path);
  std::vector<Material>& materials = import.assembly.materials = std::move(found.materials_);
  std::int32_t rest = std::int32_t(materials.size());  // the material of all others
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const bool listed = m < options.materials.size();
    if (listed ? options.materials[m].objects.empty() : materials[m].name == options.material.name)
      rest = std::int32_t(m);
  }
  bool others = false;
  std::vector<bool> used(materials.size());
  for (std::size_t i = 0; i < import.objects.size(); ++i) {
    const std::int32_t own = found.of_stone_[i] < 0 ? rest : found.of_stone_[i];
    import.assembly.blocks[i].material = own;
    if (own < std::int32_t(used.size())) used[std::size_t(own)] = true;
    others = others || own == std::int32_t(materials.size());
  }
  for (std::size_t m = options.materials.size(); m < materials.size(); ++m)
    if (!used[m])
      import.notes.push_back(fmt::format("{}: no stone has the material {}", options.map.path, materials[m].name));
  if (!others) return;
  for (const MaterialOfObjects& m : options.materials)
    if (m.material.name == options.material.name)
      throw InputError(
          "{}: the material {} has a list of objects, but other objects need it, too. Leave out its objects, so that "
          "it applies to all others.",
          path, m.material.name);
  materials.push_back(options.material);
}

bool fix_stones(Import& import, const ImportOptions& options, const std::string& path) {
  const auto fixed_by_map = [](const NameRow& row) { return row.fixed.value_or(false); };
  const bool mapped = std::any_of(import.meant.begin(), import.meant.end(), fixed_by_map);
  bool asked = false;
  const auto supports = std::count(import.supports.begin(), import.supports.end(), true);
  if (options.keep_fixed && supports > 0) {
    for (std::size_t i = 0; i < import.supports.size(); ++i) import.assembly.blocks[i].fixed = import.supports[i];
    import.notes.push_back(fmt::format(
        "{}: {} fixed", path,
        counted(supports, "stone is a support in this file and is", "stones are supports in this file and are")));
  } else if (!(options.keep_fixed && mapped)) {
    asked = true;
    fix_asked(import, options);
  }
  for (std::size_t i = 0; i < import.meant.size(); ++i)
    if (import.meant[i].fixed) import.assembly.blocks[i].fixed = *import.meant[i].fixed;
  return asked;
}

void note_what_surprises(Import& import, const ImportOptions& options, const std::string& path) {
  const std::vector<Block>& blocks = import.assembly.blocks;
  const std::int64_t n = std::ssize(blocks);
  const auto fixed = std::count_if(blocks.begin(), blocks.end(), [](const Block& b) { return b.fixed; });
  const auto note = [&](const std::string& text) { import.notes.push_back(path + ": " + text); };
  if (fixed == 0) note("no stone is fixed; the whole assembly will fall");
  if (fixed == n)
    note(n == 1 ? "the only stone is fixed, so nothing can move; --fixed sets the fixed stones"
                : "every stone is fixed, so nothing can move; --fixed sets the fixed stones");
  else if (import.assembly.joints.empty() && n > 1)
    note("no joint was found; --gap sets the largest distance of faces in contact, --units the unit of the file");
  if (const std::string odd = odd_size(import.assembly); !odd.empty()) note(odd);
  if (options.fixed != "lowest" || n < 3 || 2 * fixed <= n) return;
  if (const std::string other = other_way_up(import.assembly, options.up, fixed); !other.empty())
    note(fmt::format("{} of {} stones reach the lowest point and are fixed{}", fixed, n, other));
}

}  // namespace voussoir
