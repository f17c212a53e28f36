// As on a processor whose registers hold four lanes (tests/CMakeLists.txt).
#define LANES LanesOfFour
#include "tests/solver/lanes_checks.h"
