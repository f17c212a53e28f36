// Pieces of an HTML page. Texts are escaped; arguments named html or svg are not.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace voussoir {

std::string paragraph(std::string_view words);
/// A note in smaller letters below the item it explains.
std::string note(std::string_view words);
std::string heading(std::string_view words);
/// Empty for an empty drawing.
std::string figure(const std::string& svg);
/// A drawing as wide as the page; in print it has its own landscape sheet. Empty if it is not SVG.
std::string sheet_figure(std::string_view svg);
std::string list(const std::vector<std::string>& items);

struct Cell {
  std::string html;
  bool number = false;  // to the right
};
Cell words_cell(std::string_view words);
/// The value with two decimals; `none` if it is not finite.
Cell number_cell(double value, const char* none = "none");
/// The value in the given format, "{:.3f}"; "none" if it is not finite.
Cell formatted_cell(double value, const char* format);
/// "+1.2".
Cell signed_cell(double value);
/// `tag` is td or th; `kind` is the class of the row and may be empty.
std::string table_row(const std::vector<Cell>& cells, const char* tag, const char* kind = "");

/// A PNG file that is embedded in the page.
struct PagePicture {
  std::string title, caption, png;
};
/// Pictures below one another at full width, so that their legends are readable on paper too, under a heading; empty
/// without pictures. If a file is not PNG, a note replaces it.
std::string pictures_section(const std::vector<PagePicture>& pictures, std::string_view title = "Pictures");

/// A self-contained page around html, without scripts and external files.
std::string html_page(std::string_view title, std::string_view body);

}  // namespace voussoir
