// Standard output and standard error of the program.
#pragma once

namespace voussoir {

/// After this call a closed pipe (`| head`) is not an error: further output to it is discarded, and the program
/// continues. Other failures are still errors, see output_error().
void survive_closed_pipes();
/// Number (errno) of the first failure of standard output after that call, or 0 if there was none. Failures of standard
/// error are not noted.
int output_error();

}  // namespace voussoir
