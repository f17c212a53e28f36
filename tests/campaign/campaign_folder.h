// A temporary folder with a small case and a campaign in it.
#pragma once
#include <string>

#include "solver/base/error.h"
#include "tests/folder.h"

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

class CampaignFolder : public Folder {
 public:
  CampaignFolder() { write("column.toml", column_case); }
  /// A campaign of column.toml with these further lines in [campaign], and these tables after it.
  std::string campaign(const std::string& lines, const std::string& tables = one_record) const {
    return write("campaign.toml", "[campaign]\ncases = [\"column.toml\"]\n" + lines + "\n" + tables);
  }
};

}  // namespace voussoir::test
