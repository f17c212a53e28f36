// The modified MEXE method against a published sheet of BA 16/97, and its limits.
#include "solver/statics/mexe.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

/// "Anywhere Bridge", a spreadsheet after BA 16/97 (scribd 332064126).
MexeInput anywhere_bridge() {
  MexeInput in;
  in.span = 5.23, in.rise = 1.57, in.quarter_rise = 1.373, in.ring = 0.34, in.fill = 0.385;
  in.barrel = 0.8, in.fill_factor = 0.7, in.width = 0.9, in.depth = 1.0, in.mortar = 0.9, in.condition = 0.7;
  return in;
}

TEST(Mexe, WorkedExample) {
  const MexeResult r = mexe(anywhere_bridge());
  EXPECT_DOUBLE_EQ(r.total, 0.68);
  EXPECT_NEAR(r.provisional, 39.83, 0.005);
  EXPECT_NEAR(r.span_rise_ratio, 3.33, 0.005);
  EXPECT_EQ(r.span_rise, 1.0);
  EXPECT_NEAR(r.profile, 0.66, 0.005);
  EXPECT_NEAR(r.material, 0.75, 1e-12);
  EXPECT_NEAR(r.joint, 0.81, 1e-12);
  EXPECT_EQ(r.condition, 0.7);
  EXPECT_NEAR(r.modified, 11.2, 0.05);
}

TEST(Mexe, AllTheFillCountsWhenAskedFor) {
  MexeInput in = anywhere_bridge();
  in.fill_at_most_ring = false;
  const MexeResult r = mexe(in);
  EXPECT_DOUBLE_EQ(r.total, 0.725);
  EXPECT_NEAR(r.provisional, 39.83 * std::pow(0.725 / 0.68, 2), 0.01);
}

TEST(Mexe, ProfileFactorIsOneForDeepQuarters) {
  MexeInput in = anywhere_bridge();
  in.quarter_rise = 0.7 * in.rise;
  EXPECT_EQ(mexe(in).profile, 1.0);
}

TEST(Mexe, NoProvisionalLoadIsMoreThanTheNomogramHas) {
  MexeInput in = anywhere_bridge();
  in.span = 3.0, in.ring = 0.9, in.fill = 0.9;
  EXPECT_EQ(mexe(in).provisional, 70.0);
}

TEST(Mexe, LimitsAreNamed) {
  const auto message = [](void (*change)(MexeInput&)) {
    MexeInput in = anywhere_bridge();
    change(in);
    return test::message_of<InputError>([&] { mexe(in); });
  };
  const auto holds = [](const std::string& text, const std::string& piece) {
    EXPECT_NE(text.find(piece), std::string::npos) << text;
  };
  holds(message([](MexeInput& in) { in.span = 18.5; }), "the span is 18.5 m. It must be from 1.5 to 18 m");
  holds(message([](MexeInput& in) { in.span = std::nan(""); }), "the span is nan");
  holds(message([](MexeInput& in) { in.ring = in.fill = 0.1; }), "is 0.2 m. It must be from 0.25 to 1.8 m");
  holds(message([](MexeInput& in) { in.ring = in.fill = 0.95; }), "is 1.9 m. It must be from 0.25 to 1.8 m");
  holds(message([](MexeInput& in) { in.quarter_rise = 1.6; }), "less than the rise at the crown, 1.57 m");
  holds(message([](MexeInput& in) { in.condition = 0.0; }), "F_cM is 0");
  holds(message([](MexeInput& in) { in.rise = 1.0, in.quarter_rise = 0.8; }), "more than 4. Give the span/rise factor");
}

TEST(Mexe, FlatArchesNeedTheSpanRiseFactor) {
  MexeInput in = anywhere_bridge();
  in.rise = 1.0, in.quarter_rise = 0.75, in.span_rise = 0.85;
  EXPECT_EQ(mexe(in).span_rise, 0.85);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
