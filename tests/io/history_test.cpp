// Histories, and descriptions of files.
#include <gtest/gtest.h>

#include "io/hdf5/assembly_file.h"
#include "io/hdf5/checkpoint_file.h"
#include "io/hdf5/h5.h"
#include "io/hdf5/history_file.h"
#include "io/info/describe_file.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Folder;

const std::vector<Channel> channels = {{"time", "s"}, {"step", ""}, {"energy/kinetic", "J"}, {"energy/friction", "J"}};

History make(const std::string& path, int rows) {
  History history(path, channels);
  for (int i = 0; i < rows; ++i) history.append(std::vector<double>{0.1 * i, double(10 * i), 1.0 / (1 + i), -2.0 * i});
  return history;
}

TEST(History, RoundTripKeepsOrderUnitsAndBits) {
  const Folder folder;
  History out = make(folder / "history.h5", 100);
  out.flush();
  const History in = History::load(folder / "history.h5");
  EXPECT_EQ(in.channels(), channels);
  EXPECT_EQ(in.rows(), 100u);
  for (const Channel& channel : channels) EXPECT_EQ(in.values(channel.path), out.values(channel.path));
  const h5::File file = h5::File::open(folder / "history.h5");
  EXPECT_EQ(file.text("/", "format"), "voussoir-history");
  EXPECT_EQ(file.unit("energy/kinetic"), "J");
}

TEST(History, ReadableAfterEveryFlush) {
  const Folder folder;
  History history = make(folder / "h.h5", 0);
  history.flush();
  EXPECT_EQ(History::load(folder / "h.h5").rows(), 0u);
  for (int i = 1; i <= 3; ++i) {
    history.append(std::vector<double>{double(i), 0, 0, 0});
    EXPECT_EQ(History::load(folder / "h.h5").rows(), std::size_t(i - 1));
    history.flush();
    EXPECT_EQ(History::load(folder / "h.h5").rows(), std::size_t(i));
  }
}

TEST(History, CutBackAndContinuedItIsTheSame) {
  const Folder folder;
  History whole = make(folder / "a.h5", 50);
  History part = make(folder / "b.h5", 50);
  part.keep_first(60);
  EXPECT_EQ(part.rows(), 50u);
  part.keep_first(20);
  EXPECT_EQ(part.rows(), 20u);
  for (int i = 20; i < 50; ++i) part.append(std::vector<double>{0.1 * i, double(10 * i), 1.0 / (1 + i), -2.0 * i});
  whole.flush();
  part.flush();
  EXPECT_EQ(test::bytes_of(folder / "a.h5"), test::bytes_of(folder / "b.h5"));
}

TEST(History, ManyChannels) {
  const Folder folder;
  std::vector<Channel> many = {{"time", "s"}};
  for (int i = 0; i < 1500; ++i) many.push_back({"sensors/a rather long name of a sensor " + std::to_string(i), "m"});
  History history(folder / "h.h5", many);
  history.append(std::vector<double>(many.size(), 1.5));
  history.flush();
  EXPECT_EQ(History::load(folder / "h.h5").values(many.back().path), std::vector<double>{1.5});
}

TEST(History, Refusals) {
  EXPECT_THROW(History("h", {{"step", ""}}), InputError);
  EXPECT_THROW(History("h", {{"time", "s"}, {"time", "s"}}), InputError);
  History history = make("h.h5", 2);
  EXPECT_THROW(history.append(std::vector<double>{1.0}), RunError);
  EXPECT_NE(test::message_of<InputError>([&] {
              history.values("energy/kinetics");
            }).find("it has: time, step, energy/kinetic"),
            std::string::npos);
  const Folder folder;
  make(folder / "h.h5", 1000).flush();
  std::string bytes = test::bytes_of(folder / "h.h5");
  test::set_bytes(folder / "h.h5", bytes.substr(0, bytes.size() - 100));
  EXPECT_THROW(History::load(folder / "h.h5"), InputError);
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Info, SaysWhatEachFileHolds) {
  const Folder folder;
  make(folder / "h.h5", 11).flush();
  const std::string history = describe_file(folder / "h.h5");
  EXPECT_TRUE(holds(history, "history, 11 rows of 4 channels") && holds(history, "time 0 to 1 s") &&
              holds(history, "energy/friction: largest 20 J"))
      << history;

  const std::string record = describe_file(folder.write("r.txt", "0 0\n0.5 -3\n1.0 0\n"));
  EXPECT_TRUE(holds(record, "3 samples, 1 s at time steps of 0.5 s") &&
              holds(record, "largest value 3, largest velocity 1.5"))
      << record;

  const std::string text =
      "[bridge]\ngenerator = \"column\"\nblocks = 3\n[[stage]]\nkind = \"motion\"\nduration = 2\n"
      "pulse = { kind = \"rectangular\", axis = \"y\", amplitude = 2, length = 1 }\n";
  const std::string of_case = describe_file(folder.write("c.toml", text));
  EXPECT_TRUE(holds(of_case, "generator \"column\"") && holds(of_case, "stage 1: motion (pulse rectangular y), 2 s") &&
              holds(of_case, "peaks x 0, y 2, z 0 m/s2"))
      << of_case;

  Array<double> x(6, 1.0);
  CheckpointHeader header;
  header.time = 2.5;
  header.step = 7;
  header.numbers = {{"time_step", 0.001}};
  write_checkpoint(folder / "k.h5", header, {{"bodies/x", 3, "m", &x}});
  const std::string checkpoint = describe_file(folder / "k.h5");
  EXPECT_TRUE(holds(checkpoint, "time 2.500000 s, time step 7; 0 stages finished") &&
              holds(checkpoint, "bodies/x: 2 x 3 in m") && holds(checkpoint, "time_step = 0.001"))
      << checkpoint;

  Assembly assembly;
  assembly.generator = "test";
  assembly.materials = {{.name = "stone", .density = 2000.0}};
  Block low, high;
  low.cells = {make_box({0, 0, -1}, {1, 1, 0})};
  low.fixed = true;
  high.cells = {make_box({0, 0, 0}, {0.5, 1, 2})};
  assembly.blocks = {low, high};
  finish_blocks(assembly);
  write_assembly(folder / "a.h5", assembly);
  const std::string of_assembly = describe_file(folder / "a.h5");
  EXPECT_TRUE(holds(of_assembly, "2 blocks (1 fixed), 4000.0 kg, of which 2000.0 kg free") &&
              holds(of_assembly, "1.000 x 1.000 x 3.000 m"))
      << of_assembly;

  EXPECT_THROW(describe_file(folder / "none"), InputError);
  EXPECT_THROW(describe_file(folder.write("bad.h5", "x")), InputError);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
