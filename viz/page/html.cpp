#include "viz/page/html.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "viz/page/base64.h"
#include "viz/page/svg.h"

namespace voussoir {

namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light; }
body { margin: 0; background: #fff; color: #1f1f24; font: 15px/1.5 "Helvetica Neue", Arial, "Liberation Sans",
  "DejaVu Sans", sans-serif; }
main { max-width: 1040px; margin: 0 auto; padding: 20px 16px 60px; }
h1 { font-size: 25px; margin: 0 0 4px; }
h2 { font-size: 19px; margin: 38px 0 8px; border-top: 1px solid #c9c9cf; padding-top: 14px; }
h3 { font-size: 15px; margin: 22px 0 6px; }
p, ul { margin: 6px 0 10px; max-width: 78ch; }
.verdict { border-left: 8px solid; padding: 10px 16px; margin: 14px 0; background: #f6f6f8; font-size: 17px; }
.verdict p { margin: 3px 0; max-width: none; }
.found { border-color: #0072b2; } .consistent { border-color: #009e73; } .unexplained { border-color: #d55e00; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 2px 16px; margin: 10px 0; }
dt { font-weight: bold; } dd { margin: 0; overflow-wrap: anywhere; }
figure { margin: 10px 0; }
figcaption { margin-bottom: 4px; overflow-wrap: anywhere; }
.wide { overflow-x: auto; } svg { display: block; } .sheet svg { width: 100%; height: auto; border: 1px solid #dcdce0; }
.many { display: flex; flex-wrap: wrap; gap: 10px 26px; } .many figure { max-width: 100%; min-width: 240px; }
table { border-collapse: collapse; margin: 10px 0; font-size: 14px; }
th, td { padding: 3px 10px 3px 0; text-align: left; vertical-align: top; border-bottom: 1px solid #dcdce0; }
th { vertical-align: bottom; } .number { text-align: right; white-space: nowrap; } td .note { font-size: 12px; }
.note { color: #55555c; } tr.best td { font-weight: bold; background: #eaf3f9; } tr.best td .note { font-weight: normal; }
pre { background: #f6f6f8; padding: 10px 14px; font-size: 13px; line-height: 1.4; overflow-x: auto; }
pre .added { display: block; background: #dcebf6; border-left: 4px solid #0072b2; margin-left: -14px; padding-left: 10px; }
summary { cursor: pointer; margin: 8px 0; }
.pictures { display: grid; grid-template-columns: minmax(0, 1fr); gap: 16px; max-width: 860px; } .pictures img { width: 100%; height: auto; }
.key { display: flex; align-items: center; gap: 8px; font-size: 13px; flex-wrap: wrap; }
@media screen and (max-width: 700px) { table { display: block; overflow-x: auto; } }
pre.case { font-size: 11px; } table.small { font-size: 12px; } code { font-size: 11px; overflow-wrap: anywhere; }
@page { size: A4; margin: 16mm 15mm 18mm; @bottom-right { content: counter(page) " / " counter(pages); font: 8pt sans-serif; color: #55555c; } }
@page sheet { size: A4 landscape; margin: 8mm; }
@media print {
  main { max-width: none; padding: 0; } body { font-size: 10pt; line-height: 1.4; -webkit-print-color-adjust: exact;
    print-color-adjust: exact; }
  figure, tr, .verdict { break-inside: avoid; } h2, h3, figcaption { break-after: avoid; }
  h1 { font-size: 16pt; } h2 { font-size: 13pt; margin-top: 18pt; } h3 { font-size: 11pt; } .verdict { font-size: 11pt; }
  table { font-size: 8.5pt; } table.small, pre.case, code { font-size: 7pt; } .note { font-size: 8.5pt; }
  .sheet { page: sheet; margin: 0; } .sheet svg { border: none; max-height: 190mm; } pre.case { columns: 2; column-gap: 8mm; }
  .pictures { display: block; max-width: none; } svg, img { max-width: 100%; height: auto; } .wide { overflow: visible; } pre { white-space: pre-wrap; }
}
)";

/// Empty if the file is not a readable PNG file.
std::string png_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  return bytes.starts_with("\x89PNG\r\n\x1a\n") ? bytes : std::string();
}

std::string picture(const PagePicture& p) {
  const std::string bytes = png_bytes(p.png);
  const std::string image =
      bytes.empty() ? fmt::format("<p class=\"note\">{} is left out, because it cannot be read as a PNG picture</p>",
                                  escaped(p.png))
                    : fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", escaped(p.title), base64(bytes));
  return fmt::format("<figure><figcaption><strong>{}</strong><br>{}</figcaption>{}</figure>\n", escaped(p.title),
                     escaped(p.caption), image);
}

}  // namespace

std::string pictures_section(const std::vector<PagePicture>& pictures, std::string_view title) {
  if (pictures.empty()) return "";
  std::string text = heading(title) + "<div class=\"pictures\">\n";
  for (const PagePicture& p : pictures) text += picture(p);
  return text + "</div>\n";
}

std::string html_page(std::string_view title, std::string_view body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0}</title>\n"
      "<style>{1}</style>\n</head>\n<body>\n<main>\n<h1>{0}</h1>\n{2}</main>\n</body>\n</html>\n",
      escaped(title), kStyle, body);
}

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

std::string sheet_figure(std::string_view svg) {
  const std::size_t begin = svg.find("<svg");
  if (begin == std::string_view::npos) return "";
  return fmt::format("<figure class=\"sheet\">{}</figure>\n", svg.substr(begin));
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

Cell formatted_cell(double value, const char* format) {
  if (!std::isfinite(value)) return {"none", true};
  std::string text = fmt::format(fmt::runtime(format), value);
  // A value that rounds to zero has no sign.
  if (text.starts_with('-') && text.find_first_of("123456789") == std::string::npos) text.erase(0, 1);
  return {text, true};
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
