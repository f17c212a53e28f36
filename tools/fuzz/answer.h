// The errors that a reader may throw.
#pragma once
#include <new>

#include "solver/base/error.h"

namespace voussoir::fuzz {

/// Does the work, and ignores InputError and RunError.
template <class Work>
void answer(Work&& work) {
  try {
    work();
  } catch (const InputError&) {
  } catch (const RunError&) {
  }
}

}  // namespace voussoir::fuzz
