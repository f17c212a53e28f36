// Identification of modes from recordings, for measurements without modes.csv.
#pragma once
#include <memory>

#include "io/case/case.h"
#include "io/measured/measured.h"
#include "solver/identify/fdd.h"
#include "solver/identify/ssi.h"

namespace voussoir {

/// Intermediate results of the identification from ambient vibration; null if there was none.
struct Identification {
  std::shared_ptr<const SsiResult> ambient;
  std::shared_ptr<const Fdd> spectra;
};

/// Adds the modes identified from the recordings to a measurement without modes, at most the `most` lowest. Data that
/// are set aside and remarks are added too. The assembly gives the frequency band under a recorded ground motion, and
/// the case the expected damping. Throws InputError if no mode can be identified.
Identification identify(Measured& measured, const Case& c, const Assembly& assembly, int most);

}  // namespace voussoir
