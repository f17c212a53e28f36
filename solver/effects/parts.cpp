#include "solver/effects/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "geometry/stiffness.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

const std::vector<std::pair<Component, std::string>> families = {{Component::arch, "arch"},
                                                                 {Component::pier, "pier"},
                                                                 {Component::abutment, "abutment"},
                                                                 {Component::spandrel, "spandrel"}};
std::string plural(const std::string& family) {
  return family == "arch" ? "arches" : family + "s";
}

std::string part_name(Component component, const std::string& family, int part) {
  if (component == Component::abutment) return family + (part == 0 ? " left" : " right");
  if (component == Component::spandrel) return family + (part == 0 ? " y-" : part == 1 ? " y+" : " internal");
  return fmt::format("{} {}", family, part);
}

/// The number of the right abutment among the supports, which count from the left. It may have no infill.
int right_abutment_number(const Assembly& assembly) {
  int last = 0;
  for (const Block& b : assembly.blocks) {
    if (b.component == Component::infill) last = std::max(last, int(b.part));
    if (b.component == Component::pier) last = std::max(last, int(b.part) + 2);
  }
  return last;
}

/// Infill carries the number of its support from the left: 0 is the left abutment, then the piers.
std::pair<Component, int> owner_of_infill(int support, int last) {
  if (support == 0) return {Component::abutment, 0};
  if (support == last) return {Component::abutment, 1};
  return {Component::pier, support - 1};
}

bool is_masonry(Component c) {
  return c == Component::arch || c == Component::pier || c == Component::abutment || c == Component::backing ||
         c == Component::spandrel || c == Component::parapet || c == Component::wall || c == Component::block;
}

}  // namespace

BlockSet blocks_where(const Assembly& assembly, const std::function<bool(const Block&)>& in) {
  BlockSet set(assembly.blocks.size());
  for (std::size_t i = 0; i < set.size(); ++i) set[i] = in(assembly.blocks[i]);
  return set;
}

std::vector<std::string> masonry_parts(const Assembly& assembly) {
  std::vector<std::string> names;
  for (const auto& [family_component, family] : families) {
    std::set<int> parts;
    for (const Block& b : assembly.blocks)
      if (b.component == family_component && !b.fixed) parts.insert(b.part);
    for (int part : parts) names.push_back(part_name(family_component, family, part));
    if (parts.size() > 1) names.push_back(plural(family));
  }
  for (const Block& b : assembly.blocks)
    if (b.component == Component::backing) {
      names.push_back("backing");
      break;
    }
  names.push_back("all");
  return names;
}

BlockSet masonry_part(const Assembly& assembly, const std::string& name) {
  if (name == "all") return blocks_where(assembly, [](const Block& b) { return is_masonry(b.component); });
  if (name == "backing") return component(assembly, Component::backing);
  const int last = right_abutment_number(assembly);
  const auto is_it = [&](Component own, int part) {
    if (own == Component::infill) std::tie(own, part) = owner_of_infill(part, last);
    for (const auto& [family_component, family] : families)
      if (own == family_component) return name == plural(family) || name == part_name(own, family, part);
    return false;
  };
  std::map<std::pair<Component, int>, bool> known;  // names are compared once
  return blocks_where(assembly, [&](const Block& b) {
    const auto [at, fresh] = known.try_emplace({b.component, b.part}, false);
    if (fresh) at->second = is_it(b.component, b.part);
    return at->second;
  });
}

std::vector<std::string> parts_of_blocks(const Assembly& assembly) {
  static const std::vector<std::string> groups = {"arches", "piers", "abutments", "spandrels", "all"};
  std::vector<std::string> of(assembly.blocks.size());
  for (const std::string& name : masonry_parts(assembly)) {
    if (std::find(groups.begin(), groups.end(), name) != groups.end()) continue;
    const BlockSet part = masonry_part(assembly, name);
    for (std::size_t i = 0; i < part.size(); ++i)
      if (part[i]) of[i] = name;
  }
  for (std::size_t i = 0; i < of.size(); ++i)
    if (of[i].empty()) of[i] = component_names()[std::size_t(assembly.blocks[i].component)];
  return of;
}

std::vector<std::string> supports(const Assembly& assembly) {
  std::vector<std::string> names;
  for (const auto& [name, blocks] : assembly.groups)
    if (name.starts_with("base ") && blocks.size() == 1) names.push_back(name.substr(5));
  return names;
}

std::int64_t base_of(const Assembly& assembly, const std::string& support) {
  return assembly.groups.at("base " + support)[0];
}

std::vector<EndFace> end_faces(const Assembly& assembly, bool left) {
  const auto counts = [](const Block& b) { return !b.fixed && b.component != Component::parapet; };
  double plane = left ? 1e300 : -1e300;
  std::vector<double> reach;  // of each block
  for (const Block& b : assembly.blocks) {
    const Box box = counts(b) ? block_box(b) : Box();
    reach.push_back(left ? box.low.x() : box.high.x());
    if (counts(b)) plane = left ? std::min(plane, reach.back()) : std::max(plane, reach.back());
  }
  std::vector<EndFace> found;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Block& b = assembly.blocks[i];
    if (!counts(b) || std::abs(reach[i] - plane) > 1e-6) continue;
    for (std::size_t c = 0; c < b.cells.size(); ++c)
      for (std::size_t f = 0; f < b.cells[c].faces.size(); ++f) {
        const Plane face = face_plane(b.cells[c], int(f));
        if (face.normal.x() * (left ? -1.0 : 1.0) < 0.9999) continue;
        const Polygon polygon = face_polygon(b.cells[c], int(f));
        if (std::abs(polygon_centroid(polygon).x() - plane) > 1e-6) continue;
        found.push_back({std::int64_t(i), std::int32_t(c), std::int32_t(f), polygon});
      }
  }
  return found;
}

std::vector<std::string> free_ends(const Assembly& assembly) {
  const bool spans = assembly.groups.contains("base abutment left") && assembly.groups.contains("base abutment right");
  const bool taken_left = assembly.groups.contains("restraint left"),
             taken_right = assembly.groups.contains("restraint right");
  std::vector<std::string> ends;
  if (!spans) return ends;
  if (!taken_left) ends.push_back("left");
  if (!taken_right) ends.push_back("right");
  if (ends.size() == 2) ends.push_back("both");
  return ends;
}

std::vector<std::string> all_if_any(const Assembly& assembly, Component c) {
  const BlockSet set = component(assembly, c);
  if (std::find(set.begin(), set.end(), true) == set.end()) return {};
  return {"all"};
}

void scale_inside(Assembly& assembly, const BlockSet& part, double factor) {
  scale_between(assembly, part, part, factor);
}

void scale_between(Assembly& assembly, const BlockSet& one, const BlockSet& other, double factor) {
  for (Joint& joint : assembly.joints) {
    const auto a = std::size_t(joint.a), b = std::size_t(joint.b);
    if ((!(one[a] && other[b]) && !(one[b] && other[a])) || is_tie(assembly, joint)) continue;
    joint.kn *= factor;
    joint.ks *= factor;
  }
}

void strengthen(Assembly& assembly, const std::function<bool(const Joint&)>& chosen, double tension, double cohesion,
                double factor) {
  for (Joint& joint : assembly.joints) {
    JointLaw law = assembly.laws[std::size_t(joint.law)];
    if (law.kind == JointLaw::Kind::elastic || law.kind == JointLaw::Kind::tie || !chosen(joint)) continue;
    law.tension = std::max(law.tension, tension);
    law.cohesion = std::max(law.cohesion, cohesion);
    joint.law = law_index(assembly.laws, law);
    joint.kn *= factor;
    joint.ks *= factor;
  }
}

void scale_density(Assembly& assembly, const BlockSet& part, double factor) {
  std::map<std::int32_t, std::int32_t> scaled;  // materials
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    if (i >= part.size() || !part[i]) continue;
    Block& block = assembly.blocks[i];
    if (!scaled.contains(block.material)) {
      scaled[block.material] = std::int32_t(assembly.materials.size());
      assembly.materials.push_back(assembly.materials[std::size_t(block.material)]);
      assembly.materials.back().density *= factor;
    }
    block.material = scaled[block.material];
    block.mass *= factor;
    block.inertia *= factor;
  }
}

std::vector<std::string> all_if_filled(const Assembly& assembly) {
  if (!assembly.fill.empty()) return {"all"};
  return all_if_any(assembly, Component::backfill);
}

void scale_fill(Assembly& assembly, double stiffness, double density) {
  std::map<std::int32_t, std::int32_t> scaled;  // materials
  for (std::int32_t& material : assembly.fill.material) {
    const auto [own, fresh] = scaled.try_emplace(material, std::int32_t(assembly.materials.size()));
    if (fresh) {
      Material changed = assembly.materials[std::size_t(material)];
      changed.youngs_modulus *= stiffness, changed.shear_modulus *= stiffness;
      changed.density *= density;
      assembly.materials.push_back(changed);
    }
    material = own->second;
  }
}

void scale_patches(Assembly& assembly, const BlockSet& part, double factor) {
  for (FillJoint& patch : assembly.fill_joints) {
    if (!part[std::size_t(patch.block)]) continue;
    patch.kn *= factor;
    patch.ks *= factor;
  }
}

void scale_masonry_part(Assembly& assembly, const std::string& where, const std::vector<double>& values) {
  scale_inside(assembly, masonry_part(assembly, where), values[0]);
}

Neighbourhood lengthways(const Assembly& assembly, Component wanted) {
  const auto mean_over = [&](const auto& counts) {
    Neighbourhood sum;
    double area = 0.0;
    for (const Joint& joint : assembly.joints) {
      const Block &a = assembly.blocks[std::size_t(joint.a)], &b = assembly.blocks[std::size_t(joint.b)];
      if (std::abs(joint.normal.x()) < 0.9 || !counts(a) || !counts(b)) continue;
      area += joint.area;
      sum.kn += joint.area * joint.kn;
      sum.ks += joint.area * joint.ks;
      sum.law = joint.law;
    }
    if (area > 0.0) sum.kn /= area, sum.ks /= area;
    return sum;
  };
  const Neighbourhood own = mean_over([&](const Block& b) { return b.component == wanted; });
  return own.kn > 0.0 ? own : mean_over([](const Block& b) { return is_masonry(b.component); });
}

std::int64_t add_box_block(Assembly& assembly, const Vec3& low, const Vec3& high, Component kind, std::int32_t material,
                           bool fixed) {
  Block block;
  block.cells = {make_box(low, high)};
  block.component = kind;
  block.material = material;
  block.fixed = fixed;
  Assembly alone;  // the others are finished
  alone.materials = assembly.materials;
  alone.blocks.push_back(std::move(block));
  finish_blocks(alone);
  assembly.blocks.push_back(std::move(alone.blocks[0]));
  return std::int64_t(assembly.blocks.size()) - 1;
}

Joint& add_joint(Assembly& assembly, std::int64_t a, std::int64_t b, const Polygon& polygon, const Vec3& normal,
                 double kn, double ks, std::int32_t law) {
  Joint joint;
  joint.a = a, joint.b = b;
  joint.polygon = polygon;
  joint.normal = normal;
  joint.area = polygon_area(polygon);
  joint.kn = kn, joint.ks = ks;
  joint.law = law;
  if (joint.a > joint.b) {
    std::swap(joint.a, joint.b);
    joint.normal = -normal;
    std::reverse(joint.polygon.begin(), joint.polygon.end());
  }
  assembly.joints.push_back(std::move(joint));
  return assembly.joints.back();
}

void join_end(Assembly& assembly, const std::vector<EndFace>& faces, std::int64_t block, double share, double most) {
  std::map<Component, Neighbourhood> around;
  for (const EndFace& face : faces) {
    const Component c = assembly.blocks[std::size_t(face.block)].component;
    if (!around.contains(c)) around[c] = lengthways(assembly, c);
    const Neighbourhood& n = around[c];
    Joint& joint = add_joint(assembly, face.block, block, face.polygon, polygon_normal(face.polygon),
                             std::min(most, share * n.kn), std::min(most, share * n.ks), n.law);
    joint.cell_a = face.cell;
    joint.face_a = face.face;
  }
}

Box box_of(const std::vector<EndFace>& faces) {
  Box box;
  for (const EndFace& face : faces) {
    const Box own = bounding_box(face.polygon);
    box.low = box.low.cwiseMin(own.low), box.high = box.high.cwiseMax(own.high);
  }
  return box;
}

std::int32_t elastic_law_index(Assembly& assembly) {
  JointLaw law;
  law.kind = JointLaw::Kind::elastic;
  return law_index(assembly.laws, law);
}

void sort_joints(Assembly& assembly) {
  const auto key = [](const Joint& j) { return std::tuple(j.a, j.b, j.cell_a, j.cell_b, j.face_a, j.face_b); };
  const auto before = [&](const Joint& x, const Joint& y) { return key(x) < key(y); };
  // Mostly a few stand at the end that have just been added.
  const auto first = assembly.joints.begin(), last = assembly.joints.end();
  const auto unsorted = std::is_sorted_until(first, last, before);
  std::stable_sort(unsorted, last, before);
  std::inplace_merge(first, unsorted, last, before);
}

}  // namespace voussoir
