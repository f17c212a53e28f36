#include "solver/diagnosis/hypothesis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>

#include "solver/effects/parts.h"

namespace voussoir {

namespace {

FitParameter factor_of(const std::string& name, double spread) {
  return {name, "-", 1.0, spread, true, std::exp(-3.0 * spread), std::exp(3.0 * spread)};
}

FitParameter fit_parameter(const EffectParameter& p) {
  // Slightly above zero, so that the added parts and their derivatives exist.
  const double low = p.logarithmic ? p.low : p.low + 1e-4 * (p.usual - p.low);
  return {p.name, p.unit, p.usual, p.spread, p.logarithmic, low, p.high};
}

/// Start at the usual value; if that is the neutral one, start one standard deviation to either side.
std::vector<std::vector<double>> starts_of(const Effect& effect) {
  const EffectParameter& first = effect.parameters[0];
  std::vector<double> usual(effect.parameters.size(), 0.0);
  if (first.usual != first.neutral) return {usual};
  std::vector<double> up = usual, down = usual;
  up[0] = 1.0, down[0] = -1.0;
  return {up, down};
}

/// A clock that is late or early, typically by a tenth of a second or less.
Candidate late_clock(const Candidate& fault) {
  Candidate clock = fault;
  clock.kind = Candidate::Kind::clock;
  clock.gain = 1.0;
  clock.parameters = {{"delay", "s", 0.0, 0.02, false, -0.2, 0.2}};
  clock.starts = {{-0.5}, {0.5}};
  return clock;
}

void add_support_motions(const Assembly& assembly, std::vector<Candidate>& all) {
  const Effect effect = find_effect("support_motion");
  const std::vector<std::string> places = supports(assembly);
  for (std::size_t i = 0; i < places.size(); ++i) {
    Candidate motion;
    motion.kind = Candidate::Kind::motion;
    motion.name = effect.name;
    motion.where = places[i];
    motion.support = i;
    for (const EffectParameter& p : effect.parameters) motion.parameters.push_back(fit_parameter(p));
    motion.starts = {{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}};
    all.push_back(std::move(motion));
  }
}

/// Mounted along another axis, or between two.
void add_turned(const Candidate& fault, const Sensor& sensor, std::vector<Candidate>& all) {
  const bool upright = sensor.direction.head<2>().norm() < 0.1 * sensor.direction.norm();
  std::vector<std::pair<double, double>> ways;  // turn, tilt
  for (const double tilt : {-90.0, -45.0, 45.0, 90.0}) ways.emplace_back(0.0, tilt);
  for (const double turn : {-90.0, -45.0, 45.0, 90.0})
    if (!upright) ways.emplace_back(turn, 0.0);
  for (const double tilt : {-90.0, -45.0, 45.0, 90.0})
    if (upright) ways.emplace_back(90.0, tilt);
  for (const auto& [turn, tilt] : ways) {
    Candidate turned = fault;
    turned.kind = Candidate::Kind::turn;
    turned.gain = 1.0;
    turned.turn = turn, turned.tilt = tilt;
    turned.direction = mounted(sensor.direction, turn, tilt);
    all.push_back(turned);
  }
}

void add_sensor_faults(const std::vector<Sensor>& sensors, bool clocks, std::vector<Candidate>& all) {
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    Candidate reversed;
    reversed.kind = Candidate::Kind::gain;
    reversed.name = "sensor_fault";
    reversed.where = "channel " + sensors[i].id;
    reversed.gain = -1.0;
    reversed.sensors = {i};
    reversed.starts = {{}};
    all.push_back(reversed);
    Candidate dead = reversed;
    dead.gain = 0.0;
    all.push_back(dead);
    add_turned(reversed, sensors[i], all);
    Candidate gain = reversed;
    gain.gain = 1.0;
    gain.parameters = {{"gain", "-", 1.0, 0.7, true, 0.05, 20.0}};
    gain.starts = {{-1.0}, {1.0}};
    all.push_back(gain);
    if (clocks) all.push_back(late_clock(reversed));
    for (std::size_t j = i + 1; j < sensors.size(); ++j) {
      if ((sensors[i].position - sensors[j].position).norm() > sensor_housing) continue;
      Candidate swap = reversed;
      swap.kind = Candidate::Kind::swap;
      const auto [first, second] = std::minmax(sensors[i].id, sensors[j].id);  // whatever the order of the file
      swap.where = fmt::format("channels {} {}", first, second);
      swap.sensors = {i, j};
      all.push_back(swap);
    }
  }
}

/// Effects have their weights. Among the places of an effect, the collective place counts as much as all others
/// together, because the same cause usually affects all parts of a kind.
void share_priors(std::vector<Candidate>& all) {
  std::map<std::string, std::pair<double, double>> counts;  // name: collective places, others
  const auto collective = [](const Candidate& c) {
    static const std::vector<std::string> words = {"both", "all", "arches", "piers", "abutments", "spandrels", "deck"};
    return std::find(words.begin(), words.end(), c.where) != words.end();
  };
  for (const Candidate& c : all) (collective(c) ? counts[c.name].first : counts[c.name].second) += 1.0;
  double sum = 0.0;
  for (Candidate& c : all) {
    const auto [together, apart] = counts[c.name];
    const double half = together > 0.0 && apart > 0.0 ? 0.5 : 1.0;
    c.prior = find_effect(c.name).weight * half / (collective(c) ? together : apart);
    sum += c.prior;
  }
  for (Candidate& c : all) c.prior /= sum;
}

/// Springs of this stiffness (Pa/m) along one axis between the end faces and ground that is not in the model.
void hold_end(Assembly& assembly, bool left, bool lengthways, double stiffness) {
  const std::vector<EndFace> faces = end_faces(assembly, left);
  Box box = box_of(faces);
  (left ? box.low : box.high).x() += left ? -1.0 : 1.0;
  const std::int64_t ground = add_box_block(assembly, box.low, box.high, Component::restraint, 0, true);
  const std::int32_t law = elastic_law_index(assembly);
  for (const EndFace& face : faces) {
    Joint& joint = add_joint(assembly, face.block, ground, face.polygon, polygon_normal(face.polygon),
                             lengthways ? stiffness : 0.0, lengthways ? 0.0 : stiffness, law);
    joint.cell_a = face.cell;
    joint.face_a = face.face;
  }
  sort_joints(assembly);
}

/// The joints of a part, including those with its neighbours.
void scale_around(Assembly& assembly, const BlockSet& part, double factor) {
  for (Joint& joint : assembly.joints) {
    const auto inside = [&](std::int64_t block) {
      return std::size_t(block) < part.size() && part[std::size_t(block)];
    };
    if (inside(joint.a) || inside(joint.b)) joint.kn *= factor, joint.ks *= factor;
  }
  scale_patches(assembly, part, factor);
}

}  // namespace

double FitParameter::value(double x) const {
  const double v = logarithmic ? usual * std::exp(spread * x) : usual + spread * x;
  return std::clamp(v, low, high);
}

double FitParameter::x(double v) const {
  return logarithmic ? std::log(v / usual) / spread : (v - usual) / spread;
}

std::vector<Calibration> calibrations(const Assembly& assembly) {
  const Effect effect = find_effect("calibration");
  std::vector<Calibration> all;
  for (const std::string& where : effect.places(assembly)) {
    // The densities of masonry and of what fills it are known to a few per cent, that of a backfill is not.
    const bool fill = where == "backfill";
    all.push_back({where, "stiffness", factor_of(where + " stiffness", where == "masonry" ? 0.25 : 0.3)});
    if (where != "infill") all.push_back({where, "density", factor_of(where + " density", fill ? 0.06 : 0.04)});
  }
  return all;
}

std::vector<EffectSetting> Hypothesis::settings(const Eigen::VectorXd& x) const {
  std::vector<EffectSetting> all;
  Eigen::Index at = 0;
  for (const Calibration& c : materials) {
    if (all.empty() || all.back().where != c.where)
      all.push_back({"calibration", c.where, {{"stiffness", 1.0}, {"density", 1.0}}});
    all.back().values[c.property] = c.parameter.value(x[at++]);
  }
  for (const Candidate& c : effects) {
    if (c.kind != Candidate::Kind::factor) all.push_back(c.setting(x.data() + at));
    at += Eigen::Index(c.parameters.size());
  }
  return all;
}

std::string Candidate::text() const {
  return name + (where.empty() ? "" : " at " + where);
}

std::string Candidate::full_text() const {
  if (kind == Kind::swap) return text() + ", swapped";
  if (kind == Kind::turn) {
    const char* how = turn == 0.0 ? "tilted" : tilt == 0.0 ? "turned" : "turned and tilted";
    return fmt::format("{}, {} by {:+.0f}°", text(), how, tilt == 0.0 ? turn : tilt);
  }
  if (kind == Kind::clock) return text() + ", late";
  if (kind != Kind::gain) return text();
  return text() + (!parameters.empty() ? ", gain" : gain == 0.0 ? ", dead" : ", reversed");
}

EffectSetting Candidate::setting(const double* x) const {
  EffectSetting setting = {name, where, {}};
  for (std::size_t i = 0; i < parameters.size(); ++i) setting.values[parameters[i].name] = parameters[i].value(x[i]);
  if (kind == Kind::gain && parameters.empty()) setting.values["gain"] = gain;
  if (kind == Kind::turn) setting.values["turn"] = turn, setting.values["tilt"] = tilt;
  if (kind != Kind::factor) complete(setting);
  return setting;
}

std::vector<Candidate> candidates(const Assembly& assembly, const std::vector<Sensor>& sensors,
                                  const CandidateChoice& choice) {
  std::vector<Candidate> all;
  const auto left_out = [&](const std::string& name) {
    return std::find(choice.without.begin(), choice.without.end(), name) != choice.without.end();
  };
  for (const Effect& effect : effects()) {
    if (left_out(effect.name) || effect.weight == 0.0) continue;
    if (!effect.apply) {
      if (effect.name != "damping" || !choice.damping) continue;
      Candidate damping;
      damping.kind = Candidate::Kind::damping;
      damping.name = effect.name;
      damping.where = "all";
      damping.parameters = {fit_parameter(effect.parameters[0])};
      damping.starts = {{0.0}};
      all.push_back(damping);
      continue;
    }
    for (const std::string& where : effect.places(assembly)) {
      Candidate c;
      c.name = effect.name;
      c.where = where;
      for (const EffectParameter& p : effect.parameters) c.parameters.push_back(fit_parameter(p));
      c.starts = starts_of(effect);
      all.push_back(std::move(c));
    }
  }
  if (!left_out("sensor_fault")) add_sensor_faults(sensors, choice.clocks, all);
  if (choice.driven && !left_out("support_motion")) add_support_motions(assembly, all);
  share_priors(all);
  return all;
}

std::vector<Candidate> nameless_factors(const Assembly& assembly) {
  std::vector<Candidate> all;
  const auto add = [&](const std::string& name, const std::string& where, double spread,
                       std::function<void(Assembly&, double)> apply) {
    Candidate c;
    c.kind = Candidate::Kind::factor;
    c.name = name;
    c.where = where;
    c.parameters = {{"factor", "-", 1.0, spread, true, std::exp(-4.0 * spread), std::exp(4.0 * spread)}};
    c.starts = {{-1.0}, {1.0}};
    c.apply = std::move(apply);
    all.push_back(std::move(c));
  };
  // Parts by their names: they act on other meshes too.
  const auto add_both = [&](const std::string& where, const std::function<BlockSet(const Assembly&)>& part) {
    add("stiffness", where, 0.6, [part](Assembly& a, double factor) { scale_around(a, part(a), factor); });
    add("mass", where, 0.2, [part](Assembly& a, double factor) { scale_density(a, part(a), factor); });
  };
  for (const std::string& name : masonry_parts(assembly)) {
    static const std::vector<std::string> groups = {"arches", "piers", "abutments", "spandrels", "all"};
    if (std::find(groups.begin(), groups.end(), name) == groups.end())
      add_both(name, [name](const Assembly& a) { return masonry_part(a, name); });
  }
  if (!all_if_any(assembly, Component::backfill).empty())
    add_both("backfill", [](const Assembly& a) { return component(a, Component::backfill); });
  if (!assembly.fill.empty()) {
    add("stiffness", "backfill", 0.6, [](Assembly& a, double factor) {
      scale_fill(a, factor, 1.0);
      scale_patches(a, BlockSet(a.blocks.size(), true), factor);
    });
    add("mass", "backfill", 0.2, [](Assembly& a, double factor) { scale_fill(a, 1.0, factor); });
  }
  for (const std::string& support : supports(assembly)) {
    add("stiffness", "base of " + support, 1.0, [support](Assembly& a, double factor) {
      const std::int64_t base = base_of(a, support);
      for (Joint& joint : a.joints)
        if (joint.a == base || joint.b == base) joint.kn *= factor, joint.ks *= factor;
    });
  }
  for (const std::string& end : free_ends(assembly))
    for (const bool lengthways : {true, false}) {
      add(lengthways ? "springs along x" : "springs across", end == "both" ? "both abutments" : "abutment " + end, 2.0,
          [end, lengthways](Assembly& a, double stiffness) {
            for (const bool left : {true, false})
              if (acts_at(end, left)) hold_end(a, left, lengthways, stiffness);
          });
      Candidate& springs = all.back();
      springs.parameters = {{"stiffness", "Pa/m", 1e8, 2.0, true, 1e4, 1e11}};
      springs.starts = {{0.0}};
    }
  for (Candidate& c : all) c.prior = 1.0 / double(all.size());
  return all;
}

std::size_t Hypothesis::size() const {
  std::size_t n = materials.size();
  for (const Candidate& c : effects) n += c.parameters.size();
  return n;
}

std::vector<FitParameter> Hypothesis::parameters() const {
  std::vector<FitParameter> all;
  for (const Calibration& c : materials) all.push_back(c.parameter);
  for (const Candidate& c : effects) all.insert(all.end(), c.parameters.begin(), c.parameters.end());
  return all;
}

Assembly Hypothesis::assembly(const Assembly& base, const Eigen::VectorXd& x) const {
  Assembly changed = base;
  change(changed, x);
  return changed;
}

void Hypothesis::change(Assembly& changed, const Eigen::VectorXd& x) const {
  // Materials first: what an effect takes from its surroundings then follows them.
  for (const EffectSetting& setting : settings(x))
    if (setting.name != "sensor_fault") apply_effect(changed, setting);
  auto at = Eigen::Index(materials.size());
  for (const Candidate& c : effects) {
    if (c.kind == Candidate::Kind::factor) c.apply(changed, c.parameters[0].value(x[at]));
    at += Eigen::Index(c.parameters.size());
  }
}

namespace {

/// A support that moves by `factor`, `delay` (s) late: its part of the participation is multiplied by f e^(−iωτ).
void move_support(std::size_t support, double factor, double delay, const ModalData& modes, Observed& seen) {
  if (support >= modes.at_support.size()) return;
  for (Eigen::Index m = 0; m < modes.log_frequency.size(); ++m) {
    const double omega = 2.0 * EIGEN_PI * std::exp(modes.log_frequency[m]);
    seen.participation.col(m) += (std::polar(factor, -omega * delay) - 1.0) * modes.at_support[support].col(m);
  }
}

}  // namespace

Observed Hypothesis::observe(const ModalData& modes, double damping, const Eigen::VectorXd& x) const {
  Observed seen;
  seen.log_frequency = modes.log_frequency;
  seen.readings = modes.sensors;
  seen.participation = modes.participation.cast<std::complex<double>>();
  seen.delays = Eigen::VectorXd::Zero(modes.sensors.rows());
  seen.damping = damping;
  auto at = Eigen::Index(materials.size());
  for (const Candidate& c : effects) {
    const auto value = [&](std::size_t i) { return c.parameters[i].value(x[at + Eigen::Index(i)]); };
    using Kind = Candidate::Kind;
    if (c.kind == Kind::damping) seen.damping = value(0);
    if (c.kind == Kind::gain) seen.readings.row(Eigen::Index(c.sensors[0])) *= c.parameters.empty() ? c.gain : value(0);
    if (c.kind == Kind::turn && modes.motions.size() > 0)
      seen.readings.row(Eigen::Index(c.sensors[0])) =
          c.direction.transpose() * modes.motions.middleRows<3>(3 * Eigen::Index(c.sensors[0]));
    if (c.kind == Kind::swap)
      seen.readings.row(Eigen::Index(c.sensors[0])).swap(seen.readings.row(Eigen::Index(c.sensors[1])));
    if (c.kind == Kind::clock) seen.delays[Eigen::Index(c.sensors[0])] += value(0);
    if (c.kind == Kind::motion) move_support(c.support, value(0), value(1), modes, seen);
    at += Eigen::Index(c.parameters.size());
  }
  return seen;
}

Hypothesis Hypothesis::with(const Candidate& candidate) const {
  Hypothesis more = *this;
  more.effects.push_back(candidate);
  return more;
}

}  // namespace voussoir
