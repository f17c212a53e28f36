// voussoir report.
#include <fmt/format.h>

#include <filesystem>

#include "solver/base/error.h"
#include "tools/campaign/campaign_page.h"
#include "tools/run/run_page.h"
#include "tools/voussoir/verb.h"
#include "viz/page/print_page.h"

namespace voussoir {

namespace {

/// Prints an existing page as a PDF beside it.
void print_beside(const std::string& page, bool says) {
  const std::string pdf = page.substr(0, page.rfind('.')) + ".pdf";
  print_page(page, pdf);
  if (says) fmt::print("{}\n", pdf);
}

int report(const std::vector<std::string>& arguments) {
  CommandLine line("report", "report DIR|PAGE.html [--pdf]", "voussoir report demo --pdf");
  line.described.add_options()("pdf", "also print the page as a PDF in the same folder (needs Chromium)");
  line.positional = line.required = {"DIR"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const std::string from = values["DIR"].as<std::string>();
  const bool says = !values.count("quiet"), prints = values.count("pdf") > 0;
  std::error_code ignored;
  if (from.ends_with(".html")) {  // of any verb
    if (!std::filesystem::exists(from, ignored)) throw InputError("there is no file {}", from);
    if (!prints) throw InputError("{} is a page already. Give --pdf to print it", from);
    print_beside(from, says);
    return 0;
  }
  if (std::filesystem::exists(from + "/table.csv", ignored))
    write_campaign_page(from);
  else
    write_run_page(from);
  if (says) fmt::print("{}/report.html\n", from);
  if (prints) print_beside(from + "/report.html", says);
  return 0;
}

}  // namespace

Verb report_verb() {
  return {"report", "write the page of a run or a campaign again from its files, also as a PDF", report};
}

}  // namespace voussoir
