#include "io/records/curve.h"
#include "io/records/format.h"
#include "tools/fuzz/answer.h"
#include "tools/fuzz/readers.h"

namespace voussoir::fuzz {

void read_record(const std::string& bytes) {
  answer([&] { parse_record(bytes, "record.txt"); });
  answer([&] { parse_record(bytes, "record.txt", 0.01); });
  answer([&] { parse_channels(bytes, "record.txt"); });
  answer([&] { parse_curve(bytes, "curve.txt"); });
}

}  // namespace voussoir::fuzz
