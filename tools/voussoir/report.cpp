// voussoir report.
#include <fmt/format.h>

#include <filesystem>

#include "tools/campaign/campaign_page.h"
#include "tools/run/run_page.h"
#include "tools/voussoir/verb.h"

namespace voussoir {

namespace {

int report(const std::vector<std::string>& arguments) {
  CommandLine line("report", "report DIR", "voussoir report demo");
  line.positional = line.required = {"DIR"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const std::string directory = values["DIR"].as<std::string>();
  std::error_code ignored;
  if (std::filesystem::exists(directory + "/table.csv", ignored))
    write_campaign_page(directory);
  else
    write_run_page(directory);
  if (!values.count("quiet")) fmt::print("{}/report.html\n", directory);
  return 0;
}

}  // namespace

Verb report_verb() {
  return {"report", "the page of a run or a campaign, made again from its files", report};
}

}  // namespace voussoir
