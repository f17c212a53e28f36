#include <fmt/format.h>

#include "io/case/sections.h"

namespace voussoir {

const std::vector<std::string>& modal_states() {
  static const std::vector<std::string> words = {"intact", "gravity"};
  return words;
}

const std::vector<std::string>& mode_directions() {
  static const std::vector<std::string> words = {"longitudinal", "transverse", "vertical", "torsional"};
  return words;
}

void read_modal(TableReader& root, Case& c) {
  auto table = root.table("modal", "[modal]");
  if (!table) return;
  ModalSettings& modal = c.settings.modal;
  modal.modes = int(table->integer("modes", modal.modes, 1, 10000));
  modal.state = ModalSettings::State(table->word("state", modal_states(), 0));
  modal.geometric = table->flag("geometric", false);
  if (modal.geometric && modal.state == ModalSettings::State::intact)
    table->fail("geometric", "is true, but without gravity the joints have no forces. Set state = \"gravity\", too.");
  for (TableReader& row : table->tables("expected")) {
    ExpectedPeriod expected;
    expected.direction = mode_directions()[row.required_word("direction", mode_directions())];
    expected.order = int(row.integer("order", 1, 1, 1000));
    expected.period = row.required_number("period", {0.0, 1e4, "s", true});
    expected.source = row.text("source", "expected");
    row.finish();
    c.expected_periods.push_back(expected);
  }
  table->finish();
}

}  // namespace voussoir
