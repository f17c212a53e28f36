#include "solver/diagnosis/model_change.h"

#include <cmath>
#include <limits>

#include "solver/base/error.h"

namespace voussoir {

namespace {

/// Whether a block of `high` moves that `low` does not have, or not moving.
bool is_freed(const Assembly& low, const Assembly& high, std::size_t block) {
  return !high.blocks[block].fixed && (block >= low.blocks.size() || low.blocks[block].fixed);
}

/// First of a block's unknowns, which follow each other; −1: it has none.
Eigen::Index first_of(const Unknowns& unknowns, std::int64_t block) {
  return unknowns.of[std::size_t(block)][0];
}

constexpr double irregular = std::numeric_limits<double>::quiet_NaN();

void check_blocks(const Assembly& low, const Assembly& high) {
  if (low.blocks.size() > high.blocks.size())
    throw InputError("the two assemblies have {} and {} blocks: K and M cannot be compared", low.blocks.size(),
                     high.blocks.size());
}

/// What joints and blocks of two assemblies add to K and M.
class Differences {
 public:
  Differences(const Assembly& low, const Assembly& high) : low_(low), high_(high) { check_blocks(low, high); }

  bool freed(std::int64_t block) const { return is_freed(low_, high_, std::size_t(block)); }
  /// By which the stiffness of a joint has grown; `irregular` where it is not the same for all motions.
  double factor(const Joint* l, const Joint* h) const {
    if (!l || !h || freed(h->a) || freed(h->b) || !same_place(*l, *h)) return irregular;
    if (l->kn == h->kn && l->ks == h->ks) return 1.0;
    const double normal = h->kn / l->kn, shear = h->ks / l->ks;
    return std::abs(normal - shear) < 1e-12 * normal ? normal : irregular;
  }
  double factor(std::size_t block) const {
    const Block &a = low_.blocks[block], &b = high_.blocks[block];
    if (a.fixed && b.fixed) return 1.0;
    if (a.fixed != b.fixed) return irregular;
    const double factor = b.mass / a.mass;
    return (b.inertia - factor * a.inertia).norm() < 1e-12 * b.inertia.norm() ? factor : irregular;
  }
  Matrix12 of_low(const Joint& joint) const {
    Matrix12 k = pair_stiffness(low_, joint);
    if (freed(joint.a)) k.topRows<6>().setZero(), k.leftCols<6>().setZero();  // what does not move yet
    if (freed(joint.b)) k.bottomRows<6>().setZero(), k.rightCols<6>().setZero();
    return k;
  }
  /// K of h less `share` of that of l.
  Derivative::Pair pair(const Joint* l, const Joint* h, double share = 1.0) const {
    if (!h) return {l->a, l->b, -share * of_low(*l)};
    if (!l) return {h->a, h->b, pair_stiffness(high_, *h)};
    if (same_place(*l, *h) && !freed(h->a) && !freed(h->b)) {  // the stiffness is linear in both
      Joint difference = *h;
      difference.kn -= share * l->kn, difference.ks -= share * l->ks;
      return {h->a, h->b, pair_stiffness(high_, difference)};
    }
    return {h->a, h->b, pair_stiffness(high_, *h) - share * of_low(*l)};
  }
  Derivative::Own own(std::size_t block, double share = 1.0) const {
    const Matrix6 m = block_mass(high_.blocks[block]);
    if (freed(std::int64_t(block))) return {std::int64_t(block), m};
    return {std::int64_t(block), m - share * block_mass(low_.blocks[block])};
  }

 private:
  /// Where it is, and how far from the centroids of its blocks.
  bool same_place(const Joint& l, const Joint& h) const {
    const auto stays = [&](std::int64_t block) {
      return low_.blocks[std::size_t(block)].centroid == high_.blocks[std::size_t(block)].centroid;
    };
    return l.polygon == h.polygon && stays(h.a) && stays(h.b);
  }

  const Assembly &low_, &high_;
};

}  // namespace

Derivative derivative(const Assembly& low, const Assembly& high, double apart) {
  const Differences differences(low, high);
  Derivative d;
  match_joints(low, high, [&](const Joint* l, const Joint* h) {
    if (differences.factor(l, h) != 1.0) d.pairs.push_back(differences.pair(l, h)), d.pairs.back().k /= apart;
  });
  for (std::size_t i = 0; i < high.blocks.size(); ++i) {
    if (high.blocks[i].fixed || (i < low.blocks.size() && differences.factor(i) == 1.0)) continue;
    d.blocks.push_back(differences.own(i)), d.blocks.back().m /= apart;
  }
  return d;
}

namespace {

/// Numbers the distinct factors as they come; those that differ by rounding are the same, what is irregular has none.
void sort_out(const std::vector<double>& factors, std::vector<std::int32_t>& of,
              std::vector<std::vector<std::int32_t>>& members) {
  std::vector<double> distinct;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const auto same = [&](double f) { return std::abs(f - factors[i]) <= 1e-9 * f; };
    const auto found = std::find_if(distinct.begin(), distinct.end(), same);
    of.push_back(std::isnan(factors[i]) ? -1 : std::int32_t(found - distinct.begin()));
    if (of.back() < 0) continue;
    if (found == distinct.end()) distinct.push_back(factors[i]), members.emplace_back();
    members[std::size_t(of.back())].push_back(std::int32_t(i));
  }
}

/// Of each joint and block of the origin.
struct Factors {
  std::vector<double> joints, blocks;
  Factors(const Assembly& origin, const Assembly& changed, const Differences& differences) {
    match_joints(origin, changed, [&](const Joint* l, const Joint* h) {
      if (l) joints.push_back(differences.factor(l, h));
    });
    for (std::size_t i = 0; i < origin.blocks.size(); ++i) blocks.push_back(differences.factor(i));
  }
};

/// The first regular member of a class speaks for it.
std::vector<double> factors_of(const std::vector<std::vector<std::int32_t>>& classes,
                               const std::vector<double>& factors) {
  std::vector<double> own(classes.size(), 1.0);
  for (std::size_t c = 0; c < classes.size(); ++c)
    for (const std::int32_t member : classes[c])
      if (!std::isnan(factors[std::size_t(member)])) {
        own[c] = factors[std::size_t(member)];
        break;
      }
  return own;
}

double usual(const std::vector<std::int32_t>& of, const std::vector<double>& factors, std::size_t i) {
  return i < of.size() && of[i] >= 0 ? factors[std::size_t(of[i])] : 1.0;
}

bool differs(double factor, double usual) {
  return !(std::abs(factor - usual) <= 1e-12 * usual);
}

}  // namespace

Classes find_classes(const Assembly& origin, const Assembly& changed) {
  const Factors factors(origin, changed, Differences(origin, changed));
  Classes classes;
  sort_out(factors.joints, classes.of_joint, classes.joints);
  sort_out(factors.blocks, classes.of_block, classes.blocks);
  return classes;
}

Change find_change(const Assembly& origin, const Classes& classes, const Assembly& changed) {
  const Differences differences(origin, changed);
  const Factors factors(origin, changed, differences);
  Change change;
  change.stiffness = factors_of(classes.joints, factors.joints);
  change.mass = factors_of(classes.blocks, factors.blocks);
  std::size_t at = 0;
  match_joints(origin, changed, [&](const Joint* l, const Joint* h) {
    const double share = l ? usual(classes.of_joint, change.stiffness, at) : 1.0;
    if (!l || differs(factors.joints[at], share)) change.others.pairs.push_back(differences.pair(l, h, share));
    at += l != nullptr;
  });
  for (std::size_t i = 0; i < changed.blocks.size(); ++i) {
    const bool known = i < origin.blocks.size();
    const double share = known ? usual(classes.of_block, change.mass, i) : 1.0;
    if (!changed.blocks[i].fixed && (!known || differs(factors.blocks[i], share)))
      change.others.blocks.push_back(differences.own(i, share));
  }
  return change;
}

Unknowns with_freed(const Unknowns& unknowns, const Assembly& from, const Assembly& to) {
  Unknowns all = unknowns;
  all.of.resize(to.blocks.size(), {-1, -1, -1, -1, -1, -1});
  for (std::size_t i = 0; i < to.blocks.size(); ++i)
    if (is_freed(from, to, i))
      for (std::int32_t& unknown : all.of[i]) unknown = all.count++;
  return all;
}

namespace {

void add_product(const Derivative::Pair& pair, double factor, const Unknowns& unknowns, const Vectors& x, Vectors& y) {
  const Eigen::Index a = first_of(unknowns, pair.a), b = first_of(unknowns, pair.b);
  const Matrix12 k = factor * pair.k;
  if (a >= 0) y.middleRows<6>(a) += k.topLeftCorner<6, 6>().lazyProduct(x.middleRows<6>(a));
  if (b >= 0) y.middleRows<6>(b) += k.bottomRightCorner<6, 6>().lazyProduct(x.middleRows<6>(b));
  if (a < 0 || b < 0) return;
  y.middleRows<6>(a) += k.topRightCorner<6, 6>().lazyProduct(x.middleRows<6>(b));
  y.middleRows<6>(b) += k.bottomLeftCorner<6, 6>().lazyProduct(x.middleRows<6>(a));
}

}  // namespace

Vectors times_stiffness(const Derivative& d, const Unknowns& unknowns, const Vectors& x) {
  Vectors y = Vectors::Zero(x.rows(), x.cols());
  for (const Derivative::Pair& pair : d.pairs) add_product(pair, 1.0, unknowns, x, y);
  return y;
}

void add_products(const std::vector<Derivative::Pair>& pairs, const std::vector<std::int32_t>& listed, double factor,
                  const Unknowns& unknowns, const Vectors& x, Vectors& y) {
  for (const std::int32_t i : listed) add_product(pairs[std::size_t(i)], factor, unknowns, x, y);
}

Vectors times_mass(const Derivative& d, const Unknowns& unknowns, const Vectors& x) {
  Vectors y = Vectors::Zero(x.rows(), x.cols());
  for (const Derivative::Own& own : d.blocks)
    if (const Eigen::Index at = first_of(unknowns, own.block); at >= 0)
      y.middleRows<6>(at) += own.m.lazyProduct(x.middleRows<6>(at));
  return y;
}

Eigen::VectorXd times_stiffness(const Derivative& d, const Unknowns& unknowns, const Eigen::VectorXd& x) {
  return times_stiffness(d, unknowns, Vectors(x)).col(0);
}

Eigen::VectorXd times_mass(const Derivative& d, const Unknowns& unknowns, const Eigen::VectorXd& x) {
  return times_mass(d, unknowns, Vectors(x)).col(0);
}

namespace {

/// Renumbers the sites that a derivative touches, so that only their rows are read.
class Touched {
 public:
  Touched(const Derivative& d, const Unknowns& all) : all_(all) {
    unknowns_.of.assign(all.of.size(), {-1, -1, -1, -1, -1, -1});
    for (const Derivative::Pair& pair : d.pairs) touch(pair.a), touch(pair.b);
    for (const Derivative::Own& own : d.blocks) touch(own.block);
  }
  const Unknowns& unknowns() const { return unknowns_; }
  Vectors rows(const Vectors& v) const {
    Vectors rows(unknowns_.count, v.cols());
    for (std::size_t i = 0; i < all_.of.size(); ++i)
      if (unknowns_.any(i)) rows.middleRows<6>(unknowns_.of[i][0]) = v.middleRows<6>(all_.of[i][0]);
    return rows;
  }

 private:
  void touch(std::int64_t block) {
    auto& own = unknowns_.of[std::size_t(block)];
    if (!all_.any(std::size_t(block)) || own[0] >= 0) return;
    for (std::int32_t& unknown : own) unknown = unknowns_.count++;
  }
  const Unknowns& all_;
  Unknowns unknowns_;
};

}  // namespace

Eigen::MatrixXd project_stiffness(const Derivative& d, const Unknowns& unknowns, const Vectors& v, const Vectors& w) {
  const Touched touched(d, unknowns);
  return touched.rows(v).transpose() * times_stiffness(d, touched.unknowns(), touched.rows(w));
}

Eigen::MatrixXd project_mass(const Derivative& d, const Unknowns& unknowns, const Vectors& v, const Vectors& w) {
  const Touched touched(d, unknowns);
  return touched.rows(v).transpose() * times_mass(d, touched.unknowns(), touched.rows(w));
}

}  // namespace voussoir
