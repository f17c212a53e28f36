// The case to begin with: it is a case, and has every key of the generator.
#include "io/case/case_template.h"

#include <gtest/gtest.h>

#include "io/case/case.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

Case read(const CaseTemplate& wanted) {
  return parse_case(case_template(wanted), "template.toml", CaseUse::run);
}

TEST(CaseTemplate, HasEveryKeyOfTheGenerator) {
  const std::string text = case_template({});
  const Generator& bridge = find_generator("bridge");
  const auto expect_line = [&](const std::string& key) {
    EXPECT_NE(text.find("\n" + key + " = "), std::string::npos) << key;
  };
  for (const Parameter& p : bridge.parameters) expect_line(p.name);
  for (const Choice& c : bridge.choices) expect_line(c.name);
  for (const KeyTable& table : bridge.tables) {
    EXPECT_NE(text.find(table.heading()), std::string::npos) << table.heading();
    for (const Parameter& p : table.parameters) expect_line(p.name);
  }
  for (const Material& m : bridge.materials) EXPECT_NE(text.find("[materials." + m.name + "]"), std::string::npos);
}

TEST(CaseTemplate, IsTheCaseOfTheDefaultsButForTheSpans) {
  const Case c = read({{8.0, 10.0, 10.0, 8.0}, "three-centred", 5.5});
  EXPECT_EQ(c.generator_input.entries.at("span"), 4u);
  EXPECT_EQ(c.generator_input("span.3.clear_span"), 10.0);
  EXPECT_EQ(c.generator_input.choices.at("span.4.shape"), "three-centred");
  EXPECT_EQ(c.generator_input("width"), 5.5);
  GeneratorInput defaults = default_input(find_generator("bridge"));
  for (const auto& [key, value] : defaults.values)
    if (key != "width" && key != "span.1.clear_span") {
      EXPECT_EQ(c.generator_input(key), value) << key;
    }
  EXPECT_EQ(c.settings.stages.size(), 1u);
}

TEST(CaseTemplate, EachShapeCanBeBuilt) {
  for (const std::string shape : {"semicircular", "segmental", "elliptical", "three-centred", "pointed", "parabolic"}) {
    Case c = read({{3.0, 5.0}, shape, 3.0});
    c.generator_input.values["block_scale"] = 2.0;
    EXPECT_GT(make_assembly(c).blocks.size(), 50u) << shape;
  }
  EXPECT_GT(make_assembly(read({{2.0}, "segmental", 2.5})).blocks.size(), 50u) << "one span, no pier";
}

TEST(CaseTemplate, RefusesLengthsBeyondTheirRange) {
  const auto message = [](const CaseTemplate& wanted) {
    return test::message_of<InputError>([&] { case_template(wanted); });
  };
  EXPECT_NE(message({{}, "segmental", 0.0}).find("has 0 spans"), std::string::npos);
  EXPECT_NE(message({{8.0, NAN}, "segmental", 0.0}).find("--spans has nan m"), std::string::npos);
  EXPECT_NE(message({std::vector<double>(61, 8.0), "segmental", 0.0}).find("61 spans"), std::string::npos);
  EXPECT_NE(message({{8.0}, "segmental", 0.5}).find("--width has 0.5 m"), std::string::npos);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
