// The meaning of the objects of a drawing by their names: component and part of a bridge, material, groups, fixed or
// not, and the stone of which they are cells.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// Treatment of a shape that is not convex, even after its faces have been made plane. refuse: an error; hull: its
/// convex hull replaces it; cut: it is cut into convex cells of one stone.
enum class NotConvex { refuse, hull, cut };
const std::vector<std::string>& not_convex_words();  // in the order of the enumeration

/// One row of a map: properties of the objects whose name, or whose layer, fits a pattern. Optional ones may be unset.
struct NameRow {
  std::string pattern;  // * stands for any text
  bool layer = false;
  std::optional<Component> component;
  std::optional<std::int32_t> part;
  std::optional<std::string> material;  // name of the material
  std::vector<std::string> groups;
  std::optional<bool> fixed;
  /// The stone of which the objects are cells. Its k-th * stands for the same text as the k-th * of the pattern.
  std::optional<std::string> block;
  std::optional<NotConvex> not_convex;
};

struct NameMap {
  std::string path;                 // used in messages
  std::vector<NameRow> rows;        // rows of layers first, then rows of names, each in the order of the file
  std::vector<Material> materials;  // materials of the table
  bool object_groups = true;        // whether every named object is a group "object NAME"
  bool empty() const { return rows.empty() && materials.empty(); }
};

/// Reads the tables [names], [layers] and [materials.NAME]; keys that a material does not have come from `usual`.
/// Throws InputError "FILE:LINE: …", with the known words if a word is unknown.
NameMap read_name_map(const std::string& path, const Material& usual);
/// The map as a text from which read_name_map() gives the same map bit for bit.
std::string text_of(const NameMap& map);

/// The properties of one object from all rows that fit it: later rows take precedence, groups are collected, and the
/// stars of `block` are replaced. Marks the rows that fit in `used`, which has one entry for each row.
NameRow meaning_of(const NameMap& map, const std::string& name, const std::string& layer, std::vector<bool>& used);

/// Whether a name fits a pattern, in which * stands for any text.
bool fits_pattern(std::string_view name, std::string_view pattern);

}  // namespace voussoir
