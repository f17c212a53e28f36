// Comparison with the published periods of the bridges CS1 and CS2.
#pragma once
#include <string>

#include "solver/model/settings.h"

namespace voussoir {

/// Computes the periods of cases/cs1-f, cs1-r, cs2-f and cs2-r, with intact joints or with the joints after gravity.
/// Prints them with the published ones ([[modal.expected]]), the ratios of free to restrained, and whether the modes
/// come in the published order. Writes the same as Markdown to `file`, unless that is empty. Returns 1 if a period
/// differs by more than 10 % of the published value, a ratio by more than 15 %, or the order differs. Known misses,
/// which are printed with their reason, do not count.
int modal_paper(const std::string& file, ModalSettings::State state, int threads);

}  // namespace voussoir
