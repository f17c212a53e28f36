// Where voussoir hide puts its instruments.
#pragma once
#include "io/measured/measured.h"
#include "tools/hide/request.h"

namespace voussoir {

/// The request's plan on this bridge. sparse: along one edge of the deck, across and upwards over the keystones,
/// lengthways over the piers; rich: both edges, more axes, the ends and the piers at half their height; none; a number
/// from 5 to 40: so many channels, drawn by the seed from the rich plan (and, where that has fewer, from the other edge
/// over piers and ends too), among them one across, one upwards and one lengthways; or a file like
/// measured/sensors.csv. Throws InputError for another word, for a bridge on which a plan finds no place, and
/// "FILE:ROW: …" for what is wrong in the file.
std::vector<MeasuredSensor> instruments(const Assembly& assembly, const HideRequest& request);

}  // namespace voussoir
