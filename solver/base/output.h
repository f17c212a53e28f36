// The program's own standard output and error.
#pragma once

namespace voussoir {

/// From here on a reader that goes away (`| head`) is no failure: what would have gone to it is dropped, and the
/// program goes on. Other failures stay failures, and output_error() is their number (errno), 0 before any.
void survive_closed_pipes();
int output_error();

}  // namespace voussoir
