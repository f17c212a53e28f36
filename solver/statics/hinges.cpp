#include "solver/statics/hinges.h"

#include <algorithm>

namespace voussoir {

namespace {

bool of_ring(const Assembly& assembly, const Joint& joint) {
  const Component a = assembly.blocks[std::size_t(joint.a)].component,
                  b = assembly.blocks[std::size_t(joint.b)].component;
  const auto fits = [](Component p, Component q) {
    return p == Component::arch && (q == Component::arch || q == Component::base);
  };
  return std::abs(joint.normal.y()) < 0.5 && (fits(a, b) || fits(b, a));
}

/// Of b against a, about axes in the joint's plane; the small turn's vector is twice the quaternion's.
Vec3 turn_of(const Joint& joint, const Snapshot& snapshot) {
  Eigen::Quaterniond q = snapshot.rotation[std::size_t(joint.b)] * snapshot.rotation[std::size_t(joint.a)].conjugate();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const Vec3 turn = 2.0 * q.vec();
  return turn - joint.normal.dot(turn) * joint.normal;
}

/// Middle of the edge that stays closed: b moves away from a along the normal by r · (n × turn) at r from there.
Vec3 closed_edge(const Joint& joint, const Vec3& turn) {
  const Vec3 opens = joint.normal.cross(turn);
  double least = 1e300;
  for (const Vec3& p : joint.polygon) least = std::min(least, opens.dot(p));
  Vec3 sum = Vec3::Zero();
  double count = 0.0;
  for (const Vec3& p : joint.polygon)
    if (opens.dot(p) <= least + 1e-3 * opens.norm() * std::sqrt(joint.area)) sum += p, count += 1.0;
  return sum / count;
}

bool adjoin(const Hinge& p, const Hinge& q) {
  return p.edge == q.edge && (p.a == q.a || p.a == q.b || p.b == q.a || p.b == q.b);
}

/// Takes the first joint out of the list, with all that hang together with it.
std::vector<Hinge> take_run(std::vector<Hinge>& open) {
  std::vector<Hinge> run = {open.front()};
  open.erase(open.begin());
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Hinge one = run[i];
    std::erase_if(open, [&](const Hinge& other) {
      if (!adjoin(one, other)) return false;
      run.push_back(other);
      return true;
    });
  }
  return run;
}

/// The joint of a run that has turned most, with the range across the arch of the whole run.
Hinge hinge_of(const std::vector<Hinge>& run) {
  Hinge hinge = *std::ranges::max_element(run, {}, &Hinge::turn);
  for (const Hinge& joint : run) hinge.y0 = std::min(hinge.y0, joint.y0), hinge.y1 = std::max(hinge.y1, joint.y1);
  return hinge;
}

}  // namespace

std::vector<Hinge> find_hinges(const Assembly& assembly, const Snapshot& snapshot, double share, double least) {
  double largest = 0.0;
  for (const Joint& joint : assembly.joints)
    if (of_ring(assembly, joint)) largest = std::max(largest, turn_of(joint, snapshot).norm());
  std::vector<Hinge> open;
  for (const Joint& joint : assembly.joints) {
    if (!of_ring(assembly, joint)) continue;
    const Vec3 turn = turn_of(joint, snapshot);
    if (turn.norm() < std::max(share * largest, least)) continue;
    MechanismJoint at;
    at.a = joint.a, at.b = joint.b;
    at.place = closed_edge(joint, turn);
    at.centre = polygon_centroid(joint.polygon);
    const Box box = bounding_box(joint.polygon);
    open.push_back({joint.a, joint.b, edge_name(assembly, at), at.place, turn.norm(), box.low.y(), box.high.y()});
  }
  std::vector<Hinge> hinges;
  while (!open.empty()) hinges.push_back(hinge_of(take_run(open)));
  return hinges;
}

}  // namespace voussoir
