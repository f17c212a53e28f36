// Checkpoints: bit-exact round trips, damage that is found, disks that are full.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstring>

#include "io/hdf5/checkpoint_file.h"
#include "io/hdf5/h5.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

namespace fs = std::filesystem;
using test::Folder;

struct State {
  Array<double> displacement, empty;
  Array<std::int64_t> key;
  Array<std::int32_t> flags;
  Array<std::uint8_t> bonded;
  std::vector<NamedArray> arrays() {
    return {{"bodies/displacement", 3, "m", &displacement},
            {"bodies/empty", 3, "m", &empty},
            {"patches/key", 1, "", &key},
            {"patches/flags", 2, "", &flags},
            {"patches/bonded", 1, "", &bonded}};
  }
};

State make_state(std::size_t n) {
  State s;
  for (std::size_t i = 0; i < 3 * n; ++i) s.displacement.push_back(std::sin(double(i)) / 3.0);
  s.displacement[0] = -0.0;
  s.displacement[1] = 5e-324;
  s.displacement[2] = std::nan("7");
  for (std::size_t i = 0; i < n; ++i) s.key.push_back(std::int64_t(i) - (std::int64_t(1) << 62));
  for (std::size_t i = 0; i < 2 * n; ++i) s.flags.push_back(std::int32_t(i * 2654435761u));
  for (std::size_t i = 0; i < n; ++i) s.bonded.push_back(std::uint8_t(i * 7));
  return s;
}

CheckpointHeader make_header() {
  CheckpointHeader header;
  header.time = 12.5;
  header.step = std::int64_t(1) << 53;
  header.stage = 1;
  header.stage_time = 1.0 / 3.0;
  header.assembly_hash = 0xfedcba9876543210ULL;
  header.case_hash = 1;
  header.numbers = {{"time_step", 1.9e-4}, {"energy of friction", 0.1 + 0.2}};
  return header;
}

TEST(Checkpoint, RoundTripIsBitExact) {
  const Folder folder;
  State out = make_state(1000), in;
  const std::uint64_t hash = write_checkpoint(folder / "c.h5", make_header(), out.arrays());
  EXPECT_EQ(hash, hash_arrays(out.arrays()));
  CheckpointHeader header;
  in.empty.resize(9);  // resized to fit
  read_checkpoint(folder / "c.h5", header, in.arrays());
  ASSERT_EQ(in.displacement.size(), out.displacement.size());
  EXPECT_EQ(std::memcmp(in.displacement.data(), out.displacement.data(), out.displacement.size() * sizeof(double)), 0);
  EXPECT_EQ(in.key, out.key);
  EXPECT_EQ(in.flags, out.flags);
  EXPECT_EQ(in.bonded, out.bonded);
  EXPECT_TRUE(in.empty.empty());
  const CheckpointHeader expected = make_header();
  EXPECT_EQ(header.time, expected.time);
  EXPECT_EQ(header.step, expected.step);
  EXPECT_EQ(header.stage, expected.stage);
  EXPECT_EQ(header.stage_time, expected.stage_time);
  EXPECT_EQ(header.assembly_hash, expected.assembly_hash);
  EXPECT_EQ(header.case_hash, expected.case_hash);
  EXPECT_EQ(header.state_hash, hash);
  EXPECT_EQ(header.numbers, expected.numbers);
  EXPECT_EQ(header.number("time_step"), 1.9e-4);
  EXPECT_NE(test::message_of<RunError>([&] { (void)header.number("frames"); }).find("frames"), std::string::npos);
  EXPECT_THROW((void)header.count("time_step"), RunError);
  EXPECT_FALSE(header.program_version.empty());
  write_checkpoint(folder / "d.h5", header, in.arrays());
  EXPECT_EQ(test::bytes_of(folder / "c.h5"), test::bytes_of(folder / "d.h5"));
}

/// Reads into a fresh state. True: read and right. False: refused as damaged.
bool accepted(const std::string& path, std::uint64_t hash, double time) {
  State state;
  CheckpointHeader header;
  try {
    read_checkpoint(path, header, state.arrays());
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("checkpoint " + path + " is damaged: "), std::string::npos)
        << error.what();
    return false;
  } catch (const h5::ForeignFile&) {
    return false;  // the damage hit the format attribute
  }
  EXPECT_EQ(hash_arrays(state.arrays()), hash);
  EXPECT_EQ(header.time, time);
  return true;
}

TEST(Checkpoint, OneWrongByteInAnArrayIsFound) {
  const Folder folder;
  State state = make_state(2000);
  const std::uint64_t hash = write_checkpoint(folder / "c.h5", make_header(), state.arrays());
  const std::string bytes = test::bytes_of(folder / "c.h5");
  const auto* raw = reinterpret_cast<const char*>(state.displacement.data());
  const std::size_t at = bytes.find(std::string(raw + 800, 64));
  ASSERT_NE(at, std::string::npos);
  EXPECT_TRUE(accepted(folder / "c.h5", hash, 12.5));
  std::string broken = bytes;
  broken[at + 5] ^= 0x10;
  test::set_bytes(folder / "c.h5", broken);
  EXPECT_FALSE(accepted(folder / "c.h5", hash, 12.5));
}

TEST(Checkpoint, DamageAnywhereIsFoundOrHarmless) {
  const Folder folder;
  State state = make_state(40);
  const std::uint64_t hash = write_checkpoint(folder / "c.h5", make_header(), state.arrays());
  const std::string bytes = test::bytes_of(folder / "c.h5");
  int refused = 0, tried = 0;
  for (std::size_t at = 0; at < bytes.size(); at += 11, ++tried) {
    std::string broken = bytes;
    broken[at] = char(broken[at] ^ (1 << (at % 8)));
    test::set_bytes(folder / "b.h5", broken);
    refused += !accepted(folder / "b.h5", hash, 12.5);
  }
  EXPECT_GT(refused, tried / 4);
}

TEST(Checkpoint, TruncationAnywhereIsFound) {
  const Folder folder;
  State state = make_state(100);
  write_checkpoint(folder / "c.h5", make_header(), state.arrays());
  const std::string bytes = test::bytes_of(folder / "c.h5");
  for (const double share : {0.0, 0.01, 0.3, 0.7, 0.99}) {
    test::set_bytes(folder / "b.h5", bytes.substr(0, std::size_t(share * double(bytes.size()))));
    EXPECT_FALSE(accepted(folder / "b.h5", 0, 0.0)) << share;
  }
  std::string noise;
  for (int i = 0; i < 5000; ++i) noise += char(i * i % 251);
  test::set_bytes(folder / "b.h5", noise);
  EXPECT_FALSE(accepted(folder / "b.h5", 0, 0.0));
}

/// A checkpoint as another program may have written it, with sound checksums: the attributes of another file, but for
/// its version, and these arrays.
void forge(const std::string& path, const std::string& like, std::int64_t version, State& state) {
  const h5::File from = h5::File::open(like);
  h5::File to = h5::File::create(path);
  for (const char* name : {"format", "assembly_hash", "case_hash", "state_hash", "program_version"})
    to.set_text("/", name, from.text("/", name));
  to.set_integer("/", "format_version", version);
  for (const char* name : {"step", "stage"}) to.set_integer("/", name, from.integer("/", name));
  for (const char* name : {"time", "stage_time"}) to.set_number("/", name, from.number("/", name));
  to.make_group("header/numbers");
  for (const NamedArray& array : state.arrays())
    std::visit(
        [&](const auto* v) {
          h5::Shape shape = {v->size() / array.columns};
          if (array.columns > 1) shape.push_back(array.columns);
          to.write(array.name, std::span(v->data(), v->size()), shape);
        },
        array.data);
  to.save();
}

std::int64_t version_of(const std::string& path) {
  return h5::File::open(path).integer("/", "format_version");
}

TEST(Checkpoint, EarlierVersionsAreNotResumed) {
  const Folder folder;
  State state = make_state(10), other;
  write_checkpoint(folder / "c.h5", make_header(), state.arrays());
  forge(folder / "d.h5", folder / "c.h5", version_of(folder / "c.h5") - 1, state);
  CheckpointHeader header;
  const std::string message =
      test::message_of<InputError>([&] { read_checkpoint(folder / "d.h5", header, other.arrays()); });
  EXPECT_NE(message.find("begin the run again"), std::string::npos) << message;
  EXPECT_EQ(read_checkpoint_header(folder / "d.h5").step, make_header().step);
}

TEST(Checkpoint, DigestSeesWhatChecksumsCannot) {
  const Folder folder;
  State state = make_state(10), other;
  write_checkpoint(folder / "c.h5", make_header(), state.arrays());
  state.key[3] += 1;
  forge(folder / "d.h5", folder / "c.h5", version_of(folder / "c.h5"), state);
  CheckpointHeader header;
  const std::string message =
      test::message_of<RunError>([&] { read_checkpoint(folder / "d.h5", header, other.arrays()); });
  EXPECT_NE(message.find("is damaged"), std::string::npos) << message;
  EXPECT_NE(message.find("digest"), std::string::npos) << message;
}

TEST(Checkpoint, OtherFilesAreNotDamaged) {
  const Folder folder;
  h5::File file = h5::File::create(folder / "h.h5");
  file.set_text("/", "format", "voussoir-history");
  file.set_integer("/", "format_version", 1);
  file.save();
  EXPECT_NE(test::message_of<InputError>([&] {
              read_checkpoint_header(folder / "h.h5");
            }).find("is a \"voussoir-history\" file"),
            std::string::npos);
  EXPECT_NE(test::message_of<InputError>([&] { read_checkpoint_header(folder / "none.h5"); }).find("no such file"),
            std::string::npos);
}

TEST(Checkpoint, AnotherSetOfArraysIsRefused) {
  const Folder folder;
  State state = make_state(5), other;
  write_checkpoint(folder / "c.h5", make_header(), state.arrays());
  auto fewer = other.arrays();
  fewer.pop_back();
  CheckpointHeader header;
  EXPECT_NE(test::message_of<RunError>([&] {
              read_checkpoint(folder / "c.h5", header, fewer);
            }).find("has 5 arrays instead of 4"),
            std::string::npos);
  auto wider = other.arrays();
  wider[0].columns = 4;
  EXPECT_NE(
      test::message_of<RunError>([&] { read_checkpoint(folder / "c.h5", header, wider); }).find("bodies/displacement"),
      std::string::npos);
}

void write_at(const Folder& folder, const std::string& name, double time) {
  State state = make_state(3);
  CheckpointHeader header = make_header();
  header.time = time;
  write_checkpoint(folder / name, header, state.arrays());
}

std::vector<std::string> names(const std::vector<std::string>& paths) {
  std::vector<std::string> found;
  for (const std::string& path : paths) found.push_back(fs::path(path).filename().string());
  return found;
}

TEST(Checkpoint, NewestFirstAndPruned) {
  const Folder folder;
  EXPECT_EQ(checkpoint_name(12.5), "00012.500.h5");
  EXPECT_EQ(checkpoint_name(0.0), "00000.000.h5");
  for (const double t : {5.0, 10.0, 15.0, 20.0, 25.0}) write_at(folder, checkpoint_name(t), t);
  write_at(folder, "stage_1.h5", 12.0);
  folder.write("00030.000.h5", "rotten");
  folder.write("00031.000.h5.partial", "cut off");
  folder.write("notes.txt", "keep");
  EXPECT_EQ(names(list_checkpoints(folder.path())),
            (std::vector<std::string>{"00030.000.h5", "00025.000.h5", "00020.000.h5", "00015.000.h5", "stage_1.h5",
                                      "00010.000.h5", "00005.000.h5"}));
  EXPECT_EQ(prune_checkpoints(folder.path(), 3), 3);
  EXPECT_EQ(names(list_checkpoints(folder.path())),
            (std::vector<std::string>{"00030.000.h5", "00025.000.h5", "00020.000.h5", "00015.000.h5", "stage_1.h5"}));
  EXPECT_TRUE(fs::exists(folder / "notes.txt"));
  EXPECT_FALSE(fs::exists(folder / "00031.000.h5.partial"));
  EXPECT_TRUE(list_checkpoints(folder / "none").empty());
}

TEST(Atomic, FullDiskIsSaidPlainlyAndTheOldFileStays) {
  const Folder folder;
  folder.write("a.txt", "old");
  const std::string message = test::message_of<RunError>([&] {
    write_atomically(folder / "a.txt", [&](const std::string& temporary) {
      write_bytes(temporary, {});
      write_bytes("/dev/full", std::as_bytes(std::span("new")));
    });
  });
  EXPECT_NE(message.find("the disk is full"), std::string::npos) << message;
  EXPECT_EQ(test::bytes_of(folder / "a.txt"), "old");
  EXPECT_FALSE(fs::exists(folder / std::string("a.txt") + unfinished_suffix));
}

/// A process that may write 20 kB a file and tries to replace a small checkpoint with a large one.
TEST(Atomic, CheckpointThatDoesNotFitLeavesTheOldOne) {
  const Folder folder;
  State small = make_state(3), large = make_state(20000);
  const std::string path = folder / "c.h5";
  const std::uint64_t hash = write_checkpoint(path, make_header(), small.arrays());
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = {20000, 20000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const std::string message =
        test::message_of<RunError>([&] { write_checkpoint(path, make_header(), large.arrays()); });
    const bool plain = message.find("cannot write " + path + ": the file would be larger") != std::string::npos;
    ::_exit(plain ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  EXPECT_TRUE(accepted(path, hash, 12.5));
  EXPECT_FALSE(fs::exists(path + unfinished_suffix));
}

TEST(Atomic, MissingFolder) {
  const Folder folder;
  State state = make_state(3);
  const std::string message =
      test::message_of<RunError>([&] { write_checkpoint(folder / "none/c.h5", make_header(), state.arrays()); });
  EXPECT_NE(message.find("the folder does not exist"), std::string::npos) << message;
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
