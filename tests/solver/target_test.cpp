// Spectra of the codes, beside values worked out by hand and by another program.
#include "solver/motion/target.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

/// L'Aquila, 475 years, as the paper has it.
TargetSpectrum aquila() {
  TargetSpectrum t;
  t.ag = 0.2607, t.f0 = 2.36, t.tc = 0.35, t.soil = 'D';
  return t;
}

TEST(Target, NtcByHand) {
  // S_S = 2.4 − 1.5 · 2.36 · 0.2607 = 1.47712; C_C = 1.25/√0.35 = 2.11289; T_C = 0.73951, T_B = 0.24650, T_D = 2.6428 s
  const TargetSpectrum t = aquila();
  EXPECT_NEAR(spectral_acceleration(t, 0.0), 0.38508, 1e-5);
  EXPECT_NEAR(spectral_acceleration(t, 0.5), 0.90880, 1e-5);
  EXPECT_NEAR(spectral_acceleration(t, 0.12325), 0.5 * (0.38508 + 0.90880), 1e-4);
  EXPECT_NEAR(spectral_acceleration(t, 1.0), 0.90880 * 0.73951, 2e-5);
  EXPECT_NEAR(spectral_acceleration(t, 4.0), 0.90880 * 0.73951 * 2.6428 / 16.0, 1e-5);
  TargetSpectrum damped = t;
  damped.damping = 0.1;
  EXPECT_NEAR(spectral_acceleration(damped, 0.5), std::sqrt(10.0 / 15.0) * 0.90880, 1e-5);
  EXPECT_NEAR(spectral_acceleration(damped, 0.0), 0.38508, 1e-5);
  TargetSpectrum ridge = t;
  ridge.topography = 4;
  EXPECT_NEAR(spectral_acceleration(ridge, 0.5), 1.4 * 0.90880, 1e-5);
  TargetSpectrum strong = t;
  strong.ag = 0.5, strong.soil = 'C';  // 1.7 − 0.6 · 2.36 · 0.5 = 0.992: not below 1
  EXPECT_NEAR(spectral_acceleration(strong, 0.0), 0.5, 1e-12);
  TargetSpectrum rock = t;
  rock.soil = 'A';
  EXPECT_NEAR(spectral_acceleration(rock, 0.349), 0.2607 * 2.36, 1e-12);
  EXPECT_LT(spectral_acceleration(rock, 0.352), 0.2607 * 2.36);
}

TEST(Target, EurocodeByHand) {
  TargetSpectrum t = aquila();
  t.code = TargetCode::en1998_type_1;
  EXPECT_NEAR(spectral_acceleration(t, 0.0), 1.35 * 0.2607, 1e-12);
  EXPECT_NEAR(spectral_acceleration(t, 0.1), 1.35 * 0.2607 * 1.75, 1e-12);
  EXPECT_NEAR(spectral_acceleration(t, 0.79), 2.5 * 1.35 * 0.2607, 1e-12);
  EXPECT_NEAR(spectral_acceleration(t, 1.6), 0.5 * 2.5 * 1.35 * 0.2607, 1e-12);
  EXPECT_NEAR(spectral_acceleration(t, 4.0), 2.5 * 1.35 * 0.2607 * 0.8 * 2.0 / 16.0, 1e-12);
  t.code = TargetCode::en1998_type_2;
  EXPECT_NEAR(spectral_acceleration(t, 0.2), 2.5 * 1.8 * 0.2607, 1e-12);
}

TEST(Target, VerticalByHand) {
  // NTC 2018: 0.2607 · 1.35 · √0.2607 = 0.17970 at 0 s, times F0 on the plateau; no factor of the soil.
  EXPECT_NEAR(vertical_spectral_acceleration(aquila(), 0.0), 0.179700, 1e-5);
  EXPECT_NEAR(vertical_spectral_acceleration(aquila(), 0.1), 0.424091, 2e-5);
  EXPECT_NEAR(vertical_spectral_acceleration(aquila(), 0.025), 0.5 * (0.179700 + 0.424091), 2e-5);
  EXPECT_NEAR(vertical_spectral_acceleration(aquila(), 0.6), 0.424091 * 0.15 / 0.6, 1e-5);
  EXPECT_NEAR(vertical_spectral_acceleration(aquila(), 2.0), 0.424091 * 0.15 / 4.0, 1e-5);
  // EN 1998-1: avg/ag 0.90 and 0.45, plateau of 3 avg.
  TargetSpectrum t;
  t.code = TargetCode::en1998_type_1, t.ag = 0.2, t.soil = 'C';
  EXPECT_NEAR(vertical_spectral_acceleration(t, 0.0), 0.18, 1e-12);
  EXPECT_NEAR(vertical_spectral_acceleration(t, 0.15), 0.54, 1e-12);
  t.code = TargetCode::en1998_type_2;
  EXPECT_NEAR(vertical_spectral_acceleration(t, 0.1), 0.27, 1e-12);
}

TEST(Target, WhatThereIsNotIsRefused) {
  const auto fault = [](auto change) {
    TargetSpectrum t = aquila();
    change(t);
    return test::message_of<InputError>([&] { check_target(t); });
  };
  EXPECT_EQ(fault([](TargetSpectrum&) {}), "");
  EXPECT_EQ(fault([](TargetSpectrum& t) { t.soil = 'F'; }), "the soil class is 'F'. It must be A, B, C, D or E.");
  EXPECT_EQ(fault([](TargetSpectrum& t) { t.topography = 5; }),
            "the topographic class is T5. It must be T1, T2, T3 or T4.");
  EXPECT_NE(fault([](TargetSpectrum& t) { t.ag = 0.0; }).find("ag is 0 g"), std::string::npos);
  EXPECT_NE(fault([](TargetSpectrum& t) { t.tc = NAN; }).find("tc is nan"), std::string::npos);
}

TEST(Target, AsAnotherProgramHasIt) {
  const std::string path = VOUSSOIR_SOURCE_DIR "/../shared/records/target_NTC18_LAquila_D_T1.csv";
  std::ifstream file(path);
  if (!file) GTEST_SKIP() << "no real records here";
  std::string line;
  std::getline(file, line);
  int compared = 0;
  for (double period = 0.0, value = 0.0; std::getline(file, line); ++compared) {
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf", &period, &value), 2);
    EXPECT_NEAR(spectral_acceleration(aquila(), period), value, 3e-4 * value) << period;
  }
  EXPECT_GT(compared, 40);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
