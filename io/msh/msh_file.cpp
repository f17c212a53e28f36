#include "io/msh/msh_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "geometry/extent.h"
#include "geometry/fill_mesh.h"
#include "io/msh/element_kinds.h"
#include "io/msh/msh_values.h"
#include "solver/base/atomic_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"

namespace voussoir {

namespace {

using Corners = std::array<std::int64_t, 4>;  // numbers of nodes

struct NumberedNode {
  std::int64_t number = 0;
  Vec3 place;  // units of the file
};

class MshReader {
 public:
  MshReader(const std::string& bytes, const std::string& path) : values_(bytes, path), path_(path) {}

  void read() {
    read_format();
    for (std::string name = values_.section(); !name.empty(); name = values_.section()) {
      if (name == "Nodes")
        begin(has_nodes_, name), version4_ ? read_nodes_4() : read_nodes_2();
      else if (name == "Elements")
        begin(has_elements_, name), version4_ ? read_elements_4() : read_elements_2();
      else if (name == "PhysicalNames")
        read_group_names();
      else {
        values_.skip_section(name);
        continue;
      }
      values_.end_section(name);
    }
    check();
  }
  std::vector<NumberedNode> nodes;  // as in the file
  std::vector<Corners> tets;

 private:
  void read_format() {
    const std::string_view word = values_.word();
    if (word != "$MeshFormat")
      throw InputError(
          "{} is not a Gmsh mesh: it begins with \"{}\" instead of \"$MeshFormat\". Save it from Gmsh as version 4.1 "
          "or 2.2.",
          path_, shown(word));
    const std::string_view version = values_.word();
    if (!version.starts_with("2") && version != "4.1")
      throw InputError("{} is a Gmsh mesh of version {}; save it as version 4.1 or 2.2 (gmsh FILE -save -format msh41)",
                       path_, shown(version));
    version4_ = version == "4.1";
    const std::int64_t binary = values_.whole_word("0 for text or 1 for binary");
    const std::int64_t width = values_.whole_word("the width of its numbers");
    if (binary < 0 || binary > 1 || width != 8)
      values_.fail(fmt::format("the format is {} {}. It must be 0 or 1 (text or binary) and 8 (bytes for each number).",
                               binary, width));
    if (binary == 1) {
      values_.end_line();
      values_.set_binary(false);
      const std::int64_t one = values_.integer(4, "the number 1, which tells the order of bytes");
      if (one != 1 && one != 1 << 24) values_.fail("the number after the format is not 1 in any byte order");
      values_.set_binary(one != 1);
    }
    values_.end_section("MeshFormat");
  }

  void begin(bool& has, const std::string& name) {
    if (has) values_.fail(fmt::format("there is a second section ${}: this seems to be several files in one", name));
    has = true;
    if (version4_ || !values_.binary()) values_.end_line();
  }

  void read_group_names() {
    const std::size_t groups = values_.count(values_.whole_word("the number of groups"), 6, 6, "groups");
    for (std::size_t i = 0; i < groups; ++i) {
      highest_group_ = std::max(highest_group_, values_.whole_word("the dimension of a group"));
      values_.end_line();
    }
  }

  void add_node(std::int64_t number, const Vec3& place) {
    if (number < 1) values_.fail(fmt::format("a node has the number {}, but nodes count from 1", number));
    nodes.push_back({number, place});
  }

  void read_nodes_2() {
    const std::size_t count = values_.count(values_.whole_word("the number of nodes"), 8, 28, "nodes");
    if (values_.binary()) values_.end_line();
    nodes.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t number = values_.integer(4, "the number of a node");
      add_node(number, values_.point());
      values_.end_record("a node");
    }
  }

  void read_nodes_4() {
    const std::int64_t blocks = values_.integer(8, "the number of blocks of nodes");
    const std::size_t count = values_.count(values_.integer(8, "the number of nodes"), 8, 32, "nodes");
    values_.skip(2, 8);  // least and largest number
    nodes.reserve(count);
    std::vector<std::int64_t> numbers;
    for (std::size_t b = values_.count(blocks, 8, 20, "blocks of nodes"); b > 0; --b) {
      const std::int64_t dimension = values_.integer(4, "the dimension of a block of nodes");
      values_.skip(1, 4);  // the entity
      const std::int64_t parametric = values_.integer(4, "0, or 1 for parametric nodes");
      if (dimension < 0 || dimension > 3 || parametric < 0 || parametric > 1)
        values_.fail(
            fmt::format("a block of nodes has dimension {} and parametric {}. They must be 0 to 3, and 0 or 1.",
                        dimension, parametric));
      numbers.resize(values_.count(values_.integer(8, "the number of nodes in a block"), 8, 32, "nodes"));
      for (std::int64_t& number : numbers) number = values_.integer(8, "the number of a node");
      for (const std::int64_t number : numbers) {
        add_node(number, values_.point());
        if (parametric == 1) values_.skip(std::size_t(dimension), 8);
        values_.end_record("a node");
      }
    }
  }

  const ElementKind& kind_of(std::int64_t number) const {
    const ElementKind* kind = element_kind(number);
    if (!kind)
      values_.fail(
          fmt::format("elements have the kind {}, which is not known. Mesh it with Mesh.ElementOrder = 1.", number));
    if (kind->dimension == 3 && number != tetrahedron_kind)
      throw InputError(
          "{}: it has elements \"{} {}\" of {}, but a fill must have tetrahedra of 4 nodes only. Mesh it with "
          "Mesh.ElementOrder = 1 and without recombination.",
          path_, kind->name, kind->nodes, counted(kind->nodes, "node"));
    return *kind;
  }

  void read_element(const ElementKind& kind, std::size_t width) {
    ++elements_[std::size_t(kind.dimension)];
    if (kind.number == tetrahedron_kind) {
      Corners& corners = tets.emplace_back();
      for (std::int64_t& corner : corners) corner = values_.integer(width, "a corner of a tetrahedron");
    } else {
      values_.skip(std::size_t(kind.nodes), width);
    }
    values_.end_record("an element");
  }

  void read_elements_2() {
    const std::size_t count = values_.count(values_.whole_word("the number of elements"), 6, 8, "elements");
    if (values_.binary()) values_.end_line();
    for (std::size_t done = 0; done < count;) {
      if (!values_.binary()) values_.skip(1, 4);  // its number
      const ElementKind& kind = kind_of(values_.integer(4, "the kind of an element"));
      std::size_t alike = 1;
      if (values_.binary()) {
        alike = values_.count(values_.integer(4, "the number of elements of a kind"), 8, 8, "elements");
        if (alike == 0 || alike > count - done)
          values_.fail(fmt::format("{} stated, but only {} are left",
                                   counted(alike, "element of one kind is", "elements of one kind are"), count - done));
      }
      const std::size_t tags = values_.count(values_.integer(4, "the number of tags"), 2, 4, "tags of an element");
      for (std::size_t i = 0; i < alike; ++i) {
        if (values_.binary()) values_.skip(1, 4);  // its number
        for (std::size_t t = 0; t < tags; ++t) {
          const std::int64_t tag = values_.integer(4, "a tag of an element");
          if (t == 0 && tag > 0) highest_group_ = std::max(highest_group_, std::int64_t(kind.dimension));
        }
        read_element(kind, 4);
      }
      done += alike;
    }
  }

  void read_elements_4() {
    const std::int64_t blocks = values_.integer(8, "the number of blocks of elements");
    values_.count(values_.integer(8, "the number of elements"), 4, 16, "elements");
    values_.skip(2, 8);  // least and largest number
    for (std::size_t b = values_.count(blocks, 8, 20, "blocks of elements"); b > 0; --b) {
      values_.skip(2, 4);  // the entity
      const ElementKind& kind = kind_of(values_.integer(4, "the kind of elements"));
      const std::int64_t found = values_.integer(8, "the number of elements in a block");
      for (std::size_t i = values_.count(found, 4, 16, "elements"); i > 0; --i) {
        values_.skip(1, 8);  // its number
        read_element(kind, 8);
      }
    }
  }

  void check() const {
    if (!has_nodes_ || !has_elements_)
      throw InputError("{}: it has no section ${}: the file is damaged or is not a mesh. Save it again from Gmsh.",
                       path_, has_nodes_ ? "Elements" : "Nodes");
    if (!tets.empty()) return;
    static const char* const names[] = {"points", "curves", "surfaces"};
    if (highest_group_ >= 0 && highest_group_ < 3)
      throw InputError(
          "{}: it has no tetrahedra: its physical groups have {} only, and Gmsh saves only elements of groups. Add a "
          "physical volume, or set Mesh.SaveAll = 1.",
          path_, names[highest_group_]);
    throw InputError(
        "{}: it has no tetrahedra (its {} elements on points, lines and surfaces do not count). Mesh its volumes (gmsh "
        "FILE -3). If it has physical groups, add a physical volume, or set Mesh.SaveAll = 1.",
        path_, elements_[0] + elements_[1] + elements_[2]);
  }

  MshValues values_;
  std::string path_;
  bool version4_ = false, has_nodes_ = false, has_elements_ = false;
  std::array<std::size_t, 4> elements_ = {};  // of each dimension
  std::int64_t highest_group_ = -1;           // dimension
};

void sort_by_number(std::vector<NumberedNode>& nodes, const std::string& path) {
  const auto lower = [](const NumberedNode& a, const NumberedNode& b) { return a.number < b.number; };
  std::stable_sort(nodes.begin(), nodes.end(), lower);
  const auto twice =
      std::adjacent_find(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.number == b.number; });
  if (twice != nodes.end())
    throw InputError("{}: node {} is given twice. Give each node its own number.", path, twice->number);
}

/// Place of each corner in the sorted nodes.
std::vector<std::array<std::size_t, 4>> places_of(const std::vector<Corners>& tets,
                                                  const std::vector<NumberedNode>& nodes, const std::string& path) {
  std::vector<std::array<std::size_t, 4>> places(tets.size());
  for (std::size_t i = 0; i < tets.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto found = std::lower_bound(nodes.begin(), nodes.end(), tets[i][k],
                                          [](const NumberedNode& n, std::int64_t number) { return n.number < number; });
      if (found == nodes.end() || found->number != tets[i][k])
        throw InputError("{}: tetrahedron {} has the node {}, which does not exist. Save the file again.", path, i,
                         tets[i][k]);
      places[i][k] = std::size_t(found - nodes.begin());
    }
  return places;
}

FillMesh mesh_of(MshReader& file, const std::string& path, double scale) {
  sort_by_number(file.nodes, path);
  const auto places = places_of(file.tets, file.nodes, path);
  std::vector<std::int32_t> own(file.nodes.size(), -1);  // numbers of the nodes that are used, in their order
  for (const auto& tet : places)
    for (const std::size_t place : tet) own[place] = 0;
  FillMesh mesh;
  for (std::size_t n = 0; n < own.size(); ++n) {
    if (own[n] < 0) continue;
    own[n] = std::int32_t(mesh.nodes.size());
    mesh.nodes.push_back(scale * file.nodes[n].place);
    if (!within_reach(mesh.nodes.back()))
      throw InputError("{}: node {} is at ({}, {}, {}) m. Coordinates must be at most {:g} m. Check --scale ({:g}).",
                       path, file.nodes[n].number, mesh.nodes.back().x(), mesh.nodes.back().y(), mesh.nodes.back().z(),
                       farthest, scale);
  }
  for (const auto& tet : places) {
    auto& corners = mesh.tets.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) corners[k] = own[tet[k]];
  }
  mesh.material.assign(mesh.tets.size(), 0);
  return mesh;
}

}  // namespace

FillMesh parse_msh(const std::string& bytes, const std::string& path, double scale) {
  MshReader file(bytes, path);
  file.read();
  FillMesh mesh = mesh_of(file, path, scale);
  orient_tets(mesh);
  check_fill(mesh, path);
  find_surface(mesh);
  return mesh;
}

FillMesh read_msh(const std::string& path, double scale) {
  return parse_msh(read_text(path), path, scale);
}

}  // namespace voussoir
