// A folder of field measurements to be spoilt.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "io/measured/measured.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir::test {

inline const std::string sensors = "id,x,y,z,direction\na1,0,1,2,z\na2,1.5,1,2,-x\na3,3,1,2,0.7071;0.7071;0\n";
inline const std::string modes =
    "mode,period,period_std,damping,damping_std,direction\n1,0.4,0.01,0.02,0.005,transverse\n2,0.3,,,,\nT3,0.2,,0,,\n";
inline const std::string shapes = "mode,sensor,value,std\n1,a1,1,0.1\n1,a2,-0.5,\n2,a1,0.3,\n2,a2,0.2,\n2,a3,1e-3,0\n";

/// `samples` rows of t and a sine for each channel.
inline std::string record(const std::vector<std::string>& channels, int samples = 120, double dt = 0.005) {
  std::string text = "t";
  for (const std::string& c : channels) text += "," + c;
  for (int i = 0; i < samples; ++i) {
    text += fmt::format("\n{:.6f}", dt * i);
    for (std::size_t c = 0; c < channels.size(); ++c)
      text += fmt::format(",{:.5g}", std::sin(0.3 * i + double(c) + 1.0));
  }
  return text + "\n";
}

/// As few bytes as a recording can have.
inline std::string short_record() {
  std::string text = "t,a1\n";
  for (int i = 0; i < 101; ++i) text += fmt::format("{},{}\n", i, i % 3);
  return text;
}

class MeasuredFolder : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) { folder.write(name, text); }
  void write_record(const std::string& text, const std::string& name = "wind.csv") {
    std::filesystem::create_directory(folder / "records");
    folder.write("records/" + name, text);
  }
  void write_all() {
    write("sensors.csv", sensors);
    write("modes.csv", modes);
    write("shapes.csv", shapes);
    write("about.toml", "what = \"a bridge\"\nwhen = \"2021-05-03\"\nunits = \"SI\"\nnotes = \"windy\"\n");
    write_record(record({"a1", "a2", "base_y"}));
  }
  Measured read() { return read_measured(folder.path()); }
  /// The error without the folder's path; "" when the folder is accepted.
  std::string problem() {
    std::string text = message_of<InputError>([&] { read(); });
    for (auto at = text.find(folder.path()); at != std::string::npos; at = text.find(folder.path()))
      text.replace(at, folder.path().size() + 1, "");
    return text;
  }
  std::string problem(const std::string& name, const std::string& text) {
    write(name, text);
    return problem();
  }
  std::string record_problem(const std::string& text) {
    write_record(text);
    return problem();
  }
  Folder folder;
};

inline void expect_begins(const std::string& text, const std::string& begin) {
  EXPECT_EQ(text.substr(0, begin.size()), begin) << text;
}
inline void expect_holds(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

inline void expect_same(const MeasuredMode& a, const MeasuredMode& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.period, b.period);
  EXPECT_EQ(a.period_std, b.period_std);
  EXPECT_EQ(a.damping, b.damping);
  EXPECT_EQ(a.damping_std, b.damping_std);
  EXPECT_EQ(a.direction, b.direction);
  ASSERT_EQ(a.shape.size(), b.shape.size());
  for (std::size_t i = 0; i < a.shape.size(); ++i) {
    EXPECT_EQ(a.shape[i].sensor, b.shape[i].sensor);
    EXPECT_EQ(a.shape[i].value, b.shape[i].value);
    EXPECT_EQ(a.shape[i].std, b.shape[i].std);
  }
}

inline void expect_same(const Measured& a, const Measured& b) {
  EXPECT_EQ(a.what, b.what);
  EXPECT_EQ(a.when, b.when);
  EXPECT_EQ(a.notes, b.notes);
  ASSERT_EQ(a.sensors.size(), b.sensors.size());
  for (std::size_t i = 0; i < a.sensors.size(); ++i) {
    EXPECT_EQ(a.sensors[i].id, b.sensors[i].id);
    EXPECT_EQ(a.sensors[i].position, b.sensors[i].position);
    EXPECT_EQ(a.sensors[i].direction, b.sensors[i].direction);
  }
  ASSERT_EQ(a.modes.size(), b.modes.size());
  for (std::size_t i = 0; i < a.modes.size(); ++i) expect_same(a.modes[i], b.modes[i]);
  ASSERT_EQ(a.records.size(), b.records.size());
  for (std::size_t i = 0; i < a.records.size(); ++i) {
    EXPECT_EQ(a.records[i].name, b.records[i].name);
    EXPECT_EQ(a.records[i].dt, b.records[i].dt);
    EXPECT_EQ(a.records[i].channels, b.records[i].channels);
    EXPECT_EQ(a.records[i].values, b.records[i].values);
  }
}

}  // namespace voussoir::test
