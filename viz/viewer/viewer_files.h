// The parts of view.html that are files. embed.cmake writes them into the program during the build.
#pragma once
#include <string_view>

namespace voussoir::viewer_files {

extern const std::string_view three;    // three.js, empty if it was not found
extern const std::string_view licence;  // of three.js
extern const std::string_view style, body, program;

}  // namespace voussoir::viewer_files
