#include "tools/hide/instruments.h"

#include <fmt/format.h>

#include <cmath>

#include "geometry/nearest_block.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

/// Where a box of the assembly's blocks reaches.
Box extent(const Assembly& assembly) {
  Box all;
  for (const Block& block : assembly.blocks) {
    if (block.fixed) continue;
    const Box box = block_box(block);
    all.low = all.low.cwiseMin(box.low), all.high = all.high.cwiseMax(box.high);
  }
  return all;
}

class Instruments {
 public:
  explicit Instruments(const Assembly& assembly) : assembly_(&assembly) {}
  /// At the block nearest to a point, on it.
  void add(Vec3 at, const std::string& axes) {
    const Box box = block_box(assembly_->blocks[std::size_t(nearest_block(*assembly_, at).block)]);
    at = at.cwiseMax(box.low).cwiseMin(box.high);
    for (double& x : at) x = std::round(100.0 * x) / 100.0;
    for (char axis : axes) {
      MeasuredSensor s;
      s.id = fmt::format("A{:02}{}", count_, axis);
      s.position = at;
      s.direction[axis - 'x'] = 1.0;
      sensors.push_back(s);
    }
    ++count_;
  }
  std::vector<MeasuredSensor> sensors;

 private:
  const Assembly* assembly_;
  int count_ = 1;
};

Vec3 middle_of(const Assembly& assembly, const std::string& group) {
  const Box box = block_box(assembly.blocks[std::size_t(assembly.groups.at(group)[0])]);
  return 0.5 * (box.low + box.high);
}

}  // namespace

std::vector<MeasuredSensor> instruments(const Assembly& assembly, const std::string& which) {
  if (which != "sparse" && which != "rich" && which != "none")
    throw InputError("--sensors is {}; give sparse, rich or none", which);
  Instruments all(assembly);
  if (which == "none") return {};
  const Box box = extent(assembly);
  const bool rich = which == "rich";
  const double top = box.high.z();
  for (const auto& [name, blocks] : assembly.groups) {
    if (name.starts_with("keystone ")) {
      const double x = middle_of(assembly, name).x();
      all.add({x, box.low.y(), top}, rich ? "xyz" : "yz");
      if (rich) all.add({x, box.high.y(), top}, "yz");
    }
    if (name.starts_with("base pier ")) {
      const Vec3 base = middle_of(assembly, name);
      all.add({base.x(), box.low.y(), top}, rich ? "xy" : "x");
      if (rich) all.add({base.x(), box.low.y(), 0.5 * (base.z() + top)}, "xy");
    }
  }
  if (rich)
    for (double x : {box.low.x(), box.high.x()}) all.add({x, box.low.y(), top}, "xyz");
  return all.sensors;
}

}  // namespace voussoir
