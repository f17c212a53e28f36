// The MEXE assessment of an arch from its own file.
#pragma once
#include <string>

#include "solver/statics/mexe.h"

namespace voussoir {

/// Reads the table [mexe] of a TOML file. Throws InputError "FILE:LINE: …".
MexeInput read_mexe(const std::string& path);

/// The axle load and all intermediate values, in a few lines.
std::string mexe_text(const MexeResult& result);

}  // namespace voussoir
