// Joints point by point, eight side by side, against the law applied to one point after the other.
#include "solver/contact/wrench.h"
#include "solver/model/laws.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

struct Given {
  const char* name;
  double tension, cohesion, residual_cohesion, friction, residual_friction, dilation;  // Pa; tangents
  double aside;  // the share of the motion that all but the normal one get
};

JointLaw law_of(const Given& given) {
  JointLaw law;
  law.tension = given.tension, law.cohesion = given.cohesion, law.residual_cohesion = given.residual_cohesion;
  law.friction_angle = std::atan(given.friction), law.residual_friction_angle = std::atan(given.residual_friction);
  law.dilation_angle = std::atan(given.dilation);
  return law;
}

/// A prism on another; a polygon that is no rectangle keeps its points in a table.
Assembly two_prisms(const Polygon& polygon, const JointLaw& law) {
  Assembly assembly = stone();
  add_block(assembly, make_prism(polygon, {0, 0, -0.7}));
  add_block(assembly, make_prism(Polygon(polygon.rbegin(), polygon.rend()), {0, 0, 0.6}));
  return joined(std::move(assembly), 2e9, 8e8, law);
}

/// The only joint, by the law alone.
class Oracle {
 public:
  explicit Oracle(const Bench& bench)
      : bench_(bench),
        patch_(bench.model.joints[0]),
        memory_(std::size_t(patch_.point_count)),
        branches_(std::size_t(patch_.point_count)) {
    for (PointMemory& memory : memory_) memory.broken = bench.state.joint.mode[0] & mode_broken;  // never had a bond
  }

  /// Force and moment about the world's origin on body a, at the present placement.
  std::array<double, 6> wrench() {
    const double* pose = bench_.state.pose.data();
    const Jump<double> jump = patch_jump(patch_, pose + pose_width * patch_.a, pose + pose_width * patch_.b);
    const LawConstants& law = bench_.model.laws[std::size_t(patch_.law)];
    Resultant<double> q{};
    for (int i = 0; i < patch_.point_count; ++i) {
      const PatchPoint at = patch_point(patch_, bench_.model.points, i);
      const Triple<double> u = point_jump(patch_, jump, at.s, at.t);
      PointMemory& memory = memory_[std::size_t(i)];
      const PointMemory before = memory;
      const PointResult r = BrittleLaw::update(law, patch_.kn, patch_.ks, u.x, u.y, u.z, memory);
      breaks += memory.broken && !before.broken, slides += !r.elastic && !r.open && before.broken, opens += r.open;
      const Vec3 v = Vec3(r.n, r.s, r.t) + viscous(branches_[std::size_t(i)], u, r);
      const double n = at.weight * patch_.kn * v[0], s = at.weight * patch_.ks * v[1], t = at.weight * patch_.ks * v[2];
      q.n += n, q.s += s, q.t += t;
      q.sn += at.s * n, q.tn += at.t * n, q.ss += at.s * s, q.ts += at.t * s, q.st += at.s * t, q.tt += at.t * t;
    }
    const WorldWrench<double> w(q, jump);
    return {w.force.x, w.force.y, w.force.z, w.moment.x, w.moment.y, w.moment.z};
  }

  int breaks = 0, slides = 0, opens = 0;

 private:
  /// What the branches of a point keep: the jump and whether it was open at the pass before, q of each branch.
  struct PointBranches {
    Vec3 last = Vec3::Zero();
    bool was_open = false;
    std::array<Vec3, most_branches> q;
    PointBranches() { q.fill(Vec3::Zero()); }
  };

  /// Σ q: they follow the elastic jump and are emptied where the point yields (docs/theory/damping.md).
  Vec3 viscous(PointBranches& point, const Triple<double>& u, const PointResult& r) const {
    const Vec3 jump(u.x, u.y, u.z);
    Vec3 move = jump - point.last, sum = Vec3::Zero();
    if (point.was_open) move[0] = r.n;  // pressed from where it closed
    const Branches& at_work = bench_.stepper.damping.branches;
    for (int k = 0; k < at_work.count; ++k) {
      Vec3& q = point.q[std::size_t(k)];
      q = r.elastic ? Vec3(at_work.e[k] * q + at_work.g[k] * move) : Vec3(Vec3::Zero());
      sum += q;
    }
    point.last = jump, point.was_open = r.open;
    return sum;
  }

  const Bench& bench_;
  const Patch& patch_;
  std::vector<PointMemory> memory_;
  std::vector<PointBranches> branches_;
};

/// Rocked, twisted and dragged to and fro about a mean compression.
void move_block(Bench& bench, int step, double aside) {
  const double t = 0.02 * step, reach = 1.2e-4;
  const Vec3 move = {aside * reach * std::sin(1.3 * t), aside * reach * std::sin(0.7 * t + 1.0),
                     reach * std::sin(1.1 * t) - 6e-5};
  const Vec3 turn = aside * 1e-4 * Vec3(std::sin(0.9 * t), std::sin(1.7 * t + 2.0), std::sin(0.5 * t));
  const Vec3 half = 0.5 * turn;
  bench.place(1, move, Eigen::Quaterniond(std::sqrt(1 - half.squaredNorm()), half.x(), half.y(), half.z()));
}

TEST(PointLanes, FollowTheLawPointByPoint) {
  const Given laws[] = {{"bonded", 1e5, 1.5e5, 0.0, 0.7, 0.6, 0.0, 1.0},
                        {"pulled straight beyond the cone's apex", 1e6, 3e4, 0.0, 0.7, 0.6, 0.0, 1e-3},
                        {"cohesion that stays, dilation", 5e4, 8e4, 3e4, 0.7, 0.7, 0.1, 1.0},
                        {"dry", 0.0, 0.0, 0.0, 0.5, 0.5, 0.0, 1.0}};
  const Polygon rectangle = {{0, 0, 0}, {0.8, 0, 0}, {0.8, 0.5, 0}, {0, 0.5, 0}};
  const Polygon pentagon = {{0, 0, 0}, {0.8, 0, 0}, {0.9, 0.4, 0}, {0.4, 0.7, 0}, {-0.1, 0.4, 0}};
  using Damping = DampingSettings::Kind;
  for (const Given& given : laws)
    for (const auto& [polygon, damping] : {std::pair{rectangle, Damping::none},
                                           {pentagon, Damping::none},
                                           {rectangle, Damping::maxwell},
                                           {pentagon, Damping::maxwell}}) {
      SolverSettings settings = undamped();
      settings.damping.kind = damping;
      settings.step.intact_shortcut = false;
      Bench bench(two_prisms(polygon, law_of(given)), settings);
      ASSERT_EQ(bench.model.joints.size(), 1u);
      bench.begin(1e-3);
      Oracle oracle(bench);
      double worst = 0.0, largest = 0.0;
      for (int step = 0; step < 2000; ++step) {
        move_block(bench, step, given.aside);
        bench.stepper.patches_only();
        const std::array<double, 6> expected = oracle.wrench();
        for (std::size_t c = 0; c < 6; ++c) {
          worst = std::max(worst, std::abs(bench.stepper.wrenches[c] - expected[c]));
          largest = std::max(largest, std::abs(expected[c]));
        }
      }
      // Branches are kept in single precision, and so is the jump whose change moves them.
      const double agreement = damping == Damping::none ? 1e-11 : 1e-6;
      EXPECT_LT(worst, agreement * largest) << given.name << ", " << polygon.size() << " corners";
      EXPECT_GT(oracle.slides, given.aside == 1.0 ? 1000 : 0) << given.name;
      EXPECT_GT(oracle.opens, 1000) << given.name;
      EXPECT_EQ(oracle.breaks > 0, given.cohesion > given.residual_cohesion) << given.name;
    }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
