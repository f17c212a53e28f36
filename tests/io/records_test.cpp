// Column files of ground motion.
#include <gtest/gtest.h>

#include "io/records/columns.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

std::string problem(const std::string& text, double dt = 0.0) {
  return test::message_of<InputError>([&] { parse_columns(text, "r.txt", dt); });
}

TEST(Columns, TwoColumnsWithCommentsAndAnySeparator) {
  const Record record = parse_columns("# station A\n1.00 0.5\n\n1.01, +1.5e0 # peak\r\n1.02;-2\n1.03\t0", "r.txt");
  EXPECT_NEAR(record.dt, 0.01, 1e-15);
  EXPECT_EQ(record.values, (std::vector<double>{0.5, 1.5, -2.0, 0.0}));
  EXPECT_NEAR(record.duration(), 0.03, 1e-12);
}

TEST(Columns, OneColumnWithGivenStep) {
  const Record record = parse_columns("1\n2\n3\n", "r.txt", 0.005);
  EXPECT_EQ(record.dt, 0.005);
  EXPECT_EQ(record.values.size(), 3u);
}

TEST(Columns, MessagesNameFileAndRow) {
  EXPECT_NE(
      problem("time acc\n0 0\n0.1 1\n")
          .find(
              "r.txt:1: the format of this file is not known. It begins with 'time acc'. The known formats are: PEER"),
      std::string::npos);
  EXPECT_EQ(problem("0 0\n0.1 one\n"), "r.txt:2: 'one' is not a number: rows must be numbers, headings begin with #.");
  EXPECT_NE(problem("0 0\n0.1 nan\n").find("r.txt:2: nan is not a finite number"), std::string::npos);
  EXPECT_NE(problem("0 0\n0.1 1\n0.1 1\n0.3 0\n").find("r.txt:3: the time 0.1 s follows 0.1 s"), std::string::npos);
  EXPECT_NE(problem("0 0\n0.1 1\n0.25 1\n0.3 0\n").find("r.txt:3: the time step is 0.15 s here and 0.1 s elsewhere"),
            std::string::npos);
  EXPECT_NE(problem("0 0 3\n0.1 1 3\n").find("r.txt:1: 3 columns, expected 2"), std::string::npos);
  EXPECT_NE(problem("0\n1\n").find("give the key 'dt'"), std::string::npos);
  EXPECT_NE(problem("0 1\n1 2\n", 0.1).find("expected 1 (acceleration) because 'dt' is given"), std::string::npos);
  EXPECT_NE(problem("0 0\n").find("1 row of numbers. At least 2 are needed"), std::string::npos);
  EXPECT_NE(problem("").find("0 rows"), std::string::npos);
}

TEST(Columns, StepsMayDifferByAMicrosecond) {
  EXPECT_EQ(problem("0 0\n0.0100005 1\n0.02 0\n"), "");
  EXPECT_NE(problem("0 0\n0.010003 1\n0.02 0\n"), "");
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
