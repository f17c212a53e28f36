// Pages as PDF files, printed by a browser without a window.
#pragma once
#include <string>

namespace voussoir {

/// Prints an HTML file on A4, as its style says, to a PDF file, whole or not at all. By the first of chromium,
/// chromium-browser, google-chrome and chrome that is in PATH. Throws InputError that says what to install where there
/// is none, RunError with what the browser said when it fails or takes more than two minutes.
void print_page(const std::string& html, const std::string& pdf);

}  // namespace voussoir
