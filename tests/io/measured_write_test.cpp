// Field measurements written and read again, cut short and damaged.
#include "tests/io/measured_folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using namespace test;

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
      r.values(i) = std::sin(double(i) + double(m.records.size())) * std::pow(10.0, double(i % 30) - 29.0);
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
  expect_holds(refused(m), "records/r1.csv: two recordings have this name");
  m.records[2].name = "records/..";
  expect_holds(refused(m), "has no name for its file");
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
               "records/wind.csv: this old file would be mixed");
  m = read();
  for (MeasuredMode& mode : m.modes) mode.shape.clear();
  expect_holds(test::message_of<InputError>([&] { write_measured(m, folder.path()); }),
               "shapes.csv: this old file would be mixed");
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
}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
