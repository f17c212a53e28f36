// Standard output and standard error of the program.
#pragma once

namespace voussoir {

/// After this call a closed pipe (`| head`) is not an error: further output to it is discarded, and the program
/// continues. Other failures are still errors. output_error() returns their number (errno), or 0 if there was none.
void survive_closed_pipes();
int output_error();

}  // namespace voussoir
