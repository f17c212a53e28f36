// The state of one simulation handed to another, as a checkpoint would.
#pragma once
#include <gtest/gtest.h>

#include "solver/model/state.h"

namespace voussoir::test {

inline void copy_state(const Model& model, State& from, State& to) {
  const auto source = from.arrays(), target = to.arrays();
  ASSERT_EQ(source.size(), target.size());
  for (std::size_t i = 0; i < source.size(); ++i)
    std::visit([&](auto* values) { *values = *std::get<std::remove_const_t<decltype(values)>>(source[i].data); },
               target[i].data);
  to.unpack(model);
}

}  // namespace voussoir::test
