// Convex pieces of one stone, which surface files hold as shapes of their own.
#include <algorithm>
#include <map>
#include <numeric>

#include "io/vtk/import_steps.h"
#include "solver/base/error.h"

namespace voussoir {
namespace {

/// "corbel" of "corbel.12".
std::string without_number(const std::string& name) {
  const std::size_t last = name.find_last_not_of("0123456789");
  const bool numbered = last != std::string::npos && last > 0 && last + 1 < name.size() && name[last] == '.';
  return numbered ? name.substr(0, last) : name;
}

/// Numbers of the pieces of each stone, in the order of the first pieces. Pieces without a name stay alone.
std::vector<std::vector<std::size_t>> stones_of(const std::vector<std::string>& objects, CellRule rule) {
  std::vector<std::vector<std::size_t>> stones;
  std::map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const std::string name = rule == CellRule::names ? without_number(objects[i]) : objects[i];
    const auto [entry, fresh] = known.try_emplace(name, stones.size());
    if (fresh || name.empty())
      stones.push_back({i});
    else
      stones[entry->second].push_back(i);
  }
  return stones;
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
  if (rule == CellRule::none) return;
  const auto stones = stones_of(import.objects, rule);
  const auto touching = touching_pieces(import.assembly, search);
  Assembly joined;
  joined.generator = import.assembly.generator;
  std::vector<std::string> names, objects;
  std::size_t of_several = 0;
  for (const std::vector<std::size_t>& pieces : stones) {
    const bool several = pieces.size() > 1;
    const std::string& object = import.objects[pieces[0]];
    const std::string name = rule == CellRule::names && several ? without_number(object) : object;
    if (const std::int64_t apart = piece_apart(pieces, touching); apart >= 0)
      throw InputError(
          "{}: the pieces of '{}' do not make one stone: piece {} of the file ('{}') does not touch the others by a "
          "face; draw it against them, give it another name, or raise --gap ({:g} m)",
          path, name, apart, import.names[std::size_t(apart)], search.gap);
    Block& block = joined.blocks.emplace_back();
    for (const std::size_t i : pieces)
      block.cells.insert(block.cells.end(), import.assembly.blocks[i].cells.begin(),
                         import.assembly.blocks[i].cells.end());
    of_several += several;
    names.push_back(several ? name : import.names[pieces[0]]);
    objects.push_back(several ? name : object);
  }
  import.notes.push_back(
      of_several == 0 ? path + ": no stone is made of several cells: --cells found no pieces that belong together"
                      : fmt::format("{}: {} stones are made of several cells, {} cells in all", path, of_several,
                                    import.objects.size() - (stones.size() - of_several)));
  import.assembly = std::move(joined);
  import.names = std::move(names);
  import.objects = std::move(objects);
}

}  // namespace voussoir
