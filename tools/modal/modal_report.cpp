#include "tools/modal/modal_report.h"

#include <fmt/format.h>

#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

std::vector<double> list(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

/// "block 12 (backfill, part 0), block 14 (…) and 3 more".
std::string named(const Assembly& assembly, const std::vector<std::int64_t>& blocks) {
  constexpr std::size_t most = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, blocks.size()); ++i)
    text += (i ? ", " : "") + block_label(assembly, blocks[i]);
  if (blocks.size() > most) text += fmt::format(" and {} more", blocks.size() - most);
  return text;
}

/// Hz and s.
std::string frequency_columns(const Mode& mode) {
  return fmt::format("{:>12.4f} {:>9}", mode.frequency,
                     mode.frequency > 0.0 ? fmt::format("{:.4f}", mode.period()) : "-");
}

}  // namespace

std::string modes_table(const ModesFile& file) {
  const bool damped = !file.damped.empty();
  std::string text = fmt::format("{:>4} {:>10} {:>9}  {:^20} {:^20} {:^20}", "mode", "frequency", "period",
                                 "effective mass %", "sum %", "participation");
  text += damped ? fmt::format(" {:>9} {:>8} {:>6}  motion\n", "damped", "", "ratio") : "  motion\n";
  text += fmt::format("{:>4} {:>10} {:>9}  {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6}", "", "Hz", "s", "x",
                      "y", "z", "x", "y", "z", "x", "y", "z");
  text += damped ? fmt::format(" {:>9} {:>8} {:>6}\n", "Hz", "s", "%") : "\n";
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < file.modes.size(); ++i) {
    const Mode& mode = file.modes[i];
    const Vec3 share = 100.0 * mode.effective / file.mass;
    sum += share;
    text += fmt::format("{:>4} {:>10.4f} {:>9}", i + 1, mode.frequency,
                        mode.frequency > 0.0 ? fmt::format("{:.4f}", mode.period()) : "-");
    text += fmt::format("  {:>6.1f} {:>6.1f} {:>6.1f} {:>6.1f} {:>6.1f} {:>6.1f}", share.x(), share.y(), share.z(),
                        sum.x(), sum.y(), sum.z());
    for (int c = 0; c < 3; ++c)  // + 0.0 avoids −0.00
      text += fmt::format(" {:>6.2f}", 0.01 * std::round(100.0 * mode.participation[c]) + 0.0);
    if (damped)
      text += fmt::format(" {:>9.4f} {:>8} {:>6.2f}", file.damped[i].frequency,
                          file.damped[i].frequency > 0.0 ? fmt::format("{:.4f}", file.damped[i].period()) : "-",
                          100.0 * file.damped[i].ratio);
    text += fmt::format("  {}\n", mode.words.text());
  }
  return text;
}

std::string effort_text(const ModesReport& report) {
  const Eigenpairs& s = report.solution;
  if (s.factor_entries == 0.0)
    return fmt::format("{}, dense solver: assembly {:.2f} s, modes {:.2f} s", counted(report.unknowns, "unknown"),
                       report.assembly_seconds, s.iteration_seconds);
  return fmt::format(
      "{}: assembly {:.2f} s, factorization {:.2f} s ({:.1f} million entries, {:.2f} GiB), iteration {:.2f} s ({})",
      counted(report.unknowns, "unknown"), report.assembly_seconds, s.factor_seconds, 1e-6 * s.factor_entries,
      s.factor_bytes / (1024.0 * 1024.0 * 1024.0), s.iteration_seconds, counted(s.solves, "solve"));
}

std::string loose_text(const Assembly& assembly, const Modes& modes) {
  std::string text;
  if (!modes.adrift.empty())
    text += fmt::format("{} that no joint holds, left out of the modes: {}\n", counted(modes.adrift.size(), "block"),
                        named(assembly, modes.adrift));
  if (!modes.partly.empty())
    text += fmt::format("{} that can turn or slide freely, held in that direction: {}\n",
                        counted(modes.partly.size(), "block"), named(assembly, modes.partly));
  return text;
}

namespace {

BlockPairs pairs_of_same_structure(const BlockPlaces& ours, const BlockPlaces& theirs) {
  BlockPairs pairs = pair_blocks(ours, theirs);
  if (pairs.share < 0.5)
    throw InputError(
        "only {:.0f} % of the mass has a block of the other analysis near it. Compare analyses of the same structure",
        100.0 * pairs.share);
  return pairs;
}

}  // namespace

void check_same_structure(const BlockPlaces& ours, const BlockPlaces& theirs) {
  pairs_of_same_structure(ours, theirs);
}

Pairing pair_modes(const ModesFile& ours, const ModesFile& theirs) {
  const BlockPairs pairs = pairs_of_same_structure(ours.places, theirs.places);
  Pairing pairing;
  pairing.share = pairs.share;
  pairing.assurance = assurance(ours.modes, theirs.modes, pairs);
  for (Eigen::Index j = 0; j < pairing.assurance.cols(); ++j) {
    Eigen::Index best = 0;
    const double most = pairing.assurance.col(j).maxCoeff(&best);
    pairing.ours.push_back(most >= 0.5 ? best : -1);
  }
  return pairing;
}

std::string pairing_table(const ModesFile& ours, const ModesFile& theirs, const Pairing& pairing,
                          const std::string& ours_name, const std::string& theirs_name) {
  std::string text = fmt::format("{:>4} {:>12} {:>9} {:>5} {:>12} {:>9} {:>8} {:>6}  motion\n", "", theirs_name, "", "",
                                 ours_name, "", "change", "MAC");
  text += fmt::format("{:>4} {:>12} {:>9} {:>5} {:>12} {:>9} {:>8}\n", "mode", "Hz", "s", "mode", "Hz", "s", "%");
  for (std::size_t j = 0; j < theirs.modes.size(); ++j) {
    const Mode& theirs_mode = theirs.modes[j];
    const std::int64_t i = pairing.ours[j];
    text += fmt::format("{:>4} {}", j + 1, frequency_columns(theirs_mode));
    if (i < 0) {
      text += fmt::format(" {:>5} {:>12} {:>9} {:>8} {:>6.3f}", "-", "-", "-", "-",
                          pairing.assurance.col(Eigen::Index(j)).maxCoeff());
    } else {
      const double f = ours.modes[std::size_t(i)].frequency;
      const std::string change =
          theirs_mode.frequency > 0.0 ? fmt::format("{:+.2f}", 100.0 * (f / theirs_mode.frequency - 1.0)) : "-";
      text += fmt::format(" {:>5} {} {:>8} {:>6.3f}", i + 1, frequency_columns(ours.modes[std::size_t(i)]), change,
                          pairing.assurance(Eigen::Index(i), Eigen::Index(j)));
    }
    text += fmt::format("  {}\n", theirs_mode.words.text());
  }
  return text;
}

std::vector<PeriodCheck> check_periods(const std::vector<ExpectedPeriod>& expected, const std::vector<Mode>& modes) {
  std::vector<PeriodCheck> checks;
  for (const ExpectedPeriod& e : expected) {
    const auto mode = std::find_if(modes.begin(), modes.end(), [&](const Mode& m) {
      return m.words.direction == e.direction && m.words.order == e.order;
    });
    checks.push_back({e, mode == modes.end() ? 0.0 : mode->period()});
  }
  return checks;
}

std::string periods_table(const std::vector<PeriodCheck>& checks) {
  std::size_t width = 6;
  for (const PeriodCheck& check : checks) width = std::max(width, check.expected.source.size());
  std::string text = fmt::format("{:<24} {:>10} {:>9} {:>10} {:>9} {:>8}  {:<{}}\n", "expected periods", "expected s",
                                 "Hz", "found s", "Hz", "error", "source", width);
  for (const PeriodCheck& check : checks) {
    const ModeWords words = {check.expected.direction, check.expected.order, ""};
    text +=
        fmt::format("{:<24} {:>10.4g} {:>9.4g} {:>10} {:>9} {:>8}  {}\n", words.text(), check.expected.period,
                    1.0 / check.expected.period, check.found > 0.0 ? fmt::format("{:.4f}", check.found) : "none",
                    check.found > 0.0 ? fmt::format("{:.4f}", 1.0 / check.found) : "",
                    check.found > 0.0 ? fmt::format("{:+.1f} %", 100.0 * check.error()) : "", check.expected.source);
  }
  return text;
}

nlohmann::json modes_json(const ModesFile& file, const Assembly& assembly, const Modes& modes) {
  nlohmann::json json;
  json["about"] = file.about;
  json["version"] = VOUSSOIR_VERSION;
  json["blocks"] = assembly.blocks.size();
  if (!assembly.fill.empty())
    json["fill"] = {{"nodes", assembly.fill.nodes.size()}, {"tetrahedra", assembly.fill.tets.size()}};
  json["unknowns"] = modes.report.unknowns;
  json["mass"] = file.mass;
  const Eigenpairs& s = modes.report.solution;
  json["seconds"] = {
      {"assembly", modes.report.assembly_seconds}, {"factor", s.factor_seconds}, {"iteration", s.iteration_seconds}};
  json["factor"] = {{"entries", s.factor_entries}, {"bytes", s.factor_bytes}, {"solves", s.solves}};
  json["left_out"] = modes.adrift;
  json["held"] = modes.partly;
  json["modes"] = nlohmann::json::array();
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < file.modes.size(); ++i) {
    const Mode& mode = file.modes[i];
    sum += mode.effective / file.mass;
    nlohmann::json m = {{"mode", i + 1},
                        {"motion", mode.words.text()},
                        {"direction", mode.words.direction},
                        {"order", mode.words.order},
                        {"frequency", mode.frequency},
                        {"period", mode.period()},
                        {"eigenvalue", mode.eigenvalue},
                        {"effective_mass", list(mode.effective)},
                        {"effective_share", list(mode.effective / file.mass)},
                        {"effective_sum", list(sum)},
                        {"participation", list(mode.participation)},
                        {"modal_mass", mode.modal_mass},
                        {"residual", mode.residual}};
    if (!file.damped.empty())
      m["damped"] = {{"frequency", file.damped[i].frequency},
                     {"period", file.damped[i].period()},
                     {"ratio", file.damped[i].ratio}};
    json["modes"].push_back(m);
  }
  return json;
}

nlohmann::json pairing_json(const ModesFile& ours, const ModesFile& theirs, const Pairing& pairing) {
  nlohmann::json json;
  json["about"] = theirs.about;
  json["paired_mass"] = pairing.share;
  json["pairs"] = nlohmann::json::array();
  for (std::size_t j = 0; j < theirs.modes.size(); ++j) {
    const Mode& mode = theirs.modes[j];
    nlohmann::json pair = {
        {"mode", j + 1}, {"frequency", mode.frequency}, {"period", mode.period()}, {"found", nullptr}};
    if (const std::int64_t i = pairing.ours[j]; i >= 0) {
      const Mode& own = ours.modes[std::size_t(i)];
      const double f = own.frequency;
      pair["found"] = {
          {"mode", i + 1}, {"frequency", f}, {"period", own.period()}, {"mac", pairing.assurance(i, Eigen::Index(j))}};
      if (mode.frequency > 0.0) pair["change"] = f / theirs.modes[j].frequency - 1.0;
    }
    json["pairs"].push_back(pair);
  }
  json["mac"] = nlohmann::json::array();
  for (Eigen::Index i = 0; i < pairing.assurance.rows(); ++i) {
    const Eigen::VectorXd row = pairing.assurance.row(i);
    json["mac"].push_back(std::vector<double>(row.data(), row.data() + row.size()));
  }
  return json;
}

nlohmann::json periods_json(const std::vector<PeriodCheck>& checks) {
  nlohmann::json json = nlohmann::json::array();
  for (const PeriodCheck& check : checks)
    json.push_back({{"direction", check.expected.direction},
                    {"order", check.expected.order},
                    {"expected", check.expected.period},
                    {"found", check.found},
                    {"expected_frequency", 1.0 / check.expected.period},
                    {"found_frequency", check.found > 0.0 ? 1.0 / check.found : 0.0},
                    {"source", check.expected.source}});
  return json;
}

}  // namespace voussoir
