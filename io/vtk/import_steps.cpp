#include "io/vtk/import_steps.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <string_view>

#include "solver/base/error.h"

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

/// A model that lies on its side stands on few stones once it is turned; empty when no axis helps. Modellers that do
/// not draw with z up do so with y.
std::string other_way_up(const Assembly& assembly, const std::string& up, std::int64_t lowest) {
  if (up != "z") return "";
  for (const char* word : {"y", "x"}) {
    Assembly turned = assembly;
    for (Block& block : turned.blocks)
      for (Polyhedron& cell : block.cells)
        for (Vec3& v : cell.vertices) v = turn_of(word) * v;
    fix_lowest(turned, 1e-3);
    const auto count =
        std::count_if(turned.blocks.begin(), turned.blocks.end(), [](const Block& b) { return b.fixed; });
    if (2 * count <= lowest)
      return fmt::format("; with --up {0} it would be {1}: give that if {0} points up there", word, count);
  }
  return "";
}

/// Whether a name is meant by a pattern in which * stands for any text.
bool fits(std::string_view name, std::string_view pattern) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return name == pattern;
  if (!name.starts_with(pattern.substr(0, star))) return false;
  for (std::size_t from = star; from <= name.size(); ++from)
    if (fits(name.substr(from), pattern.substr(star + 1))) return true;
  return false;
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
        "fixed stones '{}': there is no stone '{}'; give numbers 0 to {}, names of objects, 'lowest' or "
        "'none'",
        list, entry, import.names.size() - 1);
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
  if (turn.isIdentity()) throw InputError("--up is '{}'; it must be x, y, z, -x, -y or -z", up);
  return turn;
}

void give_materials(Import& import, const ImportOptions& options, const std::string& path) {
  Assembly& assembly = import.assembly;
  std::size_t rest = options.materials.size();  // the material of all others
  for (std::size_t m = 0; m < options.materials.size(); ++m) {
    assembly.materials.push_back(options.materials[m].material);
    if (options.materials[m].objects.empty()) rest = m;
  }
  std::set<std::string> used;
  bool others = false;
  for (std::size_t i = 0; i < import.objects.size(); ++i) {
    std::size_t own = rest;
    for (std::size_t m = 0; m < options.materials.size(); ++m)
      for (const std::string& pattern : options.materials[m].objects) {
        if (!fits(import.objects[i], pattern)) continue;
        used.insert(pattern);
        if (own != rest && own != m)
          throw InputError("{}: object '{}' fits two materials, {} and {}: name it once", path, import.objects[i],
                           options.materials[own].material.name, options.materials[m].material.name);
        own = m;
      }
    others = others || own == options.materials.size();
    assembly.blocks[i].material = std::int32_t(own);
  }
  for (const MaterialOfObjects& m : options.materials)
    for (const std::string& pattern : m.objects)
      if (!used.contains(pattern))
        throw InputError("{}: material {} is for '{}', but no object has such a name", path, m.material.name, pattern);
  if (!others) return;
  assembly.materials.push_back(options.material);
  for (const MaterialOfObjects& m : options.materials)
    if (m.material.name == options.material.name)
      throw InputError(
          "{}: the material {} names its objects, and there are others: leave out its objects, so that it "
          "is for these",
          path, m.material.name);
}

void fix_stones(Import& import, const ImportOptions& options) {
  if (options.fixed == "lowest") return fix_lowest(import.assembly, std::max(1e-3, options.search.gap));
  if (options.fixed == "none") return;
  for (std::size_t at = 0; at <= options.fixed.size();) {
    const std::size_t comma = std::min(options.fixed.find(',', at), options.fixed.size());
    fix_named(import, options.fixed.substr(at, comma - at), options.fixed);
    at = comma + 1;
  }
}

void note_what_surprises(Import& import, const ImportOptions& options, const std::string& path) {
  const std::vector<Block>& blocks = import.assembly.blocks;
  const std::int64_t n = std::ssize(blocks);
  const auto fixed = std::count_if(blocks.begin(), blocks.end(), [](const Block& b) { return b.fixed; });
  const auto note = [&](const std::string& text) { import.notes.push_back(path + ": " + text); };
  if (fixed == 0) note("no stone is fixed; the assembly will fall as a whole");
  if (fixed == n)
    note(n == 1 ? "its only stone is fixed, so nothing can move; --fixed says what is"
                : "every stone is fixed, so nothing can move; --fixed says which are");
  else if (import.assembly.joints.empty() && n > 1)
    note("no joint was found; --gap says how far apart faces in contact may be, --scale how long a unit is");
  if (options.fixed != "lowest" || n < 3 || 2 * fixed <= n) return;
  if (const std::string other = other_way_up(import.assembly, options.up, fixed); !other.empty())
    note(fmt::format("{} of {} stones reach down to the lowest point and are fixed{}", fixed, n, other));
}

}  // namespace voussoir
