#include "solver/base/random.h"

#include "solver/base/arrays.h"

namespace voussoir {

RandomStream stream_of(std::uint64_t seed, const std::string& purpose, int number) {
  const std::uint64_t state = hash_bytes(purpose.data(), purpose.size(), RandomStream(seed).bits());
  return RandomStream(RandomStream(state).bits() ^ std::uint64_t(number));
}

}  // namespace voussoir
