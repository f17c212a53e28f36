// A small bridge and what would be measured on it, for tests of the diagnosis.
#pragma once
#include <fmt/format.h>

#include "solver/diagnosis/diagnose.h"
#include "solver/effects/parts.h"
#include "tests/solver/models.h"

namespace voussoir::test {

inline Assembly bridge(double block_scale = 4.0) {
  const Generator& generator = find_generator("cs1");
  GeneratorInput input = default_input(generator);
  input.choices.at("abutments") = "free";
  input.values.at("block_scale") = block_scale;
  input.values.at("abutment_leaf_length") = 1.5;
  Assembly assembly = generator.build(input);
  assembly.generator = "cs1";
  return assembly;
}

/// Four semicircular spans of 8 m, each of two rings, in large blocks.
inline Assembly bridge_of_two_rings() {
  const Generator& generator = find_generator("bridge");
  GeneratorInput input = default_input(generator);
  input.entries["span"] = 4;
  const Keys keys = keys_of(generator, input);
  for (const Parameter& p : keys.parameters) input.values.try_emplace(p.name, p.value);
  for (const Choice& c : keys.choices) input.choices.try_emplace(c.name, c.words.front());
  input.values.at("block_scale") = 4.0;
  for (const char* span : {"span.1.rings", "span.2.rings", "span.3.rings", "span.4.rings"}) input.values.at(span) = 2.0;
  return generator.build(input);
}

/// CS1 or CS2 in large blocks; `edge` (m): its fill one continuum of tetrahedra no longer than that.
/// `spans`: 0: as many as it has.
inline Assembly small_bridge(const std::string& name, double block_scale, double edge = 0.0, int spans = 0) {
  GeneratorInput input = default_input(find_generator(name));
  input.values.at("block_scale") = block_scale;
  if (name == "cs1") input.values.at("abutment_leaf_length") = 1.5;
  if (spans > 0) input.values.at("spans") = spans;
  if (edge > 0.0) input.choices.at("backfill") = "deformable", input.values.at("fill_edge") = edge;
  Assembly assembly = find_generator(name).build(input);
  assembly.generator = name;
  return assembly;
}

/// Along x, y and z on a few blocks of the deck and a pier.
inline std::vector<Sensor> sensors_on(const Assembly& assembly) {
  std::vector<Sensor> sensors;
  for (const char* group : {"keystone 0", "keystone 1", "keystone 2", "keystone 3", "spandrel y- pier 1"})
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t block = assembly.groups.at(group)[0];
      sensors.push_back({fmt::format("{}{}", group, "xyz"[axis]), assembly.blocks[std::size_t(block)].centroid,
                         Vec3::Unit(axis), block});
    }
  return sensors;
}

/// What a model would give if it were measured, exactly; `driven`: with what the ground's motion does, and phases.
inline DiagnosisProblem measured(const Assembly& base, const Assembly& truth, int modes, bool driven = false) {
  DiagnosisProblem problem;
  problem.base = base;
  problem.modes = modes + 8;
  problem.damping = 0.02;
  problem.features.sensors = sensors_on(base);
  EigenMemory memory;
  const Response r = response(truth, linear_model(truth), sensors_on(truth), modes, memory, driven);
  for (int i = 0; i < modes; ++i) {
    MeasuredFeature f;
    f.name = std::to_string(i + 1);
    f.frequency = std::exp(r.log_frequency[i]);
    f.frequency_std = 0.01;
    f.direction = r.words[std::size_t(i)].direction;
    f.damping = 0.02;
    f.damping_std = 0.1;
    f.shape = r.sensors.col(i);
    f.shape_std = Eigen::VectorXd::Constant(r.sensors.rows(), 0.02 * f.shape.cwiseAbs().maxCoeff());
    if (driven) {
      f.quadrature = Eigen::VectorXd::Zero(f.shape.size());
      f.participation = r.participation.col(i).cast<std::complex<double>>();
      f.participation_std.setConstant(0.02 * r.participation.col(i).cwiseAbs().maxCoeff());
    }
    problem.features.modes.push_back(f);
  }
  set_covariance(problem);
  return problem;
}

inline Assembly with(Assembly assembly, const std::string& name, const std::string& where,
                     const std::map<std::string, double>& values) {
  EffectSetting setting = {name, where, values};
  complete(setting);
  apply_effect(assembly, setting);
  return assembly;
}

inline DiagnosisSettings quick(int threads) {
  DiagnosisSettings settings;
  settings.fits = 4;
  settings.threads = threads;
  return settings;
}

}  // namespace voussoir::test
