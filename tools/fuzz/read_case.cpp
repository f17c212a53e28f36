#include "io/case/case.h"
#include "tools/fuzz/answer.h"
#include "tools/fuzz/readers.h"

namespace voussoir::fuzz {

void read_case(const std::string& bytes) {
  answer([&] {
    const Case c = parse_case(bytes, "case.toml", CaseUse::run);
    // What is written down for a run must read as the same case.
    const Case again = parse_case(resolved_text(c), "case.toml", CaseUse::run);
    if (resolved_text(again) != resolved_text(c)) std::abort();
  });
}

}  // namespace voussoir::fuzz
