#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "solver/base/error.h"
#include "solver/base/parallel.h"
#include "solver/base/shown.h"
#include "tools/voussoir/options.h"

namespace voussoir {

namespace {

// An argument that no user can give, because it holds a null character. A verb that receives it throws its command
// line.
const std::string describe_yourself(1, '\0');

}  // namespace

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> list = {
      generate_verb(), import_verb(), export_verb(),  info_verb(),     run_verb(),          resume_verb(),
      modal_verb(),    render_verb(), check_verb(),   step_verb(),     effects_verb(),      diagnose_verb(),
      hide_verb(),     motion_verb(), report_verb(),  campaign_verb(), campaign_run_verb(), fragility_verb(),
      vehicles_verb(), rate_verb(),   compare_verb(), cracks_verb(),   view_verb(),         manual_verb()};
  return list;
}

CommandLine::CommandLine(std::string verb_name, std::string usage_text, std::string example_text)
    : verb(std::move(verb_name)), usage(std::move(usage_text)), example(std::move(example_text)) {
  described.add_options()("help,h", "print this help")(
      "threads,j", whole_option("threads", 1, std::numeric_limits<int>::max())->value_name("N"),
      "number of threads (default: all that the machine offers)")("quiet,q", "print no progress and no tables");
}

bool CommandLine::parse(const std::vector<std::string>& arguments, options::variables_map& values) {
  if (arguments == std::vector{describe_yourself}) throw CommandLine(*this);
  options::positional_options_description places;
  options::options_description all;
  all.add(described);
  options::options_description hidden;
  for (const std::string& name : positional) {
    hidden.add_options()(name.c_str(), options::value<std::string>());
    places.add(name.c_str(), 1);
  }
  if (!rest.empty()) {
    hidden.add_options()(rest.c_str(), options::value<std::vector<std::string>>());
    places.add(rest.c_str(), -1);
  }
  all.add(hidden);
  try {
    options::store(options::command_line_parser(arguments).options(all).positional(places).run(), values);
    options::notify(values);
  } catch (const options::error& e) {
    throw InputError("{}. See voussoir {} --help", shown(e.what(), 200), verb);
  }
  if (values.count("help")) {
    std::ostringstream list;
    list << described;
    fmt::print("Usage: voussoir {}\n\n{}\nExample: {}\n", usage, list.str(), example);
    return false;
  }
  for (const std::string& name : required) {
    const bool has_place = name == rest || std::ranges::count(positional, name) > 0;
    if (!values.count(name))
      throw InputError("{}{} is missing. Usage: voussoir {}", has_place ? "" : "--", name, usage);
  }
  return true;
}

CommandLine command_line_of(const Verb& verb) {
  try {
    verb.run({describe_yourself});
  } catch (const CommandLine& line) {
    return line;
  }
  throw RunError("the verb {} does not describe its options", verb.name);
}

std::vector<std::string> words_in(const std::string& list) {
  std::vector<std::string> found;
  std::string word;
  for (char c : list + ",") {
    if (c != ',') {
      word += c;
      continue;
    }
    if (!word.empty() && word != "none") found.push_back(word);
    word.clear();
  }
  return found;
}

int threads_asked(const options::variables_map& values) {
  return values.count("threads") ? std::min(values["threads"].as<int>(), 1024) : available_threads();
}

}  // namespace voussoir
