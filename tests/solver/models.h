// What the tests of the solver share: the models of the validation ladder, and GoogleTest.
#pragma once
#include <gtest/gtest.h>

#include "tools/ladder/models.h"

namespace voussoir::test {

using namespace ladder;

}  // namespace voussoir::test
