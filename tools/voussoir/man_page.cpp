// Manual pages in the macros of man(7).
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>

#include "solver/base/build_info.h"
#include "tools/voussoir/manual.h"

namespace voussoir {

namespace {

/// Returns the code point that begins at `at` of a text in UTF-8, and moves `at` behind it. An invalid byte is returned
/// as it is.
char32_t code_point(const std::string& text, std::size_t& at) {
  const auto lead = static_cast<unsigned char>(text[at++]);
  const int more = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : lead >= 0xc0 ? 1 : 0;
  char32_t point = more == 0 ? lead : lead & (0x3f >> more);
  for (int i = 0; i < more && at < text.size(); ++i)
    point = point << 6 | (static_cast<unsigned char>(text[at++]) & 0x3f);
  return point;
}

/// Text as roff source: all characters that roff would interpret are escaped.
std::string roff(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const char32_t point = code_point(text, at);
    if (point > 0x7e)
      out += fmt::format("\\[u{:04X}]", std::uint32_t(point));
    else if (point == '\\')
      out += "\\e";
    else if (point == '-' || point == '~' || point == '^' || point == '\'' || point == '`')
      out += point == '-' ? "\\-" : point == '~' ? "\\(ti" : point == '^' ? "\\(ha" : point == '\'' ? "\\(aq" : "\\(ga";
    else
      out += point == '\n' ? ' ' : char(point);
  }
  return out.starts_with('.') ? "\\&" + out : out;
}

/// The argument of a macro, in quotation marks because it may contain spaces.
std::string roff_argument(const std::string& text) {
  std::string out = roff(text);
  for (std::size_t at = 0; (at = out.find('"', at)) != std::string::npos; at += 4) out.replace(at, 1, "\\(dq");
  return '"' + out + '"';
}

std::string page_heading(const std::string& page, const std::string& summary) {
  std::string title = page;
  std::ranges::transform(title, title.begin(), [](unsigned char c) { return char(std::toupper(c)); });
  return fmt::format(".\\\" Made by voussoir manual.\n.TH {} 1 \"\" {} \"Masonry arch bridges\"\n.SH NAME\n{} \\- {}\n",
                     roff_argument(title), roff_argument("voussoir " + program_version()), roff(page), roff(summary));
}

std::string option_paragraph(const ManualOption& option) {
  std::string text = ".TP\n";
  if (!option.brief.empty()) text += fmt::format("\\fB{}\\fR, ", roff(option.brief));
  text += fmt::format("\\fB{}\\fR", roff(option.name));
  if (!option.value.empty()) text += fmt::format(" \\fI{}\\fR", roff(option.value));
  text += '\n' + roff(option.text);
  return text + (option.otherwise.empty() ? "" : roff(" (default: " + option.otherwise + ")")) + '\n';
}

std::string entry_paragraph(const ManualEntry& entry) {
  return fmt::format(".TP\n\\fB{}\\fR(1)\n{}\n", roff(page_name(entry.name)), roff(entry.summary));
}

std::string indented(const std::string& words) {
  return fmt::format(".RS 4\n.nf\n{}\n.fi\n.RE\n", roff(words));
}

const char* const exit_status =
    ".SH \"EXIT STATUS\"\n.TP\n0\nThe work is done.\n.TP\n1\nThe work failed.\n.TP\n2\nThe input is wrong.\n";

}  // namespace

std::string page_name(const std::string& entry) {
  std::string name = entry.empty() ? "voussoir" : "voussoir-" + entry;
  std::ranges::replace(name, ' ', '-');
  return name;
}

std::string entry_page(const ManualEntry& entry) {
  std::string page = page_heading(page_name(entry.name), entry.summary);
  page += fmt::format(".SH SYNOPSIS\n{}\n", roff("voussoir " + entry.usage));
  if (!entry.parts.empty()) page += ".SH PARTS\n";
  for (const ManualEntry& part : entry.parts) page += entry_paragraph(part);
  if (!entry.options.empty()) page += ".SH OPTIONS\n";
  for (const ManualOption& option : entry.options) page += option_paragraph(option);
  if (!entry.example.empty()) page += ".SH EXAMPLES\n" + indented(entry.example);
  page += exit_status;
  return page + ".SH \"SEE ALSO\"\n.BR voussoir (1)\n";
}

std::string program_page(const std::vector<ManualEntry>& entries) {
  std::string page = page_heading(page_name(""), "masonry arch bridges, stone by stone");
  page += ".SH SYNOPSIS\nvoussoir \\fIVERB\\fR \\[u2026]\n.br\nvoussoir \\-\\-help\n.br\nvoussoir \\-\\-version\n";
  page +=
      ".SH DESCRIPTION\nThe program computes masonry arch bridges by the distinct element method. Every stone is a "
      "rigid body, and every joint can open, slide and break. A case is a text file in TOML that describes the bridge, "
      "its materials and what happens to it. A verb is one command of the program. It works on a case or on files that "
      "another verb has written.\n.SH VERBS\n";
  for (const ManualEntry& entry : entries) page += entry_paragraph(entry);
  page +=
      ".SH FILES\nCases, vehicles and tutorials are in\n.I share/voussoir/cases\nnext to the program's folder. The "
      "documentation is in\n.IR share/doc/voussoir .\n";
  return page + exit_status;
}

}  // namespace voussoir
