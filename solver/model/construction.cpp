#include "solver/model/construction.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include "geometry/fill_mesh.h"
#include "solver/base/counted.h"
#include "solver/base/disjoint_sets.h"
#include "solver/base/error.h"
#include "solver/base/suggestion.h"

namespace voussoir {

namespace {

constexpr const char* fill_name = "fill";
constexpr std::int32_t never = -1;

/// What a name means: blocks, or all of the deformable fill.
struct Named {
  std::vector<std::int64_t> blocks;
  bool fill = false;
};

std::int32_t component_index(const std::string& name) {
  const std::vector<std::string>& names = component_names();
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? -1 : std::int32_t(at - names.begin());
}

std::vector<std::int64_t> blocks_of(const Assembly& assembly, std::int32_t component, int part) {
  std::vector<std::int64_t> blocks;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Block& block = assembly.blocks[i];
    if (std::int32_t(block.component) == component && (part < 0 || block.part == part))
      blocks.push_back(std::int64_t(i));
  }
  return blocks;
}

/// What a step may name here.
std::vector<std::string> names_there(const Assembly& assembly) {
  std::set<std::string> names;
  for (const Block& block : assembly.blocks)
    if (!block.fixed) names.insert(component_names()[std::size_t(block.component)]);
  std::vector<std::string> all(names.begin(), names.end());
  if (!assembly.fill.empty()) all.emplace_back(fill_name);
  for (const auto& group : assembly.groups) all.push_back(group.first);
  return all;
}

Named look_up(const Assembly& assembly, const std::string& name) {
  Named named;
  if (const auto group = assembly.groups.find(name); group != assembly.groups.end())
    named.blocks = group->second;
  else if (component_index(name) >= 0)
    named.blocks = blocks_of(assembly, component_index(name), -1);
  else if (name == fill_name)
    named.fill = !assembly.fill.empty();
  else if (const std::size_t space = name.rfind(' '); space != std::string::npos) {
    int part = -1;
    const auto end = name.data() + name.size();
    const auto read = std::from_chars(name.data() + space + 1, end, part);
    if (read.ec == std::errc() && read.ptr == end && part >= 0)
      named.blocks = blocks_of(assembly, component_index(name.substr(0, space)), part);
  }
  if (named.blocks.empty() && !named.fill)
    throw InputError("construction: this assembly has no \"{}\"{}", name, suggestion(name, names_there(assembly)));
  return named;
}

double middle(const FillMesh& fill, std::size_t tet) {
  double z = 0.0;
  for (const std::int32_t node : fill.tets[tet]) z += 0.25 * fill.nodes[std::size_t(node)].z();
  return z;
}

/// An item that a step adds, with the height of its centre.
struct Item {
  double z = 0.0, low = 0.0, high = 0.0;  // m
  std::int64_t block = -1, tet = -1;      // one of them
};

/// Fills a plan step by step.
class Planner {
 public:
  explicit Planner(const Assembly& assembly) : assembly_(assembly) {
    plan_.block.assign(assembly.blocks.size(), never);
    plan_.free = plan_.block;
    plan_.tet.assign(assembly.fill.tets.size(), never);
  }

  void take(const ConstructionStep& step) {
    if (step.add.empty() == step.strike.empty())
      throw InputError(
          "construction: step {} must either add something or strike centering. Give it either 'add' or 'strike'.",
          ++count_);
    ++count_;
    if (step.add.empty())
      strike(step);
    else
      add(step);
  }

  ConstructionPlan finish() {
    for (std::size_t i = 0; i < plan_.block.size(); ++i)
      if (assembly_.blocks[i].fixed && plan_.block[i] == never) plan_.block[i] = plan_.free[i] = 0;
    std::map<std::string, std::int64_t> left;
    for (std::size_t i = 0; i < plan_.block.size(); ++i)
      if (plan_.block[i] == never) ++left[component_names()[std::size_t(assembly_.blocks[i].component)]];
    std::vector<std::string> words;
    for (const auto& [name, count] : left) words.push_back(fmt::format("{} of {}", count, name));
    const auto tets = std::count(plan_.tet.begin(), plan_.tet.end(), never);
    if (tets > 0) words.push_back(fmt::format("{} of the fill", counted(tets, "element")));
    if (!words.empty())
      throw InputError(
          "construction: no step adds {}. Name them in the 'add' of a step, or add a last step without 'below'.",
          fmt::join(words, ", "));
    for (std::size_t i = 0; i < plan_.free.size(); ++i)
      if (plan_.free[i] == never)
        throw InputError(
            "construction: {} stands on centering that is never struck. Add a step with strike = [\"{}\"].",
            block_label(assembly_, std::int64_t(i)), component_names()[std::size_t(assembly_.blocks[i].component)]);
    return std::move(plan_);
  }

 private:
  void add(const ConstructionStep& step) {
    std::vector<Item> items;
    for (const std::string& name : step.add) collect(name, step.below, items);
    if (items.empty())
      throw InputError("construction: step {} adds nothing, because all of {}{} has already been added", count_,
                       fmt::join(step.add, ", "), step.below < 1e300 ? fmt::format(" below {:g} m", step.below) : "");
    double low = 1e300, high = -1e300;
    for (const Item& item : items) low = std::min(low, item.low), high = std::max(high, item.high);
    const int lifts = step.lift > 0.0 ? std::max(1, int(std::ceil((high - low) / step.lift - 1e-9))) : 1;
    std::vector<std::vector<Item>> by_lift{std::size_t(lifts)};
    for (const Item& item : items) {
      const int at = high > low ? int((item.z - low) / (high - low) * lifts) : 0;
      by_lift[std::size_t(std::clamp(at, 0, lifts - 1))].push_back(item);
    }
    std::erase_if(by_lift, [](const auto& lift) { return lift.empty(); });
    for (std::size_t i = 0; i < by_lift.size(); ++i) {
      const std::int32_t number = plan_.steps();
      for (const Item& item : by_lift[i]) {
        if (item.tet >= 0) plan_.tet[std::size_t(item.tet)] = number;
        if (item.block < 0) continue;
        plan_.block[std::size_t(item.block)] = number;
        if (!step.centering) plan_.free[std::size_t(item.block)] = number;
      }
      std::string label = step.label.empty() ? fmt::format("{}", fmt::join(step.add, ", ")) : step.label;
      if (step.centering) label += " on centering";
      if (by_lift.size() > 1) label += fmt::format(", lift {} of {}", i + 1, by_lift.size());
      plan_.labels.push_back(label);
    }
  }

  void collect(const std::string& name, double below, std::vector<Item>& items) {
    constexpr std::int32_t taken = -2;  // an item named twice in this step counts once
    const Named named = look_up(assembly_, name);
    for (const std::int64_t block : named.blocks) {
      if (plan_.block[std::size_t(block)] != never) continue;
      const Box box = block_box(assembly_.blocks[std::size_t(block)]);
      const double z = assembly_.blocks[std::size_t(block)].centroid.z();
      if (z >= below) continue;
      plan_.block[std::size_t(block)] = taken;
      items.push_back({z, box.low.z(), box.high.z(), block, -1});
    }
    for (std::size_t tet = 0; named.fill && tet < plan_.tet.size(); ++tet) {
      if (plan_.tet[tet] != never) continue;
      const double z = middle(assembly_.fill, tet);
      if (z >= below) continue;
      plan_.tet[tet] = taken;
      items.push_back({z, z, z, -1, std::int64_t(tet)});
    }
  }

  void strike(const ConstructionStep& step) {
    std::int64_t struck = 0;
    for (const std::string& name : step.strike)
      for (const std::int64_t block : look_up(assembly_, name).blocks) {
        const auto i = std::size_t(block);
        if (plan_.block[i] == never || plan_.free[i] != never) continue;
        plan_.free[i] = plan_.steps();
        ++struck;
      }
    if (struck == 0)
      throw InputError(
          "construction: step {} strikes the centering of {}, but no part of it stands on centering. Name a part that "
          "an earlier step adds with centering = true.",
          count_, fmt::join(step.strike, ", "));
    plan_.labels.push_back(step.label.empty() ? fmt::format("{}: centering struck", fmt::join(step.strike, ", "))
                                              : step.label);
  }

  const Assembly& assembly_;
  ConstructionPlan plan_;
  int count_ = 0;
};

/// In every step all present parts must be connected to a held part.
void check_held(const Assembly& assembly, const ConstructionPlan& plan) {
  const std::size_t blocks = assembly.blocks.size();
  const std::vector<std::int32_t> tet_of = triangle_tets(assembly.fill);
  for (std::int32_t step = 0; step < plan.steps(); ++step) {
    const auto there = [&](std::int64_t block) { return plan.block[std::size_t(block)] <= step; };
    DisjointSets sets(blocks + assembly.fill.nodes.size());
    for (const Joint& joint : assembly.joints)
      if (there(joint.a) && there(joint.b)) sets.join(std::size_t(joint.a), std::size_t(joint.b));
    for (std::size_t t = 0; t < assembly.fill.tets.size(); ++t)
      for (std::size_t k = 1; plan.tet[t] <= step && k < 4; ++k)
        sets.join(blocks + std::size_t(assembly.fill.tets[t][0]), blocks + std::size_t(assembly.fill.tets[t][k]));
    for (const FillJoint& joint : assembly.fill_joints) {
      const auto tet = std::size_t(tet_of[std::size_t(joint.triangle)]);
      if (there(joint.block) && plan.tet[tet] <= step)
        sets.join(std::size_t(joint.block), blocks + std::size_t(assembly.fill.tets[tet][0]));
    }
    std::vector<char> held(blocks + assembly.fill.nodes.size(), 0);
    for (std::size_t i = 0; i < blocks; ++i)
      if (assembly.blocks[i].fixed || (there(std::int64_t(i)) && plan.free[i] > step)) held[sets.of(i)] = 1;
    const auto refuse = [&](const std::string& what, const Vec3& at) {
      throw InputError(
          "construction: in step {} ({}) {} at ({:.2f}, {:.2f}, {:.2f}) m has no support: no joints connect it to a "
          "fixed block or to a part on centering. Add its supports in an earlier step, or place it on centering.",
          step + 1, plan.labels[std::size_t(step)], what, at.x(), at.y(), at.z());
    };
    for (std::size_t i = 0; i < blocks; ++i)
      if (there(std::int64_t(i)) && !held[sets.of(i)])
        refuse(block_label(assembly, std::int64_t(i)), assembly.blocks[i].centroid);
    for (std::size_t t = 0; t < assembly.fill.tets.size(); ++t) {
      const auto node = std::size_t(assembly.fill.tets[t][0]);
      if (plan.tet[t] <= step && !held[sets.of(blocks + node)]) refuse("the fill", assembly.fill.nodes[node]);
    }
  }
}

}  // namespace

namespace {

/// Lowest point of the free blocks of some components, m.
double bottom_of(const Assembly& assembly, const std::vector<Component>& components) {
  double z = 1e300;
  for (const Block& block : assembly.blocks)
    if (!block.fixed && std::find(components.begin(), components.end(), block.component) != components.end())
      z = std::min(z, block_box(block).low.z());
  return z;
}

/// Whether some of the fill, rigid or deformable, has its middle below this height.
bool any_below(const Assembly& assembly, double z) {
  for (const Block& block : assembly.blocks)
    if (!block.fixed && block.component == Component::backfill && block.centroid.z() < z) return true;
  for (std::size_t tet = 0; tet < assembly.fill.tets.size(); ++tet)
    if (middle(assembly.fill, tet) < z) return true;
  return false;
}

}  // namespace

std::vector<ConstructionStep> usual_order(const Assembly& assembly, double lift) {
  std::set<std::string> there;
  for (const Block& block : assembly.blocks)
    if (!block.fixed || block.component == Component::restraint)
      there.insert(component_names()[std::size_t(block.component)]);
  if (!assembly.fill.empty()) there.insert(fill_name);
  const auto those_of = [&](const std::vector<std::string>& names) {
    std::vector<std::string> found;
    for (const std::string& name : names)
      if (there.contains(name)) found.push_back(name);
    return found;
  };
  std::vector<ConstructionStep> order;
  const auto add = [&](const std::vector<std::string>& names, double height, bool centering, double below = 1e300) {
    ConstructionStep step;
    step.add = those_of(names), step.lift = height, step.centering = centering, step.below = below;
    if (!step.add.empty()) order.push_back(step);
  };
  add({"base", "pier", "abutment", "infill", "wall", "block"}, lift, false);
  const double bottom = bottom_of(assembly, {Component::arch, Component::backing});
  const bool vaulted = there.contains("arch") || there.contains("backing");
  if (vaulted && any_below(assembly, bottom)) add({"backfill", fill_name}, lift, false, bottom);
  add({"arch"}, 0.0, true);
  add({"backing"}, 0.0, false);
  if (there.contains("arch")) {
    ConstructionStep strike;
    strike.strike = {"arch"};
    order.push_back(strike);
  }
  add({"spandrel", "backfill", fill_name}, lift, false);
  add({"parapet"}, 0.0, false);
  add({"restraint"}, 0.0, false);
  return order;
}

ConstructionPlan construction_plan(const Assembly& assembly, const ConstructionSettings& settings) {
  Planner planner(assembly);
  for (const ConstructionStep& step : settings.steps.empty() ? usual_order(assembly, settings.lift) : settings.steps)
    planner.take(step);
  ConstructionPlan plan = planner.finish();
  check_held(assembly, plan);
  for (const std::int32_t tet : triangle_tets(assembly.fill)) plan.triangle.push_back(plan.tet[std::size_t(tet)]);
  return plan;
}

}  // namespace voussoir
