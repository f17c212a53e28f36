#include "tools/voussoir/html.h"

#include <fmt/format.h>

#include <cmath>

#include "tools/voussoir/svg.h"

namespace voussoir {

std::string paragraph(std::string_view text) {
  return fmt::format("<p>{}</p>\n", escaped(text));
}

std::string note(std::string_view text) {
  return fmt::format("<p class=\"note\">{}</p>\n", escaped(text));
}

std::string heading(std::string_view text) {
  return fmt::format("<h2>{}</h2>\n", escaped(text));
}

std::string figure(const std::string& svg) {
  return svg.empty() ? std::string() : fmt::format("<figure class=\"wide\">{}</figure>\n", svg);
}

std::string list(const std::vector<std::string>& items) {
  std::string text = "<ul>\n";
  for (const std::string& item : items) text += fmt::format("<li>{}</li>\n", escaped(item));
  return text + "</ul>\n";
}

Cell words_cell(std::string_view words) {
  return {escaped(words), false};
}
Cell number_cell(double value, const char* none) {
  return {std::isfinite(value) ? fmt::format("{:.2f}", value) : std::string(none), true};
}

Cell signed_cell(double value) {
  return {fmt::format("{}{:.1f}", value < 0.0 ? "−" : "+", std::abs(value)), true};
}

std::string table_row(const std::vector<Cell>& cells, const char* tag, const char* kind) {
  std::string text = *kind ? fmt::format("<tr class=\"{}\">", kind) : std::string("<tr>");
  for (const Cell& cell : cells)
    text += fmt::format("<{0}{1}>{2}</{0}>", tag, cell.number ? " class=\"number\"" : "", cell.html);
  return text + "</tr>\n";
}

}  // namespace voussoir
