// In which order a bridge is built: what comes in which step, and what is let go in which
// (docs/theory/construction.md).
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "solver/model/settings.h"

namespace voussoir {

/// Steps are numbered from 0. Fixed blocks are there from the first, unless a step adds them.
struct ConstructionPlan {
  std::vector<std::string> labels;     // of the steps
  std::vector<std::int32_t> block;     // of Assembly::blocks: the step in which it comes
  std::vector<std::int32_t> free;      // and that in which it is let go: later, where it stands on centering
  std::vector<std::int32_t> tet;       // of FillMesh::tets: the step in which it comes
  std::vector<std::int32_t> triangle;  // of FillMesh::triangles: that of the tetrahedron behind it
  bool empty() const { return labels.empty(); }
  std::int32_t steps() const { return std::int32_t(labels.size()); }
};

/// The order in which masons build a bridge with these components: supports with their infill in lifts, vaults on
/// centering, backing, centering struck, spandrel walls and fill in lifts, parapets. Stones of other components come
/// first, what restrains the ends last.
std::vector<ConstructionStep> usual_order(const Assembly& assembly, double lift);

/// Throws InputError for a name that is not there, a step that adds or strikes nothing, what is left out, centering
/// that is never struck, and stones that in some step nothing ties to anything held.
ConstructionPlan construction_plan(const Assembly& assembly, const ConstructionSettings& settings);

}  // namespace voussoir
