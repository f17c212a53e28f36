// Kinds of elements in Gmsh files. Private to io/msh.
#pragma once
#include <cstdint>
#include <string>

namespace voussoir {

struct ElementKind {
  int number;        // in the file
  const char* name;  // usual name
  int nodes;
  int dimension;  // 0 point, 1 line, 2 surface, 3 solid
};

inline constexpr std::int64_t tetrahedron_kind = 4;  // of 4 nodes

/// The kind with this number in the manual of Gmsh (version 4.11, "MSH file format"); null if there is none.
inline const ElementKind* element_kind(std::int64_t number) {
  static constexpr ElementKind kinds[] = {
      {1, "line", 2, 1},          {2, "triangle", 3, 2},      {3, "quadrangle", 4, 2},    {4, "tetrahedron", 4, 3},
      {5, "hexahedron", 8, 3},    {6, "prism", 6, 3},         {7, "pyramid", 5, 3},       {8, "line", 3, 1},
      {9, "triangle", 6, 2},      {10, "quadrangle", 9, 2},   {11, "tetrahedron", 10, 3}, {12, "hexahedron", 27, 3},
      {13, "prism", 18, 3},       {14, "pyramid", 14, 3},     {15, "point", 1, 0},        {16, "quadrangle", 8, 2},
      {17, "hexahedron", 20, 3},  {18, "prism", 15, 3},       {19, "pyramid", 13, 3},     {20, "triangle", 9, 2},
      {21, "triangle", 10, 2},    {22, "triangle", 12, 2},    {23, "triangle", 15, 2},    {24, "triangle", 15, 2},
      {25, "triangle", 21, 2},    {26, "line", 4, 1},         {27, "line", 5, 1},         {28, "line", 6, 1},
      {29, "tetrahedron", 20, 3}, {30, "tetrahedron", 35, 3}, {31, "tetrahedron", 56, 3}, {92, "hexahedron", 64, 3},
      {93, "hexahedron", 125, 3},
  };
  for (const ElementKind& kind : kinds)
    if (kind.number == number) return &kind;
  return nullptr;
}

}  // namespace voussoir
