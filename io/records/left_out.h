// The files of a folder of records that are not used, with each reason once.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

struct LeftOut {
  std::string name;    // name of a file, without its folder, or of a recording
  std::string reason;  // the message without its place
  std::string row;     // row of the file, if the message has one
};

/// From a message about a file: the reason is the text after "PATH:".
LeftOut left_out_file(const std::string& path, const std::string& message);
/// A line for each reason, in the order of first occurrence: "36 files or recordings (A.VT2, A.DT2 and 34 more): why".
/// Reasons that differ only by numbers and quoted texts count as equal.
std::vector<std::string> said_once(const std::vector<LeftOut>& all);

}  // namespace voussoir
