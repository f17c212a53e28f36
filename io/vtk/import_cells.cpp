// Joins convex pieces of one stone, which are separate shapes in surface files.
#include <algorithm>
#include <map>
#include <numeric>

#include "io/vtk/import_steps.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {
namespace {

/// "corbel" of "corbel.12".
std::string without_number(const std::string& name) {
  const std::size_t last = name.find_last_not_of("0123456789");
  const bool numbered = last != std::string::npos && last > 0 && last + 1 < name.size() && name[last] == '.';
  return numbered ? name.substr(0, last) : name;
}

/// The stone to which a piece belongs by the map or the rule; empty: the piece is a separate stone.
std::string stone_of(const Import& import, std::size_t piece, CellRule rule) {
  if (import.meant[piece].block) return *import.meant[piece].block;
  if (rule == CellRule::none) return "";
  return rule == CellRule::names ? without_number(import.objects[piece]) : import.objects[piece];
}

/// Numbers of the pieces of each stone, in the order of the first pieces. Pieces without a name stay alone. A name of
/// the map is another than the same one of the rule.
std::vector<std::vector<std::size_t>> stones_of(const Import& import, CellRule rule) {
  std::vector<std::vector<std::size_t>> stones;
  std::map<std::pair<bool, std::string>, std::size_t> known;
  for (std::size_t i = 0; i < import.objects.size(); ++i) {
    const std::string name = stone_of(import, i, rule);
    const auto [entry, fresh] = known.try_emplace({import.meant[i].block.has_value(), name}, stones.size());
    if (fresh || name.empty())
      stones.push_back({i});
    else
      stones[entry->second].push_back(i);
  }
  return stones;
}

template <class T>
void add_member(std::optional<T>& to, const std::optional<T>& from, const std::string& where, const char* what) {
  if (to && from && *to != *from)
    throw InputError("{} have different values of {}. Give all pieces of a stone the same value.", where, what);
  if (from) to = from;
}

/// The row of the map for all pieces of a stone.
NameRow together(const Import& import, const std::vector<std::size_t>& pieces, const std::string& where) {
  NameRow whole = import.meant[pieces[0]];
  for (const std::size_t i : pieces) {
    const NameRow& piece = import.meant[i];
    add_member(whole.component, piece.component, where, "component");
    add_member(whole.part, piece.part, where, "part");
    add_member(whole.material, piece.material, where, "material");
    add_member(whole.fixed, piece.fixed, where, "being fixed");
    for (const std::string& group : piece.groups)
      if (std::find(whole.groups.begin(), whole.groups.end(), group) == whole.groups.end())
        whole.groups.push_back(group);
  }
  return whole;
}

/// The first piece that cannot be reached from the stone's first one over pieces that touch; none: −1.
std::int64_t piece_apart(const std::vector<std::size_t>& pieces,
                         const std::map<std::size_t, std::vector<std::size_t>>& touching) {
  std::vector<std::size_t> reached = {pieces[0]};
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const auto found = touching.find(reached[k]);
    if (found == touching.end()) continue;
    for (const std::size_t other : found->second)
      if (std::find(reached.begin(), reached.end(), other) == reached.end() &&
          std::find(pieces.begin(), pieces.end(), other) != pieces.end())
        reached.push_back(other);
  }
  for (const std::size_t i : pieces)
    if (std::find(reached.begin(), reached.end(), i) == reached.end()) return std::int64_t(i);
  return -1;
}

std::map<std::size_t, std::vector<std::size_t>> touching_pieces(Assembly pieces, const JointSearch& search) {
  find_joints(pieces, search);
  std::map<std::size_t, std::vector<std::size_t>> touching;
  for (const Joint& joint : pieces.joints) {
    touching[std::size_t(joint.a)].push_back(std::size_t(joint.b));
    touching[std::size_t(joint.b)].push_back(std::size_t(joint.a));
  }
  return touching;
}

}  // namespace

void join_cells(Import& import, CellRule rule, const JointSearch& search, const std::string& path) {
  const bool by_map =
      std::any_of(import.meant.begin(), import.meant.end(), [](const NameRow& row) { return row.block; });
  if (rule == CellRule::none && !by_map) return;
  const auto stones = stones_of(import, rule);
  const auto touching = touching_pieces(import.assembly, search);
  Assembly joined;
  joined.generator = import.assembly.generator;
  std::vector<std::string> names, objects;
  std::vector<NameRow> meant;
  std::vector<bool> supports;
  std::size_t of_several = 0, cells = 0;
  for (const std::vector<std::size_t>& pieces : stones) {
    const bool several = pieces.size() > 1;
    const std::string& object = import.objects[pieces[0]];
    const std::string name = several ? stone_of(import, pieces[0], rule) : object;
    if (const std::int64_t apart = piece_apart(pieces, touching); apart >= 0)
      throw InputError(
          "{}: the pieces of '{}' do not form one stone: piece {} of the file ('{}') has no face in contact with the "
          "others. Move it into contact, give it another name, or raise --gap ({:g} m).",
          path, name, apart, import.names[std::size_t(apart)], search.gap);
    Block& block = joined.blocks.emplace_back();
    for (const std::size_t i : pieces)
      block.cells.insert(block.cells.end(), import.assembly.blocks[i].cells.begin(),
                         import.assembly.blocks[i].cells.end());
    of_several += several;
    if (several) cells += block.cells.size();
    names.push_back(several ? name : import.names[pieces[0]]);
    objects.push_back(several ? name : object);
    meant.push_back(together(import, pieces, fmt::format("{}: the pieces of '{}'", path, name)));
    supports.push_back(std::any_of(pieces.begin(), pieces.end(), [&](std::size_t i) { return import.supports[i]; }));
  }
  import.notes.push_back(
      of_several == 0
          ? path + ": no stone is made of several cells: --cells and --map found no pieces that belong together"
          : fmt::format("{}: {} of several cells, {} cells in all", path,
                        counted(of_several, "stone consists", "stones consist"), cells));
  import.assembly = std::move(joined);
  import.names = std::move(names);
  import.objects = std::move(objects);
  import.meant = std::move(meant);
  import.supports = std::move(supports);
}

}  // namespace voussoir
