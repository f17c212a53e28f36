// Intensity and response spectra of ground motions: closed forms, and real records beside reference values.
#include "solver/motion/intensity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "io/records/format.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

constexpr double pi = 3.14159265358979323846, g = 9.80665;

std::vector<double> sine(double amplitude, double frequency, double duration, double dt) {
  std::vector<double> a;
  for (int i = 0; i <= int(std::lround(duration / dt)); ++i)
    a.push_back(amplitude * std::sin(2.0 * pi * frequency * dt * i));
  return a;
}

TEST(Intensity, OfASine) {
  const Intensity i = intensity_of(sine(2.0, 1.0, 10.0, 0.001), 0.001);
  EXPECT_NEAR(i.pga, 2.0, 1e-5);
  EXPECT_NEAR(i.pgv, 2.0 * 2.0 / (2.0 * pi), 1e-5);  // 1 − cos
  EXPECT_NEAR(i.arias, pi / (2.0 * g) * 4.0 * 0.5 * 10.0, 1e-6);
  EXPECT_NEAR(i.cav, 10.0 * 2.0 * 2.0 / pi, 5e-5);  // the trapezoidal rule errs by 4.2e-5 at the twenty kinks
  EXPECT_NEAR(i.t5, 0.5, 0.01);
  EXPECT_NEAR(i.significant(), 9.0, 0.02);
}

TEST(Intensity, OfNothing) {
  const Intensity i = intensity_of({0.0, 0.0, 0.0}, 0.01);
  EXPECT_EQ(i.pga + i.pgv + i.arias + i.cav + i.t5 + i.t95, 0.0);
  EXPECT_EQ(intensity_of({}, 0.01).pga, 0.0);
  EXPECT_EQ(response_spectrum({0.0, 0.0}, 0.01, {1.0})[0], 0.0);
}

/// A constant acceleration from the first sample on: a (1 + exp(−π ζ/√(1−ζ²))), and with a slow ramp just a.
TEST(Spectrum, OfAStepAndARamp) {
  const std::vector<double> step(20001, 3.0);
  for (const double damping : {0.02, 0.05, 0.2})
    for (const double period : {0.05, 0.3, 2.0}) {
      const double exact = 3.0 * (1.0 + std::exp(-pi * damping / std::sqrt(1.0 - damping * damping)));
      const double found = response_spectrum(step, 0.001, {period}, damping)[0];
      EXPECT_NEAR(found, exact, 2e-3 * exact);
      // However far apart the samples: the motion is linear between them.
      EXPECT_NEAR(response_spectrum(std::vector<double>(21, 3.0), 1.0, {period}, damping)[0], exact, 4e-3 * exact);
    }
  std::vector<double> ramp;
  for (int i = 0; i <= 2000; ++i) ramp.push_back(3.0 * std::min(1.0, i / 1000.0));
  EXPECT_NEAR(response_spectrum(ramp, 0.01, {0.05})[0], 3.0, 0.01);
}

/// In resonance u grows as (a/2ζω²)(1 − e^(−ζωt)).
TEST(Spectrum, InResonance) {
  for (const double cycles : {3.0, 10.0, 60.0}) {
    const double zeta = 0.05, exact = 1.0 / (2.0 * zeta) * (1.0 - std::exp(-zeta * 2.0 * pi * cycles));
    EXPECT_NEAR(response_spectrum(sine(1.0, 2.0, cycles / 2.0, 0.002), 0.002, {0.5}, zeta)[0], exact, 0.06 * exact);
  }
  EXPECT_NEAR(response_spectrum(sine(1.0, 2.0, 100.0, 0.002), 0.002, {0.5})[0], 10.0, 0.02);
}

std::vector<std::vector<std::string>> rows_of(const std::string& path) {
  std::vector<std::vector<std::string>> rows;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    rows.emplace_back();
    for (std::string word; std::getline(words, word, ',');) rows.back().push_back(word);
  }
  return rows;
}

/// Values that another program found for the same files.
TEST(Intensity, OfRealRecords) {
  const std::string folder = VOUSSOIR_SOURCE_DIR "/../shared/records/";
  if (!std::filesystem::exists(folder + "REFERENCE_IMS.csv")) GTEST_SKIP() << "no real records here";
  const auto measures = rows_of(folder + "REFERENCE_IMS.csv"), spectra = rows_of(folder + "REFERENCE_PSA_5pct.csv");
  std::map<std::string, std::vector<std::string>> psa;
  for (const auto& row : spectra) psa[row[0] + row[1]] = row;
  std::vector<double> periods;
  for (std::size_t k = 2; k < spectra[0].size(); ++k) periods.push_back(std::stod(spectra[0][k].substr(1)));
  int compared = 0;
  for (std::size_t i = 1; i < measures.size(); ++i) {
    const auto& row = measures[i];
    if (row[1] != "acc" || !std::filesystem::exists(folder + row[5])) continue;
    SCOPED_TRACE(row[5]);
    const Record record = read_record(folder + row[5], std::stod(row[7])).record;
    const Intensity found = intensity_of(record.values, record.dt);
    EXPECT_NEAR(found.pga / g, std::stod(row[8]), 1e-5 * found.pga);
    EXPECT_NEAR(100.0 * found.pgv, std::stod(row[9]), 1e-4 * 100.0 * found.pgv);
    EXPECT_NEAR(found.arias, std::stod(row[10]), 1e-4 * found.arias);
    EXPECT_NEAR(found.significant(), std::stod(row[11]), 1e-3);
    EXPECT_NEAR(found.cav, std::stod(row[14]), 1e-4 * found.cav);
    const auto reference = psa.find(row[0] + row[4]);
    if (reference == psa.end()) continue;
    const std::vector<double> spectrum = response_spectrum(record.values, record.dt, periods);
    // Those look for peaks at the samples alone; so done here, 954 of 990 values agree to 0.05 %.
    for (std::size_t k = 0; k < periods.size(); ++k) {
      const double expected = g * std::stod(reference->second[k + 2]);
      EXPECT_NEAR(spectrum[k], expected, (periods[k] < 0.15 ? 0.03 : 0.005) * expected) << periods[k];
    }
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
