#include "tools/run/part_damage.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "solver/effects/parts.h"
#include "tools/run/damage_words.h"

namespace voussoir {

namespace {

struct PartDamage {
  double bonded = 0.0, broken = 0.0, opening = 0.0, slip = 0.0, open_now = 0.0, slip_now = 0.0;
  bool fill = false;
  Vec3 opens = Vec3::Zero(), slides = Vec3::Zero();

  void add(const PatchSnapshot& p, const Polygon& as_built) {
    if (p.had_bond) bonded += p.area, broken += p.area * (1.0 - p.bonded);
    if (p.largest_opening > opening) opening = p.largest_opening, opens = polygon_centroid(as_built);
    if (p.largest_slip > slip) slip = p.largest_slip, slides = polygon_centroid(as_built);
    open_now = std::max(open_now, p.opening), slip_now = std::max(slip_now, p.slip);
  }
};

bool is_loose(Component c) {
  return c == Component::infill || c == Component::backfill;
}

}  // namespace

nlohmann::json part_damage_json(const Assembly& assembly, const Snapshot& snapshot) {
  const std::vector<std::string> names = parts_of_blocks(assembly);
  std::map<std::pair<std::string, std::string>, PartDamage> damage;
  for (std::size_t i = 0; i < snapshot.patches.size(); ++i) {
    const PatchSnapshot& p = snapshot.patches[i];
    if (p.tie || p.polygon.empty()) continue;
    const auto a = std::size_t(p.a), b = std::size_t(p.b);
    const bool loose = is_loose(assembly.blocks[a].component) || is_loose(assembly.blocks[b].component);
    // The infill of a pier is a part of the pier, but its joints are not joints of the masonry.
    const auto name = [&](std::size_t k) {
      return assembly.blocks[k].component == Component::infill ? "infill of " + names[k] : names[k];
    };
    PartDamage& d = damage[std::minmax(name(a), name(b))];
    d.fill = d.fill || loose;
    d.add(p, i < assembly.joints.size() ? assembly.joints[i].polygon : p.polygon);
  }
  nlohmann::json all = nlohmann::json::array();
  for (const auto& [pair, d] : damage) {
    nlohmann::json parts = {pair.first};
    if (pair.second != pair.first) parts.push_back(pair.second);
    const Vec3& at = d.opening > 0.0 ? d.opens : d.slides;
    all.push_back({{"parts", parts},
                   {"fill", d.fill},
                   {"at", {at.x(), at.y(), at.z()}},
                   {"broken_share", d.bonded > 0.0 ? d.broken / d.bonded : 0.0},
                   {"bonded", d.bonded > 0.0},
                   {"class", damage_word(d.opening)},
                   {"largest_opening", d.opening},
                   {"largest_slip", d.slip},
                   {"residual_opening", d.open_now},
                   {"residual_slip", d.slip_now}});
  }
  std::stable_sort(all.begin(), all.end(), [](const nlohmann::json& a, const nlohmann::json& b) {
    const auto size = [](const nlohmann::json& of) {
      return std::pair(of["largest_opening"].get<double>(), of["largest_slip"].get<double>());
    };
    return size(a) > size(b);
  });
  return all;
}

std::string part_words(const nlohmann::json& entry) {
  const nlohmann::json& parts = entry["parts"];
  return parts.size() == 1 ? parts[0].get<std::string>()
                           : fmt::format("between {} and {}", parts[0].get<std::string>(), parts[1].get<std::string>());
}

std::string place_words(const nlohmann::json& place) {
  return fmt::format("at x = {:.2f}, y = {:.2f}, z = {:.2f} m", place[0].get<double>(), place[1].get<double>(),
                     place[2].get<double>());
}

}  // namespace voussoir
