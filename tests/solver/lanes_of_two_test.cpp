// As on a processor whose registers hold two lanes (tests/CMakeLists.txt).
#define LANES LanesOfTwo
#include "tests/solver/lanes_checks.h"
