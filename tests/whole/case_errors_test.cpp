// Cases that are wrong: each is refused with its place, what was found and what is right, and nothing is begun.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

const std::string motion = "pulse = { kind = \"sine\", axis = \"y\", amplitude = 9, frequency = 2 }";

/// `run` (and `info` and `generate`) refuses the text with the pieces, and no run directory appears.
void expect_refused(const std::string& text, std::vector<std::string> pieces, bool by_all = true) {
  Folder folder;
  folder.write("bad.toml", text);
  pieces.push_back("bad.toml");
  std::vector<std::vector<std::string>> commands = {{"run", "bad.toml", "-o", "run"}};
  if (by_all) commands.insert(commands.end(), {{"info", "bad.toml"}, {"generate", "bad.toml"}});
  for (const auto& words : commands) {
    SCOPED_TRACE(words[0]);
    expect_error(voussoir(words, {.folder = folder.path()}), 2, pieces);
  }
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"bad.toml"});
}

void expect_refused_with(const std::string& piece, const std::string& other, const std::vector<std::string>& pieces) {
  SCOPED_TRACE(other);
  expect_refused(exchanged(case_text({}), piece, other), pieces, false);
}

TEST(CaseErrors, UnknownKeysAreNamedWithTheNearest) {
  expect_refused_with("courses", "coursse", {"bad.toml:4:", "unknown key 'coursse'", "did you mean 'courses'?"});
  expect_refused_with("[output]", "[outptu]", {"unknown key 'outptu'", "did you mean 'output'?"});
  expect_refused_with("fields_every", "fields_evry", {"'fields_evry'", "did you mean 'fields_every'?"});
  expect_refused_with("frequency =", "frequncy =", {"'frequncy'", "did you mean 'frequency'?"});
  expect_refused_with("direction", "orientation", {"needs 'direction'"});
  expect_refused_with("[output]", "[materials.masonry]\nfrction_angle = 30\n[output]",
                      {"'frction_angle'", "did you mean 'friction_angle'?"});
}

TEST(CaseErrors, WrongTypes) {
  expect_refused_with("courses = 6", "courses = \"six\"", {"bad.toml:4:", "'courses'", "must be a number"});
  expect_refused_with("courses = 6", "courses = 6.5", {"'courses'", "6.5", "whole number"});
  expect_refused_with("kind = \"gravity\"", "kind = 3", {"'kind'", "a number"});
  expect_refused_with("kind = \"gravity\"", "kind = \"levity\"", {"levity", "gravity"});
  expect_refused_with(motion, "pulse = 3", {"'pulse'", "a table"});
  expect_refused_with("[output]", "[[output]]", {"'output'", "a table"});
  expect_refused_with("[output]", "[damping]\nband = 5\n[output]", {"'band'", "list"});
  expect_refused_with("generator = \"wall\"", "generator = [\"wall\"]", {"'generator'", "text"});
}

TEST(CaseErrors, WrongRangesAndUnits) {
  expect_refused_with("courses = 6", "courses = 0", {"'courses'", "is 0", "from 1"});
  expect_refused_with("duration = 0.5", "duration = -0.5", {"'duration'", "-0.5", " s"});
  expect_refused_with("[output]", "[materials.masonry]\nfriction_angle = 350\n[output]", {"350", "degrees"});
  expect_refused_with("[output]", "[materials.masonry]\ndensity = 0\n[output]", {"'density'", "kg/m3"});
  expect_refused_with("[output]", "[damping]\nratio = 5\n[output]", {"'ratio'", "0.5"});
  expect_refused_with("[output]", "[damping]\nband = [12, 0.5]\n[output]", {"'band'", "lower"});
  expect_refused_with("checkpoint_every = 0.1", "checkpoint_every = 0", {"'checkpoint_every'", "above 0"});
  expect_refused_with(motion, motion + "\nunits = \"feet\"", {"units"});
}

TEST(CaseErrors, NumbersThatAreNotFinite) {
  for (const char* value : {"nan", "inf", "-inf"}) {
    expect_refused_with("amplitude = 9", std::string("amplitude = ") + value, {"'amplitude'", "finite"});
    expect_refused_with("[0.3, 0.0", std::string("[0.3, ") + value, {"'position'", "finite"});
    expect_refused_with("[output]", std::string("[analysis]\ngravity = ") + value + "\n[output]", {"'gravity'"});
    expect_refused_with("courses = 6", std::string("courses = ") + value, {"'courses'", "finite"});
  }
  expect_refused_with("duration = 0.5", "duration = 1e999", {"bad.toml:11"});
}

TEST(CaseErrors, BrokenFiles) {
  expect_refused("", {"bridge"});
  expect_refused("\n\n# nothing\n", {"bridge"});
  expect_refused("[bridge\ngenerator = \"wall\"\n", {"bad.toml:1", "TOML"});
  expect_refused_with("courses = 6", "courses = 6\ncourses = 7", {"bad.toml:5", "courses"});
  expect_refused_with("generator = \"wall\"", "", {"generator"});
  expect_refused_with("generator = \"wall\"", "generator = \"wal\"", {"did you mean 'wall'?"});
  expect_refused(std::string("\0\1\2\xff\xfe", 5), {"TOML"});
  expect_refused(std::string(100000, '['), {"bad.toml"});
  std::string garbage(20000, '\0');
  std::mt19937 random(7);
  for (char& c : garbage) c = char(random());
  expect_refused(garbage, {"TOML"});
  // A case as some editors save it: with a byte-order mark and Windows' line ends. It must not be refused.
  Folder folder;
  std::string windows = "\xef\xbb\xbf";
  for (char c : case_text({})) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  folder.write("windows.toml", windows);
  EXPECT_EQ(voussoir({"info", "windows.toml"}, {.folder = folder.path()}).status, 0);
}

TEST(CaseErrors, AnyCutCaseIsRefusedOrWhole) {
  Folder folder;
  const std::string text = case_text({});
  for (std::size_t length = 0; length < text.size(); length += 41) {
    folder.write("cut.toml", text.substr(0, length));
    const Outcome outcome = voussoir({"info", "cut.toml"}, {.folder = folder.path()});
    if (outcome.status != 0) expect_error(outcome, 2, {"cut.toml"});
  }
}

TEST(CaseErrors, StagesAndWhatTheyNeed) {
  const std::string text = case_text({});
  expect_refused(text.substr(0, text.find("[[stage]]")), {"stage"}, false);
  expect_refused_with(motion, "", {"'record'", "pulse"});
  expect_refused_with("duration = 0.5\n", "", {"duration"});
  expect_refused_with(motion, "record = \"no_such_file.txt\"", {"bad.toml:12:", "no_such_file.txt", "no such file"});
  expect_refused_with(motion, "record = \".\"", {"record"});
  expect_refused_with("generator = \"wall\"\nlength_blocks = 6\ncourses = 6", "assembly = \"none.h5\"",
                      {"none.h5", "no such file"});
}

TEST(CaseErrors, RecordsThatAreWrong) {
  Folder folder;
  folder.write("case.toml", exchanged(case_text({}), motion, "record = \"record.txt\""));
  const auto refused = [&](const std::string& record, std::vector<std::string> pieces) {
    SCOPED_TRACE(record.substr(0, 60));
    folder.write("record.txt", record);
    pieces.push_back("record.txt");
    expect_error(voussoir({"run", "case.toml", "-o", "run"}, {.folder = folder.path()}), 2, pieces);
    EXPECT_FALSE(exists(folder / "run"));
  };
  refused("", {"0 rows"});
  refused("0 0\n", {"1 row"});
  refused("0 0\n0.1 nan\n0.2 0\n", {"record.txt:2:", "finite"});
  refused("0 0\n0.1 1e999\n0.2 0\n", {"record.txt:2:"});
  refused("my words\n0 0\n0.1 1\n", {"record.txt:1:", "'my words'", "K-NET", "line of names"});
  refused("0 0\n0.2 1\n0.1 2\n", {"record.txt:3:", "increase"});
  refused("0 0\n0.1 1\n0.3 2\n0.4 3\n", {"equal"});
  refused("1\n2\n3\n", {"columns", "dt"});
  refused("0 1 2\n1 2 3\n", {"columns"});
  refused(std::string("\0\0\0\1", 4), {"record.txt:1:"});
  // No ground shakes like this: the unit is wrong.
  folder.write("record.txt", "0 0\n0.1 1e12\n0.2 0\n");
  expect_error(voussoir({"run", "case.toml", "-o", "run"}, {.folder = folder.path()}), 2,
               {"record.txt: sample 2", "1e+12 m/s2", "unit"});
}

TEST(CaseErrors, FilesThatAreNoCases) {
  Folder folder;
  std::filesystem::create_directory(folder / "folder.toml");
  const Surroundings there{.folder = folder.path()};
  for (const char* verb : {"run", "generate", "info"}) {
    SCOPED_TRACE(verb);
    expect_error(voussoir({verb, "missing.toml"}, there), 2, {"missing.toml", "o such file"});
    expect_error(voussoir({verb, "folder.toml"}, there), 2, {"folder.toml"});
    expect_error(voussoir({verb, std::string(5000, 'x') + ".toml"}, there), 2, {"xxx", "5006 bytes"});
    expect_error(voussoir({verb, ""}, there), 2, {});
  }
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"folder.toml"});
}

TEST(CaseErrors, SensorsOffTheStructure) {
  expect_refused(exchanged(case_text({}), "[0.3, 0.0, 0.25]", "[0.3, 0.0, 25]"), {"\"foot\"", "nearest block"}, false);
}

TEST(CaseErrors, AStepThatIsTooLarge) {
  expect_refused_with("[output]", "[analysis]\ntime_step = 0.01\n[output]",
                      {"time_step = 0.01 s", "critical time step", "block"});
}

TEST(CaseErrors, PlacementsOfWhatIsNotThereOrFixed) {
  const auto refuse = [](const std::string& group, const std::vector<std::string>& pieces) {
    expect_refused_with("duration = 0.5", "duration = 0.5\nplace = [{ group = \"" + group + "\" }]", pieces);
  };
  refuse("tpo", {"'tpo'", "did you mean 'top'?"});
  refuse("base", {"'base'", "fixed"});
}

TEST(CaseErrors, DrivesOfWhatIsNotThereOrFree) {
  const auto refuse = [](const std::string& group, const std::vector<std::string>& pieces) {
    expect_refused_with("duration = 0.5",
                        "duration = 0.5\ndrive = [{ group = \"" + group + "\", velocity = [0.1, 0, 0] }]", pieces);
  };
  refuse("bse", {"'bse'", "did you mean 'base'?"});
  refuse("top", {"'top'", "free"});
}

TEST(CaseErrors, PlotsOfWhatIsNotRecorded) {
  expect_refused_with("[output]", "[[plot]]\nname = \"a\"\ny = \"reactions/top_x\"\n[output]",
                      {"plot 'a'", "'reactions/top_x'", "does not record"});
  expect_refused_with("[output]", "[[plot]]\nname = \"a\"\ny = \"energy/kinetc\"\n[output]",
                      {"did you mean 'energy/kinetic'?"});
}

TEST(CaseErrors, GuidesOfWhatIsNotThereOrFree) {
  const auto refuse = [](const std::string& group, const std::vector<std::string>& pieces) {
    expect_refused_with("[output]", "[[guide]]\ngroup = \"" + group + "\"\nfree = [\"z\"]\n[output]", pieces);
  };
  refuse("bse", {"'bse'", "did you mean 'base'?"});
  refuse("top", {"'top'", "free"});
}

TEST(CaseErrors, ThePlaceOfOutputCannotBeMade) {
  Folder folder;
  write_wall(folder);
  const Surroundings there{.folder = folder.path()};
  for (const std::string place : {"wall.toml", "wall.toml/run", "/proc/run", "/dev/null"}) {
    SCOPED_TRACE(place);
    const Outcome run = voussoir({"run", "wall.toml", "-o", place, "--no-pictures"}, there);
    expect_error(run, run.status == 1 ? 1 : 2, {place});
    const Outcome made = voussoir({"generate", "wall.toml", "-o", place + "/x.h5"}, there);
    expect_error(made, made.status == 1 ? 1 : 2, {place});
  }
  EXPECT_EQ(bytes_of(folder / "wall.toml"), case_text({}));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
