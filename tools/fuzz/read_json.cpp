#include "tools/campaign/json.h"
#include "tools/fuzz/answer.h"
#include "tools/fuzz/readers.h"

namespace voussoir::fuzz {

void read_json(const std::string& bytes) {
  answer([&] {
    const campaign::json object = parse_json(bytes, "plan.json");
    answer([&] { campaign::need<std::string>(object, "name", "plan.json"); });
    answer([&] { campaign::need<double>(object, "value", "plan.json"); });
    answer([&] { campaign::need<std::vector<std::string>>(object, "runs", "plan.json"); });
    answer([&] { campaign::value_or(object, "seed", std::uint64_t(1), "plan.json"); });
  });
}

}  // namespace voussoir::fuzz
