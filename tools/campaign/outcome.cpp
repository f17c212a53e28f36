#include "tools/campaign/outcome.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "solver/base/json_file.h"
#include "tools/campaign/json.h"

namespace voussoir::campaign {

namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 4> names = {"done", "collapsed", "failed", "missing"};

std::string file_of(const std::string& directory, const PlannedRun& run) {
  return folder_of(directory, run) + "/outcome.json";
}

std::string hash_of(const PlannedRun& run) {
  return fmt::format("{:016x}", run.hash);
}

/// The reason as one line without the name of the folder, so that the table of a campaign does not depend on its
/// folder.
std::string tidy(std::string text, const std::string& directory) {
  for (std::size_t at = text.find(directory + "/"); at != std::string::npos; at = text.find(directory + "/"))
    text.erase(at, directory.size() + 1);
  std::string line;
  for (const char c : text) {
    const bool blank = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    if (!blank)
      line += c;
    else if (!line.empty() && line.back() != ' ')
      line += ' ';
  }
  return line;
}

}  // namespace

Outcome read_outcome(const std::string& directory, const PlannedRun& run) {
  Outcome outcome;
  std::error_code ignored;
  outcome.begun = fs::exists(folder_of(directory, run) + "/case.toml", ignored);
  outcome.reason = outcome.begun ? "begun, not ended" : "not begun";
  const json j = json_if_any(file_of(directory, run));
  if (!j.is_object() || j.value("hash", "") != hash_of(run)) return outcome;
  const auto found =
      std::ranges::find(names, j.value("status", ""), [](const char* name) { return std::string(name); });
  if (found == names.end()) return outcome;
  outcome.status = Status(found - names.begin());
  outcome.reason = j.value("reason", "");
  outcome.seconds = j.value("seconds", 0.0);
  outcome.goes_on = j.value("goes_on", false);
  return outcome;
}

void write_outcome(const std::string& directory, const PlannedRun& run, Outcome outcome) {
  const json j = {{"format", "voussoir-outcome"},
                  {"format_version", 1},
                  {"program_version", VOUSSOIR_VERSION},
                  {"hash", hash_of(run)},
                  {"status", run_status_name(outcome.status)},
                  {"reason", tidy(outcome.reason, directory)},
                  {"seconds", outcome.seconds},
                  {"goes_on", outcome.goes_on}};
  std::error_code ignored;  // the next line reports a folder that cannot be made
  fs::create_directories(folder_of(directory, run), ignored);
  write_json(file_of(directory, run), j, 1);
}

std::size_t forget_failures(const std::string& directory, const Plan& plan) {
  std::size_t count = 0;
  for (const PlannedRun& run : plan.runs) {
    const Outcome outcome = read_outcome(directory, run);
    if (outcome.status != Status::failed) continue;
    ++count;
    std::error_code failed;
    // The case file is removed first. Without it the run cannot be continued, even if the removal is interrupted.
    if (!outcome.goes_on)
      for (const char* name :
           {"case.toml", "assembly.h5", "history.h5", "checkpoints", "vtk", "images", "summary.json"})
        if (fs::remove_all(folder_of(directory, run) + "/" + name, failed); failed)
          throw RunError("{}/{} cannot be removed: {}", folder_of(directory, run), name, failed.message());
    if (fs::remove(file_of(directory, run), failed); failed)
      throw RunError("{} cannot be removed: {}", file_of(directory, run), failed.message());
  }
  return count;
}

void count(Tally& t, Status status) {
  switch (status) {
    case Status::done:
      ++t.done;
      break;
    case Status::collapsed:
      ++t.collapsed;
      break;
    case Status::failed:
      ++t.failed;
      break;
    case Status::missing:
      ++t.missing;
      break;
  }
}

Tally tally(const std::string& directory, const Plan& plan) {
  Tally t;
  for (const PlannedRun& run : plan.runs) count(t, read_outcome(directory, run).status);
  return t;
}

}  // namespace voussoir::campaign
