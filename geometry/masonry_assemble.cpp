// Makes an assembly of a layout: finds the joints once, merges slivers with their neighbours, renumbers the joints.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>

#include "geometry/joints.h"
#include "geometry/masonry.h"

namespace voussoir {

namespace {

/// A length, area or volume (m, m2, m3) as a whole number of grains of 1e-11. Bridges are symmetric and have round
/// dimensions: measures that are equal by design, or lie on a limit, differ by their rounding, which depends on the
/// compiler. In grains they are equal.
std::int64_t grains(double measure) {
  constexpr double most = 1e7;
  return std::llround(1e11 * std::min(measure, most));
}

/// Stones that were joined into one, as lists of stone indices; the first of a list is the stone that took in the rest.
class Groups {
 public:
  explicit Groups(std::size_t n) : root_(n), members_(n) {
    std::iota(root_.begin(), root_.end(), 0);
    for (std::size_t i = 0; i < n; ++i) members_[i] = {i};
  }
  std::size_t root(std::size_t i) const { return root_[i]; }
  const std::vector<std::size_t>& members(std::size_t root) const { return members_[root]; }
  void join(std::size_t host, std::size_t guest) {
    for (const std::size_t i : members_[guest]) {
      root_[i] = host;
      members_[host].push_back(i);
    }
    members_[guest].clear();
  }

 private:
  std::vector<std::size_t> root_;
  std::vector<std::vector<std::size_t>> members_;
};

/// Smallest extent of a set of cells over their face normals, m.
double thinness(const std::vector<const Polyhedron*>& cells) {
  double smallest = 1e300;
  for (const Polyhedron* cell : cells) {
    for (int f = 0; f < int(cell->faces.size()); ++f) {
      const Vec3 n = face_plane(*cell, f).normal;
      double low = 1e300, high = -1e300;
      for (const Polyhedron* other : cells) {
        for (const Vec3& v : other->vertices) low = std::min(low, n.dot(v)), high = std::max(high, n.dot(v));
      }
      smallest = std::min(smallest, high - low);
    }
  }
  return smallest;
}

bool is_sliver(const std::vector<Stone>& stones, const std::vector<std::size_t>& members, const SliverRule& rule) {
  double volume = 0.0;
  std::vector<const Polyhedron*> cells;
  for (const std::size_t i : members) {
    if (!stones[i].was_cut) return false;
    for (const Polyhedron& cell : stones[i].cells) {
      cells.push_back(&cell);
      volume += mass_properties(cell).volume;
    }
  }
  const Vec3& nominal = stones[members.front()].nominal;
  if (grains(volume) < grains(rule.share * nominal.prod())) return true;
  return grains(thinness(cells)) < grains(std::min(rule.thickness, 0.5 * nominal.minCoeff()));
}

/// Volumes of the groups, and how large each may become, m3.
class Sizes {
 public:
  Sizes(const std::vector<Stone>& stones, double most) {
    for (const Stone& stone : stones) {
      volume_.push_back(grains(mass_properties(stone.cells).volume));
      most_.push_back(grains(most * stone.nominal.prod()));
    }
  }
  void join(std::size_t host, std::size_t guest) { volume_[host] += volume_[guest]; }
  bool fit(std::size_t a, std::size_t b) const { return volume_[a] + volume_[b] <= most_[b]; }
  std::int64_t volume(std::size_t i) const { return volume_[i]; }

 private:
  std::vector<std::int64_t> volume_, most_;  // grains
};

struct Contact {
  std::size_t stone = 0;
  std::int64_t area = 0;  // grains
};

/// Joints of each stone with others of its own component, material and layer.
std::vector<std::vector<Contact>> like_neighbours(const std::vector<Stone>& stones, const std::vector<Joint>& joints) {
  std::vector<std::vector<Contact>> contacts(stones.size());
  for (const Joint& joint : joints) {
    const auto a = std::size_t(joint.a), b = std::size_t(joint.b);
    if (stones[a].component != stones[b].component || stones[a].material != stones[b].material ||
        (stones[a].layers & stones[b].layers) == 0)
      continue;
    contacts[a].push_back({b, grains(joint.area)});
    contacts[b].push_back({a, grains(joint.area)});
  }
  return contacts;
}

constexpr std::int64_t part_of_a_joint = 20;  // a twentieth of the largest is the least that counts

/// The group a sliver joins: the one it shares most area with, whole stones before other slivers, and before all those
/// that do not become larger than the rule allows; of equals the first; itself if none.
std::size_t best_host(std::size_t sliver, const Groups& groups, const std::vector<std::vector<Contact>>& contacts,
                      const std::vector<char>& slivers, const Sizes& sizes) {
  std::map<std::size_t, std::int64_t> shared;
  for (const std::size_t i : groups.members(sliver)) {
    for (const Contact& contact : contacts[i]) {
      const std::size_t other = groups.root(contact.stone);
      if (other != sliver) shared[other] += contact.area;
    }
  }
  std::int64_t most = 0;
  for (const auto& [other, area] : shared) most = std::max(most, area);
  std::size_t best = sliver;
  for (const auto& [other, area] : shared) {
    if (part_of_a_joint * area < most) continue;  // it would hang by a corner
    const auto rank = [&](std::size_t i) { return std::make_tuple(sizes.fit(sliver, i), slivers[i] == 0, shared[i]); };
    if (best == sliver || rank(other) > rank(best)) best = other;
  }
  return best;
}

Groups join_slivers(const std::vector<Stone>& stones, const std::vector<Joint>& joints, const SliverRule& rule) {
  Groups groups(stones.size());
  const auto contacts = like_neighbours(stones, joints);
  std::vector<char> slivers(stones.size(), 0);
  Sizes sizes(stones, rule.most);
  std::vector<std::pair<std::int64_t, std::size_t>> queue;  // smallest first
  for (std::size_t i = 0; i < stones.size(); ++i) {
    slivers[i] = is_sliver(stones, {i}, rule);
    if (slivers[i]) queue.emplace_back(sizes.volume(i), i);
  }
  std::sort(queue.begin(), queue.end());
  for (std::size_t q = 0; q < queue.size(); ++q) {
    const std::size_t sliver = groups.root(queue[q].second);
    if (!slivers[sliver]) continue;
    const std::size_t host = best_host(sliver, groups, contacts, slivers, sizes);
    if (host == sliver) continue;  // alone of its kind: it stays
    groups.join(host, sliver);
    sizes.join(host, sliver);
    if (slivers[host]) {
      slivers[host] = is_sliver(stones, groups.members(host), rule);
      if (slivers[host]) queue.emplace_back(0, host);  // two slivers that are still one: look again later
    }
  }
  return groups;
}

/// The block of each stone, and the first of its cells in that block.
struct Place {
  std::int64_t block = 0;
  std::int32_t first_cell = 0;
};

std::vector<Place> make_blocks(Assembly& assembly, std::vector<Stone>& stones, const Groups& groups) {
  std::vector<Place> places(stones.size());
  for (std::size_t i = 0; i < stones.size(); ++i) {
    if (groups.root(i) != i) continue;
    Block block;
    block.component = stones[i].component;
    block.part = stones[i].part;
    block.material = stones[i].material;
    block.fixed = stones[i].fixed;
    for (const std::size_t j : groups.members(i)) {
      places[j] = {std::int64_t(assembly.blocks.size()), std::int32_t(block.cells.size())};
      for (Polyhedron& cell : stones[j].cells) block.cells.push_back(std::move(cell));
    }
    assembly.blocks.push_back(std::move(block));
  }
  return places;
}

std::vector<Joint> renumber(std::vector<Joint> joints, const std::vector<Place>& places) {
  std::vector<Joint> result;
  result.reserve(joints.size());
  for (Joint& joint : joints) {
    const Place &a = places[std::size_t(joint.a)], &b = places[std::size_t(joint.b)];
    if (a.block == b.block) continue;
    joint.a = a.block, joint.cell_a += a.first_cell;
    joint.b = b.block, joint.cell_b += b.first_cell;
    if (joint.a > joint.b) {
      std::swap(joint.a, joint.b);
      std::swap(joint.cell_a, joint.cell_b);
      std::swap(joint.face_a, joint.face_b);
      joint.normal = -joint.normal;
      std::reverse(joint.polygon.begin(), joint.polygon.end());
    }
    result.push_back(std::move(joint));
  }
  std::sort(result.begin(), result.end(), [](const Joint& p, const Joint& q) {
    return std::tie(p.a, p.b, p.cell_a, p.cell_b, p.face_a, p.face_b) <
           std::tie(q.a, q.b, q.cell_a, q.cell_b, q.face_a, q.face_b);
  });
  return result;
}

Assembly as_they_lie(const std::vector<Stone>& stones) {
  Assembly assembly;
  for (const Stone& stone : stones) {
    Block block;
    block.cells = stone.cells;
    block.fixed = stone.fixed;
    assembly.blocks.push_back(std::move(block));
  }
  return assembly;
}

}  // namespace

Assembly assemble(Layout layout, const std::vector<Material>& materials, const SliverRule& slivers, double gap) {
  Assembly raw = as_they_lie(layout.stones);
  JointSearch search;
  search.gap = gap;
  find_joints(raw, search);
  const Groups groups = join_slivers(layout.stones, raw.joints, slivers);

  Assembly assembly;
  assembly.materials = materials;
  const std::vector<Place> places = make_blocks(assembly, layout.stones, groups);
  assembly.joints = renumber(std::move(raw.joints), places);
  for (const auto& [name, stones] : layout.groups) {
    std::vector<std::int64_t>& blocks = assembly.groups[name];
    for (const std::int64_t i : stones) blocks.push_back(places[std::size_t(i)].block);
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  }
  finish_blocks(assembly);
  return assembly;
}

}  // namespace voussoir
