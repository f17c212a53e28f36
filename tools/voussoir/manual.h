// The manual pages and the completion of the command line, made from what --help prints from.
#pragma once
#include <string>
#include <vector>

#include "tools/voussoir/verb.h"

namespace voussoir {

struct ManualOption {
  std::string brief, name;  // "-o" (empty: none), "--output"
  std::string value;        // "DIR"; empty: it takes none
  std::string text;         // what it does
  std::string otherwise;    // its value where it is not given, as --help says it; may be empty
};

/// What the manual says of a verb, or of a part of one.
struct ManualEntry {
  std::string name;     // "run", "motion info"
  std::string summary;  // one line
  std::string usage;    // without the program's name
  std::string example;
  std::vector<ManualOption> options;
  std::vector<ManualEntry> parts;
};

/// Of the listed verbs, in their order, with their parts.
std::vector<ManualEntry> manual_entries();
/// The entries and their parts, each before its parts.
std::vector<ManualEntry> with_parts(const std::vector<ManualEntry>& entries);

/// "voussoir-motion-info": the page of an entry; of an empty name the program's.
std::string page_name(const std::string& entry);
/// Source of the manual page of an entry, for man(7): the characters outside of ASCII are written as escapes.
std::string entry_page(const ManualEntry& entry);
/// Source of the manual page of the program, which lists the entries.
std::string program_page(const std::vector<ManualEntry>& entries);

/// A script that bash reads to complete verbs, parts, options and names of files.
std::string bash_completion(const std::vector<ManualEntry>& entries);

}  // namespace voussoir
