#include "tools/diagnosis/diagnosis_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "io/case/remarks.h"
#include "solver/base/error.h"
#include "solver/identify/driven_modes.h"
#include "solver/identify/fdd.h"
#include "solver/identify/setups.h"
#include "solver/identify/ssi.h"

namespace voussoir {

namespace {

constexpr double default_period_std = 0.01;  // share, where a measurement gives none
constexpr double default_shape_std = 0.05;   // share of the largest component
constexpr double default_damping_std = 0.3;  // share

/// A complex shape turned so that the sum of squares of its imaginary parts is least.
Eigen::VectorXcd turned(const Eigen::VectorXcd& shape) {
  std::complex<double> sum = 0.0;
  for (const std::complex<double>& v : shape)
    if (std::isfinite(v.real())) sum += v * v;
  return shape * std::polar(1.0, -0.5 * std::arg(sum));
}

void add_shape(const std::vector<std::string>& channels, const Eigen::VectorXcd& shape, const Eigen::VectorXd& std,
               const std::vector<MeasuredSensor>& sensors, MeasuredMode& mode) {
  mode.phases = true;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    const auto at = std::find(channels.begin(), channels.end(), sensors[s].id);
    if (at == channels.end()) continue;
    const auto channel = Eigen::Index(at - channels.begin());
    if (std::isfinite(shape[channel].real()))
      mode.shape.push_back({s, shape[channel].real(), std[channel], shape[channel].imag()});
  }
}

MeasuredMode named_mode(const Measured& measured, double frequency, double frequency_std, double damping,
                        double damping_std) {
  MeasuredMode mode;
  mode.name = fmt::format("{}", measured.modes.size() + 1);
  mode.period = 1.0 / frequency;
  mode.period_std = frequency_std / (frequency * frequency);
  mode.damping = damping;
  mode.damping_std = damping_std;
  return mode;
}

/// Channels that are in some recordings only, where these are taken together.
void set_aside_dropped(Measured& measured) {
  for (const DroppedChannel& dropped : dropped_channels(measured.records))
    measured.set_aside.push_back({fmt::format("channel {}", dropped.name), dropped.reason});
}

/// A shape over `from` as one over `to`, NaN where it is not known.
Eigen::VectorXcd at_channels(const Eigen::VectorXcd& shape, const std::vector<std::string>& from,
                             const std::vector<std::string>& to) {
  Eigen::VectorXcd out = Eigen::VectorXcd::Constant(Eigen::Index(to.size()), {NAN, NAN});
  for (std::size_t c = 0; c < to.size(); ++c)
    if (const auto at = std::find(from.begin(), from.end(), to[c]); at != from.end())
      out[Eigen::Index(c)] = shape[at - from.begin()];
  return out;
}

/// The channels that all setups have, or words for none.
std::string reference_words(const SsiResult& found) {
  std::vector<std::string> names;
  for (const int c : found.references) names.push_back(found.channels[std::size_t(c)]);
  if (names.empty()) return "channels that some of them share";
  return fmt::format("the references {}", fmt::join(names, ", "));
}

/// A case that expects next to no damping may find it.
SsiSettings ssi_settings(const Case& c) {
  SsiSettings settings;
  const DampingSettings& damping = c.settings.damping;
  if (damping.kind != DampingSettings::Kind::none && damping.ratio > 0.0)
    settings.least_damping = std::min(settings.least_damping, 0.2 * damping.ratio);
  return settings;
}

/// Modes under an unknown excitation.
void identify_ambient(DiagnosisInput& input) {
  Measured& measured = input.measured;
  input.ambient = std::make_shared<SsiResult>(identify_modes(measured.records, ssi_settings(input.c)));
  // Of several setups that of the most channels: a second look at frequencies.
  const std::vector<Setup> setups = setups_of(measured.records);
  const Setup& widest = *std::max_element(setups.begin(), setups.end(), [](const Setup& a, const Setup& b) {
    return a.recordings.front().channels.size() < b.recordings.front().channels.size();
  });
  input.spectra =
      std::make_shared<Fdd>(decompose_spectra(input.ambient->setups > 1 ? widest.recordings : measured.records));
  const SsiResult& found = *input.ambient;
  const Fdd& spectra = *input.spectra;
  for (const PoorChannel& poor : found.poor)
    measured.set_aside.push_back({fmt::format("channel {}", found.channels[std::size_t(poor.channel)]), poor.reason});
  for (const RejectedMode& aside : found.set_aside)
    measured.set_aside.push_back({fmt::format("{:.3f} Hz", aside.mode.frequency), aside.reason});
  if (found.setups > 1)
    measured.remarks.push_back(
        fmt::format("{} setups, whose shapes are put together by {}", found.setups, reference_words(found)));
  else
    set_aside_dropped(measured);
  for (const IdentifiedMode& m : found.modes) {
    MeasuredMode mode = named_mode(measured, m.frequency, m.frequency_std, m.damping, m.damping_std);
    add_shape(found.channels, turned(m.shape), m.shape_std, measured.sensors, mode);
    const FddPeak peak = peak_near(spectra, m.frequency, at_channels(m.shape, found.channels, spectra.channels));
    measured.remarks.push_back(fmt::format(
        "mode {}: {:.3f} Hz ± {:.3f}, damping {:.2f} % ± {:.2f}, stable at {} orders; {}", mode.name, m.frequency,
        m.frequency_std, 100.0 * m.damping, 100.0 * m.damping_std, m.hits,
        peak.found
            ? fmt::format("frequency-domain decomposition: {:.3f} Hz, MAC {:.2f}", peak.frequency, peak.assurance)
            : std::string("no peak of the frequency-domain decomposition")));
    measured.modes.push_back(std::move(mode));
  }
}

/// Windows as long as the number of averages allows that three inputs need: a single earthquake is short. Up to half as
/// high again as as many modes of the model as are used: of more than a dozen the poles are not all found, and what is
/// missing pulls at the others.
TransferSettings transfer_settings(const DiagnosisInput& input, const Assembly& assembly, int modes) {
  EigenMemory memory;
  const Response plain = response(assembly, linear_model(assembly), {}, modes, memory);
  double longest = 0.0, dt = 0.0;
  for (const Recording& r : input.measured.records) longest = std::max(longest, r.duration()), dt = r.dt;
  TransferSettings settings;
  settings.window = longest / 5.0;
  settings.highest_frequency = std::min({20.0, 0.4 / dt, 1.5 * std::exp(plain.log_frequency.tail(1)[0])});
  return settings;
}

/// Modes under a recorded motion of the ground.
void identify_driven(Measured& measured, const TransferSettings& settings) {
  const DrivenModes found = driven_modes(transfer_functions(measured.records, settings));
  for (const UndrivenMode& aside : found.set_aside)
    measured.set_aside.push_back({fmt::format("{:.3f} Hz", aside.mode.frequency), aside.reason});
  for (const DrivenMode& m : found.modes) {
    MeasuredMode mode = named_mode(measured, m.frequency, m.frequency_std, m.damping, m.damping_std);
    add_shape(found.outputs, m.shape, m.shape_std, measured.sensors, mode);
    std::string parts;
    for (std::size_t i = 0; i < found.inputs.size(); ++i) {
      const auto axis = Eigen::Index(found.inputs[i].back() - 'x'), input = Eigen::Index(i);
      mode.participation[axis] = m.participation[input];
      mode.participation_std[axis] = m.participation_std[input];
      parts += fmt::format("{} {} {:.2f} ± {:.2f}", i ? "," : "", "xyz"[axis], std::abs(m.participation[input]),
                           m.participation_std[input]);
    }
    measured.remarks.push_back(
        fmt::format("mode {}: {:.3f} Hz ± {:.3f}, damping {:.2f} % ± {:.2f}, driven by the ground "
                    "along{}",
                    mode.name, m.frequency, m.frequency_std, 100.0 * m.damping, 100.0 * m.damping_std, parts));
    measured.modes.push_back(std::move(mode));
  }
  measured.remarks.push_back(fmt::format(
      "these modes explain {:.0f} % of the transfer functions from the ground's motion", 100.0 * found.explained));
}

bool names_ground(const std::vector<Recording>& recordings) {
  return std::any_of(recordings.begin(), recordings.end(), [](const Recording& r) {
    return std::any_of(r.channels.begin(), r.channels.end(), is_base_channel);
  });
}

/// Modes from the recordings, where none are given.
void identify(DiagnosisInput& input, const Assembly& assembly, int most) {
  Measured& measured = input.measured;
  if (!measured.modes.empty() || measured.records.empty()) return;
  if (names_ground(measured.records) && has_base_motion(measured.records)) {
    check_in_common(measured.records);
    set_aside_dropped(measured);
    identify_driven(measured, transfer_settings(input, assembly, most));
  } else {
    identify_ambient(input);
  }
  if (int(measured.modes.size()) > most) {
    for (std::size_t m = std::size_t(most); m < measured.modes.size(); ++m)
      measured.set_aside.push_back({fmt::format("mode {}", measured.modes[m].name),
                                    fmt::format("only the {} lowest modes are used; see --most-modes", most)});
    measured.modes.resize(std::size_t(most));
  }
  if (measured.modes.empty())
    throw InputError("{}: no mode can be identified from the recordings; record longer, or give modes.csv",
                     measured.directory);
}

/// The case's assembly with blocks of another size.
Assembly remeshed(const Case& c, double block_scale) {
  Case other = c;
  other.generator_input.values.at("block_scale") = block_scale;
  return make_assembly(other);
}

std::int64_t unknowns_of(const Assembly& assembly) {
  return 6 * std::count_if(assembly.blocks.begin(), assembly.blocks.end(), [](const Block& b) { return !b.fixed; });
}

bool can_remesh(const Case& c) {
  return !c.generator.empty() && c.generator_input.values.contains("block_scale");
}

/// Blocks 1.25 times as large, to see what their size does.
std::shared_ptr<const CoarserMesh> coarser_mesh(const DiagnosisInput& input) {
  if (!can_remesh(input.c)) return nullptr;
  auto mesh = std::make_shared<CoarserMesh>();
  mesh->assembly = remeshed(input.c, 1.25 * input.block_scale);
  mesh->sensors = features_of(input.measured, mesh->assembly).sensors;
  // The stones are those of the case: what is coarser is so many times farther off; and no mesh is better than half.
  const double own = input.c.generator_input.values.at("block_scale");
  mesh->farther = std::max(0.5, (input.block_scale - own) / (0.25 * input.block_scale));
  return mesh;
}

/// What the mesh does to the case as it is, and errors of shapes, for both problems.
void measure_mesh(DiagnosisInput& input) {
  EigenMemory memory;
  DiagnosisProblem& p = input.coarse;
  p.coarser = coarser_mesh(input);
  const Response plain = response(p.base, linear_model(p.base), p.features.sensors, p.modes, memory);
  set_mesh_error(p, plain, {}, {});
  set_shape_errors(p, plain);
  if (!input.coarsened) {
    input.full = p;
    return;
  }
  input.full.mesh = p.mesh;
  input.full.error.frequency = std::hypot(p.apart_from_mesh.frequency, 0.5 * p.mesh.scatter);
  input.full.error.shape = std::hypot(p.apart_from_mesh.shape, 0.5 * p.mesh.shape);
  set_shape_errors(input.full);
}

void hold_back(Features& features, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const auto at = std::find_if(features.modes.begin(), features.modes.end(),
                                 [&](const MeasuredFeature& mode) { return mode.name == name; });
    if (at == features.modes.end()) throw InputError("--hold-back: there is no measured mode '{}'", name);
    at->held_back = true;
  }
}

DiagnosisProblem problem_of(const DiagnosisRequest& request, const DiagnosisInput& input, Assembly assembly) {
  DiagnosisProblem problem;
  problem.features = features_of(input.measured, assembly);
  hold_back(problem.features, request.hold_back);
  problem.base = std::move(assembly);
  problem.apart_from_mesh.frequency = request.model_error;
  problem.apart_from_mesh.shape = request.shape_error;
  problem.error = problem.apart_from_mesh;
  const DampingSettings& damping = input.c.settings.damping;
  using Kind = DampingSettings::Kind;
  if (damping.kind == Kind::maxwell || damping.kind == Kind::rayleigh) problem.damping = damping.ratio;
  // Identification leaves out modes that nothing drove.
  const int measured = int(problem.features.modes.size());
  problem.modes = std::min(input.measured.records.empty() ? measured + 8 : 2 * measured + 8, 40);
  return problem;
}

}  // namespace

MeasuredFeature feature_of(const MeasuredMode& mode, std::size_t sensors) {
  MeasuredFeature f;
  f.name = mode.name;
  f.frequency = 1.0 / mode.period;
  f.frequency_std = mode.period_std > 0.0 ? mode.period_std / mode.period : default_period_std;
  f.direction = mode.direction;
  if (mode.damping && *mode.damping > 0.0) {
    f.damping = mode.damping;
    f.damping_std = mode.damping_std > 0.0 ? mode.damping_std / *mode.damping : default_damping_std;
  }
  if (mode.shape.empty()) return f;
  f.participation = mode.participation;
  f.participation_std = mode.participation_std;
  if (mode.phases) f.quadrature = Eigen::VectorXd::Constant(Eigen::Index(sensors), std::nan(""));
  f.shape = Eigen::VectorXd::Constant(Eigen::Index(sensors), std::nan(""));
  f.shape_std = Eigen::VectorXd::Zero(Eigen::Index(sensors));
  double largest = 0.0;
  for (const MeasuredValue& v : mode.shape) largest = std::max(largest, std::abs(v.value));
  for (const MeasuredValue& v : mode.shape) {
    f.shape[Eigen::Index(v.sensor)] = v.value;
    if (mode.phases) f.quadrature[Eigen::Index(v.sensor)] = v.quadrature;
    f.shape_std[Eigen::Index(v.sensor)] = v.std > 0.0 ? v.std : default_shape_std * largest;
  }
  return f;
}

Features features_of(const Measured& measured, const Assembly& assembly) {
  Features features;
  const std::vector<std::int64_t> blocks = place_sensors(measured, assembly);
  for (std::size_t i = 0; i < measured.sensors.size(); ++i)
    features.sensors.push_back(
        {measured.sensors[i].id, measured.sensors[i].position, measured.sensors[i].direction, blocks[i]});
  for (const MeasuredMode& mode : measured.modes) features.modes.push_back(feature_of(mode, measured.sensors.size()));
  std::stable_sort(features.modes.begin(), features.modes.end(),
                   [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
  return features;
}

std::string sensors_used(const Features& features) {
  std::vector<bool> used(features.sensors.size());
  for (const MeasuredFeature& mode : features.modes)
    for (Eigen::Index s = 0; s < mode.shape.size(); ++s)
      if (std::isfinite(mode.shape[s])) used[std::size_t(s)] = true;
  const auto count = std::size_t(std::count(used.begin(), used.end(), true)), all = used.size();
  return count == all ? fmt::format("{} sensors", all) : fmt::format("{} of {} sensors", count, all);
}

DiagnosisInput diagnosis_input(const DiagnosisRequest& request) {
  DiagnosisInput input;
  input.c = read_case(request.case_file, CaseUse::geometry);
  input.measured = read_measured(request.measured);
  input.without = request.settings.without;
  Assembly own = make_assembly(input.c);
  for (std::string& text : remarks(input.c, own)) input.measured.remarks.push_back(std::move(text));
  if (can_remesh(input.c)) input.block_scale = input.c.generator_input.values.at("block_scale");
  Assembly coarse = own;
  while (can_remesh(input.c) && unknowns_of(coarse) > request.unknowns) {
    // Blocks per volume fall with the cube of their size.
    const double factor = std::cbrt(double(unknowns_of(coarse)) / request.unknowns);
    input.block_scale *= std::max(1.05, factor);
    input.coarsened = true;
    coarse = remeshed(input.c, input.block_scale);
  }
  identify(input, coarse, request.most_modes);
  input.full = problem_of(request, input, std::move(own));
  input.coarse = problem_of(request, input, std::move(coarse));
  measure_mesh(input);
  return input;
}

}  // namespace voussoir
