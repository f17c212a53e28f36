#include "io/info/describe_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include "geometry/fill_report.h"
#include "geometry/joint_counts.h"
#include "io/case/case.h"
#include "io/case/remarks.h"
#include "io/hdf5/assembly_file.h"
#include "io/hdf5/checkpoint_file.h"
#include "io/hdf5/h5.h"
#include "io/hdf5/history_file.h"
#include "io/hdf5/modes_file.h"
#include "io/records/format.h"
#include "solver/base/atomic_file.h"
#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/motion/baseline.h"
#include "solver/motion/intensity.h"

namespace voussoir {

namespace {

/// Lines of a description.
struct Lines {
  std::string text;
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    if (!text.empty()) text += '\n';
    text += fmt::format(format, std::forward<Args>(args)...);
  }
};

double largest(const std::vector<double>& values) {
  double peak = 0.0;
  for (const double v : values) peak = std::max(peak, std::abs(v));
  return peak;
}

std::string motion_text(const GroundMotion& motion) {
  Vec3 peak = Vec3::Zero();
  for (const Vec3& a : motion.acceleration) peak = peak.cwiseMax(a.cwiseAbs());
  return fmt::format("{:.6g} s of motion at time steps of {:.6g} s, peaks x {:.4g}, y {:.4g}, z {:.4g} m/s2",
                     motion.duration(), motion.dt, peak.x(), peak.y(), peak.z());
}

/// Describes a synthetic motion without computing it.
std::string synthetic_text(const MotionSource& source) {
  const SyntheticSettings& s = source.synthetic;
  const std::string size = s.spectrum
                               ? fmt::format("with the spectrum of {}", target_codes()[std::size_t(s.spectrum->code)])
                               : fmt::format("largest value {:.4g} m/s2", s.peak * std::abs(source.scale));
  return fmt::format("{:.6g} s of synthetic motion at time steps of {:.6g} s, {}", s.duration, s.dt, size);
}

std::string describe_case(const std::string& path) {
  const Case c = read_case(path, CaseUse::geometry);
  Lines out;
  out.add("{}: case (hash {:016x})", path, c.hash);
  if (c.generator.empty())
    out.add("  bridge: assembly file {}", c.assembly_file);
  else
    out.add("  bridge: generator \"{}\", {}", c.generator, counted(c.generator_input.materials.size(), "material"));
  const DampingSettings& damping = c.settings.damping;
  out.add("  damping: {}, ratio {}, {} to {} Hz", damping_kinds()[std::size_t(damping.kind)], damping.ratio,
          damping.band[0], damping.band[1]);
  for (std::size_t i = 0; i < c.settings.stages.size(); ++i) {
    const StageSettings& stage = c.settings.stages[i];
    out.add("  stage {}: {}", i + 1, stage.label);
    if (stage.duration > 0.0) out.text += fmt::format(", {} s", stage.duration);
    if (stage.kind == StageSettings::Kind::motion)
      out.text += "; " + (stage.motion.acceleration.empty() ? synthetic_text(c.motions[i]) : motion_text(stage.motion));
    for (const Drive& d : stage.drives) out.text += fmt::format("; drives \"{}\"", d.group);
  }
  if (c.settings.stages.empty()) out.add("  no stages: the case can be used for generate and modal, but not for run");
  out.add("  {}", counted(c.sensors.size(), "sensor"));
  for (const std::string& remark : remarks(c)) out.add("  remark: {}", remark);
  return out.text;
}

void describe_components(Lines& out, const Assembly& assembly) {
  std::map<Component, std::pair<std::int64_t, double>> sums;
  for (const Block& block : assembly.blocks) {
    auto& [count, mass] = sums[block.component];
    ++count;
    mass += block.mass;
  }
  for (const auto& [component, sum] : sums)
    out.add("    {:<10} {:>8} blocks {:>14.1f} kg", component_names()[std::size_t(component)], sum.first, sum.second);
}

std::string composite_text(const JointLaw& law) {
  std::string text = fmt::format("composite joints: tension {:g} Pa, cohesion {:g} Pa, GI {:g} and GII {:g} J/m2",
                                 law.tension, law.cohesion, law.fracture_energy[0], law.fracture_energy[1]);
  if (law.compressive_strength <= 0.0) return text + ", no crushing";
  text += fmt::format("; compressive strength {:g} Pa, energy {:g} J/m2, weight of the shear in the cap {:g}",
                      law.compressive_strength, law.compressive_energy, law.cap_shear);
  return law.compressive_peak > 0.0 ? text + fmt::format(", peak at {:g} m", law.compressive_peak) : text;
}

std::string describe_assembly(const std::string& path) {
  const Assembly assembly = read_assembly(path);
  Box box;
  double mass = 0.0, free_mass = 0.0, area = 0.0;
  std::int64_t fixed = 0;
  std::vector<double> volumes;
  for (const Block& block : assembly.blocks) {
    const Box own = block_box(block);
    box.low = box.low.cwiseMin(own.low);
    box.high = box.high.cwiseMax(own.high);
    mass += block.mass;
    if (!block.fixed) free_mass += block.mass;
    fixed += block.fixed;
    volumes.push_back(block.mass / block_density(assembly, block));
  }
  for (const Joint& joint : assembly.joints) area += joint.area;
  for (const Vec3& p : assembly.fill.nodes) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  const Vec3 size = box.high - box.low;
  const auto [small, large] = std::minmax_element(volumes.begin(), volumes.end());
  Lines out;
  out.add("{}: block assembly, generator \"{}\"", path, assembly.generator);
  out.add("  {} ({} fixed), {:.1f} kg, of which {:.1f} kg free", counted(assembly.blocks.size(), "block"), fixed, mass,
          free_mass);
  describe_components(out, assembly);
  if (!volumes.empty())
    out.add("  smallest block {} ({:.4g} m3), largest block {} ({:.4g} m3)", small - volumes.begin(), *small,
            large - volumes.begin(), *large);
  out.add("  {:.3f} x {:.3f} x {:.3f} m, from ({:.3f}, {:.3f}, {:.3f}) m", size.x(), size.y(), size.z(), box.low.x(),
          box.low.y(), box.low.z());
  out.add("  {}, {:.2f} m2, {}, {}", counted(assembly.joints.size(), "joint"), area,
          counted(assembly.laws.size(), "law"), counted(assembly.materials.size(), "material"));
  out.add("  {}", joints_text(assembly));
  for (const JointLaw& law : assembly.laws)
    if (law.kind == JointLaw::Kind::composite) out.add("  {}", composite_text(law));
  if (!assembly.blocks.empty() && !states_joints(path))
    out.add("  the file states no joints; the program has found these");
  for (const std::string& line : fill_lines(assembly)) out.add("  {}", line);
  std::size_t objects = 0;
  for (const auto& [name, members] : assembly.groups) objects += name.starts_with(object_group_prefix);
  constexpr std::size_t most = 20;  // an imported bridge may have thousands
  for (const auto& [name, members] : assembly.groups)
    if (objects <= most || !name.starts_with(object_group_prefix))
      out.add("  group \"{}\": {}", name, counted(members.size(), "block"));
  if (objects > most)
    out.add("  {} groups \"{}NAME\", one for each object of the drawing", objects, object_group_prefix);
  for (const Sensor& sensor : assembly.sensors) out.add("  sensor \"{}\" on block {}", sensor.id, sensor.block);
  for (const std::string& remark : remarks(assembly, path)) out.add("  remark: {}", remark);
  return out.text;
}

/// The header of a checkpoint. A damaged file is an InputError here, not a RunError.
CheckpointHeader header_of(const std::string& path) {
  try {
    return read_checkpoint_header(path);
  } catch (const RunError& error) {
    throw InputError("{}", error.what());
  }
}

std::string describe_checkpoint(const std::string& path) {
  const CheckpointHeader header = header_of(path);
  const h5::File file = h5::File::open(path);
  Lines out;
  out.add("{}: checkpoint of voussoir {}", path, header.program_version);
  out.add("  time {:.6f} s, time step {}; {} finished, {:.6f} s of the next", header.time, header.step,
          counted(header.stage, "stage"), header.stage_time);
  out.add("  state {:016x}, assembly {:016x}, case {:016x}", header.state_hash, header.assembly_hash, header.case_hash);
  for (const auto& [name, value] : header.numbers) out.add("  {} = {:.9g}", name, value);
  for (const std::string& name : file.datasets()) {
    std::string shape;
    for (const std::size_t n : file.shape(name)) shape += (shape.empty() ? "" : " x ") + std::to_string(n);
    const std::string unit = file.unit(name);
    out.add("  {}: {}{}{}", name, shape, unit.empty() ? "" : " in ", unit);
  }
  return out.text;
}

std::string describe_history(const std::string& path) {
  const History history = History::load(path);
  Lines out;
  out.add("{}: history, {} of {}", path, counted(history.rows(), "row"), counted(history.channels().size(), "channel"));
  if (history.rows() == 0) return out.text;
  out.add("  time {:.6g} to {:.6g} s", history.time().front(), history.time().back());
  for (const Channel& channel : history.channels())
    if (channel.path != "time")
      out.add("  {}: largest {:.6g} {}", channel.path, largest(history.values(channel.path)), channel.unit);
  return out.text;
}

std::string describe_modes(const std::string& path) {
  const ModesFile modes = read_modes(path);
  Lines out;
  out.add("{}: {} of {}", path, counted(modes.modes.size(), "mode"), modes.about);
  const std::string nodes =
      modes.nodes.empty() ? "" : fmt::format(", {} of a fill", counted(modes.nodes.size(), "node"));
  out.add("  {}{}, movable mass {:.1f} kg, assembly {:016x}", counted(modes.places.mass.size(), "block"), nodes,
          modes.mass, modes.assembly_hash);
  for (std::size_t i = 0; i < modes.modes.size(); ++i)
    out.add("  mode {}: {:.6g} Hz, {}", i + 1, modes.modes[i].frequency, modes.modes[i].words.text());
  return out.text;
}

void describe_channel(const RecordFile& file, Lines& out) {
  const Record& record = file.record;
  const std::vector<double> velocity = integrate(record.values, record.dt);
  const auto said = [](const std::string& text) { return text.empty() ? "not stated" : text; };
  if (file.unit > 0.0)
    out.add("  event {}, station {}, component {}; unit {:g} m/s2", said(file.event), said(file.station),
            said(file.component), file.unit);
  out.add("  largest value {:.6g}, largest velocity {:.6g}, velocity at the end {:.6g}", largest(record.values),
          largest(velocity), velocity.back());
  if (file.unit == 0.0) return;
  std::vector<double> acceleration = record.values;
  for (double& a : acceleration) a *= file.unit;
  const Intensity i = intensity_of(acceleration, record.dt);
  out.add("  PGA {:.4f} g, PGV {:.4g} m/s, Arias intensity {:.4g} m/s, 5 to 95 % of it in {:.4g} s",
          i.pga / standard_gravity, i.pgv, i.arias, i.significant());
}

std::string describe_record(const std::string& path) {
  const std::vector<RecordFile> channels = parse_channels(read_text(path), path);
  const RecordFile& first = channels.front();
  Lines out;
  out.add("{}: {}record of {}{}, {:.6g} s at time steps of {:.6g} s", path, first.unit > 0.0 ? first.format + " " : "",
          channels.size() > 1 ? fmt::format("{} channels of ", channels.size()) : "",
          counted(first.record.values.size(), "sample"), first.record.duration(), first.record.dt);
  for (const RecordFile& channel : channels) describe_channel(channel, out);
  out.add("  values in the unit of the file; velocities in this unit times s");
  return out.text;
}

std::string first_lines(const std::string& text, int count) {
  std::size_t end = 0;
  for (int i = 0; i < count && end != std::string::npos; ++i) end = text.find('\n', end + (i > 0));
  return text.substr(0, end);
}

/// Describes case, assembly, history and newest undamaged checkpoint of a run directory.
std::string describe_run(const std::string& path) {
  Lines out;
  out.add("{}: run directory", path);
  out.add("{}", describe_case(path + "/case.toml"));
  std::error_code ignored;
  if (std::filesystem::exists(path + "/assembly.h5", ignored))
    out.add("{}", first_lines(describe_assembly(path + "/assembly.h5"), 2));
  if (std::filesystem::exists(path + "/history.h5", ignored))
    out.add("{}", first_lines(describe_history(path + "/history.h5"), 2));
  for (const std::string& checkpoint : list_checkpoints(path + "/checkpoints")) try {
      out.add("{}", first_lines(describe_checkpoint(checkpoint), 2));
      break;
    } catch (const std::runtime_error& damaged) {
      out.add("{}", damaged.what());
    }
  std::ifstream summary(path + "/summary.json");
  const std::string text{std::istreambuf_iterator<char>(summary), {}};
  if (text.find("\"finished\": true") != std::string::npos)
    out.add("the run has ended; its results are in {}/summary.json", path);
  else
    out.add("the run has not ended; continue it with: voussoir resume {}", path);
  return out.text;
}

}  // namespace

std::string describe_file(const std::string& path) {
  std::error_code ignored;  // an error counts as a file that does not exist
  if (!std::filesystem::exists(path, ignored)) throw InputError("cannot read {}: there is no such file", path);
  if (std::filesystem::exists(path + "/case.toml", ignored)) return describe_run(path);
  if (!std::filesystem::is_regular_file(path, ignored)) throw InputError("cannot read {}: it is not a file", path);
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".toml") return describe_case(path);
  if (extension == ".json")
    throw InputError("{} is a text file; read it with an editor (docs/formats.md describes its contents)", path);
  if (!h5::File::is_hdf5(path)) {
    if (extension == ".h5") throw InputError("{} is not an HDF5 file, or its beginning is damaged", path);
    return describe_record(path);
  }
  const h5::File file = h5::File::open(path);
  const std::string format = file.has_attribute("/", "format") ? file.text("/", "format") : "";
  if (format == "voussoir-assembly") return describe_assembly(path);
  if (format == "voussoir-checkpoint") return describe_checkpoint(path);
  if (format == "voussoir-history") return describe_history(path);
  if (format == "voussoir-modes") return describe_modes(path);
  throw InputError(
      "{} is an HDF5 file of another program: its attribute 'format' is \"{}\". It must be an assembly, a checkpoint, "
      "a history or a modes file of voussoir.",
      path, format);
}

}  // namespace voussoir
