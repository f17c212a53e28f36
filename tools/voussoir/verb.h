// The verbs of the program. A new verb is one file here and one line in verbs.cpp.
#pragma once
#include <boost/program_options.hpp>
#include <functional>
#include <string>
#include <vector>

namespace voussoir {

struct Verb {
  std::string name;
  std::string summary;                                      // one line; empty: for the program itself, not listed
  std::function<int(const std::vector<std::string>&)> run;  // arguments after the verb; returns the exit status
  std::vector<Verb> parts = {};  // parts of a verb that has several: "info", "select" … of motion
};

const std::vector<Verb>& verbs();

Verb generate_verb();
Verb import_verb();
Verb export_verb();
Verb info_verb();
Verb run_verb();
Verb resume_verb();
Verb modal_verb();
Verb render_verb();
Verb view_verb();
Verb cracks_verb();
Verb check_verb();
Verb step_verb();
Verb effects_verb();
Verb diagnose_verb();
Verb hide_verb();
Verb motion_verb();
Verb report_verb();
Verb campaign_verb();
Verb campaign_run_verb();
Verb fragility_verb();
Verb rate_verb();
Verb compare_verb();
Verb vehicles_verb();
Verb manual_verb();

namespace options = boost::program_options;

/// The command line of a verb: the options that all verbs have (--help, --threads N, --quiet), its own options, and its
/// positional arguments.
struct CommandLine {
  std::string verb, usage, example;  // usage without the program's name: "run CASE [-o DIR]"
  options::options_description described{"Options"};
  std::vector<std::string> positional;  // names of the positional arguments, in order
  std::vector<std::string> required;    // names of the arguments and options that must be given
  std::string rest;                     // name of the list of all further positional arguments; empty: none allowed
  CommandLine(std::string verb_name, std::string usage_text, std::string example_text);
  /// Reads the arguments. Returns false if help was asked for (and has been printed). Throws InputError for arguments
  /// that do not fit. Throws the command line itself for command_line_of().
  bool parse(const std::vector<std::string>& arguments, options::variables_map& values);
};

/// The command line of a verb (options, usage, example), without running the verb. A verb with parts has no command
/// line.
CommandLine command_line_of(const Verb& verb);

/// The words of a list separated by commas, without the word "none".
std::vector<std::string> words_in(const std::string& list);
/// --threads, or all that the machine offers.
int threads_asked(const options::variables_map& values);

}  // namespace voussoir
