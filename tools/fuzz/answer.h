// What a reader may answer.
#pragma once
#include <new>

#include "solver/base/error.h"

namespace voussoir::fuzz {

/// Does the work; an error with a text for a person is as good as a result.
template <class Work>
void answer(Work&& work) {
  try {
    work();
  } catch (const InputError&) {
  } catch (const RunError&) {
  }
}

}  // namespace voussoir::fuzz
