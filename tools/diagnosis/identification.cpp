#include "tools/diagnosis/identification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/diagnosis/response.h"
#include "solver/identify/driven_modes.h"
#include "solver/identify/setups.h"

namespace voussoir {

namespace {

/// Periods of the lowest mode that an ambient recording shall hold (Cantieni 2005: 1000 to 2000; Brincker & Ventura
/// 2015: 20/(2 ζ), the same with a damping of 0.5 to 1 %).
constexpr double enough_periods = 1000.0;

/// "1.925 Hz (0.5195 s)".
std::string hertz(double frequency) {
  return fmt::format("{:.3f} Hz ({:.4f} s)", frequency, 1.0 / frequency);
}

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

bool names_ground(const std::vector<Recording>& recordings) {
  return std::any_of(recordings.begin(), recordings.end(), [](const Recording& r) {
    return std::any_of(r.channels.begin(), r.channels.end(), is_base_channel);
  });
}

/// Channels that are in some recordings only, where these are taken together.
void set_aside_dropped(Measured& measured) {
  for (const DroppedChannel& dropped : dropped_channels(measured.records))
    measured.set_aside.push_back({fmt::format("channel {}", dropped.name), dropped.reason});
}

/// The length of the recordings, or of the shortest setup, in periods of the lowest mode.
std::string length_remark(const SsiResult& found) {
  const double lowest = found.modes.front().frequency, periods = found.duration * lowest;
  const std::string what = fmt::format("{} {:.4g} s, {:.0f} periods of the lowest mode, {}",
                                       found.setups > 1 ? "the shortest setup lasts" : "the recordings last",
                                       found.duration, periods, hertz(lowest));
  if (periods >= enough_periods) return what;
  return fmt::format(
      "{}. This is too short: {:.0f} to {:.0f} periods are needed, {:.0f} s or more. Its frequency, and especially its "
      "damping, are less certain than their standard deviations say. Record for longer",
      what, enough_periods, 2.0 * enough_periods, std::ceil(enough_periods / lowest));
}

/// Sets aside the recordings of a folder that gives its modes itself, except the first one with the ground motion: the
/// response of the case to it is computed.
void set_aside_recordings(Measured& measured) {
  bool ground = false;
  for (const Recording& r : measured.records) {
    if (!ground && !measured.sensors.empty() && names_ground({r}) && has_base_motion({r}))
      ground = true;
    else
      measured.set_aside.push_back({r.name, "modes.csv gives the modes, so the program takes none from recordings"});
  }
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

/// The channels that all setups share, or words for their absence.
std::string reference_words(const SsiResult& found) {
  std::vector<std::string> names;
  for (const int c : found.references) names.push_back(found.channels[std::size_t(c)]);
  if (names.empty()) return "channels that some setups share";
  return fmt::format("the reference channels {}", fmt::join(names, ", "));
}

/// Settings for this case. A case with very low damping lowers the least damping ratio that a mode may have.
SsiSettings ssi_settings(const Case& c) {
  SsiSettings settings;
  const DampingSettings& damping = c.settings.damping;
  if (damping.kind != DampingSettings::Kind::none && damping.ratio > 0.0)
    settings.least_damping = std::min(settings.least_damping, 0.2 * damping.ratio);
  return settings;
}

/// Modes under an unknown excitation.
Identification identify_ambient(Measured& measured, const Case& c) {
  const auto ambient = std::make_shared<SsiResult>(identify_modes(measured.records, ssi_settings(c)));
  // Of several setups, the one with the most channels is used: a second estimate of the frequencies.
  const std::vector<Setup> setups = setups_of(measured.records);
  const Setup& widest = *std::max_element(setups.begin(), setups.end(), [](const Setup& a, const Setup& b) {
    return a.recordings.front().channels.size() < b.recordings.front().channels.size();
  });
  const SsiResult& found = *ambient;
  const auto decomposed =
      std::make_shared<Fdd>(decompose_spectra(found.setups > 1 ? widest.recordings : measured.records));
  const Fdd& spectra = *decomposed;
  for (const PoorChannel& poor : found.poor)
    measured.set_aside.push_back({fmt::format("channel {}", found.channels[std::size_t(poor.channel)]), poor.reason});
  for (const RejectedMode& aside : found.set_aside)
    measured.set_aside.push_back({hertz(aside.mode.frequency), aside.reason});
  for (const ShortRecording& r : found.too_short) measured.set_aside.push_back({r.name, r.reason});
  if (found.setups > 1)
    measured.remarks.push_back(fmt::format("{}, combined {} through {}", counted(found.setups, "setup"),
                                           found.joint ? "in one model (PreGER)" : "mode by mode (PoSER)",
                                           reference_words(found)));
  else
    set_aside_dropped(measured);
  if (!found.modes.empty()) measured.remarks.push_back(length_remark(found));
  for (const IdentifiedMode& m : found.modes) {
    MeasuredMode mode = named_mode(measured, m.frequency, m.frequency_std, m.damping, m.damping_std);
    add_shape(found.channels, turned(m.shape), m.shape_std, measured.sensors, mode);
    const FddPeak peak = peak_near(spectra, m.frequency, at_channels(m.shape, found.channels, spectra.channels));
    measured.remarks.push_back(fmt::format(
        "mode {}: {} ± {:.3f} Hz, damping {:.2f} % ± {:.2f}, stable at {}; {}", mode.name, hertz(m.frequency),
        m.frequency_std, 100.0 * m.damping, 100.0 * m.damping_std, counted(m.hits, "order"),
        peak.found
            ? fmt::format("frequency-domain decomposition: {}, MAC {:.2f}", hertz(peak.frequency), peak.assurance)
            : std::string("no peak of the frequency-domain decomposition")));
    measured.modes.push_back(std::move(mode));
  }
  return {ambient, decomposed};
}

/// Windows as long as the number of averages for three inputs allows, because a single earthquake is short. The band
/// ends at 1.5 times the highest of the `modes` lowest frequencies of the model: with more than about a dozen modes,
/// not all poles are found, and the missing ones distort the others.
TransferSettings transfer_settings(const Measured& measured, const Assembly& assembly, int modes) {
  EigenMemory memory;
  const Response plain = response(assembly, linear_model(assembly), {}, modes, memory);
  double longest = 0.0, dt = 0.0;
  for (const Recording& r : measured.records) longest = std::max(longest, r.duration()), dt = r.dt;
  TransferSettings settings;
  settings.window = longest / 5.0;
  settings.highest_frequency = std::min({20.0, 0.4 / dt, 1.5 * std::exp(plain.log_frequency.tail(1)[0])});
  return settings;
}

/// Modes under a recorded motion of the ground.
void identify_driven(Measured& measured, const TransferSettings& settings) {
  const DrivenModes found = driven_modes(transfer_functions(measured.records, settings));
  for (const UndrivenMode& aside : found.set_aside)
    measured.set_aside.push_back({hertz(aside.mode.frequency), aside.reason});
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
        fmt::format("mode {}: {} ± {:.3f} Hz, damping {:.2f} % ± {:.2f}, driven by the ground along{}", mode.name,
                    hertz(m.frequency), m.frequency_std, 100.0 * m.damping, 100.0 * m.damping_std, parts));
    measured.modes.push_back(std::move(mode));
  }
  measured.remarks.push_back(fmt::format(
      "these modes explain {:.0f} % of the transfer functions from the ground's motion", 100.0 * found.explained));
}

}  // namespace

Identification identify(Measured& measured, const Case& c, const Assembly& assembly, int most) {
  Identification identification;
  if (!measured.modes.empty()) set_aside_recordings(measured);
  if (!measured.modes.empty() || measured.records.empty()) return identification;
  if (names_ground(measured.records) && has_base_motion(measured.records)) {
    check_in_common(measured.records);
    set_aside_dropped(measured);
    identify_driven(measured, transfer_settings(measured, assembly, most));
  } else {
    identification = identify_ambient(measured, c);
  }
  if (int(measured.modes.size()) > most) {
    for (std::size_t m = std::size_t(most); m < measured.modes.size(); ++m)
      measured.set_aside.push_back({fmt::format("mode {}", measured.modes[m].name),
                                    fmt::format("only the {} lowest modes are used; see --most-modes", most)});
    measured.modes.resize(std::size_t(most));
  }
  if (measured.modes.empty())
    throw InputError("{}: the program can identify no mode from the recordings. Record for longer or give modes.csv",
                     measured.directory);
  return identification;
}

}  // namespace voussoir
