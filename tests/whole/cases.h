// Small cases that run in about a second, and what their run directories say.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "tests/whole/program.h"

namespace voussoir::test {

/// A dry wall, shaken across until stones slide, rock and meet new neighbours, then left alone for a moment.
struct Wall {
  int length = 6, courses = 6;              // blocks
  double amplitude = 9.0, frequency = 2.0;  // m/s2, Hz; one sine wave
  double shaken = 0.5, free = 0.1;          // s
  double checkpoints = 0.1, fields = 0.2;   // s between them
  double history = 0.005;                   // s
  std::string extra{};                      // more tables
};

std::string case_text(const Wall& wall);

/// The same text with one piece exchanged; throws when the piece is not there, so that no test tests nothing.
std::string exchanged(std::string text, const std::string& piece, const std::string& other);

/// A unit cube of an .obj file as object `name`, its lowest corner at (x, y, z) m; its corners count from `first`.
std::string cube(const std::string& name, double x, double y, double z, int first);

/// Writes the wall's case as NAME.toml into the folder and returns that name.
std::string write_wall(const Folder& folder, const Wall& wall = {}, const std::string& name = "wall.toml");

nlohmann::json summary(const std::string& run_directory);

/// Runs CASE into RUN (both in the folder) without pictures; an ended run is expected.
void run_whole(const Folder& folder, const std::string& case_file, const std::string& run,
               const std::vector<std::string>& more = {});

/// That two finished run directories say the same: end state bit for bit, every number of the summary but times and
/// threads, history and ParaView files byte for byte.
void expect_same_run(const std::string& one, const std::string& other);

/// That a folder still holds what it held, byte for byte.
void expect_unchanged(const std::string& folder, const std::map<std::string, std::string>& before);

/// What the outcome of a refused command must look like: exit status, no signal, and pieces of the message.
void expect_error(const Outcome& outcome, int status, const std::vector<std::string>& pieces);

}  // namespace voussoir::test
