// What the objects of a drawing are, by their names: which component and part of a bridge, of which material, in which
// groups, fixed or not, pieces of which stone.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// What becomes of a shape that is not convex, even after its faces have been made plane: it is an error; its convex
/// hull takes its place; it is cut into convex cells of one stone.
enum class NotConvex { refuse, hull, cut };
const std::vector<std::string>& not_convex_words();  // in the order of the enumeration

/// What a map says of the objects whose name, or whose layer's name, fits a pattern. What is not set is left open.
struct NameRow {
  std::string pattern;  // * stands for any text
  bool layer = false;
  std::optional<Component> component;
  std::optional<std::int32_t> part;
  std::optional<std::string> material;  // a name
  std::vector<std::string> groups;
  std::optional<bool> fixed;
  std::optional<std::string>
      block;  // the stone that the objects are cells of; its k-th * is what that of the pattern is
  std::optional<NotConvex> not_convex;
};

struct NameMap {
  std::string path;                 // for messages
  std::vector<NameRow> rows;        // those of layers first, each kind in the file's order
  std::vector<Material> materials;  // that rows name
  bool object_groups = true;        // whether every named object is a group "object NAME"
  bool empty() const { return rows.empty() && materials.empty(); }
};

/// Reads the tables [names], [layers] and [materials.NAME]; what a material leaves out is taken from `usual`. Throws
/// InputError "FILE:LINE: …", with the known words for an unknown one.
NameMap read_name_map(const std::string& path, const Material& usual);
/// The same as a text that read_name_map() reads back to the last bit.
std::string text_of(const NameMap& map);

/// Everything that the rows say of one object: later rows take precedence over earlier ones, groups add up, and the
/// stars of `block` are filled in. Marks the rows that fit in `used`, which has one entry a row.
NameRow meaning_of(const NameMap& map, const std::string& name, const std::string& layer, std::vector<bool>& used);

/// Whether a name is meant by a pattern in which * stands for any text.
bool fits_pattern(std::string_view name, std::string_view pattern);

}  // namespace voussoir
