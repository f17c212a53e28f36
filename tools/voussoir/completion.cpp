// Completion for bash.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "tools/voussoir/manual.h"

namespace voussoir {

namespace {

/// Values of options that are names of files or folders; the others are numbers and words.
const std::set<std::string> names_of_files = {"FILE", "DIR", "OUT", "STEM", "PNG", "ASSEMBLY", "MODES.H5"};

std::vector<std::string> names_of(const std::vector<ManualEntry>& entries) {
  std::vector<std::string> names;
  for (const ManualEntry& entry : entries) names.push_back(entry.name.substr(entry.name.rfind(' ') + 1));
  return names;
}

/// "--threads|-j": options as the patterns of a case in bash; "" if there are none.
std::string patterns_of_other_values(const ManualEntry& entry) {
  std::vector<std::string> patterns;
  for (const ManualOption& option : entry.options) {
    if (option.value.empty() || names_of_files.contains(option.value)) continue;
    patterns.push_back(option.name);
    if (!option.brief.empty()) patterns.push_back(option.brief);
  }
  return fmt::format("{}", fmt::join(patterns, "|"));
}

std::string branch_of(const ManualEntry& entry) {
  if (!entry.parts.empty())
    return fmt::format("    {}) words='{} --help' ;;\n", entry.name, fmt::join(names_of(entry.parts), " "));
  std::vector<std::string> words;
  for (const ManualOption& option : entry.options) words.push_back(option.name);
  const std::string others = patterns_of_other_values(entry);
  return fmt::format("    '{}')\n      words='{}'\n{}      ;;\n", entry.name, fmt::join(words, " "),
                     others.empty() ? "" : fmt::format("      case $before in {}) return ;; esac\n", others));
}

/// "motion|…": the verbs whose next word is a part.
std::string patterns_of_verbs_with_parts(const std::vector<ManualEntry>& entries) {
  std::vector<std::string> names;
  for (const ManualEntry& entry : entries)
    if (!entry.parts.empty()) names.push_back(entry.name);
  return names.empty() ? "''" : fmt::format("{}", fmt::join(names, "|"));
}

}  // namespace

std::string bash_completion(const std::vector<ManualEntry>& entries) {
  std::string branches;
  for (const ManualEntry& entry : with_parts(entries)) branches += branch_of(entry);
  return fmt::format(R"(# Completion of voussoir for bash. Made by voussoir manual.
_voussoir() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} verb=${{COMP_WORDS[1]}} words=
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W '{} --help --version' -- "$word")
    return
  fi
  case $verb in
    {}) [ "$COMP_CWORD" -gt 2 ] && verb+=" ${{COMP_WORDS[2]}}" ;;
  esac
  case $verb in
{}  esac
  if [[ $word == -* || $words != -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
    return
  fi
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -f -- "$word")
}}
complete -F _voussoir voussoir
)",
                     fmt::join(names_of(entries), " "), patterns_of_verbs_with_parts(entries), branches);
}

}  // namespace voussoir
