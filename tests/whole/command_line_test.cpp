// The command line: help, options, exit status.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <regex>

#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

const std::vector<std::string> verb_names = {"generate", "import",  "export", "info",     "run",       "resume",
                                             "modal",    "render",  "check",  "step",     "effects",   "diagnose",
                                             "hide",     "motion",  "report", "campaign", "fragility", "vehicles",
                                             "rate",     "compare", "cracks", "view"};

TEST(CommandLine, HelpOfEachVerbHasAnExample) {
  const Outcome all = voussoir({"--help"});
  EXPECT_EQ(all.status, 0);
  for (const std::string& verb : verb_names) {
    EXPECT_NE(all.out.find("\n  " + verb + " "), std::string::npos) << verb;
    const Outcome help = voussoir({verb, "--help"});
    EXPECT_EQ(help.status, 0) << verb;
    EXPECT_NE(help.out.find("Example: voussoir " + verb + " "), std::string::npos) << help.out;
    for (const char* option : {"--help", "--threads", "--quiet"})
      EXPECT_NE(help.out.find(option), std::string::npos) << verb << " " << option;
    EXPECT_EQ(help.err, "");
    EXPECT_FALSE(std::regex_search(help.out, std::regex("=[0-9.]{8,}"))) << "a default to the last bit: " << help.out;
  }
}

TEST(CommandLine, EveryVerbOfTheHelpIsTestedHere) {
  std::string text = voussoir({"--help"}).out;
  std::vector<std::string> found;
  for (std::size_t at = text.find("\n  "); at != std::string::npos; at = text.find("\n  ", at + 1))
    found.push_back(text.substr(at + 3, text.find(' ', at + 3) - at - 3));
  EXPECT_EQ(found, verb_names) << "a verb has come or gone: add it to the tests of this folder";
}

TEST(CommandLine, VersionIsSaid) {
  const Outcome outcome = voussoir({"--version"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_TRUE(outcome.out.starts_with("voussoir 0.")) << outcome.out;
  // The commit, the kernels and each library with a number.
  EXPECT_TRUE(std::regex_search(outcome.out, std::regex(", commit (unknown|[0-9a-f]{10}(-dirty)?), kernels for \\S")))
      << outcome.out;
  for (const char* library : {"Eigen", "CHOLMOD", "Ceres", "HDF5", "VTK", "cairo", "Gmsh", "Boost", "fmt",
                              "nlohmann-json", "toml\\+\\+", "OpenSSL"})
    EXPECT_TRUE(std::regex_search(outcome.out, std::regex(std::string(" ") + library + " [0-9]+\\.[0-9]"))) << library;
}

TEST(CommandLine, WorksWhateverTheThreadsAreToldToDoWhileTheyWait) {
  for (const char* policy : {"", "active", "passive"}) {
    const Outcome outcome = voussoir({"--version"}, {.environment = {{"OMP_WAIT_POLICY", policy}}});
    EXPECT_EQ(outcome.status, 0) << policy << outcome.err;
  }
}

TEST(CommandLine, WorksWhateverMemoryIsAskedForIn) {
  for (const char* tunables : {"", "glibc.malloc.hugetlb=0", "glibc.malloc.hugetlb=1", "nonsense"}) {
    const Outcome outcome = voussoir({"--version"}, {.environment = {{"GLIBC_TUNABLES", tunables}}});
    EXPECT_EQ(outcome.status, 0) << tunables << outcome.err;
    EXPECT_TRUE(outcome.out.starts_with("voussoir 0.")) << outcome.out;
  }
}

TEST(CommandLine, NothingAskedIsAnErrorWithHelp) {
  const Outcome outcome = voussoir({});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.out.find("Usage"), std::string::npos);
}

TEST(CommandLine, UnknownVerbSuggestsTheRightOne) {
  expect_error(voussoir({"rnu", "case.toml"}), 2, {"'rnu'", "did you mean 'run'", "--help"});
  expect_error(voussoir({"demolish"}), 2, {"'demolish'", "--help"});
}

TEST(CommandLine, WrongOptionsAreRefused) {
  Folder folder;
  write_wall(folder);
  const Surroundings there{.folder = folder.path()};
  const auto refused = [&](const std::vector<std::string>& words, const std::vector<std::string>& pieces) {
    SCOPED_TRACE(words.back());
    expect_error(voussoir(words, there), 2, pieces);
  };
  refused({"run", "wall.toml", "--colour", "red"}, {"--colour", "run --help"});
  refused({"run"}, {"CASE", "Usage"});
  refused({"run", "wall.toml", "second.toml"}, {"run --help"});
  refused({"run", "wall.toml", "--threads", "0"}, {"--threads", "0"});
  refused({"run", "wall.toml", "--threads", "many"}, {"many", "threads"});
  refused({"run", "wall.toml", "--threads", "99999999999999"}, {"threads"});
  refused({"run", "wall.toml", "--until", "soon"}, {"soon", "until"});
  refused({"run", "wall.toml", "--until", "nan"}, {"--until", "nan"});
  refused({"run", "wall.toml", "--until", "-1"}, {"--until", "-1"});
  refused({"render", "wall.toml", "--width", "-5"}, {"5"});
  refused({"generate"}, {"CASE"});
  refused({"generate", "--keys", "pyramid"}, {"pyramid"});
  refused({"import", "x.obj"}, {"-o"});
  refused({"import", "x.obj", "-o", "y.h5", "--density", "inf"}, {"--density", "inf"});
  refused({"import", "x.obj", "-o", "y.h5", "--cohesion", "-1"}, {"--cohesion", "-1"});
  refused({"import", "x.obj", "-o", "y.h5", "--tension", "nan"}, {"--tension", "nan"});
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"wall.toml"})
      << "a refused command left something behind";
}

/// Every option that takes a number, of every verb. Not a word is read of files that are not there.
TEST(CommandLine, NumbersOutOfRangeAreRefusedBeforeAnythingIsRead) {
  const std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> options = {
      {{"run", "none.toml"}, {"until"}},
      {{"import", "none.obj", "-o", "out.h5"},
       {"scale", "density", "youngs-modulus", "shear-modulus", "tension", "cohesion", "friction", "kn", "ks", "gap",
        "dilation", "interface-share", "interface-friction"}},
      {{"render", "none"}, {"time", "amplification", "crack", "range", "width", "height"}},
      {{"modal", "none.toml"}, {"modes", "width", "height"}},
      {{"step", "none.toml"}, {"bodies"}},
      {{"hide", "none.toml", "-o", "out"},
       {"modes", "minutes", "shaken", "noise", "scatter", "materials", "defects", "mesh"}},
      {{"diagnose", "none.toml", "--measured", "none"},
       {"effects", "fits", "model-error", "most-modes", "run-seconds"}},
      {{"fragility", "none"}, {"bootstrap"}},
  };
  Folder folder;
  const Surroundings there{.folder = folder.path()};
  for (const auto& [command, names] : options)
    for (const std::string& name : names)
      for (const char* value : {"inf", "-1e300"}) {
        SCOPED_TRACE(name + " " + value);
        std::vector<std::string> words = command;
        words.insert(words.end(), {"--" + name, value});
        expect_error(voussoir(words, there), 2, {name});
      }
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{});
}

TEST(CommandLine, NamesThatEndLikeAnotherKindOfFileAreRefused) {
  Folder folder;
  write_wall(folder);
  const Surroundings there{.folder = folder.path()};
  expect_error(voussoir({"render", "wall.toml", "-o", "a.svg"}, there), 2, {"a.svg", "PNG", "must end in .png"});
  expect_error(voussoir({"generate", "wall.toml", "-o", "a.PNG"}, there), 2, {"a.PNG", "must end in .h5 or .hdf5"});
  expect_error(voussoir({"import", "a.obj", "-o", "b.obj"}, there), 2, {"b.obj", "must end in .h5 or .hdf5"});
  expect_error(voussoir({"step", "wall.toml", "-o", "a.csv"}, there), 2, {"a.csv", "must end in .json"});
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"wall.toml"});
}

/// `voussoir … | head -1`: what is not read is nobody's loss.
TEST(CommandLine, AReaderThatGoesAwayIsNoFailure) {
  const std::string program = "\"" VOUSSOIR_PROGRAM "\"";
  const auto status = [&](const std::string& words) {
    return std::system(("bash -c '" + program + words + "; exit ${PIPESTATUS[0]}'").c_str());
  };
  EXPECT_EQ(status(" generate --keys cs1 | true"), 0);
  EXPECT_EQ(status(" generate --keys cs1 2>&1 | head -c 1 >/dev/null"), 0);
  EXPECT_EQ(status(" --help | true"), 0);
  EXPECT_EQ(WEXITSTATUS(status(" nothing 2>&1 | true")), 2) << "what failed has failed all the same";
}

TEST(CommandLine, KeysOfEachGeneratorAreListed) {
  for (const char* name : {"cs1", "cs2", "arch", "wall", "column", "filled-arch"}) {
    const Outcome outcome = voussoir({"generate", "--keys", name});
    EXPECT_EQ(outcome.status, 0) << name;
    EXPECT_NE(outcome.out.find("Pa/m"), std::string::npos) << outcome.out;
  }
}

TEST(CommandLine, OutputThatCannotBeWrittenIsSaid) {
  Folder folder;
  write_wall(folder);
  const Outcome outcome = voussoir({"info", "wall.toml"}, {.folder = folder.path(), .output_file = "/dev/full"});
  expect_error(outcome, 1, {"standard output", "No space left"});
  // More than the buffer holds, and the text of an option.
  expect_error(voussoir({"generate", "--keys", "cs1"}, {.output_file = "/dev/full"}), 1,
               {"cannot write to standard output: No space left"});
  expect_error(voussoir({"run", "--help"}, {.output_file = "/dev/full"}), 1,
               {"cannot write to standard output: No space left"});
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
