// voussoir manual: for the installation, which calls it.
#include "tools/voussoir/manual.h"

#include <fmt/format.h>

#include "solver/base/atomic_file.h"
#include "solver/base/folder.h"

namespace voussoir {

namespace {

ManualOption manual_option(const options::option_description& option) {
  using namespace options::command_line_style;
  ManualOption found;
  found.name = "--" + option.long_name();
  const std::string brief = option.canonical_display_name(allow_dash_for_short);
  if (brief != option.long_name() && brief.size() == 2) found.brief = brief;
  found.text = option.description();
  if (option.semantic()->max_tokens() == 0) return found;
  // The text is "WORD (=lz4)" if there is a default.
  const std::string value = option.format_parameter();
  const std::size_t at = value.find(" (=");
  found.value = value.substr(0, at);
  if (at != std::string::npos) found.otherwise = value.substr(at + 3, value.size() - at - 4);
  return found;
}

ManualEntry manual_entry(const Verb& verb, const std::string& of) {
  ManualEntry entry;
  entry.name = of + verb.name;
  entry.summary = verb.summary;
  if (!verb.parts.empty()) {
    entry.usage = entry.name + " PART …";
    for (const Verb& part : verb.parts) entry.parts.push_back(manual_entry(part, entry.name + " "));
    return entry;
  }
  const CommandLine line = command_line_of(verb);
  entry.usage = line.usage;
  entry.example = line.example;
  for (const auto& option : line.described.options()) entry.options.push_back(manual_option(*option));
  return entry;
}

int manual(const std::vector<std::string>& arguments) {
  CommandLine line("manual", "manual DIR", "voussoir manual build/manual");
  line.positional = line.required = {"DIR"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const std::string folder = values["DIR"].as<std::string>();
  const auto write = [&](const std::string& path, const std::string& text) {
    make_folder_of(folder + "/" + path);
    write_atomically(folder + "/" + path, text);
  };
  const std::vector<ManualEntry> entries = manual_entries();
  write("man1/" + page_name("") + ".1", program_page(entries));
  for (const ManualEntry& entry : with_parts(entries)) write("man1/" + page_name(entry.name) + ".1", entry_page(entry));
  write("completions/voussoir", bash_completion(entries));
  return 0;
}

}  // namespace

std::vector<ManualEntry> manual_entries() {
  std::vector<ManualEntry> entries;
  for (const Verb& verb : verbs())
    if (!verb.summary.empty()) entries.push_back(manual_entry(verb, ""));
  return entries;
}

std::vector<ManualEntry> with_parts(const std::vector<ManualEntry>& entries) {
  std::vector<ManualEntry> all;
  for (const ManualEntry& entry : entries) {
    all.push_back(entry);
    for (const ManualEntry& part : with_parts(entry.parts)) all.push_back(part);
  }
  return all;
}

Verb manual_verb() {
  return {"manual", "", manual};
}

}  // namespace voussoir
