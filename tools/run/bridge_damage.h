// Damage of a bridge, classified by its consequences for the load-bearing structure. The classes are defined by this
// program (docs/theory/crack-map.md). Those of damage_words.h are made for houses.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "solver/step/snapshot.h"

namespace voussoir {

/// Classes in their order: sound, slight, marked, serious, bearing lost.
const std::vector<std::string>& bridge_classes();

/// A criterion, and the measure from which each class after the first begins; infinite for a class that it cannot give.
struct BridgeCriterion {
  std::string what;     // "seating lost"
  std::string measure;  // "share of the joint's depth"
  double from[4];
};
const std::vector<BridgeCriterion>& bridge_criteria();

/// The worst finding of one criterion in one part of the bridge.
struct BridgeFinding {
  std::string what, where;
  double measure = 0.0;   // the measure of its criterion; widths in m
  std::size_t grade = 0;  // of bridge_classes(), at least 1
  std::string sentence() const;
};
/// All findings, the worst first. Widths are the largest since the start; all other measures are those of the snapshot.
/// Soil (backfill) and ties are left out. Spans run along x.
std::vector<BridgeFinding> bridge_findings(const Assembly& assembly, const Snapshot& snapshot);

/// For summary.json: `class` and `findings`, each with `what`, `where`, `measure`, `class`, `words`.
nlohmann::json bridge_damage_json(const Assembly& assembly, const Snapshot& snapshot);

}  // namespace voussoir
