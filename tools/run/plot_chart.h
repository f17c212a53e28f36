// The charts of the [[plot]] tables of a case.
#pragma once
#include "io/case/case.h"
#include "io/hdf5/history_file.h"
#include "viz/page/line_chart.h"

namespace voussoir {

/// One history channel against another, with the measured curves whose file exists. Throws InputError for a channel
/// that the history does not have.
LineChart plot_chart(const PlotSpec& plot, const History& history);

}  // namespace voussoir
