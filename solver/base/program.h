// Common frame of all programs of this project.
#pragma once

namespace voussoir {

/// The body of a main(): prepares the process (begin_process()), runs, and prints errors to stderr after the name of
/// the program. Returns the exit status: 0 success, 1 the work failed (or its output could not be written), 2 the input
/// is wrong.
int run_program(const char* name, int (*run)(int argc, char** argv), int argc, char** argv);

}  // namespace voussoir
