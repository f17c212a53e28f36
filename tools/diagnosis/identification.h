// Modes from the recordings of a measurement that gives none.
#pragma once
#include <memory>

#include "io/case/case.h"
#include "io/measured/measured.h"
#include "solver/identify/fdd.h"
#include "solver/identify/ssi.h"

namespace voussoir {

/// How modes were identified from recordings of ambient vibration; empty: they were not.
struct Identification {
  std::shared_ptr<const SsiResult> ambient;
  std::shared_ptr<const Fdd> spectra;
};

/// Adds the modes that are identified from the recordings, at most so many of the lowest, where none are given; what is
/// set aside and remarks go into the measurement too. The assembly tells the band under a recorded motion of the
/// ground, the case what damping is expected. Throws InputError when no mode can be identified.
Identification identify(Measured& measured, const Case& c, const Assembly& assembly, int most);

}  // namespace voussoir
