// A bridge that was built in stages: the same bits for any number of threads, and across a restart.
#include "solver/run/simulation.h"
#include "tests/restart/copy_state.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

SolverSettings built_then_shaken() {
  SolverSettings settings;
  StageSettings gravity, pulse;
  gravity.construction = ConstructionSettings{};
  pulse.kind = StageSettings::Kind::motion;
  pulse.duration = 0.06;
  pulse.motion.dt = 0.01;
  pulse.motion.acceleration.assign(8, Vec3(3.0, 4.0, 1.0));
  settings.stages = {gravity, pulse};
  return settings;
}

std::uint64_t hash_of(Simulation& s) {
  return hash_arrays(s.state().arrays());
}

void keeps_its_bits(const Assembly& assembly) {
  const SolverSettings settings = built_then_shaken();
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 3}) {
    Simulation whole(assembly, settings, threads, {});
    ASSERT_EQ(whole.run(), RunEnd::finished) << whole.failure();
    hashes.push_back(hash_of(whole));
    double most = 0.0;
    for (const float x : whole.state().built) most = std::max(most, std::abs(double(x)));
    EXPECT_GT(most, 1e-5) << "nothing had moved before it was built on";
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  Simulation first(assembly, settings, 2, {});
  ASSERT_EQ(first.run(0.03), RunEnd::interrupted);
  Simulation second(assembly, settings, 1, {});
  copy_state(second.model(), first.state(), second.state());
  second.restore(first.position());
  ASSERT_EQ(second.run(), RunEnd::finished) << second.failure();
  EXPECT_EQ(hash_of(second), hashes[0]);
}

TEST(Staged, KeepsItsBitsWithAFillOfBlocks) {
  keeps_its_bits(generated("cs2", {{"block_scale", 3.0}}));
}

TEST(Staged, KeepsItsBitsWithADeformableFill) {
  const Generator& generator = find_generator("cs2");
  GeneratorInput input = default_input(generator);
  input.values.at("block_scale") = 3.0, input.values.at("fill_edge") = 2.0;
  input.choices.at("backfill") = "deformable";
  keeps_its_bits(generator.build(input));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
