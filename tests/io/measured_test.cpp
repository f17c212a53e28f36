// Tables of field measurements: every layout, what is refused, what is set aside, and which block a sensor is on.
#include "io/case/case.h"
#include "tests/io/measured_folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using namespace test;

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
               "/none: there is no such folder. Give a folder with modes.csv or records/*.csv");
  expect_holds(problem(), "the folder has nothing. It must have modes.csv or records/*.csv or both");
  expect_holds(problem("sensors.csv", sensors), "the folder has sensors.csv. It must have modes.csv");
  std::filesystem::create_directory(folder / "records");
  expect_holds(problem(), "there is no usable recording and no modes.csv");
  write_record("t,a1\n" + record({"a1"}).substr(5), "wind.txt");
  expect_holds(problem(), "(records/wind.txt: not read: names of recordings end in .csv)");
  expect_begins(test::message_of<InputError>([&] { read_measured(folder / "sensors.csv"); }),
                folder / "sensors.csv: there is no such folder");
}

TEST_F(MeasuredFolder, WrongKindsOfFile) {
  write("modes.csv", modes);
  write("records", "t,a\n");
  expect_begins(problem(), "records: is a file. It must be a folder");
  std::filesystem::remove(folder / "records");
  ASSERT_EQ(::mkfifo((folder / "shapes.csv").c_str(), 0600), 0);
  expect_begins(problem(), "shapes.csv: is not a text file");
  std::filesystem::remove(folder / "shapes.csv");
  std::filesystem::create_directory(folder / "sensors.csv");
  expect_begins(problem(), "sensors.csv: is not a text file");
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
                "modes.csv:1: the table has both 'period' and 'frequency'");
  expect_begins(problem("modes.csv", "mode,period,frequency_std\n1,0.4,2.5\n"),
                "modes.csv:1: the table has 'frequency_std' but not 'frequency'");
  expect_begins(problem("modes.csv", "mode,frequency,period_std\n1,0.4,2.5\n"),
                "modes.csv:1: the table has 'period_std' but not 'period'");
  expect_begins(problem("modes.csv", "mode\n1\n"),
                "modes.csv:1: the table has neither a column 'period' (s) nor a column 'frequency' (Hz)");
  expect_begins(problem("modes.csv", "mode,frequency\n1,1e-310\n"), "modes.csv:2: frequency is 1e-310 Hz");
}

TEST_F(MeasuredFolder, SuspiciousPeriodsAreRemarked) {
  const auto remarks = [&](const std::string& text) {
    write("modes.csv", text);
    const Measured m = read();
    return m.remarks.empty() ? "" : m.remarks[0];
  };
  expect_holds(remarks("mode,period\n1,5.5\n2,7\n"), "If they are frequencies");
  expect_holds(remarks("mode,period\n1,2.5\n2,4\n3,4.1\n"), "If they are frequencies");
  expect_holds(remarks("mode,frequency\n1,0.11\n2,0.1\n"), "If they are periods");
  EXPECT_EQ(remarks("mode,period\n1,5.5\n2,3\n"), "");
  EXPECT_EQ(remarks(modes), "");
}

TEST_F(MeasuredFolder, WrongTables) {
  write("modes.csv", modes);
  const auto sensor = [&](const std::string& row) { return problem("sensors.csv", "id,x,y,z,direction\n" + row); };
  expect_begins(problem("sensors.csv", ""), "sensors.csv:1: the file is empty");
  expect_begins(problem("sensors.csv", "# x\n\nid,x,y,z,direction\n"),
                "sensors.csv:3: there are no rows below the heading");
  expect_begins(problem("sensors.csv", "id,x,y,z,directon\na,0,0,0,x\n"),
                "sensors.csv:1: unknown column 'directon': did you mean 'direction'?");
  expect_begins(problem("sensors.csv", "id,x,y,z\na,0,0,0\n"),
                "sensors.csv:1: the column 'direction' is missing; the required columns are: id, x, y, z, direction");
  expect_begins(problem("sensors.csv", "id,x,x,y,z,direction\n"), "sensors.csv:1: two columns have the name 'x'");
  expect_begins(problem("sensors.csv", "id,x,y,z,direction,\n"), "sensors.csv:1: column 6 has no name");
  expect_begins(problem("sensors.csv", "id\tx\ty\tz\tdirection\n"),
                "sensors.csv:1: the name of a column contains a tab");
  expect_begins(problem("sensors.csv", "id;x;y;z;direction\na;0;0;0;1;0;0\n"),
                "sensors.csv:2: the row has 7 cells, the heading has 5. Write numbers with a decimal point, and put "
                "text that contains ';' in");
  expect_begins(sensor("a,0,0,0,x\nb,0,0,1\n"), "sensors.csv:3: the row has 4 cells, the heading has 5");
  expect_begins(sensor("a,0,0,0,x\nb,0,5,0,0,1,x\n"), "sensors.csv:3: the row has 7 cells, the heading has 5");
  expect_begins(sensor("a,0,0,0,\n"), "sensors.csv:2: the cell in column 'direction' is empty");
  expect_begins(sensor(",0,0,0,x\n"), "sensors.csv:2: the cell in column 'id' is empty");
  expect_begins(sensor("a,0,,0,x\n"), "sensors.csv:2: the cell in column 'y' is empty, but a number is needed");
  expect_begins(sensor("a,0,1m,0,x\n"), "sensors.csv:2: '1m' in column 'y' is not a number");
  expect_begins(sensor("a,0,\"1,5\",0,x\n"),
                "sensors.csv:2: '1,5' in column 'y' is not a number: write a decimal point, not a comma");
  expect_begins(sensor("a,0,+-1,0,x\n"), "sensors.csv:2: '+-1' in column 'y' is not a number");
  expect_begins(sensor("a,0,nan,0,x\n"), "sensors.csv:2: 'nan' in column 'y' is not a finite number");
  expect_begins(sensor("a,0,1e999,0,x\n"), "sensors.csv:2: '1e999' in column 'y' is outside the range of numbers");
  expect_begins(sensor("a,0,\"1,0,x\n"), "sensors.csv:2: a quoted cell does not end on its line");
  expect_begins(sensor("a,0,\"1\"2,0,x\n"),
                "sensors.csv:2: there is text after the closing quote of \"1\", where ',' is expected");
  expect_begins(sensor("\xe4,0,1,0,x\n"), "sensors.csv:2: byte 0xe4 is not UTF-8 text");
  expect_begins(sensor("a\rb,0,1,0,x\n"), "sensors.csv:2: byte 0x0d");
  expect_begins(problem("sensors.csv", std::string("i\0d\0", 4)), "sensors.csv:1: byte 0x00");
  EXPECT_EQ(sensor("\xc3\xa4,0,1,0,x\n"), "");
}

TEST_F(MeasuredFolder, ContradictorySensors) {
  write("modes.csv", modes);
  const auto sensor = [&](const std::string& row) { return problem("sensors.csv", "id,x,y,z,direction\n" + row); };
  expect_begins(sensor("a,0,0,0,x\n\na,0,0,1,x\n"), "sensors.csv:4: sensor 'a' is already in row 2");
  expect_begins(sensor("a,0,0,0,x\nb,0,0,0,x\n"),
                "sensors.csv:3: sensor 'b' has the same place and axis as the one in row 2");
  expect_begins(sensor("a,0,0,0,x\nb,0,0,-0,-x\n"), "sensors.csv:3: sensor 'b' has the same place");
  EXPECT_EQ(sensor("a,0,0,0,x\nb,0,0,0,y\nc,0,0,1,y\n"), "");
  expect_begins(sensor("a,0,0,0,up\n"),
                "sensors.csv:2: direction is 'up'. It must be x, y, z, -x, -y, -z or a unit vector");
  expect_begins(sensor("a,0,0,0,1;0\n"), "sensors.csv:2: direction is '1;0'");
  expect_begins(sensor("a,0,0,0,1;0;0;0\n"), "sensors.csv:2: direction is '1;0;0;0'");
  expect_begins(sensor("a,0,0,0,1;1;0\n"), "sensors.csv:2: direction '1;1;0' has the length 1.414");
  expect_begins(sensor("a,0,0,0,0;0;0\n"), "sensors.csv:2: direction '0;0;0' has the length 0");
  EXPECT_EQ(sensor("a,0,0,0,1.009;0;0\n"), "");
  EXPECT_EQ(read().sensors[0].direction, Vec3(1, 0, 0));
  expect_begins(sensor("t,0,0,0,x\n"), "sensors.csv:2: a sensor has the name 't'");
  expect_begins(sensor("base_x,0,0,0,x\n"), "sensors.csv:2: a sensor has the name 'base_x'");
}

TEST_F(MeasuredFolder, ContradictoryModes) {
  const auto mode = [&](const std::string& row) {
    return problem("modes.csv", "mode,period,period_std,damping,damping_std,direction\n" + row);
  };
  expect_begins(mode("1,0.4,,,,\n2,0.3,,,,\n1,0.3,,,,\n"), "modes.csv:4: mode '1' is already in row 2");
  expect_begins(mode("1,0,,,,\n"), "modes.csv:2: period is 0 s. It must be above 0");
  expect_begins(mode("1,-0.4,,,,\n"), "modes.csv:2: period is -0.4 s. It must be above 0");
  expect_begins(mode("1,nan,,,,\n"), "modes.csv:2: 'nan' in column 'period'");
  expect_begins(mode("1,inf,,,,\n"), "modes.csv:2: 'inf' in column 'period'");
  expect_begins(mode("1,,,,,\n"), "modes.csv:2: the cell in column 'period' is empty");
  expect_begins(mode(",0.4,,,,\n"), "modes.csv:2: the cell in column 'mode' is empty");
  expect_begins(mode("1,0.4,-0.1,,,\n"), "modes.csv:2: period_std is -0.1. A standard deviation must be 0 or more");
  expect_begins(mode("1,0.4,,1,,\n"), "modes.csv:2: damping is 1. It must be at least 0 and below 1");
  expect_begins(mode("1,0.4,,-0.01,,\n"), "modes.csv:2: damping is -0.01");
  expect_begins(mode("1,0.4,,0.01,-1,\n"), "modes.csv:2: damping_std is -1");
  expect_begins(mode("1,0.4,,,0.01,\n"), "modes.csv:2: damping_std is 0.01, but there is no damping");
  expect_begins(mode("1,0.4,,,,tranverse\n"), "modes.csv:2: direction 'tranverse': did you mean 'transverse'?");
  expect_begins(mode("1,0.4,,,,up\n"), "modes.csv:2: direction 'up': expected one of: longitudinal");
}

TEST_F(MeasuredFolder, ContradictoryShapes) {
  expect_begins((write("modes.csv", modes), problem("shapes.csv", shapes)),
                "shapes.csv:1: there are shapes, but no sensors.csv");
  std::filesystem::remove(folder / "modes.csv");
  write("sensors.csv", sensors);
  write_record(record({"a1"}));
  expect_begins(problem(), "shapes.csv:1: there are shapes, but no modes.csv");
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
  EXPECT_EQ(m.set_aside[0].what, "the shape of mode '1' has 1 sensor; at least 2 are needed");
  EXPECT_EQ(m.set_aside[1].place, "shapes.csv:3");
  EXPECT_EQ(m.set_aside[1].what, "the shape of mode '2' has only zeros");
  EXPECT_TRUE(m.modes[0].shape.empty());
  EXPECT_TRUE(m.modes[1].shape.empty());
  EXPECT_EQ(m.modes[2].shape.size(), 2u);
}

TEST_F(MeasuredFolder, About) {
  write("modes.csv", modes);
  expect_begins(problem("about.toml", "what = \"x\"\nunits = \"g\"\n"),
                "about.toml:2: 'units' in the file is \"g\". It must be \"SI\"");
  expect_begins(problem("about.toml", "what = 3\n"), "about.toml:1: 'what' in the file is a number. It must be text");
  expect_begins(problem("about.toml", "what = \"x\n"), "about.toml:1: not valid TOML");
  EXPECT_EQ(problem("about.toml", ""), "");
}

TEST_F(MeasuredFolder, AboutHoldsWhatPeopleLike) {
  write("modes.csv", modes);
  write("about.toml",
        "what = \"a bridge\"\nnote = \"windy\"\nwhen = 2021-05-03\nteam = [\"A\", \"B\"]\n[weather]\nwind = 3.0\n"
        "[weather.sun]\nshines = true\n");
  const Measured m = read();
  EXPECT_EQ(m.what, "a bridge");
  EXPECT_EQ(m.when, "2021-05-03");
  EXPECT_EQ(m.notes, "");
  ASSERT_EQ(m.set_aside.size(), 1u);
  EXPECT_EQ(m.set_aside[0].place, "about.toml:2");
  EXPECT_EQ(m.set_aside[0].what, "key 'note' is kept as a note: did you mean 'notes'?");
  std::string notes;
  for (const Note& note : m.more) notes += fmt::format("{}={}\n", note.key, note.text);
  EXPECT_EQ(notes, "note=windy\nteam=[ 'A', 'B' ]\nweather.sun.shines=true\nweather.wind=3.0\n");
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
                "measured/sensors.csv:3: sensor 'b' at (2.95, 0.5, 1.8) m is 0.8 m away from the nearest block, "
                "block 2 (");
  expect_holds(message, "from (2, 0, 0) to (3, 1, 1) m. It must be within 0.5 m of a block. Correct its place");
  expect_holds(test::message_of<InputError>([&] { place_sensors(m, Assembly{}); }), "there is no block");
}
}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
