#include "io/measured/units.h"

#include <cmath>

#include "solver/base/constants.h"

namespace voussoir {

namespace {

void replace_all(std::string& text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

}  // namespace

const std::vector<ChannelUnit>& channel_units() {
  static const std::vector<ChannelUnit> units = {{"m/s2", 1.0, 0},
                                                 {"cm/s2", 1e-2, 0},
                                                 {"gal", 1e-2, 0},
                                                 {"mm/s2", 1e-3, 0},
                                                 {"um/s2", 1e-6, 0},
                                                 {"g", standard_gravity, 0},
                                                 {"mg", 1e-3 * standard_gravity, 0},
                                                 {"ug", 1e-6 * standard_gravity, 0},
                                                 {"m/s", 1.0, 1},
                                                 {"cm/s", 1e-2, 1},
                                                 {"mm/s", 1e-3, 1},
                                                 {"um/s", 1e-6, 1},
                                                 {"m", 1.0, 2},
                                                 {"cm", 1e-2, 2},
                                                 {"mm", 1e-3, 2},
                                                 {"um", 1e-6, 2}};
  return units;
}

const ChannelUnit* find_unit(const std::string& name) {
  std::string plain = name;
  for (const char* two : {"²", "^2", "**2"}) replace_all(plain, two, "2");
  for (const char* micro : {"µ", "μ"}) replace_all(plain, micro, "u");  // the sign, and the Greek letter
  if (plain == "Gal") plain = "gal";
  for (const ChannelUnit& unit : channel_units())
    if (unit.name == plain) return &unit;
  return nullptr;
}

Eigen::VectorXd differentiated(const Eigen::VectorXd& x, double dt) {
  constexpr double beta = 10.0;  // with 6 the error is 4e-3 at a thirtieth of the sampling rate
  const Eigen::Index n = x.size() - 2 * derivative_reach;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(std::max<Eigen::Index>(n, 0));
  for (Eigen::Index k = 1; k <= derivative_reach && n > 0; ++k) {
    const double r = double(k) / double(derivative_reach + 1);
    const double taper = std::cyl_bessel_i(0.0, beta * std::sqrt(1.0 - r * r)) / std::cyl_bessel_i(0.0, beta);
    const double weight = (k % 2 ? 1.0 : -1.0) / (double(k) * dt) * taper;
    y += weight * (x.segment(derivative_reach + k, n) - x.segment(derivative_reach - k, n));
  }
  return y;
}

}  // namespace voussoir
