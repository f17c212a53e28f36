// The twelve periods of the seed paper.
#pragma once
#include <string>

#include "solver/model/settings.h"

namespace voussoir {

/// Prints the periods of cases/cs1-f, cs1-r, cs2-f and cs2-r, intact or as their gravity stages leave them, beside
/// those their [[modal.expected]] name, the ratios of free to restrained, and whether the modes come in the published
/// order; as Markdown to `file` unless that is empty. Returns 1 when a period is off by more than 10 % of the published
/// value, a ratio by more than 15 % (but for known misses, which say why), or an order differs.
int modal_paper(const std::string& file, ModalSettings::State state, int threads);

}  // namespace voussoir
