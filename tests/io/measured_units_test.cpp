// Units of measured channels, and times that a logger has rounded.
#include <gtest/gtest.h>

#include <cmath>

#include "io/measured/measured.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

void write_record(const test::Folder& folder, const std::string& text) {
  std::filesystem::create_directory(folder / "records");
  folder.write("records/wind.csv", text);
}

Measured read_record(const test::Folder& folder, const std::string& text) {
  write_record(folder, text);
  return read_measured(folder.path());
}

/// Why the folder is refused; empty when it is not.
std::string error_of(const test::Folder& folder) {
  return test::message_of<InputError>([&] { read_measured(folder.path()); });
}

/// Sensors a1 to a4 in these units, and a recording in which each moves as a sin(2 pi f t), amplitudes in them.
Measured in_units(const test::Folder& folder, const std::vector<std::string>& units,
                  const std::vector<double>& amplitudes) {
  const double f = 3.0, dt = 0.01;
  std::string table = "id,x,y,z,direction,unit\n", text = "t";
  for (std::size_t i = 0; i < units.size(); ++i) {
    table += fmt::format("a{0},{0},0,0,z,{1}\n", i + 1, units[i]);
    text += fmt::format(",a{}", i + 1);
  }
  for (int i = 0; i < 400; ++i) {
    text += fmt::format("\n{:.2f}", dt * i);
    for (const double a : amplitudes) text += fmt::format(",{:.12g}", a * std::sin(2.0 * M_PI * f * dt * i));
  }
  folder.write("sensors.csv", table);
  return read_record(folder, text + "\n");
}

TEST(MeasuredUnits, ChannelsHaveThem) {
  const test::Folder folder;
  const double omega = 2.0 * M_PI * 3.0, g = 9.80665;
  const Measured a =
      in_units(folder, {"m/s2", "mm/s^2", "g", "mg", "gal", ""}, {0.5, 500.0, 0.5 / g, 500.0 / g, 50.0, 1.5});
  EXPECT_EQ(a.records[0].values.rows(), 400);
  for (Eigen::Index c = 1; c < 5; ++c)
    EXPECT_LT((a.records[0].values.col(c) - a.records[0].values.col(0)).cwiseAbs().maxCoeff(), 1e-10) << c;
  EXPECT_LT((a.records[0].values.col(5) - 3.0 * a.records[0].values.col(0)).cwiseAbs().maxCoeff(), 1e-10);
  // A velocity v sin has the acceleration omega v cos, a displacement u sin that of -omega2 u sin.
  const Measured m =
      in_units(folder, {"m/s2", "mm/s", "µm", "m/s"}, {1.0, 1000.0 / omega, 1e6 / (omega * omega), 1.0 / omega});
  const Eigen::MatrixXd& x = m.records[0].values;
  ASSERT_EQ(x.rows(), 400 - 2 * 48);
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const double phase = omega * 0.01 * double(i + 48);
    ASSERT_NEAR(x(i, 0), std::sin(phase), 1e-9) << i;
    ASSERT_NEAR(x(i, 1), std::cos(phase), 1e-3) << i;
    ASSERT_NEAR(x(i, 2), -std::sin(phase), 1e-3) << i;
    ASSERT_NEAR(x(i, 3), std::cos(phase), 1e-3) << i;
  }
}

TEST(MeasuredUnits, UnknownOnesAreRefused) {
  const test::Folder folder;
  folder.write("modes.csv", "mode,period\n1,0.4\n");
  folder.write("sensors.csv", "id,x,y,z,direction,unit\na1,0,1,2,z,mm/s3\n");
  EXPECT_NE(error_of(folder).find("sensors.csv:2: unit 'mm/s3': did you mean 'mm/s"), std::string::npos)
      << error_of(folder);
}

/// A recording whose times a logger has rounded to `decimals`, at `rate` samples a second.
std::string rounded_times(double rate, int decimals, int samples, double start = 0.0) {
  std::string text = "t,a1\n";
  for (int i = 0; i < samples; ++i) text += fmt::format("{:.{}f},{}\n", start + double(i) / rate, decimals, i % 7);
  return text;
}

TEST(MeasuredTimes, RoundedOnesHaveTheStepsTheyCameFrom) {
  const test::Folder folder;
  for (const double rate : {128.0, 256.0, 512.0, 102.4, 75.0})
    for (const int decimals : {3, 4, 5}) {
      const Measured m = read_record(folder, rounded_times(rate, decimals, 5000, 3.7));
      // Of five thousand rounded times the rate is known to a few hundred thousandths.
      EXPECT_NEAR(m.records[0].dt * rate, 1.0, 3e-6 * std::pow(10.0, 5 - decimals) * 0.1 + 1e-12)
          << rate << " " << decimals;
      EXPECT_EQ(m.records[0].values.rows(), 5000);
      if (rate == std::round(rate)) {
        EXPECT_EQ(m.records[0].dt, 1.0 / rate);
      }
    }
}

TEST(MeasuredTimes, RoundedOnesWithAGapAreRefused) {
  const test::Folder folder;
  std::string text = rounded_times(128.0, 4, 1000);
  const std::size_t row = text.find("\n3.9062,");
  ASSERT_NE(row, std::string::npos);
  write_record(folder, text.erase(row, text.find('\n', row + 1) - row));
  EXPECT_NE(error_of(folder).find("the time step is 0.0157 s here and 0.0078 s elsewhere"), std::string::npos)
      << error_of(folder);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
