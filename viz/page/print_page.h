// Pages as PDF files, printed by a browser without a window.
#pragma once
#include <string>

namespace voussoir {

/// Prints an HTML file on A4 with its own style to a PDF file, which is written atomically. It uses the first of
/// chromium, chromium-browser, google-chrome and chrome in PATH. Throws InputError that says what to install if there
/// is none, and RunError if the browser fails or takes more than two minutes, or if the PDF file cannot be written.
void print_page(const std::string& html, const std::string& pdf);

}  // namespace voussoir
