// The figures of the MEXE method for one arch, as a text of its own.
#pragma once
#include <string>

#include "solver/statics/mexe.h"

namespace voussoir {

/// Reads the table [mexe] of a TOML file. Throws InputError "FILE:LINE: …".
MexeInput read_mexe(const std::string& path);

/// The axle load and every figure on the way to it, in a few lines.
std::string mexe_text(const MexeResult& result);

}  // namespace voussoir
