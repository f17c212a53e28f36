// Modes files, and the modal section of a case.
#include <gtest/gtest.h>

#include "io/case/case.h"
#include "io/hdf5/h5.h"
#include "io/hdf5/modes_file.h"
#include "io/info/describe_file.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Folder;

ModesFile two_modes() {
  ModesFile file;
  file.about = "a wall, all joints intact";
  file.assembly_hash = 0xfedcba9876543210ULL;
  file.mass = 300.0;
  file.places = {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)}, {0.0, 100.0, 200.0}, 0.5};
  for (int i = 0; i < 2; ++i) {
    Mode mode;
    mode.eigenvalue = 4.0 + i, mode.frequency = 0.3 + i, mode.modal_mass = 10.0 * (1 + i), mode.residual = 1e-12;
    mode.participation = Vec3(1, 2, 3) * (1 + i), mode.effective = Vec3(4, 5, 6) * (1 + i);
    mode.words = {"transverse", 1 + i, i ? "with vertical" : ""};
    mode.shape = BlockMotions::Random(3, 6);
    file.modes.push_back(mode);
  }
  file.damped = {{0.31, 0.02}, {1.31, 0.021}};
  return file;
}

TEST(ModesFiles, RoundTripKeepsEveryBit) {
  const Folder folder;
  const ModesFile out = two_modes();
  write_modes(folder / "modes.h5", out);
  const ModesFile in = read_modes(folder / "modes.h5");
  EXPECT_EQ(in.about, out.about);
  EXPECT_EQ(in.assembly_hash, out.assembly_hash);
  EXPECT_EQ(in.mass, out.mass);
  EXPECT_EQ(in.places.centroid, out.places.centroid);
  EXPECT_EQ(in.places.mass, out.places.mass);
  EXPECT_EQ(in.places.size, out.places.size);
  ASSERT_EQ(in.modes.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(in.modes[i].eigenvalue, out.modes[i].eigenvalue);
    EXPECT_EQ(in.modes[i].frequency, out.modes[i].frequency);
    EXPECT_EQ(in.modes[i].modal_mass, out.modes[i].modal_mass);
    EXPECT_EQ(in.modes[i].participation, out.modes[i].participation);
    EXPECT_EQ(in.modes[i].effective, out.modes[i].effective);
    EXPECT_EQ(in.modes[i].words.text(), out.modes[i].words.text());
    EXPECT_EQ(in.modes[i].shape, out.modes[i].shape);
    EXPECT_EQ(in.damped[i].frequency, out.damped[i].frequency);
    EXPECT_EQ(in.damped[i].ratio, out.damped[i].ratio);
  }
  EXPECT_NE(describe_file(folder / "modes.h5").find("mode 2: 1.3 Hz, transverse, 2nd order, with vertical"),
            std::string::npos)
      << describe_file(folder / "modes.h5");
}

TEST(ModesFiles, KeepTheMotionOfAFill) {
  const Folder folder;
  ModesFile out = two_modes();
  out.nodes = {Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 1, 1), Vec3(0, 0, 2)};
  for (Mode& mode : out.modes) mode.nodes = NodeMotions::Random(4, 3);
  write_modes(folder / "modes.h5", out);
  const ModesFile in = read_modes(folder / "modes.h5");
  EXPECT_EQ(in.nodes, out.nodes);
  ASSERT_EQ(in.modes.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(in.modes[i].nodes, out.modes[i].nodes);
    EXPECT_EQ(in.modes[i].shape, out.modes[i].shape);
  }
  EXPECT_NE(describe_file(folder / "modes.h5").find("3 blocks, 4 nodes of a fill"), std::string::npos);
}

/// As all were before modes moved a fill.
TEST(ModesFiles, WithoutAFillHaveNoTrailOfIt) {
  const Folder folder;
  write_modes(folder / "modes.h5", two_modes());
  EXPECT_FALSE(h5::File::open(folder / "modes.h5").has("fill/nodes"));
  EXPECT_FALSE(h5::File::open(folder / "modes.h5").has("modes/fill_shape"));
  const ModesFile in = read_modes(folder / "modes.h5");
  EXPECT_TRUE(in.nodes.empty());
  EXPECT_EQ(in.modes[0].nodes.rows(), 0);
}

TEST(ModesFiles, WithoutDampingSayNothingOfIt) {
  const Folder folder;
  ModesFile out = two_modes();
  out.damped.clear();
  write_modes(folder / "modes.h5", out);
  EXPECT_TRUE(read_modes(folder / "modes.h5").damped.empty());
}

TEST(ModesFiles, ThatAreNoneOrDamagedAreRefusedByName) {
  const Folder folder;
  const auto message = [&] { return test::message_of<InputError>([&] { read_modes(folder / "modes.h5"); }); };
  EXPECT_NE(message().find("modes.h5"), std::string::npos) << "there is none";
  folder.write("modes.h5", "not HDF5");
  EXPECT_NE(message().find("modes.h5"), std::string::npos);
  write_modes(folder / "modes.h5", two_modes());
  const std::string whole = test::bytes_of(folder / "modes.h5");
  for (std::size_t at = whole.size() / 10; at < whole.size(); at += whole.size() / 7) {
    std::string cut = whole.substr(0, at);
    test::set_bytes(folder / "modes.h5", cut);
    EXPECT_NE(message(), "") << at;
  }
  {
    h5::File other = h5::File::create(folder / "modes.h5");
    other.set_text("/", "format", "voussoir-history");
    other.set_integer("/", "format_version", 1);
    other.save();
  }
  EXPECT_NE(message().find("voussoir-modes"), std::string::npos) << message();
}

const std::string plain = "[bridge]\ngenerator = \"column\"\n";

TEST(ModalCase, SurvivesResolvingAndChangesNoRun) {
  const std::string text =
      plain +
      "[modal]\nmodes = 4\nstate = \"gravity\"\ngeometric = true\n"
      "[[modal.expected]]\ndirection = \"transverse\"\norder = 2\nperiod = 0.25\nsource = \"site\"\n"
      "[[modal.expected]]\ndirection = \"vertical\"\nperiod = 0.1\n";
  const Case c = parse_case(text, "case.toml", CaseUse::geometry);
  EXPECT_EQ(c.hash, parse_case(plain, "case.toml", CaseUse::geometry).hash);
  const Case copy = parse_case(resolved_text(c), "case.toml", CaseUse::geometry);
  for (const Case* one : {&c, &copy}) {
    EXPECT_EQ(one->settings.modal.modes, 4);
    EXPECT_EQ(one->settings.modal.state, ModalSettings::State::gravity);
    EXPECT_TRUE(one->settings.modal.geometric);
    ASSERT_EQ(one->expected_periods.size(), 2u);
    EXPECT_EQ(one->expected_periods[0].direction, "transverse");
    EXPECT_EQ(one->expected_periods[0].order, 2);
    EXPECT_EQ(one->expected_periods[0].period, 0.25);
    EXPECT_EQ(one->expected_periods[0].source, "site");
    EXPECT_EQ(one->expected_periods[1].order, 1);
  }
}

TEST(ModalCase, WrongKeysSayLineAndRemedy) {
  const auto message = [](const std::string& text) {
    return test::message_of<InputError>([&] { parse_case(plain + text, "c.toml", CaseUse::geometry); });
  };
  const auto holds = [&](const std::string& text, const std::vector<std::string>& pieces) {
    for (const std::string& piece : pieces) EXPECT_NE(message(text).find(piece), std::string::npos) << message(text);
  };
  holds("[modal]\nmodes = 0\n", {"c.toml:4:", "'modes'", "1"});
  holds("[modal]\nmodes = 2.5\n", {"c.toml:4:", "'modes'", "whole number"});
  holds("[modal]\nstate = \"cracked\"\n", {"c.toml:4:", "'state'", "intact", "gravity"});
  holds("[modal]\ngeometric = true\n", {"c.toml:4:", "state = \"gravity\""});
  holds("[modal]\nmode = 3\n", {"c.toml:4:", "'mode'", "modes"});
  holds("[[modal.expected]]\nperiod = 0.3\n", {"c.toml:3:", "direction"});
  holds("[[modal.expected]]\ndirection = \"sideways\"\nperiod = 0.3\n", {"c.toml:4:", "transverse"});
  holds("[[modal.expected]]\ndirection = \"vertical\"\nperiod = 0.0\n", {"c.toml:5:", "'period'", "above 0"});
  holds("[[modal.expected]]\ndirection = \"vertical\"\n", {"c.toml:3:", "period"});
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
