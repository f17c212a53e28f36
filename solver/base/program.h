// What all programs of this project do around their work.
#pragma once

namespace voussoir {

/// The body of a main(): settles its process (begin_process()), runs, prints errors to stderr after the program's name.
/// Returns the exit status: 0 done, 1 the work failed (or its output did not arrive), 2 the input is wrong.
int run_program(const char* name, int (*run)(int argc, char** argv), int argc, char** argv);

}  // namespace voussoir
