// A case as a list of keys, for the comparison with another case.
#pragma once
#include <map>
#include <string>

namespace voussoir {

/// Every value of a TOML text by its dotted key ("bridge.width", "stage[2].duration"; entries of lists of tables count
/// from 1), as TOML writes it. Throws InputError for a text that is not TOML; `path` is its name in messages.
std::map<std::string, std::string> flat_case(const std::string& text, const std::string& path);

}  // namespace voussoir
