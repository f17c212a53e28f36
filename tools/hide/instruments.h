// Sensor plans of voussoir hide.
#pragma once
#include "io/measured/measured.h"
#include "tools/hide/request.h"

namespace voussoir {

/// The sensors of the requested plan on this bridge. sparse: along one edge of the deck, transverse and vertical above
/// the keystones, longitudinal above the piers. rich: both edges, more axes, the ends, and the piers at half their
/// height. none: no sensors. A number from 5 to 40: so many channels, drawn with the seed from the rich plan (and, if
/// that is too small, from the other edge above piers and ends too), among them at least one transverse, one vertical
/// and one longitudinal. Otherwise a file like measured/sensors.csv. Throws InputError for another word and for a
/// bridge without places for the plan, and "FILE:ROW: …" for errors in the file.
std::vector<MeasuredSensor> instruments(const Assembly& assembly, const HideRequest& request);

}  // namespace voussoir
