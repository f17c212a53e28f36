#include "tools/hide/instruments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/nearest_block.h"
#include "solver/base/counted.h"
#include "solver/base/csv.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

/// Bounding box of the blocks of the assembly.
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
  /// The nearest point on the block nearest to a point.
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

enum class Plan { sparse, rich, dense };

/// Channels of a plan. The additional channels of a larger plan come after those of a smaller plan.
std::vector<MeasuredSensor> planned(const Assembly& assembly, Plan plan) {
  Instruments all(assembly);
  const Box box = extent(assembly);
  const bool rich = plan != Plan::sparse;
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
  if (plan == Plan::dense) {
    for (const auto& [name, blocks] : assembly.groups)
      if (name.starts_with("base pier ")) all.add({middle_of(assembly, name).x(), box.high.y(), top}, "xyz");
    for (double x : {box.low.x(), box.high.x()}) all.add({x, box.high.y(), top}, "xyz");
  }
  return all.sensors;
}

/// The given number of channels of the plan, in its order: one of each axis, then any.
std::vector<MeasuredSensor> drawn(const Assembly& assembly, int channels, const HideRequest& request) {
  std::vector<MeasuredSensor> pool = planned(assembly, Plan::rich);
  if (int(pool.size()) < channels) pool = planned(assembly, Plan::dense);
  if (int(pool.size()) < channels)
    throw InputError("--sensors {}: the largest plan has {} on this bridge. Give a smaller number or a file", channels,
                     counted(pool.size(), "channel"));
  std::vector<std::size_t> order;
  RandomStream random = stream_of(request, "sensors");
  for (std::size_t i = 0; i < pool.size(); ++i) {  // Fisher and Yates (1938), as Durstenfeld (1964) has it
    order.push_back(i);
    std::swap(order[i], order[random.below(i + 1)]);
  }
  std::vector<std::size_t> chosen;
  for (const int axis : {1, 2, 0}) {
    const auto at =
        std::find_if(order.begin(), order.end(), [&](std::size_t i) { return pool[i].direction[axis] != 0.0; });
    if (at == order.end()) continue;
    chosen.push_back(*at);
    order.erase(at);
  }
  chosen.insert(chosen.end(), order.begin(), order.begin() + (channels - std::ptrdiff_t(chosen.size())));
  std::sort(chosen.begin(), chosen.end());
  std::vector<MeasuredSensor> sensors;
  for (const std::size_t i : chosen) sensors.push_back(pool[i]);
  return sensors;
}

/// Recordings are written as accelerations.
std::vector<MeasuredSensor> of_file(const std::string& file) {
  const std::vector<MeasuredSensor> sensors = read_sensors(file);
  for (const MeasuredSensor& s : sensors)
    if (s.unit != "m/s2")
      throw InputError("{}:{}: sensor '{}' has the unit {}. voussoir hide writes m/s2: leave the unit out", file, s.row,
                       s.id, s.unit);
  return sensors;
}

}  // namespace

std::vector<MeasuredSensor> instruments(const Assembly& assembly, const HideRequest& request) {
  const std::string& which = request.sensors;
  if (which == "none") return {};
  if (which.ends_with(".csv")) return of_file(which);
  double number = 0.0;
  const bool count = parse_number(which, number) == NumberTrouble::none;
  if (count && (number < 5.0 || number > 40.0 || number != std::floor(number)))
    throw InputError("--sensors {}: the number of channels must be a whole number from 5 to 40", which);
  if (!count && which != "sparse" && which != "rich")
    throw InputError(
        "--sensors is '{}'. It must be sparse, rich, none, a number from 5 to 40, or a file whose name ends in .csv",
        which);
  const std::vector<MeasuredSensor> sensors =
      count ? drawn(assembly, int(number), request) : planned(assembly, which == "rich" ? Plan::rich : Plan::sparse);
  if (sensors.empty())
    throw InputError(
        "--sensors {}: the plan needs groups keystone … and base pier …, and this assembly has none. Give a file like "
        "measured/sensors.csv",
        which);
  return sensors;
}

}  // namespace voussoir
