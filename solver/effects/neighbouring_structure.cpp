// A structure next to one end: a mass against the whole end face, tied to the ground behind it by springs.
#include <fmt/format.h>

#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

/// The end face of the box that looks away from the bridge, counter-clockwise about the outward normal.
Polygon far_face(const Box& box, bool left) {
  const double x = left ? box.low.x() : box.high.x();
  const Polygon face = {{x, box.low.y(), box.low.z()},
                        {x, box.high.y(), box.low.z()},
                        {x, box.high.y(), box.high.z()},
                        {x, box.low.y(), box.high.z()}};
  return left ? Polygon(face.rbegin(), face.rend()) : face;
}

void stand_beside(Assembly& assembly, bool left, double stiffness, double mass) {
  const std::vector<EndFace> faces = end_faces(assembly, left);
  Box box = box_of(faces);
  (left ? box.low : box.high).x() += left ? -1.0 : 1.0;
  Material material = assembly.materials[0];
  material.name = fmt::format("neighbour {}", left ? "left" : "right");
  material.density = mass / (box.high - box.low).prod();
  assembly.materials.push_back(material);
  const auto own = std::int32_t(assembly.materials.size()) - 1;
  const std::int64_t neighbour = add_box_block(assembly, box.low, box.high, Component::block, own, false);
  assembly.groups[fmt::format("neighbour {}", left ? "left" : "right")] = {neighbour};
  Box behind = box;
  (left ? behind.high : behind.low).x() = left ? box.low.x() : box.high.x();
  (left ? behind.low : behind.high).x() += left ? -1.0 : 1.0;
  const std::int64_t ground = add_box_block(assembly, behind.low, behind.high, Component::restraint, 0, true);
  assembly.groups[left ? "restraint left" : "restraint right"] = {ground};
  const Polygon face = far_face(box, left);
  const double k = stiffness / polygon_area(face);
  // Ten times as stiff as its springs, so that what hardly holds does not bind the end stones to each other either.
  join_end(assembly, faces, neighbour, 1.0, 10.0 * k);
  add_joint(assembly, neighbour, ground, face, Vec3::UnitX() * (left ? -1.0 : 1.0), k, k, elastic_law_index(assembly));
}

void apply_neighbouring_structure(Assembly& assembly, const std::string& where, const std::vector<double>& values) {
  stand_beside(assembly, where == "left", values[0], values[1]);
}

/// One end each: two neighbours are two effects.
std::vector<std::string> places_of_neighbouring_structure(const Assembly& assembly) {
  std::vector<std::string> names = free_ends(assembly);
  std::erase(names, "both");
  return names;
}

}  // namespace

Effect neighbouring_structure() {
  return {"neighbouring_structure",
          "another structure is in contact with an end of the bridge",
          "Inspect the structure at that end (a wall, a slab or a neighbouring bridge). Check whether the joint "
          "between it and the bridge is open.",
          {{"stiffness", "N/m", "stiffness of its springs to the ground, in each direction", 1e5, 1e12, 1e5, 1e9, 1.5,
            true},
           {"mass", "kg", "mass that moves with the end face", 1e2, 1e7, 1e2, 1e5, 1.5, true}},
          places_of_neighbouring_structure,
          apply_neighbouring_structure,
          nullptr,
          nullptr,
          0.2};
}

}  // namespace voussoir
