// Where voussoir hide puts its instruments.
#pragma once
#include "io/measured/measured.h"

namespace voussoir {

/// sparse: along one edge of the deck, across and upwards over the keystones, lengthways over the piers; rich: both
/// edges, more axes, the ends and the piers at half their height; none. Throws InputError for another word.
std::vector<MeasuredSensor> instruments(const Assembly& assembly, const std::string& which);

}  // namespace voussoir
