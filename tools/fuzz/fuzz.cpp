// A fuzzer of one reader, whose name the build puts in (VOUSSOIR_READER).
#include <cstdint>

#include "tools/fuzz/readers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  voussoir::fuzz::VOUSSOIR_READER(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
