// Folders of field measurements: every layout, what is refused, what is set aside, and the way back.
#include "io/measured/measured.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>

#include "io/case/case.h"
#include "solver/base/error.h"
#include "tests/io/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

const std::string sensors = "id,x,y,z,direction\na1,0,1,2,z\na2,1.5,1,2,-x\na3,3,1,2,0.7071;0.7071;0\n";
const std::string modes =
    "mode,period,period_std,damping,damping_std,direction\n1,0.4,0.01,0.02,0.005,transverse\n2,0.3,,,,\nT3,0.2,,0,,\n";
const std::string shapes = "mode,sensor,value,std\n1,a1,1,0.1\n1,a2,-0.5,\n2,a1,0.3,\n2,a2,0.2,\n2,a3,1e-3,0\n";

/// `samples` rows of t and a sine for each channel.
std::string record(const std::vector<std::string>& channels, int samples = 120, double dt = 0.005) {
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
std::string short_record() {
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
    std::string text = test::message_of<InputError>([&] { read(); });
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
  test::Folder folder;
};

void expect_begins(const std::string& text, const std::string& begin) {
  EXPECT_EQ(text.substr(0, begin.size()), begin) << text;
}
void expect_holds(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

void expect_same(const MeasuredMode& a, const MeasuredMode& b) {
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

void expect_same(const Measured& a, const Measured& b) {
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

TEST_F(MeasuredFolder, EverythingIsRead) {
  write_all();
  const Measured m = read();
  EXPECT_EQ(m.directory, folder.path());
  EXPECT_EQ(m.what, "a bridge");
  EXPECT_EQ(m.when, "2021-05-03");
  EXPECT_EQ(m.notes, "windy");
  ASSERT_EQ(m.sensors.size(), 3u);
  EXPECT_EQ(m.sensors[1].position, Vec3(1.5, 1, 2));
  EXPECT_EQ(m.sensors[1].direction, Vec3(-1, 0, 0));
  EXPECT_EQ(m.sensors[1].row, 3);
  EXPECT_NEAR(m.sensors[2].direction.norm(), 1.0, 1e-15);
  ASSERT_EQ(m.modes.size(), 3u);
  EXPECT_EQ(m.modes[0].period, 0.4);
  EXPECT_EQ(m.modes[0].period_std, 0.01);
  EXPECT_EQ(m.modes[0].damping, 0.02);
  EXPECT_EQ(m.modes[0].damping_std, 0.005);
  EXPECT_EQ(m.modes[0].direction, "transverse");
  EXPECT_EQ(m.modes[0].shape.size(), 2u);
  EXPECT_EQ(m.modes[0].shape[1].value, -0.5);
  EXPECT_FALSE(m.modes[1].damping.has_value());
  EXPECT_EQ(m.modes[1].shape.size(), 3u);
  EXPECT_EQ(m.modes[2].damping, 0.0);
  EXPECT_TRUE(m.modes[2].shape.empty());
  EXPECT_EQ(m.modes[2].row, 4);
  ASSERT_EQ(m.records.size(), 1u);
  EXPECT_EQ(m.records[0].name, "records/wind.csv");
  EXPECT_EQ(m.records[0].dt, 0.005);
  EXPECT_EQ(m.records[0].channels, (std::vector<std::string>{"a1", "a2", "base_y"}));
  EXPECT_EQ(m.records[0].values.rows(), 120);
  EXPECT_NEAR(m.records[0].values(7, 1), std::sin(2.1 + 2.0), 1e-5);
  EXPECT_TRUE(m.set_aside.empty());
  EXPECT_TRUE(m.remarks.empty());
}

TEST_F(MeasuredFolder, PartsMayBeMissing) {
  write("modes.csv", "mode,period\n1,0.4\n");
  EXPECT_EQ(read().modes.size(), 1u);
  write("sensors.csv", sensors);
  EXPECT_EQ(read().sensors.size(), 3u);
  std::filesystem::remove(folder / "modes.csv");
  write_record(record({"a1"}));
  EXPECT_EQ(read().records.size(), 1u);
  EXPECT_TRUE(read().remarks.empty());
  std::filesystem::remove(folder / "sensors.csv");
  write_record(record({"anything"}));
  ASSERT_EQ(read().remarks.size(), 1u);
  expect_holds(read().remarks[0], "no sensors.csv");
  write("modes.csv", modes);
  std::filesystem::remove_all(folder / "records");
  std::filesystem::create_directory(folder / "records");
  EXPECT_EQ(read().modes.size(), 3u);
}

TEST_F(MeasuredFolder, NothingToUse) {
  expect_holds(test::message_of<InputError>([&] { read_measured(folder / "none"); }),
               "/none: no such folder, expected one with modes.csv or records/*.csv");
  expect_holds(problem(), "found nothing, expected modes.csv or records/*.csv or both");
  expect_holds(problem("sensors.csv", sensors), "found sensors.csv, expected modes.csv");
  std::filesystem::create_directory(folder / "records");
  expect_holds(problem(), "no recording that can be used, and no modes.csv");
  write_record("t,a1\n" + record({"a1"}).substr(5), "wind.txt");
  expect_holds(problem(), "(records/wind.txt: nothing that is read: recordings end in .csv)");
  expect_begins(test::message_of<InputError>([&] { read_measured(folder / "sensors.csv"); }),
                folder / "sensors.csv: no such folder");
}

TEST_F(MeasuredFolder, WrongKindsOfFile) {
  write("modes.csv", modes);
  write("records", "t,a\n");
  expect_begins(problem(), "records: is a file, expected a folder");
  std::filesystem::remove(folder / "records");
  ASSERT_EQ(::mkfifo((folder / "shapes.csv").c_str(), 0600), 0);
  expect_begins(problem(), "shapes.csv: is not an ordinary file");
  std::filesystem::remove(folder / "shapes.csv");
  std::filesystem::create_directory(folder / "sensors.csv");
  expect_begins(problem(), "sensors.csv: is not an ordinary file");
}

TEST_F(MeasuredFolder, StrangersAreReported) {
  write_all();
  write("photo.jpg", "x");
  write("shape.csv", "x");
  write_record("x", "readme.txt");
  const Measured m = read();
  ASSERT_EQ(m.set_aside.size(), 3u);
  EXPECT_EQ(m.set_aside[0].place, "records/readme.txt");
  EXPECT_EQ(m.set_aside[1].place, "photo.jpg");
  EXPECT_EQ(m.set_aside[2].place, "shape.csv");
  expect_holds(m.set_aside[2].what, "did you mean 'shapes.csv'?");
}

TEST_F(MeasuredFolder, ColumnsInAnyOrderAndFormat) {
  write("modes.csv", "mode,period\n1,0.4\n");
  const std::string plain = "id,x,y,z,direction\na 1,1,2,3,x\nb,+4,5e0,.6,0.6;0;0.8\n";
  write("sensors.csv", plain);
  const Measured expected = read();
  ASSERT_EQ(expected.sensors.size(), 2u);
  for (const std::string& text :
       {std::string("\xef\xbb\xbfid,x,y,z,direction\r\na 1,1,2,3,x\r\nb,4,5,0.6,0.6;0;0.8"),
        std::string("# heading\n\n  # more\n id , x,y,z, direction\n\n  a 1 ,1 ,\t2,3,x\n#b,9,9,9,z\nb,4,5,0.6, 0.6; "
                    "0;0.8\n\n"),
        std::string("direction,z,y,x,id\nx,3,2,1,a 1\n\"0.6;0;0.8\",0.6,5,4,\"b\"\n"),
        std::string("id;x;y;z;direction\n\"a 1\";1;2;3;x\nb;4;5;0.6;\"0.6;0;0.8\"\r\n"),
        std::string("\"id\",\"x\",\"y\",\"z\",\"direction\"\n \"a 1\" ,\"1\",2,3,x\nb,4,5,0.6,\"0.6;0;0.8\"\n")}) {
    write("sensors.csv", text);
    expect_same(read(), expected);
  }
  write("sensors.csv", "id,x,y,z,direction\n\"a,\"\"1\"\"\",1,2,3,x\n\"#b\",1,2,3,y\n\" c\",1,2,3,z\n");
  EXPECT_EQ(read().sensors[0].id, "a,\"1\"");
  EXPECT_EQ(read().sensors[1].id, "#b");
  EXPECT_EQ(read().sensors[2].id, " c");
}

TEST_F(MeasuredFolder, FrequenciesBecomePeriods) {
  write("modes.csv", "frequency_std;frequency;mode\n0.1;2.5;T1\n;4;T2\n");
  const Measured m = read();
  EXPECT_EQ(m.modes[0].period, 0.4);
  EXPECT_NEAR(m.modes[0].period_std, 0.1 / 6.25, 1e-16);
  EXPECT_EQ(m.modes[1].period, 0.25);
  EXPECT_EQ(m.modes[1].period_std, 0.0);
  EXPECT_TRUE(m.remarks.empty());
  expect_begins(problem("modes.csv", "mode,period,frequency\n1,0.4,2.5\n"),
                "modes.csv:1: both 'period' and 'frequency'");
  expect_begins(problem("modes.csv", "mode,period,frequency_std\n1,0.4,2.5\n"), "modes.csv:1: 'frequency_std' without");
  expect_begins(problem("modes.csv", "mode,frequency,period_std\n1,0.4,2.5\n"), "modes.csv:1: 'period_std' without");
  expect_begins(problem("modes.csv", "mode\n1\n"), "modes.csv:1: no column 'period' (s), nor 'frequency' (Hz)");
  expect_begins(problem("modes.csv", "mode,frequency\n1,1e-310\n"), "modes.csv:2: frequency is 1e-310 Hz");
}

TEST_F(MeasuredFolder, SuspiciousPeriodsAreRemarked) {
  const auto remarks = [&](const std::string& text) {
    write("modes.csv", text);
    const Measured m = read();
    return m.remarks.empty() ? "" : m.remarks[0];
  };
  expect_holds(remarks("mode,period\n1,5.5\n2,7\n"), "look like frequencies");
  expect_holds(remarks("mode,period\n1,2.5\n2,4\n3,4.1\n"), "look like frequencies");
  expect_holds(remarks("mode,frequency\n1,0.11\n2,0.1\n"), "look like periods");
  EXPECT_EQ(remarks("mode,period\n1,5.5\n2,3\n"), "");
  EXPECT_EQ(remarks(modes), "");
}

TEST_F(MeasuredFolder, WrongTables) {
  write("modes.csv", modes);
  const auto sensor = [&](const std::string& row) { return problem("sensors.csv", "id,x,y,z,direction\n" + row); };
  expect_begins(problem("sensors.csv", ""), "sensors.csv:1: the file is empty");
  expect_begins(problem("sensors.csv", "# x\n\nid,x,y,z,direction\n"), "sensors.csv:3: no rows below the heading");
  expect_begins(problem("sensors.csv", "id,x,y,z,directon\na,0,0,0,x\n"),
                "sensors.csv:1: unknown column 'directon': did you mean 'direction'?");
  expect_begins(problem("sensors.csv", "id,x,y,z\na,0,0,0\n"),
                "sensors.csv:1: no column 'direction', expected: id, x, y, z, direction");
  expect_begins(problem("sensors.csv", "id,x,x,y,z,direction\n"), "sensors.csv:1: column 'x' is there twice");
  expect_begins(problem("sensors.csv", "id,x,y,z,direction,\n"), "sensors.csv:1: column 6 has no name");
  expect_begins(problem("sensors.csv", "id\tx\ty\tz\tdirection\n"), "sensors.csv:1: a tab in the name of a column");
  expect_begins(
      problem("sensors.csv", "id;x;y;z;direction\na;0;0;0;1;0;0\n"),
      "sensors.csv:2: 7 cells, expected 5 as in the heading: numbers take a decimal point, texts with ';' in");
  expect_begins(sensor("a,0,0,0,x\nb,0,0,1\n"), "sensors.csv:3: 4 cells, expected 5");
  expect_begins(sensor("a,0,0,0,x\nb,0,5,0,0,1,x\n"), "sensors.csv:3: 7 cells, expected 5");
  expect_begins(sensor("a,0,0,0,\n"), "sensors.csv:2: the cell in column 'direction' is empty");
  expect_begins(sensor(",0,0,0,x\n"), "sensors.csv:2: the cell in column 'id' is empty");
  expect_begins(sensor("a,0,,0,x\n"), "sensors.csv:2: the cell in column 'y' is empty, expected a number");
  expect_begins(sensor("a,0,1m,0,x\n"), "sensors.csv:2: '1m' in column 'y' is not a number");
  expect_begins(sensor("a,0,\"1,5\",0,x\n"),
                "sensors.csv:2: '1,5' in column 'y' is not a number: write a decimal point, not a comma");
  expect_begins(sensor("a,0,+-1,0,x\n"), "sensors.csv:2: '+-1' in column 'y' is not a number");
  expect_begins(sensor("a,0,nan,0,x\n"), "sensors.csv:2: 'nan' in column 'y' is not a finite number");
  expect_begins(sensor("a,0,1e999,0,x\n"), "sensors.csv:2: '1e999' in column 'y' is beyond what numbers can hold");
  expect_begins(sensor("a,0,\"1,0,x\n"), "sensors.csv:2: a quoted cell does not end on its line");
  expect_begins(sensor("a,0,\"1\"2,0,x\n"), "sensors.csv:2: text after the closing quote of \"1\", expected ','");
  expect_begins(sensor("\xe4,0,1,0,x\n"), "sensors.csv:2: byte 0xe4 where UTF-8 text is expected");
  expect_begins(sensor("a\rb,0,1,0,x\n"), "sensors.csv:2: byte 0x0d");
  expect_begins(problem("sensors.csv", std::string("i\0d\0", 4)), "sensors.csv:1: byte 0x00");
  EXPECT_EQ(sensor("\xc3\xa4,0,1,0,x\n"), "");
}

TEST_F(MeasuredFolder, ContradictorySensors) {
  write("modes.csv", modes);
  const auto sensor = [&](const std::string& row) { return problem("sensors.csv", "id,x,y,z,direction\n" + row); };
  expect_begins(sensor("a,0,0,0,x\n\na,0,0,1,x\n"), "sensors.csv:4: sensor 'a' is already in row 2");
  expect_begins(sensor("a,0,0,0,x\nb,0,0,0,x\n"),
                "sensors.csv:3: sensor 'b' has the place and the axis of the one in row 2");
  expect_begins(sensor("a,0,0,0,x\nb,0,0,-0,-x\n"), "sensors.csv:3: sensor 'b' has the place");
  EXPECT_EQ(sensor("a,0,0,0,x\nb,0,0,0,y\nc,0,0,1,y\n"), "");
  expect_begins(sensor("a,0,0,0,up\n"), "sensors.csv:2: direction 'up': expected x, y, z, -x, -y, -z or a unit vector");
  expect_begins(sensor("a,0,0,0,1;0\n"), "sensors.csv:2: direction '1;0'");
  expect_begins(sensor("a,0,0,0,1;0;0;0\n"), "sensors.csv:2: direction '1;0;0;0'");
  expect_begins(sensor("a,0,0,0,1;1;0\n"), "sensors.csv:2: direction '1;1;0' has the length 1.414");
  expect_begins(sensor("a,0,0,0,0;0;0\n"), "sensors.csv:2: direction '0;0;0' has the length 0");
  EXPECT_EQ(sensor("a,0,0,0,1.009;0;0\n"), "");
  EXPECT_EQ(read().sensors[0].direction, Vec3(1, 0, 0));
  expect_begins(sensor("t,0,0,0,x\n"), "sensors.csv:2: a sensor may not be named 't'");
  expect_begins(sensor("base_x,0,0,0,x\n"), "sensors.csv:2: a sensor may not be named 'base_x'");
}

TEST_F(MeasuredFolder, ContradictoryModes) {
  const auto mode = [&](const std::string& row) {
    return problem("modes.csv", "mode,period,period_std,damping,damping_std,direction\n" + row);
  };
  expect_begins(mode("1,0.4,,,,\n2,0.3,,,,\n1,0.3,,,,\n"), "modes.csv:4: mode '1' is already in row 2");
  expect_begins(mode("1,0,,,,\n"), "modes.csv:2: period is 0 s: must be above 0");
  expect_begins(mode("1,-0.4,,,,\n"), "modes.csv:2: period is -0.4 s: must be above 0");
  expect_begins(mode("1,nan,,,,\n"), "modes.csv:2: 'nan' in column 'period'");
  expect_begins(mode("1,inf,,,,\n"), "modes.csv:2: 'inf' in column 'period'");
  expect_begins(mode("1,,,,,\n"), "modes.csv:2: the cell in column 'period' is empty");
  expect_begins(mode(",0.4,,,,\n"), "modes.csv:2: the cell in column 'mode' is empty");
  expect_begins(mode("1,0.4,-0.1,,,\n"), "modes.csv:2: period_std is -0.1: a standard deviation must be 0 or more");
  expect_begins(mode("1,0.4,,1,,\n"), "modes.csv:2: damping is 1: must be from 0 to below 1");
  expect_begins(mode("1,0.4,,-0.01,,\n"), "modes.csv:2: damping is -0.01");
  expect_begins(mode("1,0.4,,0.01,-1,\n"), "modes.csv:2: damping_std is -1");
  expect_begins(mode("1,0.4,,,0.01,\n"), "modes.csv:2: damping_std is 0.01, but there is no damping");
  expect_begins(mode("1,0.4,,,,tranverse\n"), "modes.csv:2: direction 'tranverse': did you mean 'transverse'?");
  expect_begins(mode("1,0.4,,,,up\n"), "modes.csv:2: direction 'up': expected one of: longitudinal");
}

TEST_F(MeasuredFolder, ContradictoryShapes) {
  expect_begins((write("modes.csv", modes), problem("shapes.csv", shapes)), "shapes.csv:1: shapes, but no sensors.csv");
  std::filesystem::remove(folder / "modes.csv");
  write("sensors.csv", sensors);
  write_record(record({"a1"}));
  expect_begins(problem(), "shapes.csv:1: shapes, but no modes.csv");
  write("modes.csv", modes);
  const auto shape = [&](const std::string& row) { return problem("shapes.csv", "mode,sensor,value,std\n" + row); };
  expect_begins(shape("TT3,a1,1,\n"), "shapes.csv:2: mode 'TT3' is not in modes.csv: did you mean 'T3'?");
  expect_begins(shape("1,a1,1,\n1,b7,1,\n"),
                "shapes.csv:3: sensor 'b7' is not in sensors.csv: expected one of: a1, a2, a3");
  expect_begins(shape("1,a1,1,\n1,a4,1,\n"), "shapes.csv:3: sensor 'a4' is not in sensors.csv: did you mean 'a1'?");
  expect_begins(shape("1,a1,1,\n1,a2,1,\n1,a1,1,\n"), "shapes.csv:4: sensor 'a1' of mode '1' is already in row 2");
  expect_begins(shape("1,a1,,\n"), "shapes.csv:2: the cell in column 'value' is empty");
  expect_begins(shape("1,a1,1,-1\n"), "shapes.csv:2: std is -1");
  expect_begins(shape("1,a1,inf,1\n"), "shapes.csv:2: 'inf' in column 'value'");
}

TEST_F(MeasuredFolder, EmptyShapesAreSetAside) {
  write("sensors.csv", sensors);
  write("modes.csv", modes);
  write("shapes.csv", "sensor,mode,value\na1,1,1\na1,2,0\na2,2,0\na2,T3,1\na3,T3,0\n");
  const Measured m = read();
  ASSERT_EQ(m.set_aside.size(), 2u);
  EXPECT_EQ(m.set_aside[0].place, "shapes.csv:2");
  EXPECT_EQ(m.set_aside[0].what, "the shape of mode '1' has 1 sensor, needs 2");
  EXPECT_EQ(m.set_aside[1].place, "shapes.csv:3");
  EXPECT_EQ(m.set_aside[1].what, "the shape of mode '2' has nothing but zeros");
  EXPECT_TRUE(m.modes[0].shape.empty());
  EXPECT_TRUE(m.modes[1].shape.empty());
  EXPECT_EQ(m.modes[2].shape.size(), 2u);
}

TEST_F(MeasuredFolder, About) {
  write("modes.csv", modes);
  expect_begins(problem("about.toml", "what = \"x\"\nunits = \"g\"\n"),
                "about.toml:2: 'units' in the file is \"g\": expected \"SI\"");
  expect_begins(problem("about.toml", "what = 3\n"), "about.toml:1: 'what' in the file is a number, expected text");
  expect_begins(problem("about.toml", "what = \"x\n"), "about.toml:1: not valid TOML");
  EXPECT_EQ(problem("about.toml", ""), "");
}

TEST_F(MeasuredFolder, AboutHoldsWhatPeopleLike) {
  write("modes.csv", modes);
  write("about.toml",
        "what = \"a bridge\"\nnote = \"windy\"\nwhen = 2021-05-03\nteam = [\"A\", \"B\"]\n[weather]\nwind = 3.0\n");
  const Measured m = read();
  EXPECT_EQ(m.what, "a bridge");
  EXPECT_EQ(m.when, "2021-05-03");
  EXPECT_EQ(m.notes, "");
  ASSERT_EQ(m.set_aside.size(), 2u);
  EXPECT_EQ(m.set_aside[0].place, "about.toml:2");
  EXPECT_EQ(m.set_aside[0].what, "key 'note' is not read: did you mean 'notes'?");
  EXPECT_EQ(m.set_aside[1].place, "about.toml");
  EXPECT_EQ(m.set_aside[1].what, "kept there and not read: team, weather");
}

TEST_F(MeasuredFolder, RecordsInAnyOrderOfColumns) {
  write("sensors.csv", sensors);
  std::string text = "\xef\xbb\xbf# logger 7\r\n\"a3\"; t ;a1\r\n";
  for (int i = 0; i < 100; ++i) text += fmt::format("{};\"{}\"; {} \r\n# x\r\n", i % 7, 5.0 + 0.01 * i, -i);
  write_record(text);
  const Measured m = read();
  EXPECT_EQ(m.records[0].channels, (std::vector<std::string>{"a3", "a1"}));
  EXPECT_NEAR(m.records[0].dt, 0.01, 1e-15);
  EXPECT_EQ(m.records[0].values.rows(), 100);
  EXPECT_EQ(m.records[0].values(99, 0), 1.0);
  EXPECT_EQ(m.records[0].values(99, 1), -99.0);
}

TEST_F(MeasuredFolder, RecordsAreInTheOrderOfTheirNames) {
  for (const char* name : {"c.csv", "a.csv", "b.csv"}) write_record(record({"a1"}), name);
  const Measured m = read();
  ASSERT_EQ(m.records.size(), 3u);
  EXPECT_EQ(m.records[0].name, "records/a.csv");
  EXPECT_EQ(m.records[2].name, "records/c.csv");
}

TEST_F(MeasuredFolder, WrongRecords) {
  write("sensors.csv", sensors);
  const std::string good = record({"a1", "a2"});
  EXPECT_EQ(record_problem(good), "");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return record_problem(text.replace(text.find(from), from.size(), to));
  };
  expect_begins(with("a2", "a9"),
                "records/wind.csv:1: channel 'a9' is neither a sensor of sensors.csv nor the ground's motion: did "
                "you mean 'a1'?");
  expect_begins(with("a2", "base_w"),
                "records/wind.csv:1: channel 'base_w' is neither a sensor of sensors.csv nor the "
                "ground's motion: did you mean 'base_x'?");
  expect_begins(with("a2", "a1"), "records/wind.csv:1: column 'a1' is there twice");
  expect_begins(with("t,", "time,"), "records/wind.csv:1: no column 't'");
  expect_begins(record_problem("t\n0\n"), "records/wind.csv:1: no channels");
  expect_begins(record_problem(""), "records/wind.csv:1: the file is empty");
  expect_begins(with("\n0.015000,", "\n0.015000,1,"), "records/wind.csv:5: 4 cells, expected 3");
  expect_begins(with("\n0.015000,", "\n0.015000 "), "records/wind.csv:5: ");
  expect_begins(with("\n0.015000,", "\n0.015000,nan\n#"),
                "records/wind.csv:5: 'nan' in column 'a1' is not a finite number; fill");
  expect_begins(with("\n0.015000,", "\n0.015000,,1\n#"),
                "records/wind.csv:5: the cell in column 'a1' is empty, expected a number; fill");
  expect_begins(with("\n0.015000,", "\n0.015000,1\n#"), "records/wind.csv:5: 2 cells, expected 3");
  expect_begins(with("\n0.015000,", "\n0.017000,"), "records/wind.csv:5: time step 0.007 s, elsewhere 0.005 s");
  expect_begins(with("\n0.015000,", "\n0.010000,"),
                "records/wind.csv:5: time 0.01 s after 0.01 s: times must increase");
  expect_begins(with("\n0.015000,", "\n#"), "records/wind.csv:6: time step 0.01 s, elsewhere 0.005 s");
  EXPECT_EQ(with("\n0.015000,", "\n0.0150005,"), "");
  expect_begins(record_problem(record({"a1"}, 99)),
                "records/wind.csv:100: the recording ends after 99 samples, expected at least 100");
  EXPECT_EQ(record_problem(record({"a1"}, 100)), "");
}

TEST_F(MeasuredFolder, ALongGapIsFoundWhereItIs) {
  std::string text = "t,a1\n";
  for (int i = 0; i < 200; ++i) text += fmt::format("{:.3f},{}\n", 0.01 * i + (i < 150 ? 0.0 : 1000.0), i % 3);
  expect_begins(record_problem(text), "records/wind.csv:152: time step 1000.01 s, elsewhere 0.01 s");
}

TEST_F(MeasuredFolder, ASlowlyChangingRateIsRefused) {
  std::string text = "t,a1\n";
  double t = 0.0;
  for (int i = 0; i < 40000; ++i, t += i < 20000 ? 0.001 : 0.0010015) text += fmt::format("{:.9f},{}\n", t, i % 3);
  expect_holds(record_problem(text), "the sampling rate changes");
}

TEST_F(MeasuredFolder, ConstantChannelsAreSetAside) {
  write("sensors.csv", sensors);
  write_record("t,a1,a2,a3\n", "wind.csv");
  std::string text = "# x\nt,a1,a2,a3\n";
  for (int i = 0; i < 100; ++i) text += fmt::format("{},0,{},2.5\n", 0.01 * i, i % 5);
  write_record(text);
  const Measured m = read();
  ASSERT_EQ(m.set_aside.size(), 2u);
  EXPECT_EQ(m.set_aside[0].place, "records/wind.csv:2");
  EXPECT_EQ(m.set_aside[0].what, "channel 'a1' is 0 throughout");
  EXPECT_EQ(m.set_aside[1].what, "channel 'a3' is 2.5 throughout");
  ASSERT_EQ(m.records[0].channels, (std::vector<std::string>{"a2"}));
  ASSERT_EQ(m.records[0].values.cols(), 1);
  EXPECT_EQ(m.records[0].values(3, 0), 3.0);
  text = "t,a1\n";
  for (int i = 0; i < 100; ++i) text += fmt::format("{},0\n", 0.01 * i);
  expect_holds(record_problem(text), "(records/wind.csv:1: no channel of the recording is left)");
}

TEST_F(MeasuredFolder, SuspiciousUnitsAreRemarked) {
  std::string text = "t,a1\n";
  for (int i = 0; i < 100; ++i) text += fmt::format("{},{}\n", 5 * i, i * 10);
  write_record(text);
  const Measured m = read();
  ASSERT_EQ(m.remarks.size(), 3u);
  expect_begins(m.remarks[0], "records/wind.csv: a sample every 5 s");
  expect_begins(m.remarks[1], "records/wind.csv: accelerations up to 990 look like another unit");
}

TEST_F(MeasuredFolder, LongWordsMakeShortMessages) {
  write("modes.csv", modes);
  const std::string message = problem("sensors.csv", std::string(300000, 'x') + "\n1\n");
  EXPECT_LT(message.size(), 300u);
  std::string many = "id,x,y,z,direction\n";
  for (int i = 0; i < 3000; ++i) many += fmt::format("sensor{0},{0},0,0,x\n", i);
  write("sensors.csv", many);
  EXPECT_LT(problem("shapes.csv", "mode,sensor,value\n1,q,1\n").size(), 600u);
}

Measured difficult() {
  Measured m;
  m.what = "a \"quoted\" \\ bridge\nof two lines\t\x01\u00e4";
  m.notes = "'''";
  m.sensors = {{"a,1", Vec3(1.0 / 3.0, -0.0, 1e-300), Vec3(0, -1, 0), 2},
               {"#2", Vec3(1e17, 0.1, 0.2), Vec3(1.0 / 3.0, 2.0 / 3.0, -2.0 / 3.0), 3},
               {" q\"; ", Vec3(0, 0, 0), Vec3(0.6, 0, 0.8).normalized(), 4}};
  m.modes = {{"T 1", 0.1 + 0.2, 1e-5 / 3.0, 0.0, 0.01, "vertical", {{2, 1.0 / 7.0, 0.1}, {0, -5e-324, 0.0}}, 2},
             {"\"", std::sqrt(2.0), 0.0, std::nullopt, 0.0, "", {}, 3}};
  for (const double dt : {0.1, 1.0 / 128.0, 1.0 / 300.0, 0.0049}) {
    Recording r;
    r.name = fmt::format("records/r{}.csv", m.records.size());
    r.dt = dt;
    r.channels = {"a,1", "base_z", " q\"; "};
    r.values = Eigen::MatrixXd(333, 3);
    for (Eigen::Index i = 0; i < r.values.size(); ++i)
      r.values(i) = std::sin(double(i)) * std::pow(10.0, double(i % 30) - 29.0);
    m.records.push_back(r);
  }
  return m;
}

TEST_F(MeasuredFolder, RoundTripIsExact) {
  const Measured m = difficult();
  write_measured(m, folder / "new/one");
  expect_same(read_measured(folder / "new/one"), m);
  write_measured(read_measured(folder / "new/one"), folder / "two");
  for (const char* name : {"about.toml", "sensors.csv", "modes.csv", "shapes.csv", "records/r1.csv"})
    EXPECT_EQ(test::bytes_of(folder / (std::string("two/") + name)),
              test::bytes_of(folder / (std::string("new/one/") + name)));
  write_all();
  write_measured(read(), folder / "three");
  expect_same(read_measured(folder / "three"), read());
}

TEST_F(MeasuredFolder, ReadDirectionsAreWrittenAsTheyAre) {
  write("modes.csv", modes);
  std::string text = "id,x,y,z,direction\n";
  for (int i = 0; i < 200; ++i)
    text += fmt::format("s{},{},0,0,{:.3f};{:.3f};{:.3f}\n", i, i, std::cos(i) * std::cos(2 * i),
                        std::sin(i) * std::cos(2 * i), std::sin(2 * i));
  write("sensors.csv", text);
  write_measured(read(), folder / "two");
  expect_same(read_measured(folder / "two"), read());
}

TEST_F(MeasuredFolder, WritesNothingThatCannotBeRead) {
  const auto refused = [&](const Measured& m) {
    const std::string message = test::message_of<InputError>([&] { write_measured(m, folder / "new"); });
    EXPECT_FALSE(std::filesystem::exists(folder / "new"));
    return message;
  };
  expect_holds(refused(Measured{}), "neither modes nor recordings");
  Measured m = difficult();
  m.modes[1].period = NAN;
  expect_holds(refused(m), "modes.csv:3: 'nan' in column 'period'");
  m = difficult();
  m.sensors[0].id = "two\nlines";
  expect_holds(refused(m), "sensors.csv:2: ");
  m = difficult();
  m.records[2].name = "elsewhere/r1.csv";
  expect_holds(refused(m), "records/r1.csv: two recordings of this name");
  m.records[2].name = "records/..";
  expect_holds(refused(m), "expected a name for its file");
  m = difficult();
  m.records[0].channels[1] = "other";
  expect_holds(refused(m), "records/r0.csv:1: channel 'other'");
}

TEST_F(MeasuredFolder, OldFilesAreNotMixedWithNewOnes) {
  write_all();
  Measured m = read();
  write_measured(m, folder.path());
  expect_same(read(), m);
  m.records[0].name = "other.csv";
  expect_holds(test::message_of<InputError>([&] { write_measured(m, folder.path()); }),
               "records/wind.csv: is there from before");
  m = read();
  for (MeasuredMode& mode : m.modes) mode.shape.clear();
  expect_holds(test::message_of<InputError>([&] { write_measured(m, folder.path()); }),
               "shapes.csv: is there from before");
}

TEST_F(MeasuredFolder, TruncatedAnywhere) {
  write_all();
  write_record(short_record());
  for (const char* name : {"sensors.csv", "modes.csv", "shapes.csv", "about.toml", "records/wind.csv"}) {
    const std::string whole = test::bytes_of(folder / name);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      test::set_bytes(folder / name, whole.substr(0, size));
      EXPECT_NO_THROW({
        try {
          read();
        } catch (const InputError& error) {
          EXPECT_NE(std::string(error.what()).find(folder.path()), std::string::npos) << error.what();
        }
      }) << name
         << " of " << size << " bytes";
    }
    test::set_bytes(folder / name, whole);
  }
}

TEST_F(MeasuredFolder, DamagedAnywhere) {
  write_all();
  write_record(short_record());
  for (const char* name : {"sensors.csv", "modes.csv", "shapes.csv", "about.toml", "records/wind.csv"}) {
    const std::string whole = test::bytes_of(folder / name);
    for (std::size_t at = 0; at < std::min<std::size_t>(whole.size(), 150); ++at)
      for (const char c : {",\n\0"[at % 3], "\";#e\xff"[at % 5]}) {
        std::string text = whole;
        text[at] = c;
        test::set_bytes(folder / name, text);
        EXPECT_NO_THROW({
          try {
            read();
          } catch (const InputError&) {
          }
        }) << name
           << " byte " << at;
      }
    test::set_bytes(folder / name, whole);
  }
}

/// Blocks of 1 m side by side along x.
Assembly row_of_blocks(int count) {
  Assembly assembly;
  assembly.materials.push_back({"stone", 2000.0, 1e9, 4e8, 0.0, 0.0, 0.0});
  for (int i = 0; i < count; ++i) {
    Block block;
    block.cells = {make_box(Vec3(i, 0, 0), Vec3(i + 1, 1, 1))};
    assembly.blocks.push_back(block);
  }
  finish_blocks(assembly);
  return assembly;
}

TEST(PlaceSensors, FindsTheBlockThatHoldsEach) {
  Measured m;
  m.directory = "measured";
  m.sensors = {{"a", Vec3(2.5, 0.5, 1.04), Vec3::UnitX(), 2},
               {"b", Vec3(1.0, 0.5, 0.5), Vec3::UnitX(), 3},
               {"c", Vec3(0.5, 0.5, 0.5), Vec3::UnitX(), 4}};
  const Assembly assembly = row_of_blocks(3);
  EXPECT_EQ(place_sensors(m, assembly), (std::vector<std::int64_t>{2, 0, 0}));
  Assembly attached = assembly;
  for (const MeasuredSensor& s : m.sensors) attach_sensors(attached, {{s.id, s.position, s.direction}});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(attached.sensors[i].block, place_sensors(m, assembly)[i]);
  m.sensors[1].position = Vec3(2.95, 0.5, 1.8);
  const std::string message = test::message_of<InputError>([&] { place_sensors(m, assembly); });
  expect_begins(message,
                "measured/sensors.csv:3: sensor 'b' at (2.95, 0.5, 1.8) m lies 0.8 m from the nearest, block 2 (");
  expect_holds(message, "from (2, 0, 0) to (3, 1, 1) m: expected within 0.5 m of a block; correct its place");
  expect_holds(test::message_of<InputError>([&] { place_sensors(m, Assembly{}); }), "there is no block");
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
