#include "solver/base/json_file.h"

#include <filesystem>

#include "solver/base/atomic_file.h"
#include "solver/base/error.h"

namespace voussoir {

using nlohmann::json;

json parse_json(const std::string& text, const std::string& path) {
  try {
    return json::parse(text);
  } catch (const json::exception& error) {
    throw InputError("{} is not valid JSON: {}", path, error.what());
  }
}

json read_json(const std::string& path) {
  return parse_json(read_text(path), path);
}

json json_if_any(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return {};
  const json found = json::parse(read_text(path), nullptr, false);
  return found.is_discarded() ? json() : found;
}

std::string json_text(const json& value, int indent) {
  return value.dump(indent, ' ', false, json::error_handler_t::replace) + "\n";
}

void write_json(const std::string& path, const json& value, int indent) {
  write_atomically(path, json_text(value, indent));
}

std::string json_excerpt(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace).substr(0, 60);
}

}  // namespace voussoir
