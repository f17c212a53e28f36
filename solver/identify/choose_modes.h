// Selects the modes that appear in models of many orders.
#pragma once
#include <functional>

#include "solver/identify/ssi.h"

namespace voussoir {

/// Models of all even orders of the same data.
struct Models {
  int largest_order = 0;
  std::function<std::vector<Pole>(int order)> poles;  // ascending in frequency, shapes over the channels in use
};

/// Data for the models. A part of the data can be left out.
struct ModelSource {
  SsiSettings settings;                                             // with the values chosen for settings of 0
  int segments = 0;                                                 // number of segments of the recordings
  std::function<Models(const std::vector<bool>& left_out)> models;  // for each segment; empty: none is left out
  std::function<void(IdentifiedMode&)> listen;                      // computes kurtosis and stops, to recognise
                                                                    // machines
};

/// Fills `poles`, `modes` and `set_aside` of the result; shapes are over the channels in use.
void choose_modes(const ModelSource& source, SsiResult& result);

}  // namespace voussoir
