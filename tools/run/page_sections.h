// The parts of a run's page, each made from what the run has left in its folder; empty where there is nothing to say.
#pragma once
#include <string>

#include "tools/run/run_files.h"

namespace voussoir {

/// Below this (m) nothing has moved that a page would have to show.
constexpr double unmoved = 5e-6;

/// The answer in a few sentences: what the last stage was to find, and where the masonry is damaged most; fill apart.
std::string verdict_section(const RunFiles& run);

/// Of a collapse stage: factor, how it was confirmed, hinges by number, load and displacement on the way.
std::string collapse_section(const RunFiles& run);
/// Of quasi-static stages: loads or settlements on the way from equilibrium to equilibrium.
std::string steps_section(const RunFiles& run);
/// What holds the bridge at the end, beside its weight; where crowns, quarter points and pier tops have gone.
std::string reactions_section(const RunFiles& run);
std::string places_section(const RunFiles& run);
/// Forces of ties, and which have yielded.
std::string ties_section(const RunFiles& run);
/// Of stages with a ground motion: what the ground did, its spectra.
std::string motion_section(const RunFiles& run);
/// Damage by structural parts.
std::string damage_section(const RunFiles& run);
std::string demand_section(const RunFiles& run);
std::string histories_section(const RunFiles& run);
/// The case's own [[plot]]s.
std::string plots_section(const RunFiles& run);
/// For the file: drawing, materials, joints, supports, assumptions, the case's text, program and digests.
std::string model_section(const RunFiles& run);
std::string provenance_section(const RunFiles& run);

}  // namespace voussoir
