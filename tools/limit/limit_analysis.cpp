#include "tools/limit/limit_analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "tools/limit/linear_program.h"

namespace voussoir::limit {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A joint as a line in the plane x-z.
struct Line {
  Vec3 normal, along;     // unit; from a to b, and in the plane
  Vec3 ends[2];           // m
  double friction = 0.0;  // tangent
  double cohesion = 0.0;  // N, over its whole area
  double length() const { return (ends[1] - ends[0]).norm(); }
  Vec3 middle() const { return 0.5 * (ends[0] + ends[1]); }
};

std::string joint_label(const Assembly& assembly, std::size_t i) {
  const Joint& joint = assembly.joints[i];
  return fmt::format("joint {} between {} and {}", i, block_label(assembly, joint.a), block_label(assembly, joint.b));
}

Line line_of(const Assembly& assembly, std::size_t i) {
  const Joint& joint = assembly.joints[i];
  const JointLaw& law = assembly.laws[std::size_t(joint.law)];
  if (law.kind == JointLaw::Kind::elastic || law.kind == JointLaw::Kind::tie)
    throw InputError("{} has the law {}. Limit analysis supports brittle and softening laws only",
                     joint_label(assembly, i), joint_law_kinds()[std::size_t(law.kind)]);
  if (std::abs(joint.normal.y()) > 1e-6)
    throw InputError(
        "{} has a normal with the component y = {:g}. Limit analysis needs an assembly that is plane in x-z",
        joint_label(assembly, i), joint.normal.y());
  Line line;
  line.normal = joint.normal;
  line.along = Vec3(joint.normal.z(), 0.0, -joint.normal.x());
  double low = infinite, high = -infinite;
  for (const Vec3& p : joint.polygon) low = std::min(low, p.dot(line.along)), high = std::max(high, p.dot(line.along));
  for (const Vec3& p : joint.polygon) {
    const double t = p.dot(line.along);
    if (std::min(t - low, high - t) > 1e-6 * (high - low))
      throw InputError("{} is not a strip across y, because one of its corners is between its ends",
                       joint_label(assembly, i));
  }
  Vec3 base = joint.polygon.front();
  base.y() = 0.0;
  const double at = base.dot(line.along);
  line.ends[0] = base + (low - at) * line.along, line.ends[1] = base + (high - at) * line.along;
  line.friction = std::tan(law.residual_friction_angle);
  line.cohesion = law.residual_cohesion * joint.area;
  return line;
}

std::vector<Line> lines_of(const Assembly& assembly) {
  if (!assembly.fill.empty())
    throw InputError("limit analysis needs rigid blocks, but the assembly has a deformable fill");
  std::vector<Line> lines;
  for (std::size_t i = 0; i < assembly.joints.size(); ++i) lines.push_back(line_of(assembly, i));
  return lines;
}

/// Bounds of a joint's shear, |shear| ≤ constant + slope × normal force.
struct ShearBound {
  double constant = 0.0;  // N
  double slope = 0.0;
};

/// The linear program. Forces are in units of the mean weight and moments of that times a block's size, so that the
/// solver's tolerances mean the same for all assemblies.
class Program {
 public:
  Program(const Assembly& assembly, const LimitProblem& problem, const std::vector<Line>& lines)
      : assembly_(assembly), problem_(problem), lines_(lines) {
    double mass = 0.0, free = 0.0;
    for (const Block& block : assembly.blocks)
      if (!block.fixed) mass += block.mass, free += 1.0;
    for (const Line& line : lines) size_ += line.length() / double(lines.size());
    force_ = mass > 0.0 ? 9.81 * mass / free : 1.0;
  }

  LimitAnalysis solve(const std::vector<ShearBound>& bounds) {
    LinearProgram lp;
    lay_blocks(lp);
    for (std::size_t i = 0; i < lines_.size(); ++i) lay_joint(lp, i, bounds[i]);
    multiplier_ = lp.add_column(0.0, problem_.largest, 1.0);
    lay_pattern(lp);
    const LinearOptimum optimum = limit::solve(lp);
    LimitAnalysis a;
    a.stands = optimum.kind == LinearOptimum::Kind::found;
    if (!a.stands) return a;
    a.multiplier = optimum.value;
    a.limited = optimum.value < problem_.largest * (1.0 - 1e-9);
    read_forces(a, optimum);
    if (a.limited) read_mechanism(a, optimum);
    return a;
  }

 private:
  /// Moment about y of a force at a point, the block's centroid being the origin.
  static double moment(const Vec3& arm, const Vec3& force) { return arm.z() * force.x() - arm.x() * force.z(); }

  void lay_blocks(LinearProgram& lp) {
    row_.assign(assembly_.blocks.size(), -1);
    for (std::size_t b = 0; b < assembly_.blocks.size(); ++b) {
      const Block& block = assembly_.blocks[b];
      if (block.fixed) continue;
      const Vec3 weight = block.mass * problem_.gravity / force_;
      row_[b] = lp.add_row(-weight.x(), -weight.x());
      lp.add_row(0.0, 0.0);
      lp.add_row(-weight.z(), -weight.z());
    }
  }

  /// A force of one unit at a point, as a column of both its blocks.
  void lay_force(LinearProgram& lp, std::size_t joint, int column, const Vec3& at, const Vec3& on_b) {
    const Joint& j = assembly_.joints[joint];
    for (const auto& [block, sign] : {std::pair(j.a, -1.0), std::pair(j.b, 1.0)})
      lay(lp, block, column, at, sign * on_b);
  }

  void lay(LinearProgram& lp, std::int64_t block, int column, const Vec3& at, const Vec3& force) {
    const int row = row_[std::size_t(block)];
    if (row < 0) return;
    const Vec3 arm = at - assembly_.blocks[std::size_t(block)].centroid;
    lp.add(row, column, force.x());
    lp.add(row + 1, column, moment(arm, force) / size_);
    lp.add(row + 2, column, force.z());
  }

  /// Columns: normal force at both ends, shear. Rows: shear within its bounds.
  void lay_joint(LinearProgram& lp, std::size_t i, const ShearBound& bound) {
    const Line& line = lines_[i];
    const int column = lp.add_column(0.0, infinite);
    lp.add_column(0.0, infinite);
    lp.add_column(-infinite, infinite);
    for (int end = 0; end < 2; ++end) lay_force(lp, i, column + end, line.ends[end], line.normal);
    lay_force(lp, i, column + 2, line.middle(), line.along);
    for (const double sign : {1.0, -1.0}) {
      const int row = lp.add_row(-infinite, bound.constant / force_);
      lp.add(row, column + 2, sign);
      for (int end = 0; end < 2; ++end) lp.add(row, column + end, -bound.slope);
    }
  }

  void lay_pattern(LinearProgram& lp) {
    std::vector<Vec3> force(assembly_.blocks.size(), Vec3::Zero());
    std::vector<double> turn(assembly_.blocks.size(), 0.0);
    for (std::size_t b = 0; b < assembly_.blocks.size(); ++b)
      force[b] = assembly_.blocks[b].mass * problem_.acceleration / force_;
    for (const BlockLoad& load : problem_.loads) {
      const auto b = std::size_t(load.block);
      force[b] += load.force / force_;
      turn[b] += moment(load.at - assembly_.blocks[b].centroid, load.force) / (force_ * size_);
    }
    for (std::size_t b = 0; b < assembly_.blocks.size(); ++b) {
      if (row_[b] < 0) continue;
      lp.add(row_[b], multiplier_, force[b].x());
      lp.add(row_[b] + 1, multiplier_, turn[b]);
      lp.add(row_[b] + 2, multiplier_, force[b].z());
    }
  }

  void read_forces(LimitAnalysis& a, const LinearOptimum& optimum) const {
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const double* x = &optimum.x[3 * i];
      JointForce f;
      f.normal = force_ * (x[0] + x[1]);
      f.shear = force_ * x[2];
      f.lever = x[0] + x[1] > 0.0 ? 0.5 * lines_[i].length() * (x[1] - x[0]) / (x[0] + x[1]) : 0.0;
      f.limit = lines_[i].cohesion + lines_[i].friction * f.normal;
      a.forces.push_back(f);
    }
  }

  /// The duals of the equilibrium of a block are its velocity: an additional force on it changes the multiplier by
  /// minus that velocity, if the power of the pattern is one.
  void read_mechanism(LimitAnalysis& a, const LinearOptimum& optimum) const {
    a.rates.assign(assembly_.blocks.size(), Vec3::Zero());
    for (std::size_t b = 0; b < assembly_.blocks.size(); ++b) {
      if (row_[b] < 0) continue;
      const double* dual = &optimum.dual[std::size_t(row_[b])];
      a.rates[b] = Vec3(dual[0], dual[1] / size_, dual[2]) / force_;
    }
    std::vector<JointRate> all;
    double largest = 0.0;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const Line& line = lines_[i];
      JointRate r;
      r.joint = i;
      for (int end = 0; end < 2; ++end) r.opening[end] = apart(a, i, line.ends[end]).dot(line.normal);
      r.slip = apart(a, i, line.middle()).dot(line.along);
      largest = std::max({largest, std::abs(r.opening[0] - r.opening[1]), std::abs(r.slip)});
      all.push_back(r);
    }
    for (const JointRate& r : all)
      if (std::max(std::abs(r.opening[0] - r.opening[1]), std::abs(r.slip)) >= 0.01 * largest) a.mechanism.push_back(r);
  }

  /// Velocity of b less that of a at a point of their joint.
  Vec3 apart(const LimitAnalysis& a, std::size_t joint, const Vec3& at) const {
    const auto velocity = [&](std::int64_t block) -> Vec3 {
      const Vec3 &rate = a.rates[std::size_t(block)], arm = at - assembly_.blocks[std::size_t(block)].centroid;
      return {rate.x() + rate.y() * arm.z(), 0.0, rate.z() - rate.y() * arm.x()};
    };
    return velocity(assembly_.joints[joint].b) - velocity(assembly_.joints[joint].a);
  }

  const Assembly& assembly_;
  const LimitProblem& problem_;
  const std::vector<Line>& lines_;
  double size_ = 0.0;   // m
  double force_ = 1.0;  // N
  std::vector<int> row_;
  int multiplier_ = 0;
};

void check_problem(const Assembly& assembly, const LimitProblem& problem) {
  if (assembly.joints.empty()) throw InputError("limit analysis: the assembly has no joints");
  for (const BlockLoad& load : problem.loads)
    if (load.block < 0 || load.block >= std::int64_t(assembly.blocks.size()))
      throw InputError("limit analysis: a load acts on block {}, but there are only {}", load.block,
                       counted(assembly.blocks.size(), "block"));
}

void find_excess(LimitAnalysis& a) {
  double normal = 0.0, beyond = 0.0;
  for (const JointForce& f : a.forces) {
    normal = std::max(normal, f.normal);
    beyond = std::max(beyond, std::abs(f.shear) - f.limit);
  }
  a.excess = normal > 0.0 ? beyond / normal : 0.0;
}

}  // namespace

bool JointRate::slides() const {
  return std::abs(slip) > std::abs(opening[1] - opening[0]);
}

LimitAnalysis limit_analysis(const Assembly& assembly, const LimitProblem& problem) {
  check_problem(assembly, problem);
  const std::vector<Line> lines = lines_of(assembly);
  std::vector<ShearBound> bounds;
  for (const Line& line : lines) bounds.push_back({line.cohesion, line.friction});
  LimitAnalysis a = Program(assembly, problem, lines).solve(bounds);
  find_excess(a);
  return a;
}

LimitAnalysis limit_analysis_without_lift(const Assembly& assembly, const LimitProblem& problem) {
  constexpr double lift = 1e-3;     // remaining share of the friction as dilation
  constexpr double share = 0.3;     // weight of the newest solution in the normal forces that limit friction
  constexpr double settled = 1e-3;  // of the multiplier, over ten solutions
  constexpr int most = 100, window = 10;
  LimitAnalysis a = limit_analysis(assembly, problem);
  if (!a.stands || !a.limited) return a;
  const std::vector<Line> lines = lines_of(assembly);
  Program program(assembly, problem, lines);
  std::vector<double> normal;
  for (const JointForce& f : a.forces) normal.push_back(f.normal);
  std::vector<double> found = {a.multiplier};
  while (int(found.size()) < most) {
    std::vector<ShearBound> bounds;
    for (std::size_t i = 0; i < lines.size(); ++i)
      bounds.push_back({lines[i].cohesion + (1.0 - lift) * lines[i].friction * normal[i], lift * lines[i].friction});
    a = program.solve(bounds);
    if (!a.stands || !a.limited)
      throw RunError("limit analysis without lift: there is no equilibrium under the normal forces of solution {}",
                     found.size());
    for (std::size_t i = 0; i < lines.size(); ++i) normal[i] += share * (a.forces[i].normal - normal[i]);
    found.push_back(a.multiplier);
    if (found.size() <= window) continue;
    const auto [low, high] = std::minmax_element(found.end() - window, found.end());
    if (*high - *low <= settled * *high) {
      a.iterations = int(found.size());
      find_excess(a);
      return a;
    }
  }
  throw RunError("limit analysis without lift: after {} linear programs the multiplier is still between {:g} and {:g}",
                 most, *std::min_element(found.end() - window, found.end()),
                 *std::max_element(found.end() - window, found.end()));
}

std::string mechanism_text(const LimitAnalysis& analysis) {
  std::size_t slide = 0;
  for (const JointRate& r : analysis.mechanism) slide += r.slides();
  return fmt::format("{}, {}", counted(analysis.mechanism.size() - slide, "joint hinges", "joints hinge"),
                     counted(slide, "slides", "slide"));
}

}  // namespace voussoir::limit
