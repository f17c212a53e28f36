#include "tools/blind/invariance.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace voussoir {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Row = std::vector<std::string>;

/// A table as our own writer writes it: no cell is quoted.
std::vector<Row> read_rows(const fs::path& file) {
  std::vector<Row> rows;
  std::ifstream text(file);
  for (std::string line; std::getline(text, line);) {
    rows.emplace_back();
    std::string cell;
    for (const char c : line)
      if (c == ',')
        rows.back().push_back(std::move(cell)), cell.clear();
      else
        cell += c;
    rows.back().push_back(cell);
  }
  return rows;
}

void write_rows(const std::vector<Row>& rows, const fs::path& file) {
  fs::create_directories(file.parent_path());
  std::ofstream text(file);
  for (const Row& row : rows) text << fmt::format("{}\n", fmt::join(row, ","));
}

/// Changes the numbers in a column; empty cells stay.
template <class F>
void change_column(std::vector<Row>& rows, std::size_t column, F&& change) {
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (!rows[i][column].empty()) rows[i][column] = change(std::stod(rows[i][column]));
}

std::string four_digits(double x) {
  return fmt::format("{:.3e}", x);
}
std::string times_thousand(double x) {
  return fmt::format("{}", 1000.0 * x);
}
std::string in_g(double x) {
  return fmt::format("{}", x / 9.80665);
}

/// mode,period,period_std,damping,damping_std,direction.
void copy_modes(std::vector<Row> rows, Copy copy, const fs::path& file) {
  if (copy == Copy::rounded)
    for (const std::size_t column : {1, 2, 3, 4}) change_column(rows, column, four_digits);
  if (copy == Copy::reordered) std::reverse(rows.begin() + 1, rows.end());
  if (copy == Copy::other_unit) {
    rows[0][1] = "frequency", rows[0][2] = "frequency_std";
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const double period = std::stod(rows[i][1]);
      rows[i][1] = fmt::format("{}", 1.0 / period);
      if (!rows[i][2].empty()) rows[i][2] = fmt::format("{}", std::stod(rows[i][2]) / (period * period));
    }
  }
  write_rows(rows, file);
}

/// mode,sensor,value,std.
void copy_shapes(std::vector<Row> rows, Copy copy, const fs::path& file) {
  for (const std::size_t column : {2, 3}) {
    if (copy == Copy::rounded) change_column(rows, column, four_digits);
    if (copy == Copy::scaled) change_column(rows, column, times_thousand);
  }
  if (copy == Copy::reordered) std::reverse(rows.begin() + 1, rows.end());
  write_rows(rows, file);
}

/// t and a column a channel. The ground's motion stays in m/s2, its unit in any file.
void copy_record(std::vector<Row> rows, Copy copy, const fs::path& file) {
  for (std::size_t column = 1; column < rows[0].size(); ++column) {
    if (copy == Copy::rounded) change_column(rows, column, four_digits);
    if (copy == Copy::scaled) change_column(rows, column, times_thousand);
    if (copy == Copy::other_unit && !rows[0][column].starts_with("base_")) change_column(rows, column, in_g);
  }
  if (copy == Copy::reordered)
    for (Row& row : rows) std::reverse(row.begin() + 1, row.end());
  write_rows(rows, file);
}

void copy_sensors(std::vector<Row> rows, Copy copy, bool recorded, const fs::path& file) {
  if (copy == Copy::reordered) std::reverse(rows.begin() + 1, rows.end());
  if (copy == Copy::other_unit && recorded)
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].push_back(i == 0 ? "unit" : "g");
  write_rows(rows, file);
}

std::string named(const json& d) {
  if (d.is_null()) return "failed";
  std::string text = d["verdict"];
  for (const json& e : d["effects"])
    text += fmt::format("; {} at {}", e["name"].get<std::string>(), e["where"].get<std::string>());
  return text;
}

/// The largest difference between the values of effects that both name, in standard deviations.
double change_of_values(const json& one, const json& other) {
  double most = 0.0;
  if (one.is_null() || other.is_null()) return most;
  for (const json& e : one["effects"])
    for (const json& f : other["effects"]) {
      if (e["name"] != f["name"] || e["where"] != f["where"]) continue;
      for (const auto& [name, value] : e["parameters"].items()) {
        const double std = value["std"].get<double>();
        if (std > 0.0 && f["parameters"].contains(name))
          most = std::max(most,
                          std::abs(f["parameters"][name]["value"].get<double>() - value["value"].get<double>()) / std);
      }
    }
  return most;
}

}  // namespace

const std::vector<std::string>& copy_names() {
  static const std::vector<std::string> names = {"rounded", "scaled", "reordered", "other unit"};
  return names;
}

void write_copy(const std::string& measured, Copy copy, const std::string& folder) {
  const fs::path from = measured, to = folder;
  fs::remove_all(to);
  fs::create_directories(to);
  const bool recorded = fs::exists(from / "records");
  if (fs::exists(from / "about.toml")) fs::copy_file(from / "about.toml", to / "about.toml");
  if (fs::exists(from / "sensors.csv"))
    copy_sensors(read_rows(from / "sensors.csv"), copy, recorded, to / "sensors.csv");
  if (fs::exists(from / "modes.csv")) copy_modes(read_rows(from / "modes.csv"), copy, to / "modes.csv");
  if (fs::exists(from / "shapes.csv")) copy_shapes(read_rows(from / "shapes.csv"), copy, to / "shapes.csv");
  if (!recorded) return;
  for (const auto& entry : fs::directory_iterator(from / "records"))
    copy_record(read_rows(entry.path()), copy, to / "records" / entry.path().filename());
}

Invariance compare_copies(const BlindTrial& trial, std::size_t number, const json& diagnosis,
                          const std::string& program, const std::string& folder) {
  Invariance result{number, named(diagnosis), {}, 0.0};
  for (std::size_t i = 0; i < copy_names().size(); ++i) {
    const std::string own = fmt::format("{}/copies/{}", folder, i);
    write_copy(folder + "/seen/measured", Copy(i), own + "/measured");
    const json d =
        diagnose(trial, program, folder + "/seen/case.toml", own + "/measured", own + "/said", own + "/log.txt");
    result.copies.push_back(named(d));
    result.change = std::max(result.change, change_of_values(diagnosis, d));
  }
  return result;
}

std::string invariance_table(const std::vector<Invariance>& all) {
  std::string text = "| # | said |";
  for (const std::string& name : copy_names()) text += fmt::format(" {} |", name);
  text += " values change by at most |\n| --- | --- |" + std::string(" --- | --- | --- | --- | --- |\n");
  std::size_t copies = 0, same = 0;
  for (const Invariance& i : all) {
    text += fmt::format("| {} | {} |", i.number, i.said);
    for (const std::string& copy : i.copies) {
      ++copies, same += copy == i.said;
      text += fmt::format(" {} |", copy == i.said ? "the same" : copy);
    }
    text += fmt::format(" {:.2g} std |\n", i.change);
  }
  return text + fmt::format("\n{} of {} copies have the same result\n", same, copies);
}

}  // namespace voussoir
