// Damage of a bridge by what it does to its bearing. The classes are voussoir's own (docs/theory/crack-map.md): those
// of damage_words.h are for houses.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "solver/step/snapshot.h"

namespace voussoir {

/// Classes in their order: sound, slight, marked, serious, bearing lost.
const std::vector<std::string>& bridge_classes();

/// What is looked at, and from which measure on each class but the first begins; infinite where none does.
struct BridgeCriterion {
  std::string what;     // "seating lost"
  std::string measure;  // "share of the joint's depth"
  double from[4];
};
const std::vector<BridgeCriterion>& bridge_criteria();

/// The worst of each criterion in each part.
struct BridgeFinding {
  std::string what, where;
  double measure = 0.0;   // as its criterion says; widths in m
  std::size_t grade = 0;  // of bridge_classes(), at least 1
  std::string sentence() const;
};
/// Worst first. Widths are the largest since the start; all else is as it is in the snapshot. Soil (backfill) and ties
/// are left out; spans run along x.
std::vector<BridgeFinding> bridge_findings(const Assembly& assembly, const Snapshot& snapshot);

/// For summary.json: `class` and `findings`, each with `what`, `where`, `measure`, `class`, `words`.
nlohmann::json bridge_damage_json(const Assembly& assembly, const Snapshot& snapshot);

}  // namespace voussoir
