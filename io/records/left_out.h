// What a folder of records leaves out, each reason once.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

struct LeftOut {
  std::string name;    // of a file, without its folder, or of a recording
  std::string reason;  // the message without the place that it begins with
  std::string row;     // of the file, where the message names one
};

/// Of a message about a file: what stands behind "PATH:" is the reason.
LeftOut left_out_file(const std::string& path, const std::string& message);
/// A line for each reason, in the order in which they came first: "36 of a kind (A.VT2, A.DT2 and 34 more): why".
/// Reasons are alike when they differ by numbers and by what is quoted from the files.
std::vector<std::string> said_once(const std::vector<LeftOut>& all);

}  // namespace voussoir
