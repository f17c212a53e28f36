// The case's own [[plot]]s as charts.
#pragma once
#include "io/case/case.h"
#include "io/hdf5/history_file.h"
#include "viz/page/line_chart.h"

namespace voussoir {

/// One history channel over another, beside measured curves whose file is there. Throws InputError for a channel that
/// the history does not have.
LineChart plot_chart(const PlotSpec& plot, const History& history);

}  // namespace voussoir
