// The sections of a run's page as HTML, each made from the files of the run. A section without content is empty.
#pragma once
#include <string>

#include "tools/run/run_files.h"

namespace voussoir {

/// Displacements below this (m) are not shown on the page.
constexpr double unmoved = 5e-6;

/// The result in a few sentences: the answer of the last stage, and the place where the masonry is damaged most. The
/// fill is reported separately.
std::string verdict_section(const RunFiles& run);

/// Collapse stage: the multiplier, its confirmation by dynamic runs, numbered hinges, load against displacement.
std::string collapse_section(const RunFiles& run);
/// Quasi-static stages: capacity curve, settlement along the deck, reactions.
std::string steps_section(const RunFiles& run);
/// Reactions at the end, compared with the weight; displacements of crowns, quarter points and pier tops.
std::string reactions_section(const RunFiles& run);
std::string places_section(const RunFiles& run);
/// Forces of the ties, and the ties that have yielded.
std::string ties_section(const RunFiles& run);
/// Stages with a ground motion: peak values and response spectra of the ground.
std::string motion_section(const RunFiles& run);
/// Damage by structural parts.
std::string damage_section(const RunFiles& run);
std::string demand_section(const RunFiles& run);
std::string histories_section(const RunFiles& run);
/// The case's own [[plot]]s.
std::string plots_section(const RunFiles& run);
/// Documentation of the run: drawing, assumptions, materials, joints and supports; then version, digests and case.
std::string model_section(const RunFiles& run);
std::string provenance_section(const RunFiles& run);

}  // namespace voussoir
