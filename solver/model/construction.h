// Construction sequence of a bridge: the step in which each part is added, and the step in which its centering is
// struck (docs/theory/construction.md).
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "solver/model/settings.h"

namespace voussoir {

/// Steps are numbered from 0. Fixed blocks are present from step 0, unless a step adds them.
struct ConstructionPlan {
  std::vector<std::string> labels;     // of the steps
  std::vector<std::int32_t> block;     // of Assembly::blocks: the step that adds it
  std::vector<std::int32_t> free;      // the step in which it becomes free; later if it stands on centering
  std::vector<std::int32_t> tet;       // of FillMesh::tets: the step that adds it
  std::vector<std::int32_t> triangle;  // of FillMesh::triangles: the step of the tetrahedron behind it
  bool empty() const { return labels.empty(); }
  std::int32_t steps() const { return std::int32_t(labels.size()); }
};

/// The usual construction sequence of a bridge with these components: supports with their infill in lifts, the fill
/// below the lowest point of the vaults, vaults on centering, backing, centering struck, spandrel walls and fill in
/// lifts, parapets. Stones of other components come first, and the restraints of the ends last. `lift`: largest height
/// of a lift, m; 0: no lifts.
std::vector<ConstructionStep> usual_order(const Assembly& assembly, double lift);

/// Throws InputError for an unknown name, a step that adds or strikes nothing, parts that no step adds, centering that
/// is never struck, and stones that in some step have no connection to a held part.
ConstructionPlan construction_plan(const Assembly& assembly, const ConstructionSettings& settings);

}  // namespace voussoir
