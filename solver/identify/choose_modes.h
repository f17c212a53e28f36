// Modes that models of all orders have in common.
#pragma once
#include <functional>

#include "solver/identify/ssi.h"

namespace voussoir {

/// Models of all even orders of the same data.
struct Models {
  int largest_order = 0;
  std::function<std::vector<Pole>(int order)> poles;  // ascending in frequency, shapes over the channels in use
};

/// Data that models can be made of, also without a part of them.
struct ModelSource {
  SsiSettings settings;                                             // with what was chosen for zeros
  int segments = 0;                                                 // that the recordings are cut into
  std::function<Models(const std::vector<bool>& left_out)> models;  // per segment; empty: none is left out
  std::function<void(IdentifiedMode&)> listen;                      // finds kurtosis and stops: is it a machine?
};

/// Fills `poles`, `modes` and `set_aside` of the result; shapes are over the channels in use.
void choose_modes(const ModelSource& source, SsiResult& result);

}  // namespace voussoir
