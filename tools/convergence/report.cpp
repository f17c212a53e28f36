#include "tools/convergence/report.h"

#include <fmt/format.h>

#include <cmath>

namespace voussoir {

namespace {

std::string row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

}  // namespace

std::string markdown(const Study& study) {
  std::string text = "## " + study.title + "\n";
  for (const Table& table : study.tables) {
    text += "\n" + table.caption + "\n\n" + row(table.columns);
    text += row(std::vector<std::string>(table.columns.size(), "---"));
    for (const auto& cells : table.rows) text += row(cells);
  }
  return text;
}

double measured_order(double error1, double error2, double h1, double h2) {
  return std::log(std::abs(error1 / error2)) / std::log(h1 / h2);
}

std::string order_text(double order) {
  return std::isfinite(order) ? fmt::format("{:.2f}", order) : "";
}

std::string percent(double error) {
  const double value = 100.0 * error, size = std::abs(value);
  if (size < 1e-6) return "0 %";
  const int places = std::min(6, std::max(0, 2 - int(std::floor(std::log10(size)))));
  return fmt::format("{:+.{}f} %", value, places);
}

}  // namespace voussoir
