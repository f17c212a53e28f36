#include "tools/run/gravity_report.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <new>
#include <nlohmann/json.hpp>

#include "solver/base/error.h"
#include "solver/effects/parts.h"
#include "solver/modal/modes.h"
#include "solver/step/damage.h"
#include "tools/run/damage_words.h"
#include "viz/page/html.h"
#include "viz/page/svg.h"

namespace voussoir {

namespace {

using nlohmann::json;

json place_json(const Vec3& x) {
  return {x.x(), x.y(), x.z()};
}

/// For each part: the largest and the mean settlement of its stones, and the largest displacements along and across,
/// with their signs.
json parts_json(const Assembly& assembly, const Snapshot& snapshot) {
  struct Part {
    double settlement = -1e300, sum = 0.0, along = 0.0, across = 0.0;
    std::int64_t blocks = 0;
  };
  const std::vector<std::string> names = parts_of_blocks(assembly);
  std::map<std::string, Part> parts;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (assembly.blocks[i].fixed) continue;
    const Vec3 u = snapshot.displacement[i] - snapshot.base_displacement;
    Part& part = parts[names[i]];
    part.settlement = std::max(part.settlement, -u.z());
    part.sum -= u.z(), ++part.blocks;
    if (std::abs(u.x()) > std::abs(part.along)) part.along = u.x();
    if (std::abs(u.y()) > std::abs(part.across)) part.across = u.y();
  }
  json all = json::array();
  for (const auto& [name, part] : parts)
    all.push_back({{"part", name},
                   {"blocks", part.blocks},
                   {"settlement", part.settlement},
                   {"settlement_mean", part.sum / double(part.blocks)},
                   {"along", part.along},
                   {"across", part.across}});
  return all;
}

/// The entries of the families of joints, the worst first.
json joints_json(const Assembly& assembly, const Snapshot& snapshot) {
  struct Worst {
    double value = 0.0;
    Vec3 place = Vec3::Zero();
    void look(double x, const Vec3& at) {
      if (x > value) value = x, place = at;
    }
  };
  struct Family {
    double area = 0.0, lost = 0.0;
    Worst opening, slip, compression;
  };
  std::map<std::string, Family> families;
  for (const PatchSnapshot& p : snapshot.patches) {
    if (p.tie || p.polygon.empty()) continue;
    Family& f = families[joint_family(assembly.blocks[std::size_t(p.a)].component,
                                      assembly.blocks[std::size_t(p.b)].component)];
    if (p.had_bond) f.area += p.area, f.lost += p.area * (1.0 - p.bonded);
    const Vec3 at = polygon_centroid(p.polygon);
    f.opening.look(p.opening, at), f.slip.look(p.slip, at), f.compression.look(-p.normal_traction, at);
  }
  json all = json::array();
  for (const auto& [name, f] : families)
    all.push_back({{"joints", name},
                   {"bonded_area", f.area},
                   {"lost", f.area > 0.0 ? json(f.lost / f.area) : json()},
                   {"opening", f.opening.value},
                   {"opening_at", place_json(f.opening.place)},
                   {"slip", f.slip.value},
                   {"slip_at", place_json(f.slip.place)},
                   {"compression", f.compression.value},
                   {"compression_at", place_json(f.compression.place)}});
  std::stable_sort(all.begin(), all.end(), [](const json& a, const json& b) {
    return a["lost"].is_number() && (!b["lost"].is_number() || a["lost"] > b["lost"]);
  });
  return all;
}

constexpr std::int32_t many_unknowns = 250000;  // beyond this the modes take minutes and are left out

/// The lowest modes of the bridge with all joints bonded and elastic, and of its present state, paired by shape.
json periods_json(const Simulation& run, int wanted) {
  constexpr double alike = 0.5;  // modal assurance criterion below which two modes are not paired
  constexpr int beyond = 12;
  json all = json::array();
  const Assembly& assembly = run.assembly();
  const bool bridge = blocks_where(assembly, [](const Block& b) { return b.component == Component::arch; }) !=
                      BlockSet(assembly.blocks.size(), false);
  if (wanted <= 0 || !bridge || number_unknowns(run.model()).count > many_unknowns) return all;
  const State intact = initial_state(run.model());
  const Modes before = find_modes(assembly, run.model(), intact, wanted, PatchTangent::intact),
              now = find_modes(assembly, run.model(), run.state(), wanted, PatchTangent::present, nullptr, beyond);
  const BlockPlaces places = block_places(assembly, run.model());
  const Eigen::MatrixXd mac = assurance(before.modes, now.modes, pair_blocks(places, places));
  for (Eigen::Index i = 0; i < mac.rows(); ++i) {
    Eigen::Index best = 0;
    const double like = mac.row(i).maxCoeff(&best);
    const Mode& was = before.modes[std::size_t(i)];
    all.push_back({{"motion", was.words.text()},
                   {"intact", was.period()},
                   {"now", like >= alike ? json(now.modes[std::size_t(best)].period()) : json()},
                   {"mac", like}});
  }
  return all;
}

/// Adds the periods, or the reason why there are none. An error here must not end the run.
void add_periods(const Simulation& run, int wanted, json& report) {
  report["periods"] = json::array();
  try {
    report["periods"] = periods_json(run, wanted);
  } catch (const std::bad_alloc&) {
    report["no_periods"] = "there was not enough memory for the modes.";
  } catch (const std::exception& error) {
    report["no_periods"] = error.what();
  }
}

/// A warning if gravity alone has damaged the bridge; otherwise empty. It names one family of joints: of those that
/// have moved far, or have lost much bond and are not loose fill, the one with the largest area of lost bond.
std::string warning_of(const json& joints, bool at_once) {
  constexpr double much = 0.1, far = 1e-3;  // of a family's bond; m
  std::string what;
  double area = 0.0;
  const json* worst = nullptr;
  for (const json& family : joints) {
    if (!family["lost"].is_number()) continue;
    const double lost = family["lost"], of = family["bonded_area"];
    const bool loose = family["joints"].get<std::string>().find("fill") != std::string::npos;
    const bool bad = (lost > much && !loose) || family["opening"] > far || family["slip"] > far;
    if (bad && lost * of > area) area = lost * of, worst = &family;
  }
  if (!worst) return "";
  const json& at = (*worst)[(*worst)["opening"] > (*worst)["slip"] ? "opening_at" : "slip_at"];
  return fmt::format(
      "gravity alone has damaged the bridge: {:.0f} % of the bond of the joints {} is lost, with openings of {} and "
      "slips of {}. The worst place is at ({:.2f}, {:.2f}, {:.2f}) m.{}",
      100.0 * (*worst)["lost"].get<double>(), (*worst)["joints"].get<std::string>(),
      bound_text((*worst)["opening"].get<double>(), 1), bound_text((*worst)["slip"].get<double>(), 1),
      at[0].get<double>(), at[1].get<double>(), at[2].get<double>(),
      at_once ? " Use construction = \"staged\" in the gravity stage to build the bridge in construction steps." : "");
}

std::string mm(const json& metres) {
  return fmt::format("{:.2f}", 1e3 * metres.get<double>());
}

std::string share_text(const json& share) {
  return share.is_number() ? fmt::format("{:.1f}", 100.0 * share.get<double>()) : "–";
}

std::string period_text(const json& period) {
  return period.is_number() ? fmt::format("{:.4f}", period.get<double>()) : "none";
}
std::string in_seconds(const json& period) {
  return period.is_number() ? period_text(period) + " s" : "no similar mode";
}

}  // namespace

json gravity_report(const Simulation& run, const Snapshot& snapshot, int modes) {
  const auto stage = std::size_t(run.position().stage);  // which has just ended
  const StageSettings& settings = run.settings().stages[stage];
  json report = {{"stage", stage + 1},
                 {"label", settings.label},
                 {"construction", settings.construction ? "staged" : "at once"},
                 {"steps", settings.construction ? run.model().plan.steps() : 0},
                 {"parts", parts_json(run.assembly(), snapshot)},
                 {"joints", joints_json(run.assembly(), snapshot)}};
  add_periods(run, modes, report);
  report["warning"] = warning_of(report["joints"], !settings.construction);
  return report;
}

std::string gravity_text(const json& report) {
  std::string text = "effects of gravity: displacement of each part since it was built (mm down, along, across):";
  for (const json& part : report["parts"])
    text += fmt::format("\n  {:18} {:>7} {:>7} {:>7}", part["part"].get<std::string>(), mm(part["settlement"]),
                        mm(part["along"]), mm(part["across"]));
  text += "\njoints: bond lost (%), opening (mm), slip (mm), compression (MPa):";
  for (const json& family : report["joints"])
    text += fmt::format("\n  {:18} {:>7} {:>7} {:>7} {:>7.3f}", family["joints"].get<std::string>(),
                        share_text(family["lost"]), mm(family["opening"]), mm(family["slip"]),
                        1e-6 * family["compression"].get<double>());
  for (const json& mode : report["periods"])
    text += fmt::format("\n  {}: {} intact, {} now", mode["motion"].get<std::string>(), in_seconds(mode["intact"]),
                        in_seconds(mode["now"]));
  if (report.contains("no_periods")) text += "\n  no periods were computed: " + report["no_periods"].get<std::string>();
  if (const std::string warning = report["warning"]; !warning.empty()) text += "\nwarning: " + warning;
  return text;
}

std::string gravity_section(const json& reports) {
  std::string html;
  for (const json& report : reports) {
    html += heading(fmt::format("Effects of gravity: stage {}, built {}", report["stage"].get<int>(),
                                report["construction"].get<std::string>()));
    if (const std::string warning = report["warning"]; !warning.empty())
      html += fmt::format("<div class=\"verdict unexplained\">\n<p><strong>Warning:</strong> {}</p>\n</div>\n",
                          escaped(with_full_stop(warning)));
    const auto words = [](const json& text) { return words_cell(text.get<std::string>()); };
    const auto number = [](std::string text) { return Cell{std::move(text), true}; };
    html +=
        "<table>\n" +
        table_row({{"part"}, {"largest settlement, mm"}, {"mean settlement, mm"}, {"along, mm"}, {"across, mm"}}, "th");
    for (const json& part : report["parts"])
      html += table_row({words(part["part"]), number(mm(part["settlement"])), number(mm(part["settlement_mean"])),
                         number(mm(part["along"])), number(mm(part["across"]))},
                        "td");
    html +=
        "</table>\n" + note(
                           "Displacements along and across are the largest of the stones of a part. All displacements "
                           "are relative to the ground and count from the moment at which the stone was built.");
    html +=
        "<table>\n" +
        table_row(
            {{"joints"}, {"bonded area, m²"}, {"bond lost, %"}, {"opening, mm"}, {"slip, mm"}, {"compression, MPa"}},
            "th");
    for (const json& f : report["joints"])
      html += table_row({words(f["joints"]), number(fmt::format("{:.1f}", f["bonded_area"].get<double>())),
                         number(share_text(f["lost"])), number(mm(f["opening"])), number(mm(f["slip"])),
                         number(fmt::format("{:.3f}", 1e-6 * f["compression"].get<double>()))},
                        "td");
    html += "</table>\n" + note(
                               "The rows are the joints within a component or between two components. Opening and slip "
                               "are the largest of any joint; compression is the largest mean compression of a joint.");
    if (report.contains("no_periods"))
      html += note("No periods were computed: " + escaped(with_full_stop(report["no_periods"].get<std::string>())));
    if (report["periods"].empty()) continue;
    html += "<table>\n" + table_row({{"mode"}, {"intact, s"}, {"now, s"}, {"MAC"}}, "th");
    for (const json& mode : report["periods"])
      html += table_row({words(mode["motion"]), number(period_text(mode["intact"])), number(period_text(mode["now"])),
                         number(fmt::format("{:.3f}", mode["mac"].get<double>()))},
                        "td");
    html += "</table>\n" + note(
                               "Intact: every joint is bonded and elastic. Now: the joints are as they rest under "
                               "gravity. The modes of the two states are paired by shape, with the modal assurance "
                               "criterion (MAC). None: none of the lowest modes of the present state has a similar "
                               "shape, because loose blocks have lower modes.");
  }
  return html;
}

}  // namespace voussoir
