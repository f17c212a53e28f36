// Pieces of an HTML page. Words are escaped, what is called html or svg is not.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace voussoir {

std::string paragraph(std::string_view words);
/// Smaller, below what it explains.
std::string note(std::string_view words);
std::string heading(std::string_view words);
/// Empty for an empty drawing.
std::string figure(const std::string& svg);
/// A drawing as wide as the page, on paper a landscape sheet of its own; empty for what is no SVG.
std::string sheet_figure(std::string_view svg);
std::string list(const std::vector<std::string>& items);

struct Cell {
  std::string html;
  bool number = false;  // to the right
};
Cell words_cell(std::string_view words);
/// Two decimals; `none` where it is not finite.
Cell number_cell(double value, const char* none = "none");
/// As `format` has it: "{:.3f}"; "none" where it is not finite.
Cell formatted_cell(double value, const char* format);
/// "+1.2".
Cell signed_cell(double value);
/// `tag` is td or th; `kind` the class of the row, may be empty.
std::string table_row(const std::vector<Cell>& cells, const char* tag, const char* kind = "");

/// A PNG file that the page holds itself.
struct PagePicture {
  std::string title, caption, png;
};
/// One below the other at full width, so that their legends can be read on paper too, under a heading; empty without
/// pictures. A file that is no PNG is said in its place.
std::string pictures_section(const std::vector<PagePicture>& pictures, std::string_view title = "Pictures");

/// A self-contained page around html: no scripts, nothing from elsewhere.
std::string html_page(std::string_view title, std::string_view body);

}  // namespace voussoir
