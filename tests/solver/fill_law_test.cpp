// Mohr–Coulomb with tension cut-off: what returns to the surface is admissible, has flowed as the rule says, and
// changes continuously; principal axes; the tangent.
#include <gtest/gtest.h>

#include <random>

#include "solver/fill/mohr_coulomb.h"
#include "solver/fill/principal.h"
#include "solver/linear/dense_solve.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

Material soil(double friction, double dilation, double cohesion, double tension) {
  Material m;
  m.name = "soil";
  m.density = 1500.0, m.youngs_modulus = 400e6, m.shear_modulus = 160e6;
  m.cohesion = cohesion, m.tensile_strength = tension;
  m.friction_angle = friction * M_PI / 180.0, m.dilation_angle = dilation * M_PI / 180.0;
  return m;
}

std::vector<Material> soils() {
  return {soil(40, 0, 20e3, 0), soil(40, 0, 20e3, 1e9), soil(30, 30, 20e3, 5e3), soil(10, 10, 1e6, 1e9),
          soil(35, 5, 0, 0),    soil(0, 0, 50e3, 1e30), soil(0, 0, 50e3, 10e3),  soil(45, 20, 100e3, 30e3)};
}

Vec3 sorted(Vec3 v) {
  std::sort(v.data(), v.data() + 3, std::greater<>());
  return v;
}

struct Returned {
  Vec3 stress;
  ReturnRegion region = ReturnRegion::elastic;
};
Returned returned(const FillLaw& law, const Vec3& trial) {
  const double t[3] = {trial[0], trial[1], trial[2]};
  double s[3], region = 0.0;
  return_to_surface(law, t, s, &region);
  return {{s[0], s[1], s[2]}, ReturnRegion(int(region))};
}

double excess(const FillLaw& law, const Vec3& s) {
  return std::max(law.major * s[0] - law.minor * s[2] - law.strength, s[0] - law.tension);
}

/// The trial stresses of a test: all sizes, and many with two or three equal.
std::vector<Vec3> trials(int count) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> size(2.0, 6.5), pick(0.0, 1.0);
  std::vector<Vec3> all;
  for (int i = 0; i < count; ++i) {
    const double scale = std::pow(10.0, size(random));
    Vec3 t = scale * Vec3(normal(random), normal(random), normal(random)) + Vec3::Constant(scale * normal(random));
    const double p = pick(random);
    if (p < 0.1) t[1] = t[0];
    if (p < 0.02) t[2] = t[0];
    all.push_back(sorted(t));
  }
  return all;
}

TEST(FillLaw, ReturnsToTheSurfaceAndFlowsAsTheRuleSays) {
  std::set<ReturnRegion> seen;
  for (const Material& m : soils()) {
    const FillLaw law = fill_law(m);
    const Mat3 d = law.lame() * Mat3::Ones() + 2.0 * law.shear * Mat3::Identity();
    for (const Vec3& trial : trials(20000)) {
      const Returned r = returned(law, trial);
      seen.insert(r.region);
      const double tiny = 1e-9 * (trial.norm() + law.strength);
      ASSERT_LE(excess(law, r.stress), tiny) << trial.transpose();
      ASSERT_GE(r.stress[0], r.stress[1] - tiny);
      ASSERT_GE(r.stress[1], r.stress[2] - tiny);
      if (excess(law, trial) <= 0.0) {
        ASSERT_EQ(r.region, ReturnRegion::elastic);
        ASSERT_EQ(r.stress, trial);
        continue;
      }
      // The plastic strain is made of the flows of planes on which the stress lies, none of them backwards.
      const Vec3 flow = d.inverse() * (trial - r.stress);
      const double a = law.flow_major, b = law.flow_minor, near = 1e-7 * (trial.norm() + law.strength);
      std::vector<Vec3> flows;
      const int pairs[6][2] = {{0, 2}, {0, 1}, {1, 2}, {1, 0}, {2, 1}, {2, 0}};
      for (const auto& [i, j] : pairs)
        if (std::abs(law.major * r.stress[i] - law.minor * r.stress[j] - law.strength) < near)
          flows.push_back(a * Vec3::Unit(i) - b * Vec3::Unit(j));
      for (int i = 0; i < 3; ++i)
        if (std::abs(r.stress[i] - law.tension) < near) flows.push_back(Vec3::Unit(i));
      // Non-negative least squares by going through all triples.
      double best = 1e300;
      const auto attempt = [&](const std::vector<Vec3>& some) {
        Eigen::MatrixXd columns(3, Eigen::Index(some.size()));
        for (std::size_t i = 0; i < some.size(); ++i) columns.col(Eigen::Index(i)) = some[i];
        const Eigen::VectorXd share = least_squares(columns, flow);
        if (share.minCoeff() > -1e-6 * flow.norm()) best = std::min(best, (columns * share - flow).norm());
      };
      for (std::size_t i = 0; i < flows.size(); ++i) {
        attempt({flows[i]});
        for (std::size_t j = i + 1; j < flows.size(); ++j) {
          attempt({flows[i], flows[j]});
          for (std::size_t k = j + 1; k < flows.size(); ++k) attempt({flows[i], flows[j], flows[k]});
        }
      }
      ASSERT_LT(best, 1e-6 * flow.norm()) << "trial " << trial.transpose() << " stress " << r.stress.transpose()
                                          << " friction " << m.friction_angle << " region " << int(r.region);
    }
  }
  EXPECT_EQ(seen.size(), std::size_t(return_regions));
}

TEST(FillLaw, ChangesContinuously) {
  for (const Material& m : soils()) {
    const FillLaw law = fill_law(m);
    for (const Vec3& trial : trials(5000)) {
      const Vec3 s = returned(law, trial).stress;
      for (int i = 0; i < 3; ++i) {
        const double h = 1e-6 * (trial.norm() + 1.0);
        const Vec3 moved = returned(law, sorted(trial + h * Vec3::Unit(i))).stress;
        ASSERT_LT((moved - s).norm(), 20.0 * h) << trial.transpose() << " friction " << m.friction_angle;
      }
    }
  }
}

TEST(FillLaw, LanesDoNotKnowOfEachOther) {
  const FillLaw law = fill_law(soil(35, 5, 20e3, 5e3));
  const std::vector<Vec3> all = trials(800);
  for (std::size_t i = 0; i + 8 <= all.size(); i += 8) {
    Lanes t[2][3], s[2][3], region[2];
    for (const std::size_t turned : {0, 3}) {
      Lanes(&trial)[3] = t[turned > 0];
      for (std::size_t lane = 0; lane < 8; ++lane)
        for (int c = 0; c < 3; ++c) trial[c][lane] = all[i + (lane + turned) % 8][c];
      return_to_surface(law, trial, s[turned > 0], &region[turned > 0]);
    }
    for (std::size_t lane = 0; lane < 8; ++lane) {
      const Returned one = returned(law, all[i + lane]);
      EXPECT_EQ(region[0][lane], double(int(one.region)));
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(s[0][c][(lane + 3) % 8], s[1][c][lane]);
        EXPECT_NEAR(s[0][c][lane], one.stress[c], 1e-11 * one.stress.norm());  // but for fused operations
      }
    }
  }
}

/// D − D R (Nᵀ D R)⁻¹ Nᵀ D for planes with these normals and flows, columns of n and r.
template <int planes>
Mat3 along(const Mat3& d, const Eigen::Matrix<double, 3, planes>& n, const Eigen::Matrix<double, 3, planes>& r) {
  const Eigen::Matrix<double, planes, planes> across = n.transpose() * d * r;
  return d - d * r * across.inverse() * n.transpose() * d;
}
Mat3 along_both(const Mat3& d, const Vec3& n, const Vec3& r, const Vec3& m, const Vec3& s) {
  Eigen::Matrix<double, 3, 2> normals, flows;
  normals << n, m;
  flows << r, s;
  return along<2>(d, normals, flows);
}

/// ∂σ_i/∂ε_j of the returned principal stresses with respect to the trial strains, in a region.
Mat3 return_tangent(const FillLaw& law, ReturnRegion region) {
  const double a = law.major, b = law.minor, ag = law.flow_major, bg = law.flow_minor;
  const Mat3 d = law.lame() * Mat3::Ones() + 2.0 * law.shear * Mat3::Identity();
  const Vec3 n13(a, 0, -b), n23(0, a, -b), n12(a, -b, 0), r13(ag, 0, -bg), r23(0, ag, -bg), r12(ag, -bg, 0);
  const Vec3 e1(1, 0, 0), e2(0, 1, 0);
  switch (region) {
    case ReturnRegion::elastic:
      return d;
    case ReturnRegion::plane:
      return along<1>(d, n13, r13);
    case ReturnRegion::cut:
      return along<1>(d, e1, e1);
    case ReturnRegion::edge_12:
      return along_both(d, n13, r13, n23, r23);
    case ReturnRegion::edge_23:
      return along_both(d, n13, r13, n12, r12);
    case ReturnRegion::cut_12:
      return along_both(d, e1, e1, e2, e2);
    case ReturnRegion::plane_cut:
      return along_both(d, n13, r13, e1, e1);
    default:
      return Mat3::Zero();  // corners: three planes
  }
}

TEST(FillLaw, SlopesAreThoseOfThePlanes) {
  for (const Material& m : soils()) {
    const FillLaw law = fill_law(m);
    const Mat3 d = law.lame() * Mat3::Ones() + 2.0 * law.shear * Mat3::Identity();
    for (const Vec3& trial : trials(3000)) {
      if (trial[0] - trial[1] < 1e-3 * trial.norm() || trial[1] - trial[2] < 1e-3 * trial.norm()) continue;
      const Returned r = returned(law, trial);
      const double h = 1e-5 * trial.norm() / law.stiff();
      Mat3 slope;
      bool same = true;
      for (int j = 0; j < 3; ++j) {
        const Returned up = returned(law, trial + h * d.col(j)), down = returned(law, trial - h * d.col(j));
        same &= up.region == r.region && down.region == r.region;
        slope.col(j) = (up.stress - down.stress) / (2.0 * h);
      }
      if (!same) continue;
      const Mat3 tangent = return_tangent(law, r.region);
      ASSERT_LT((slope - tangent).norm(), 1e-5 * d.norm()) << int(r.region);
    }
  }
}

TEST(FillLaw, TheCircularConeIsOnTheSafeSide) {
  int sure = 0;
  for (const Material& m : soils()) {
    const FillLaw law = fill_law(m);
    for (const Vec3& s : trials(5000)) {
      const double p = s.mean();
      if (!surely_elastic(law, (s - Vec3::Constant(p)).squaredNorm(), p)) continue;
      ++sure;
      ASSERT_LE(excess(law, s), 1e-9 * s.norm());
    }
  }
  EXPECT_GT(sure, 1000);
}

TEST(FillLaw, PrincipalAxes) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20000; ++i) {
    Mat3 a;
    for (int k = 0; k < 9; ++k) a(k / 3, k % 3) = normal(random);
    Mat3 s = a + a.transpose();
    if (i % 3 == 0) s = a * Vec3(1, 1, 2).asDiagonal() * a.transpose();
    if (i % 7 == 0) s = 1e-9 * s + Mat3::Identity();
    if (i % 11 == 0) s = Vec3(normal(random), 1, 1).asDiagonal();
    if (i % 13 == 0) {  // two equal ones, or nearly, along any axes
      const Mat3 q = Eigen::Quaterniond(a(0, 0), a(0, 1), a(0, 2), a(1, 0)).normalized().toRotationMatrix();
      s = q * Vec3(i % 2 ? 2 : -2, 1, 1 + 1e-12 * (i % 5)).asDiagonal() * q.transpose();
      s = (0.5 * (s + s.transpose())).eval();
    }
    if (i % 17 == 0) s = normal(random) * Mat3::Identity();
    const Symmetric<double> tensor = {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(0, 2), s(1, 2)};
    for (const Principal<double>& x : {principal(tensor), principal_axes(tensor)}) {
      Mat3 v;
      for (int k = 0; k < 9; ++k) v(k / 3, k % 3) = x.axes.m[k / 3][k % 3];
      const Vec3 values(x.value[0], x.value[1], x.value[2]);
      ASSERT_LT((v * values.asDiagonal() * v.transpose() - s).norm(), 1e-13 * s.norm());
      ASSERT_LT((v.transpose() * v - Mat3::Identity()).norm(), 1e-13);
      ASSERT_GE(values[0], values[1] - 1e-15 * s.norm());
      ASSERT_GE(values[1], values[2] - 1e-15 * s.norm());
    }
    const Symmetric<double> shape = deviator(tensor);
    const Principal<double> x = principal_axes(shape);
    const auto [high, low] = extremes(apart_value(shape));
    ASSERT_NEAR(high, x.value[0], 1e-7 * (x.value[0] - x.value[2]) + 1e-15 * s.norm());
    ASSERT_NEAR(low, x.value[2], 1e-7 * (x.value[0] - x.value[2]) + 1e-15 * s.norm());
  }
  const Principal<double> nothing = principal_axes(Symmetric<double>{});
  for (const double value : nothing.value) EXPECT_EQ(value, 0.0);
}

TEST(FillLaw, RefusesWhatIsNoMaterial) {
  EXPECT_THROW(fill_law(soil(20, 30, 0, 0)), std::exception);
  Material m = soil(30, 0, 0, 0);
  m.shear_modulus = 100e6;  // Poisson's ratio 1
  EXPECT_THROW(fill_law(m), std::exception);
  m = soil(30, 0, 0, 0);
  m.density = 0.0;
  EXPECT_THROW(fill_law(m), std::exception);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
