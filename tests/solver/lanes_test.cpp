#define LANES Lanes
#include "tests/solver/lanes_checks.h"
