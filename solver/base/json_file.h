// Reads and writes JSON in one place, because parser and writer need about four seconds of compile time.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace voussoir {

/// Throws InputError "PATH is not valid JSON: …" with line and column.
nlohmann::json parse_json(const std::string& text, const std::string& path);
/// The same for a file. Throws InputError if it cannot be read.
nlohmann::json read_json(const std::string& path);
/// Null if the file does not exist or is not JSON. Throws InputError if it exists but cannot be read.
nlohmann::json json_if_any(const std::string& path);

/// `indent` spaces for every level and a new line at the end. Bytes that are not UTF-8 become U+FFFD.
std::string json_text(const nlohmann::json& json, int indent = 2);
/// Writes the file atomically (atomic_file.h).
void write_json(const std::string& path, const nlohmann::json& json, int indent = 2);
/// The first 60 bytes in one line, for messages.
std::string json_excerpt(const nlohmann::json& json);

}  // namespace voussoir
