// voussoir info.
#include <fmt/format.h>

#include "io/info/describe_file.h"
#include "tools/voussoir/verb.h"

namespace voussoir {

namespace {

int info(const std::vector<std::string>& arguments) {
  CommandLine line("info", "info FILE", "voussoir info demo");
  line.positional = line.required = {"FILE"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  fmt::print("{}\n", describe_file(values["FILE"].as<std::string>()));
  return 0;
}

}  // namespace

Verb info_verb() {
  return {"info", "say what a case, assembly, checkpoint, history or record file holds", info};
}

}  // namespace voussoir
