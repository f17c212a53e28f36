// Dispersal of a wheel load, or an axle in plane strain, by a fill over a rigid base: an elastic layer on a smooth
// base against its closed form, and fills on rough bases against the rules of codes.
#include "solver/base/error.h"
#include "tools/ladder/dispersal.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

std::string name_of(const Dispersal& d) {
  return fmt::format("{}, {:.1f} m", d.wheel ? "wheel" : "strip", d.depth);
}

void compare_smooth(const Dispersal& d, std::vector<Finding>& findings) {
  const std::string source = "elastic layer, Filon 1903";
  const BasePressure got = base_pressure(d), expected = profile(d, smooth_base_pressure);
  if (!got.at_rest) throw RunError("{}: the fill does not come to rest", name_of(d));
  findings.push_back(near(name_of(d) + ", elastic, smooth base: greatest pressure / pressure of the patch",
                          expected.peak() / d.pressure, got.peak() / d.pressure, 0.05, "-", source));
  findings.push_back(near(name_of(d) + ": width with at least half of it", expected.half_width(), got.half_width(),
                          0.05, "m", source));
}

/// CS 454 distributes the load uniformly with a slope of 2:1. The computed width is the one that carries the load at
/// the largest pressure.
Finding compare_rule(const Dispersal& d) {
  const BasePressure got = base_pressure(d);
  if (!got.at_rest)
    throw RunError("{}: the fill does not come to rest under {:.0f} kPa", name_of(d), 1e-3 * d.pressure);
  const Finding finding =
      near(name_of(d) + (d.yields ? ", Mohr-Coulomb" : ", elastic") + ", rough base: equivalent width",
           spread_width(d, cs454_slope), got.equivalent(d.wheel), 0.25, "m", "2:1, CS 454");
  if (d.depth < 0.5 && (d.wheel || d.yields))
    return known_miss(finding, "a fill of this depth spreads the middle of the load less than the rule");
  if (d.depth > 0.9 && !d.wheel && d.yields)
    return known_miss(
        finding,
        "the fill yields under the strip, so less pressure arrives under its middle than through an elastic fill");
  return finding;
}

std::vector<Finding> climb_fill_dispersal(int) {
  std::vector<Finding> findings;
  for (const bool wheel : {false, true})
    for (std::size_t i = 0; i < std::size(dispersal_depths); ++i) {
      Dispersal d{.depth = dispersal_depths[i], .wheel = wheel, .cells = dispersal_cells[i]};
      compare_smooth(d, findings);
      d.rough = true;
      findings.push_back(compare_rule(d));
      d.yields = true;
      findings.push_back(compare_rule(d));
    }
  return findings;
}

}  // namespace

Rung fill_dispersal() {
  return {.name = "fill-dispersal",
          .help = "pressure at a rigid base under a wheel on the fill, compared with the rules of codes",
          .climb = climb_fill_dispersal,
          .slow = true};
}

}  // namespace voussoir::ladder
