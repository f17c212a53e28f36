// A temporary folder with a small case and a campaign in it.
#pragma once
#include <fmt/format.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "solver/base/error.h"

namespace voussoir::test {

inline const std::string column_case = R"([bridge]
generator = "column"
blocks = 3
[materials.masonry]
density = 2000
[[stage]]
kind = "gravity"
[[stage]]
kind = "motion"
duration = 0.2
pulse = { kind = "sine", axis = "x", amplitude = 1.0, frequency = 5.0 }
[[sensor]]
id = "top"
position = [0.0, 0.0, 1.0]
direction = "x"
)";

inline const std::string one_record = R"([[record]]
name = "pulse"
pulse = { kind = "sine", axis = "x", amplitude = 2.0, frequency = 5.0 }
)";

class CampaignFolder {
 public:
  CampaignFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "voussoir-campaign-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("cannot make a temporary folder");
    path_ = name;
    write("column.toml", column_case);
  }
  ~CampaignFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  CampaignFolder(const CampaignFolder&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(*this / name).parent_path());
    std::ofstream(*this / name, std::ios::binary) << text;
    return *this / name;
  }
  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(*this / name, std::ios::binary).rdbuf();
    return text.str();
  }
  /// A campaign of column.toml with these further lines in [campaign], and these tables after it.
  std::string campaign(const std::string& lines, const std::string& tables = one_record) const {
    return write("campaign.toml", "[campaign]\ncases = [\"column.toml\"]\n" + lines + "\n" + tables);
  }

 private:
  std::string path_;
};

/// What the InputError of `work` says; "" when there is none.
template <class Work>
std::string refusal(Work&& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace voussoir::test
