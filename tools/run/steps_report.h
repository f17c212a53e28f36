// Results of quasi-static stages: table, numbers for the summary, charts.
#pragma once
#include <nlohmann/json.hpp>

#include "io/hdf5/history_file.h"
#include "solver/model/settings.h"
#include "viz/page/line_chart.h"

namespace voussoir {

/// Rows of the history of each quasi-static stage, by its number from 1; empty if there is no such stage.
std::map<std::size_t, std::vector<std::size_t>> step_rows(const std::vector<StageSettings>& stages,
                                                          const History& history);

/// The text of steps.csv: a row for each equilibrium with increments, reactions, places and settlement of the deck.
std::string steps_table(const std::vector<StageSettings>& stages, const History& history);

/// For each quasi-static stage its equilibria, the share of the path that was reached, and the largest force with its
/// displacement.
nlohmann::json steps_json(const std::vector<StageSettings>& stages, const History& history);

/// Charts: force against displacement; settlement along the deck from the beginning to the end of each stage; vertical
/// reactions during the stages. A chart has no curves if there is nothing to show.
LineChart capacity_chart(const std::vector<StageSettings>& stages, const History& history);
LineChart deck_chart(const std::vector<StageSettings>& stages, const History& history);
LineChart reaction_chart(const std::vector<StageSettings>& stages, const History& history);

}  // namespace voussoir
