// JSON read and written in one place: what its parser and its writer are made of takes the compiler some four seconds.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace voussoir {

/// Throws InputError "PATH is no valid JSON: …" with line and column.
nlohmann::json parse_json(const std::string& text, const std::string& path);
/// The same of a file; InputError where it cannot be read.
nlohmann::json read_json(const std::string& path);
/// Null where the file is not there or is no JSON.
nlohmann::json json_if_any(const std::string& path);

/// `indent` spaces for every level, a new line at the end; bytes that are no UTF-8 become U+FFFD.
std::string json_text(const nlohmann::json& json, int indent = 2);
/// Atomically (atomic_file.h).
void write_json(const std::string& path, const nlohmann::json& json, int indent = 2);
/// At most 60 characters in one line, for messages.
std::string json_excerpt(const nlohmann::json& json);

}  // namespace voussoir
