#include "io/case/case_template.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "geometry/generator.h"
#include "io/case/degrees.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"
#include "solver/base/suggestion.h"

namespace voussoir {

namespace {

constexpr std::size_t comment_column = 38;

/// Values that are not the defaults, as TOML texts.
using Given = std::map<std::string, std::string>;

std::string key_line(const std::string& key, const std::string& value, const std::string& comment) {
  return fmt::format("{:<{}}# {}\n", fmt::format("{} = {}", key, value), comment_column, comment);
}

std::string parameter_line(const Parameter& p, const Given& given) {
  const auto own = given.find(p.name);
  const std::string value = own != given.end() ? own->second
                            : p.integer        ? fmt::format("{:.0f}", p.value)
                                               : number_text(p.value);
  const std::string unit = p.unit == "-" ? "" : p.unit + ", ";
  return key_line(p.name, value, fmt::format("{}{} ({:g} to {:g})", unit, p.help, p.low, p.high));
}

std::string choice_line(const Choice& c, const Given& given) {
  const auto own = given.find(c.name);
  return key_line(c.name, own != given.end() ? own->second : fmt::format("\"{}\"", c.words.front()),
                  c.material ? c.help : fmt::format("{} ({})", c.help, fmt::join(c.words, ", ")));
}

std::string key_lines(const std::vector<Parameter>& parameters, const std::vector<Choice>& choices,
                      const std::vector<Profile>& profiles, const Given& given) {
  std::string text;
  for (const Choice& c : choices) text += choice_line(c, given);
  for (const Parameter& p : parameters) text += parameter_line(p, given);
  for (const Profile& p : profiles) text += key_line("# " + p.name, fmt::format("[{}, …]", p.pair), "m, " + p.help);
  return text;
}

std::string table_text(const KeyTable& table, const Given& given) {
  return fmt::format("\n{}\n", table.heading()) + key_lines(table.parameters, table.choices, table.profiles, given);
}

const Parameter& parameter_of(const std::vector<Parameter>& parameters, const std::string& name) {
  return *std::ranges::find(parameters, name, &Parameter::name);
}

void check_length(const char* option, double value, const Parameter& p) {
  if (!(value >= p.low && value <= p.high))
    throw InputError("--{} has {:g} {}. {} of the generator \"bridge\" must be from {:g} to {:g} {}.", option, value,
                     p.unit, p.name, p.low, p.high, p.unit);
}

void check(const CaseTemplate& wanted, const Generator& bridge, const KeyTable& span) {
  if (wanted.clear_spans.size() < span.least || wanted.clear_spans.size() > span.most)
    throw InputError("--spans has {}. Give {} to {} spans, such as 8,10,8.", counted(wanted.clear_spans.size(), "span"),
                     span.least, span.most);
  for (const double clear : wanted.clear_spans)
    check_length("spans", clear, parameter_of(span.parameters, "clear_span"));
  if (wanted.width != 0.0) check_length("width", wanted.width, parameter_of(bridge.parameters, "width"));
  const std::vector<std::string>& shapes = std::ranges::find(span.choices, "shape", &Choice::name)->words;
  if (std::ranges::find(shapes, wanted.shape) == shapes.end())
    throw InputError("--shape {} is not a shape of a vault{}", shown(wanted.shape), suggestion(wanted.shape, shapes));
  if (wanted.shape == "surveyed")
    throw InputError(
        "--shape surveyed: a surveyed vault needs its intrados. Begin with another shape, then set it in the case.");
}

/// The spans; equal neighbours share a table; only the first table has all keys.
std::string span_tables(const CaseTemplate& wanted, const KeyTable& span) {
  std::string text;
  for (std::size_t i = 0; i < wanted.clear_spans.size();) {
    std::size_t end = i;
    while (end < wanted.clear_spans.size() && wanted.clear_spans[end] == wanted.clear_spans[i]) ++end;
    const Given given = {{"shape", fmt::format("\"{}\"", wanted.shape)},
                         {"clear_span", number_text(wanted.clear_spans[i])}};
    std::string table = i == 0 ? table_text(span, given)
                               : fmt::format("\n{}\n", span.heading()) +
                                     key_lines({parameter_of(span.parameters, "clear_span")},
                                               {*std::ranges::find(span.choices, "shape", &Choice::name)}, {}, given);
    if (end - i > 1) table += key_line("repeat", fmt::format("{}", end - i), "number of equal spans");
    text += table;
    i = end;
  }
  return text;
}

std::string material_tables(const Generator& bridge) {
  std::string text;
  for (const Material& m : bridge.materials) {
    text += fmt::format("\n[materials.{}]\n", m.name);
    text += key_line("density", number_text(m.density), "kg/m3");
    text += key_line("youngs_modulus", number_text(m.youngs_modulus), "Pa");
    text += key_line("shear_modulus", number_text(m.shear_modulus), "Pa");
    text += key_line("tensile_strength", number_text(m.tensile_strength), "Pa");
    text += key_line("cohesion", number_text(m.cohesion), "Pa");
    text += key_line("friction_angle", degrees_text(m.friction_angle), "degrees");
  }
  return text;
}

}  // namespace

std::string case_template(const CaseTemplate& wanted) {
  const Generator& bridge = find_generator("bridge");
  const auto table = [&](const std::string& name) { return *std::ranges::find(bridge.tables, name, &KeyTable::name); };
  const KeyTable span = table("span");
  check(wanted, bridge, span);
  const std::size_t spans = wanted.clear_spans.size();
  std::vector<Parameter> dimensions, others;
  for (const Parameter& p : bridge.parameters) {
    const bool layout = is_dimension(p) || p.name == "skew" || p.name == "gradient";
    (layout ? dimensions : others).push_back(p);
  }
  Given given;
  if (wanted.width != 0.0) given["width"] = number_text(wanted.width);
  std::string text = fmt::format(
      "# A bridge of {} for the generator \"bridge\". It has every key of [bridge], in SI units and degrees.\n"
      "# Spans, shape of the vaults and width are those of --spans, --shape and --width. All other values are the\n"
      "# defaults. A key that you leave out has its default, too; that of the shape is \"semicircular\".\n"
      "# In the folder of this file:\n"
      "#   voussoir generate NAME.toml --picture     draws it with its dimensions\n"
      "#   voussoir run NAME.toml -o NAME            finds its equilibrium under its weight\n\n"
      "[bridge]\ngenerator = \"bridge\"\n",
      counted(spans, "span"));
  text += key_lines(dimensions, bridge.choices, {}, given);
  text += "\n# Sizes of the blocks, and stiffness of the joints.\n" + key_lines(others, {}, {}, {});
  text += fmt::format("\n# {}.\n", span.help) + span_tables(wanted, span);
  if (spans > 1) text += fmt::format("\n# {}.\n", table("pier").help) + table_text(table("pier"), {});
  for (const KeyTable& t : bridge.tables)
    if (!t.is_list()) text += fmt::format("\n# {}.", t.help) + table_text(t, {});
  text += "\n# Materials, from which mass, stiffness and strength follow.\n" + material_tables(bridge);
  text +=
      "\n[[stage]]\nkind = \"gravity\"\nconstruction = \"staged\"\n\n"
      "# [[stage]]                            # an earthquake: three records, in the folder of this file\n"
      "# kind = \"motion\"\n"
      "# duration = 20.0                      # s\n"
      "# record = [\"station_x.txt\", \"station_y.txt\", \"station_z.txt\"]\n"
      "# units = \"g\"\n"
      "# correct = true\n";
  return text;
}

}  // namespace voussoir
