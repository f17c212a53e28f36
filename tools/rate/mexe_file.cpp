#include "tools/rate/mexe_file.h"

#include <fmt/format.h>

#include "io/toml/table_reader.h"
#include "solver/base/atomic_file.h"

namespace voussoir {

MexeInput read_mexe(const std::string& path) {
  const toml::table text = parse_toml(read_text(path), path);
  TableReader root(text, path, "the file");
  MexeInput in;
  auto table = root.table("mexe", "[mexe]");
  if (!table) root.missing("mexe", "a table with span, rise, quarter_rise, ring, fill and the factors of BA 16/97");
  const auto length = [&](const char* key) { return table->required_number(key, {0.0, 1e3, "m"}); };
  const auto factor = [&](const char* key) { return table->required_number(key, {0.0, 2.0, ""}); };
  in.span = length("span"), in.rise = length("rise"), in.quarter_rise = length("quarter_rise");
  in.ring = length("ring"), in.fill = length("fill");
  in.fill_at_most_ring = table->flag("fill_at_most_ring", true);
  in.barrel = factor("barrel_factor"), in.fill_factor = factor("fill_factor");
  in.width = factor("width_factor"), in.depth = factor("depth_factor"), in.mortar = factor("mortar_factor");
  in.condition = factor("condition_factor");
  if (table->has("span_rise_factor")) in.span_rise = factor("span_rise_factor");
  table->finish();
  root.finish();
  return in;
}

std::string mexe_text(const MexeResult& r) {
  return fmt::format(
      "MEXE (BA 16/97): modified axle load {:.1f} t, before axle factors\n"
      "  provisional axle load {:.2f} t of d + h = {:.3g} m (h counts {:.3g} m)\n"
      "  F_sr = {:.2f} (L/rc = {:.2f}), F_p = {:.2f} (rq/rc = {:.3f}), F_m = {:.2f}, F_j = {:.2f}, F_cM = {:.2f}\n",
      r.modified, r.provisional, r.total, r.fill, r.span_rise, r.span_rise_ratio, r.profile, r.quarter_ratio,
      r.material, r.joint, r.condition);
}

}  // namespace voussoir
