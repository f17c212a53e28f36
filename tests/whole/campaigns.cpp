#include "tests/whole/campaigns.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace voussoir::test {

namespace fs = std::filesystem;

std::vector<std::vector<std::string>> csv_rows(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' && quoted && i + 1 < text.size() && text[i + 1] == '"') {
      rows.back().back() += c, ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      rows.back().emplace_back();
    } else if (c == '\n' && !quoted) {
      rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  rows.pop_back();
  return rows;
}

Rows table_of(const std::string& directory) {
  const auto rows = csv_rows(bytes_of(directory + "/table.csv"));
  Rows table;
  for (std::size_t r = 1; r < rows.size(); ++r) {
    EXPECT_EQ(rows[r].size(), rows[0].size()) << "row " << r;
    for (std::size_t c = 0; c < std::min(rows[r].size(), rows[0].size()); ++c)
      table[rows[r][0]][rows[0][c]] = rows[r][c];
  }
  EXPECT_EQ(table.size() + 1, rows.size()) << "each run once";
  return table;
}

std::string table_but_seconds(const std::string& directory) {
  auto rows = csv_rows(bytes_of(directory + "/table.csv"));
  const auto column = std::find(rows[0].begin(), rows[0].end(), "seconds") - rows[0].begin();
  std::string text;
  for (auto& row : rows) {
    row.erase(row.begin() + column);
    for (const std::string& cell : row) text += "[" + cell + "]";
    text += "\n";
  }
  return text;
}

std::string write_campaign(const Folder& folder, const std::string& name, const std::string& more) {
  write_wall(folder, {.length = 3, .courses = 3});
  folder.write("broken.toml", case_text({.length = 3, .courses = 3, .extra = "[analysis]\ntime_step = 0.5\n"}));
  folder.write("column.toml", R"([bridge]
generator = "column"
blocks = 6
width = 0.5
base_width = 6.0
kn = 1e10
ks = 4e9
[[stage]]
kind = "gravity"
[[stage]]
kind = "motion"
duration = 1.0
pulse = { kind = "sine", axis = "y", amplitude = 1.0, frequency = 1.0 }
[output]
fields_every = 0.0
)");
  return folder.write(name, R"([campaign]
cases = ["wall.toml", "broken.toml", "column.toml"]
scales = [0.1, 1.0]
samples = 1
free_after = 0.3
fields_every = 0.0
[[campaign.sample]]
key = "materials.masonry.density"
distribution = "lognormal"
cov = 0.1
[campaign.fall]
displacement = 0.3
share = 0.2
[[record]]
name = "$(touch pwned) `touch pwned`; touch pwned"
event = "a \"quoted\", 'event'"
pulse = { kind = "rectangular", axis = "x", amplitude = 8.0, length = 1.0 }
[[record]]
name = "../-rf \\ %j\nline"
pulse = { kind = "sine", axis = "y", amplitude = 3.0, frequency = 4.0 }
)" + more);
}

void expect_whole_campaign(const std::string& directory) {
  const Rows table = table_of(directory);
  ASSERT_EQ(table.size(), 12u);
  int collapsed = 0;
  for (const auto& [id, row] : table) {
    EXPECT_EQ(id.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-"),
              std::string::npos);
    EXPECT_TRUE(fs::is_directory(directory + "/runs/" + id)) << id;
    const bool broken = row.at("case") == "broken";
    EXPECT_EQ(row.at("status") == "failed", broken) << id << ": " << row.at("reason");
    EXPECT_EQ(row.at("reason").find("time_step") != std::string::npos, broken) << row.at("reason");
    EXPECT_EQ(row.at("damage.wall.largest_slip").empty(), row.at("case") != "wall");
    EXPECT_FALSE(row.at("material.materials.masonry.density").empty());
    collapsed += row.at("status") == "collapsed";
    if (row.at("status") == "collapsed") {
      EXPECT_NE(row.at("reason").find("of the mass had moved more than 0.3 m"), std::string::npos);
    }
  }
  EXPECT_GE(collapsed, 1);
  EXPECT_EQ(table.at("column__touch-pwned-touch-pwned-touch-pwned__x1__s1").at("status"), "collapsed");
  EXPECT_EQ(table.at("column__rf-j-line__x0.1__s1").at("status"), "done");
  EXPECT_EQ(table.at("column__rf-j-line__x0.1__s1").at("record"), "../-rf \\ %j line");
}

std::string write_long_campaign(const Folder& folder, int records, const std::string& engine) {
  write_wall(folder, {.length = 10, .courses = 8, .shaken = 1.0, .free = 0.1});
  std::string text = "[campaign]\ncases = [\"wall.toml\"]\n";
  for (int i = 1; i <= records; ++i)
    text += fmt::format(
        "[[record]]\nname = \"r{}\"\npulse = {{ kind = \"sine\", axis = \"y\", amplitude = {}, frequency "
        "= 1.0 }}\n",
        i, 2.0 + i);
  return folder.write("long.toml", text + engine);
}

std::vector<int> processes_with(const std::string& word) {
  std::vector<int> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::string arguments = bytes_of(entry.path().string() + "/cmdline");
    for (std::size_t from = 0; from < arguments.size(); from += std::string(arguments.c_str() + from).size() + 1)
      if (arguments.c_str() + from == word) {
        found.push_back(std::stoi(name));
        break;
      }
  }
  return found;
}

}  // namespace voussoir::test
