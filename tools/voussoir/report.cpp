// voussoir report.
#include <fmt/format.h>

#include <filesystem>

#include "tools/campaign/campaign_page.h"
#include "tools/run/run_page.h"
#include "tools/voussoir/verb.h"
#include "viz/page/print_page.h"

namespace voussoir {

namespace {

int report(const std::vector<std::string>& arguments) {
  CommandLine line("report", "report DIR [--pdf]", "voussoir report demo --pdf");
  line.described.add_options()("pdf", "print the page as DIR/report.pdf, too (by Chromium)");
  line.positional = line.required = {"DIR"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const std::string directory = values["DIR"].as<std::string>();
  std::error_code ignored;
  if (std::filesystem::exists(directory + "/table.csv", ignored))
    write_campaign_page(directory);
  else
    write_run_page(directory);
  const bool says = !values.count("quiet");
  if (says) fmt::print("{}/report.html\n", directory);
  if (!values.count("pdf")) return 0;
  print_page(directory + "/report.html", directory + "/report.pdf");
  if (says) fmt::print("{}/report.pdf\n", directory);
  return 0;
}

}  // namespace

Verb report_verb() {
  return {"report", "the page of a run or a campaign, made again from its files; as a PDF, too", report};
}

}  // namespace voussoir
