// voussoir compare.
#include "tools/compare/compare.h"

#include <fmt/format.h>

#include "tools/voussoir/verb.h"

namespace voussoir {

namespace {

int compare(const std::vector<std::string>& arguments) {
  CommandLine line("compare", "compare RESULT RESULT … [-o DIR]", "voussoir compare before after -o retrofit");
  line.described.add_options()("output,o", options::value<std::string>()->value_name("DIR")->default_value("compared"),
                               "folder to write to")("no-pictures", "leave out the pictures");
  line.rest = "RESULT";
  line.required = {"RESULT"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  CompareRequest request;
  request.from = values["RESULT"].as<std::vector<std::string>>();
  request.directory = values["output"].as<std::string>();
  request.pictures = values.count("no-pictures") == 0;
  compare_results(request);
  if (!values.count("quiet")) fmt::print("{0}/compare.html, {0}/compare.csv\n", request.directory);
  return 0;
}

}  // namespace

Verb compare_verb() {
  return {"compare", "put two or more runs, modal analyses or campaigns on one page, with their differences", compare};
}

}  // namespace voussoir
