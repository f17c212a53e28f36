#include "io/case/sections.h"
#include "solver/base/error.h"

namespace voussoir {

void read_effects(TableReader& root, Case& c) {
  for (TableReader& table : root.tables("effect")) {
    EffectSetting effect;
    effect.name = table.required_text("name");
    effect.where = table.text("where", "");
    for (const std::string& key : table.keys())
      if (key != "name" && key != "where") effect.values[key] = table.required_number(key);
    try {
      complete(effect);
      apply_effect(c.settings, effect);
    } catch (const InputError& error) {
      table.fail(error.what());
    }
    table.finish();
    c.effects.push_back(std::move(effect));
  }
}

}  // namespace voussoir
