// What quasi-static stages found: table, numbers for the summary, charts.
#pragma once
#include <nlohmann/json.hpp>

#include "io/hdf5/history_file.h"
#include "solver/model/settings.h"
#include "viz/page/line_chart.h"

namespace voussoir {

/// Rows of the history of each quasi-static stage, by its number from 1; empty where there is none.
std::map<std::size_t, std::vector<std::size_t>> step_rows(const std::vector<StageSettings>& stages,
                                                          const History& history);

/// A row for each equilibrium: steps, reactions, places, settlement of the deck. For steps.csv.
std::string steps_table(const std::vector<StageSettings>& stages, const History& history);

/// Of each quasi-static stage its equilibria, how much of the path was gone, and the largest force with its
/// displacement.
nlohmann::json steps_json(const std::vector<StageSettings>& stages, const History& history);

/// Force over displacement; settlement along the deck, at the ends of the stages, since each began; vertical reactions
/// on the way. Without curves where there is nothing to show.
LineChart capacity_chart(const std::vector<StageSettings>& stages, const History& history);
LineChart deck_chart(const std::vector<StageSettings>& stages, const History& history);
LineChart reaction_chart(const std::vector<StageSettings>& stages, const History& history);

}  // namespace voussoir
