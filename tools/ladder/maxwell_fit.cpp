// Maxwell damping apart from any structure: three branches, 2 % on 0.5–12 Hz.
#include "solver/step/damping.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

constexpr const char* independent_fit = "independent least-squares fit";

/// The ratio over the band, by a fine scan.
std::vector<Finding> ripple(const MaxwellFit& fit) {
  constexpr int points = 6400;
  double lowest = 1.0, highest = 0.0;
  for (int i = 0; i <= points; ++i) {
    const double f = 0.5 * std::pow(12.0 / 0.5, double(i) / points);
    lowest = std::min(lowest, maxwell_ratio(fit, f));
    highest = std::max(highest, maxwell_ratio(fit, f));
  }
  const double said = std::max(std::abs(fit.lowest - lowest), std::abs(fit.highest - highest));
  return {near("least ratio on 0.5-12 Hz", 0.01976, lowest, 0.003, "-", independent_fit),
          near("greatest ratio on 0.5-12 Hz", 0.02011, highest, 0.003, "-", independent_fit),
          nothing("error of the least and greatest ratio of the fit", said, 1e-6, "-", "scan of the band")};
}

std::vector<Finding> climb_maxwell_fit(int) {
  const MaxwellFit fit = fit_maxwell(0.02, {0.5, 12.0}, 3);
  const double stiffness[3] = {0.0611, 0.0425, 0.0689}, frequency[3] = {0.446, 2.498, 14.28};
  std::vector<Finding> findings;
  for (std::size_t j = 0; j < 3; ++j) {
    const std::string of = " of branch " + std::to_string(j + 1);
    findings.push_back(near("alpha" + of, stiffness[j], fit.stiffness.at(j), 0.01, "-", independent_fit));
    findings.push_back(near("frequency" + of, frequency[j], fit.frequency.at(j), 0.01, "Hz", independent_fit));
  }
  for (Finding& finding : ripple(fit)) findings.push_back(std::move(finding));
  return findings;
}

}  // namespace

Rung maxwell_fit() {
  return {
      .name = "maxwell-fit", .help = "branches of Maxwell damping: 2 % on 0.5 to 12 Hz", .climb = climb_maxwell_fit};
}

}  // namespace voussoir::ladder
