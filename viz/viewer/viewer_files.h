// The texts of view.html that are files: written into the program by embed.cmake when it is built.
#pragma once
#include <string_view>

namespace voussoir::viewer_files {

extern const std::string_view three;    // three.js, empty where it was not found
extern const std::string_view licence;  // of three.js
extern const std::string_view style, body, program;

}  // namespace voussoir::viewer_files
