// Manual pages and completion of the command line, made from the same descriptions as the text of --help.
#pragma once
#include <string>
#include <vector>

#include "tools/voussoir/verb.h"

namespace voussoir {

struct ManualOption {
  std::string brief, name;  // "-o" (empty: none), "--output"
  std::string value;        // "DIR"; empty: it takes none
  std::string text;         // description
  std::string otherwise;    // default value as --help prints it; may be empty
};

/// The manual's description of a verb or of a part of a verb.
struct ManualEntry {
  std::string name;     // "run", "motion info"
  std::string summary;  // one line
  std::string usage;    // without the program's name
  std::string example;
  std::vector<ManualOption> options;
  std::vector<ManualEntry> parts;
};

/// The entries of the listed verbs, in their order, with their parts.
std::vector<ManualEntry> manual_entries();
/// A flat list of the entries and their parts. Each entry comes before its parts.
std::vector<ManualEntry> with_parts(const std::vector<ManualEntry>& entries);

/// Name of the page of an entry, such as "voussoir-motion-info". An empty entry gives the page of the program.
std::string page_name(const std::string& entry);
/// Source of the manual page of an entry, in the macros of man(7). Characters outside ASCII are written as escapes.
std::string entry_page(const ManualEntry& entry);
/// Source of the manual page of the program, which lists the entries.
std::string program_page(const std::vector<ManualEntry>& entries);

/// A script for bash that completes verbs, parts, options and file names.
std::string bash_completion(const std::vector<ManualEntry>& entries);

}  // namespace voussoir
