#include "tests/whole/cases.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

#include "solver/base/json_file.h"

namespace voussoir::test {

std::string case_text(const Wall& wall) {
  return fmt::format(R"([bridge]
generator = "wall"
length_blocks = {}
courses = {}

[[stage]]
kind = "gravity"

[[stage]]
kind = "motion"
duration = {}
pulse = {{ kind = "sine", axis = "y", amplitude = {}, frequency = {} }}

[[stage]]
kind = "free"
duration = {}

[[sensor]]
id = "foot"
position = [0.3, 0.0, 0.25]
direction = "y"

[output]
checkpoint_every = {}
fields_every = {}
history_every = {}
{})",
                     wall.length, wall.courses, wall.shaken, wall.amplitude, wall.frequency, wall.free,
                     wall.checkpoints, wall.fields, wall.history, wall.extra);
}

std::string exchanged(std::string text, const std::string& piece, const std::string& other) {
  const std::size_t at = text.find(piece);
  if (at == std::string::npos) throw std::logic_error("the text has no '" + piece + "'");
  return text.replace(at, piece.size(), other);
}

std::string cube(const std::string& name, double x, double y, double z, int first) {
  std::string text = "o " + name + "\n";
  for (const auto& [dx, dy, dz] :
       {std::array{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}})
    text += fmt::format("v {} {} {}\n", x + dx, y + dy, z + dz);
  for (const auto& f : {std::array{4, 3, 2, 1}, {5, 6, 7, 8}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 4, 8, 7}, {4, 1, 5, 8}})
    text += fmt::format("f {} {} {} {}\n", f[0] + first - 1, f[1] + first - 1, f[2] + first - 1, f[3] + first - 1);
  return text;
}

std::string write_wall(const Folder& folder, const Wall& wall, const std::string& name) {
  folder.write(name, case_text(wall));
  return name;
}

nlohmann::json summary(const std::string& run_directory) {
  return read_json(run_directory + "/summary.json");
}

void run_whole(const Folder& folder, const std::string& case_file, const std::string& run,
               const std::vector<std::string>& more) {
  std::vector<std::string> words = {"run", case_file, "-o", run, "--no-pictures"};
  words.insert(words.end(), more.begin(), more.end());
  const Outcome outcome = voussoir(words, {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
}

namespace {

/// The summary without what may differ between equal runs.
nlohmann::json essence(const std::string& run_directory) {
  nlohmann::json json = summary(run_directory);
  json.erase("wall_seconds");
  json.erase("seconds_of_this_part");
  json.erase("threads");
  json.erase("provenance");  // the day
  return json;
}

}  // namespace

void expect_same_run(const std::string& one, const std::string& other) {
  EXPECT_EQ(essence(one), essence(other));
  EXPECT_TRUE(bytes_of(one + "/history.h5") == bytes_of(other + "/history.h5")) << "histories differ";
  expect_unchanged(other + "/vtk", contents(one + "/vtk"));
}

void expect_unchanged(const std::string& folder, const std::map<std::string, std::string>& before) {
  const auto after = contents(folder);
  for (const auto& [name, bytes] : before)
    EXPECT_TRUE(after.contains(name) && after.at(name) == bytes) << name << " was changed or removed";
  for (const auto& [name, bytes] : after) EXPECT_TRUE(before.contains(name)) << name << " is new";
}

void expect_error(const Outcome& outcome, int status, const std::vector<std::string>& pieces) {
  EXPECT_EQ(outcome.signal, 0) << "it crashed; it had said:\n" << outcome.err;
  EXPECT_FALSE(outcome.timed_out) << outcome.err;
  EXPECT_EQ(outcome.status, status) << outcome.err;
  EXPECT_EQ(outcome.err.find("fault of the program"), std::string::npos) << outcome.err;
  for (const std::string& piece : pieces)
    EXPECT_NE(outcome.err.find(piece), std::string::npos) << "'" << piece << "' is not in: " << outcome.err;
}

}  // namespace voussoir::test
