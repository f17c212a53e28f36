#include "tools/hide/loosening.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "solver/base/csv.h"
#include "solver/base/error.h"
#include "solver/base/suggestion.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

const std::vector<std::string> loosening_keys = {"x", "y", "z", "part", "factor", "density"};

double loosening_number(const std::string& text, const std::string& word, const std::string& key, double low,
                        double high) {
  double value = 0.0;
  if (parse_number(word, value) != NumberTrouble::none || !(value >= low && value <= high))
    throw InputError("--loosen \"{}\": {} is '{}'. It must be a number from {:g} to {:g}", text, key, word, low, high);
  return value;
}

void read_range(const std::string& text, const std::string& key, const std::string& word, Loosening& l) {
  const std::size_t dots = word.find("..");
  if (dots == std::string::npos)
    throw InputError("--loosen \"{}\": {} is '{}'. Give a range in m such as {}=12..14, {}=..14 or {}=12..", text, key,
                     word, key, key, key);
  const int axis = key[0] - 'x';
  const std::string from = word.substr(0, dots), to = word.substr(dots + 2);
  if (!from.empty()) l.low[axis] = loosening_number(text, from, key, -1e6, 1e6);
  if (!to.empty()) l.high[axis] = loosening_number(text, to, key, -1e6, 1e6);
  if (l.low[axis] > l.high[axis])
    throw InputError("--loosen \"{}\": {} goes from {:g} to {:g}. Give the smaller value first", text, key, l.low[axis],
                     l.high[axis]);
}

void read_word(const std::string& text, const std::string& key, const std::string& value, Loosening& l) {
  if (key == "x" || key == "y" || key == "z")
    read_range(text, key, value, l);
  else if (key == "part")
    l.part = value;
  else if (key == "factor")
    l.factor = loosening_number(text, value, key, 1e-4, 1e3);
  else if (key == "density")
    l.density = loosening_number(text, value, key, 0.1, 10.0);
  else
    throw InputError("--loosen \"{}\": there is no key '{}'{}", text, key, suggestion(key, loosening_keys));
}

bool in_box(const Vec3& p, const Loosening& l) {
  return (p.array() >= l.low.array()).all() && (p.array() <= l.high.array()).all();
}

BlockSet blocks_of(const Assembly& assembly, const Loosening& l) {
  if (l.part.empty()) return BlockSet(assembly.blocks.size(), true);
  const std::vector<std::string> parts = masonry_parts(assembly);
  if (std::find(parts.begin(), parts.end(), l.part) == parts.end())
    throw InputError("--loosen \"{}\": the bridge has no part '{}'{}; its parts are: {}", l.text, l.part,
                     suggestion(l.part, parts), fmt::join(parts, ", "));
  return masonry_part(assembly, l.part);
}

}  // namespace

Loosening parse_loosening(const std::string& text) {
  Loosening l;
  l.text = text;
  std::istringstream words(text);
  std::vector<std::pair<std::string, std::string>> pairs;
  for (std::string word; words >> word;) {
    const std::size_t at = word.find('=');
    if (at != std::string::npos)
      pairs.emplace_back(word.substr(0, at), word.substr(at + 1));
    else if (!pairs.empty() && pairs.back().first == "part")
      pairs.back().second += " " + word;
    else
      throw InputError("--loosen \"{}\": '{}' is not of the form key=value. The keys are: {}", text, word,
                       fmt::join(loosening_keys, ", "));
  }
  for (const auto& [key, value] : pairs) read_word(text, key, value, l);
  if (l.factor == 1.0 && l.density == 1.0)
    throw InputError("--loosen \"{}\" changes nothing. Give factor= (of stiffness) or density= (a factor)", text);
  return l;
}

void loosen(Assembly& assembly, const Loosening& l) {
  const BlockSet part = blocks_of(assembly, l);
  std::size_t changed = 0;
  if (l.factor != 1.0) {
    for (Joint& joint : assembly.joints) {
      const bool inside = part[std::size_t(joint.a)] && part[std::size_t(joint.b)];
      if (!inside || is_tie(assembly, joint) || !in_box(polygon_centroid(joint.polygon), l)) continue;
      joint.kn *= l.factor, joint.ks *= l.factor;
      ++changed;
    }
    for (FillJoint& patch : assembly.fill_joints) {
      if (!l.part.empty() || !in_box(polygon_centroid(patch.polygon), l)) continue;
      patch.kn *= l.factor, patch.ks *= l.factor;
      ++changed;
    }
  }
  if (l.density != 1.0) {
    BlockSet heavier = part;
    for (std::size_t i = 0; i < heavier.size(); ++i) {
      heavier[i] = heavier[i] && !assembly.blocks[i].fixed && in_box(assembly.blocks[i].centroid, l);
      changed += heavier[i];
    }
    scale_density(assembly, heavier, l.density);
  }
  if (changed > 0) return;
  Box all;
  for (const Block& block : assembly.blocks) {
    const Box box = block_box(block);
    all.low = all.low.cwiseMin(box.low), all.high = all.high.cwiseMax(box.high);
  }
  throw InputError(
      "--loosen \"{}\": no part of the bridge, which extends from ({:.2f}, {:.2f}, {:.2f}) to ({:.2f}, {:.2f}, {:.2f}) "
      "m, is in this box. Move or enlarge the box",
      l.text, all.low.x(), all.low.y(), all.low.z(), all.high.x(), all.high.y(), all.high.z());
}

}  // namespace voussoir
