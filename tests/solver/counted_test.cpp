// Counts in words for messages and pages.
#include "solver/base/counted.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "geometry/joint_counts.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

TEST(Counted, OneIsSingularAndAllOthersArePlural) {
  EXPECT_EQ(counted(1, "joint"), "1 joint");
  EXPECT_EQ(counted(0, "joint"), "0 joints");
  EXPECT_EQ(counted(2, "joint"), "2 joints");
  EXPECT_EQ(counted(-1, "joint"), "-1 joints");
  EXPECT_EQ(counted(std::size_t(1), "time step"), "1 time step");
  EXPECT_EQ(counted(std::int64_t(12000000), "time step"), "12000000 time steps");
}

TEST(Counted, AnIrregularPluralIsGiven) {
  EXPECT_EQ(counted(1, "tetrahedron", "tetrahedra"), "1 tetrahedron");
  EXPECT_EQ(counted(3, "tetrahedron", "tetrahedra"), "3 tetrahedra");
  EXPECT_EQ(counted(1, "joint hinges", "joints hinge"), "1 joint hinges");
  EXPECT_EQ(counted(4, "joint hinges", "joints hinge"), "4 joints hinge");
}

TEST(Counted, ASingleJointOfAnAssemblyIsSingular) {
  Assembly assembly;
  assembly.laws.resize(1);
  assembly.joints.resize(1);
  assembly.joints[0].law = 0;
  EXPECT_EQ(joints_text(assembly).substr(0, 8), "1 joint:");
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
