#include "solver/diagnosis/model_change.h"

#include <cmath>
#include <limits>
#include <map>

#include "solver/base/error.h"

namespace voussoir {

namespace {

/// Whether a block of `high` moves that `low` does not have, or not moving.
bool is_freed(const Assembly& low, const Assembly& high, std::size_t block) {
  return !high.blocks[block].fixed && (block >= low.blocks.size() || low.blocks[block].fixed);
}

constexpr double irregular = std::numeric_limits<double>::quiet_NaN();

/// What joints and blocks of two assemblies add to K and M.
class Differences {
 public:
  Differences(const Assembly& low, const Assembly& high) : low_(low), high_(high) {
    if (low.blocks.size() > high.blocks.size())
      throw InputError("the two assemblies have {} and {} blocks: K and M cannot be compared", low.blocks.size(),
                       high.blocks.size());
    if (low.fill.nodes.size() != high.fill.nodes.size() || low.fill.tets != high.fill.tets)
      throw InputError(
          "the fills of the two assemblies, of {} and {} tetrahedra, are not meshed alike: K and M cannot be compared",
          low.fill.tets.size(), high.fill.tets.size());
  }

  bool freed(std::int64_t block) const { return is_freed(low_, high_, std::size_t(block)); }
  bool freed(const Joint& joint) const { return freed(joint.a) || freed(joint.b); }
  bool freed(const FillJoint& patch) const { return freed(patch.block); }

  /// By which the stiffness of a joint, or a patch, has grown; `irregular` where it is not the same for all motions.
  template <class Of>
  double factor(const Of* l, const Of* h) const {
    if (!l || !h || freed(*h) || !same_place(*l, *h)) return irregular;
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
  /// K of h less `share` of that of l.
  Contributions::Pair difference(const Joint* l, const Joint* h, double share) const {
    const Joint& joint = h ? *h : *l;
    return {joint.a, joint.b, stiffness_of<Matrix12>(l, h, share)};
  }
  Contributions::Patch difference(const FillJoint* l, const FillJoint* h, double share) const {
    const FillJoint& patch = h ? *h : *l;
    return {patch.block, high_.fill.triangles[std::size_t(patch.triangle)], stiffness_of<Matrix15>(l, h, share)};
  }
  Contributions::Own own(std::size_t block, double share) const {
    const Matrix6 m = block_mass(high_.blocks[block]);
    if (freed(std::int64_t(block))) return {std::int64_t(block), m};
    return {std::int64_t(block), m - share * block_mass(low_.blocks[block])};
  }

 private:
  bool stays(std::int64_t block) const {
    return low_.blocks[std::size_t(block)].centroid == high_.blocks[std::size_t(block)].centroid;
  }
  /// Where it is, and how far from the centroids of its blocks.
  bool same_place(const Joint& l, const Joint& h) const { return l.polygon == h.polygon && stays(h.a) && stays(h.b); }
  bool same_place(const FillJoint& l, const FillJoint& h) const { return l.polygon == h.polygon && stays(h.block); }

  static Matrix12 stiffness(const Assembly& assembly, const Joint& joint) { return pair_stiffness(assembly, joint); }
  static Matrix15 stiffness(const Assembly& assembly, const FillJoint& patch) {
    return patch_stiffness(assembly, patch);
  }
  /// Without what does not move yet.
  Matrix12 of_low(const Joint& joint) const {
    Matrix12 k = pair_stiffness(low_, joint);
    if (freed(joint.a)) k.topRows<6>().setZero(), k.leftCols<6>().setZero();
    if (freed(joint.b)) k.bottomRows<6>().setZero(), k.rightCols<6>().setZero();
    return k;
  }
  Matrix15 of_low(const FillJoint& patch) const {
    Matrix15 k = patch_stiffness(low_, patch);
    if (freed(patch.block)) k.topRows<6>().setZero(), k.leftCols<6>().setZero();
    return k;
  }
  template <class Matrix, class Of>
  Matrix stiffness_of(const Of* l, const Of* h, double share) const {
    if (!h) return -share * of_low(*l);
    if (!l) return stiffness(high_, *h);
    if (same_place(*l, *h) && !freed(*h)) {  // the stiffness is linear in both
      Of difference = *h;
      difference.kn -= share * l->kn, difference.ks -= share * l->ks;
      return stiffness(high_, difference);
    }
    return stiffness(high_, *h) - share * of_low(*l);
  }

  const Assembly &low_, &high_;
};

/// What the elements of two fills of one mesh add.
class FillDifferences {
 public:
  FillDifferences(const Assembly& low, const Assembly& high) : low_(low), high_(high) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> known;  // growths, by materials of low and high
    std::pair<std::int32_t, std::int32_t> last;
    std::int32_t found = 0;
    for (std::size_t i = 0; i < low.fill.tets.size(); ++i) {
      const std::pair both(low.fill.material[i], high.fill.material[i]);
      if (i == 0 || both != last) {
        const auto [at, fresh] = known.try_emplace(both, std::int32_t(growths_.size()));
        if (fresh)
          growths_.push_back(
              growth(low.materials.at(std::size_t(both.first)), high.materials.at(std::size_t(both.second))));
        last = both, found = at->second;
      }
      of_element_.push_back(found);
    }
  }
  std::size_t elements() const { return of_element_.size(); }
  double shear(std::size_t element) const { return growths_[std::size_t(of_element_[element])].shear; }
  double density(std::size_t element) const { return growths_[std::size_t(of_element_[element])].density; }
  /// By which the stiffness of each node's ring has grown; `irregular` where its elements differ.
  std::vector<double> rings() const {
    std::vector<double> factors(low_.fill.nodes.size(), 0.0);
    for (std::size_t i = 0; i < elements(); ++i) {
      const double bulk = growths_[std::size_t(of_element_[i])].bulk;
      for (const std::int32_t node : low_.fill.tets[i]) {
        double& known = factors[std::size_t(node)];
        if (known == 0.0)
          known = bulk;
        else if (!(known == bulk))
          known = irregular;
      }
    }
    return factors;
  }

  Contributions::Element element(std::size_t i, double share) const {
    Contributions::Element term = shear_term(low_elements()[i]);
    term.scale *= shear(i) - share;
    return term;
  }
  Contributions::Lump lump(std::size_t i, double share) const {
    const double density = low_.materials[std::size_t(low_.fill.material[i])].density;
    return {low_.fill.tets[i], 0.25 * density * low_elements()[i].volume * (this->density(i) - share)};
  }
  void add_ring(std::size_t node, double factor, double share, std::vector<Contributions::Ring>& rings) const {
    Contributions::Ring low = ring_term(low_rings()[node]);
    if (std::isnan(factor)) rings.push_back(ring_term(high_rings()[node])), factor = 0.0;
    low.scale *= factor - share;
    rings.push_back(std::move(low));
  }

 private:
  struct Growth {
    double shear = 1.0, bulk = 1.0, density = 1.0;
  };
  static Growth growth(const Material& low, const Material& high) {
    const FillLaw a = fill_law(low), b = fill_law(high);
    return {b.shear / a.shear, b.bulk / a.bulk, b.density / a.density};
  }
  // What few changes need.
  const std::vector<FillElement>& low_elements() const {
    return kept(elements_, [&] { return fill_elements(low_); });
  }
  const std::vector<FillRing>& low_rings() const {
    return kept(low_rings_, [&] { return fill_rings(low_elements(), low_.fill.nodes.size()); });
  }
  const std::vector<FillRing>& high_rings() const {
    return kept(high_rings_, [&] { return fill_rings(fill_elements(high_), low_.fill.nodes.size()); });
  }
  template <class Of, class Make>
  static const Of& kept(Of& of, const Make& make) {
    if (of.empty()) of = make();
    return of;
  }

  const Assembly &low_, &high_;
  std::vector<Growth> growths_;
  std::vector<std::int32_t> of_element_;
  mutable std::vector<FillElement> elements_;
  mutable std::vector<FillRing> low_rings_, high_rings_;
};

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

/// Of each unit of the origin.
struct Factors {
  std::vector<double> stiffness, mass;
  Factors(const Assembly& origin, const Assembly& changed, const Differences& differences,
          const FillDifferences& fill) {
    const auto add = [&](const auto* l, const auto* h) {
      if (l) stiffness.push_back(differences.factor(l, h));
    };
    match(origin.joints, changed.joints, add);
    match(origin.fill_joints, changed.fill_joints, add);
    for (std::size_t i = 0; i < fill.elements(); ++i) stiffness.push_back(fill.shear(i));
    const std::vector<double> rings = fill.rings();
    stiffness.insert(stiffness.end(), rings.begin(), rings.end());
    for (std::size_t i = 0; i < origin.blocks.size(); ++i) mass.push_back(differences.factor(i));
    for (std::size_t i = 0; i < fill.elements(); ++i) mass.push_back(fill.density(i));
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

Contributions derivative(const Assembly& low, const Assembly& high, double apart) {
  Contributions d = find_change(low, {}, high).others;
  for (auto& pair : d.pairs) pair.k /= apart;
  for (auto& patch : d.patches) patch.k /= apart;
  for (auto& element : d.elements) element.scale /= apart;
  for (auto& ring : d.rings) ring.scale /= apart;
  for (auto& own : d.blocks) own.m /= apart;
  for (auto& lump : d.lumps) lump.mass /= apart;
  return d;
}

Classes find_classes(const Assembly& origin, const Assembly& changed) {
  const Factors factors(origin, changed, Differences(origin, changed), FillDifferences(origin, changed));
  Classes classes;
  sort_out(factors.stiffness, classes.of_stiffness, classes.stiffness);
  sort_out(factors.mass, classes.of_mass, classes.mass);
  return classes;
}

Change find_change(const Assembly& origin, const Classes& classes, const Assembly& changed) {
  const Differences differences(origin, changed);
  const FillDifferences fill(origin, changed);
  const Factors factors(origin, changed, differences, fill);
  Change change;
  change.stiffness = factors_of(classes.stiffness, factors.stiffness);
  change.mass = factors_of(classes.mass, factors.mass);
  Contributions& others = change.others;
  const auto own_of = [&](std::size_t unit) { return usual(classes.of_mass, change.mass, unit); };
  const auto share_of = [&](std::size_t unit) { return usual(classes.of_stiffness, change.stiffness, unit); };
  const auto differing = [&](std::size_t unit) { return differs(factors.stiffness[unit], share_of(unit)); };

  std::size_t unit = 0;
  const auto add_to = [&](auto& terms) {
    return [&](const auto* l, const auto* h) {
      if (!l || differing(unit)) terms.push_back(differences.difference(l, h, l ? share_of(unit) : 1.0));
      unit += l != nullptr;
    };
  };
  match(origin.joints, changed.joints, add_to(others.pairs));
  match(origin.fill_joints, changed.fill_joints, add_to(others.patches));
  for (std::size_t i = 0; i < fill.elements(); ++i, ++unit)
    if (differing(unit)) others.elements.push_back(fill.element(i, share_of(unit)));
  for (std::size_t node = 0; node < origin.fill.nodes.size(); ++node, ++unit)
    if (differing(unit)) fill.add_ring(node, factors.stiffness[unit], share_of(unit), others.rings);

  for (std::size_t i = 0; i < changed.blocks.size(); ++i) {
    const bool known = i < origin.blocks.size();
    const double share = known ? own_of(i) : 1.0;
    if (!changed.blocks[i].fixed && (!known || differs(factors.mass[i], share)))
      others.blocks.push_back(differences.own(i, share));
  }
  unit = origin.blocks.size();
  for (std::size_t i = 0; i < fill.elements(); ++i, ++unit)
    if (differs(factors.mass[unit], own_of(unit))) others.lumps.push_back(fill.lump(i, own_of(unit)));
  return change;
}

Unknowns with_freed(const Unknowns& unknowns, const Assembly& from, const Assembly& to) {
  Unknowns all = unknowns;
  const auto nodes = unknowns.of.begin() + std::ptrdiff_t(unknowns.bodies);
  all.of.assign(unknowns.of.begin(), nodes);
  all.of.resize(to.blocks.size(), {-1, -1, -1, -1, -1, -1});
  all.bodies = to.blocks.size();
  for (std::size_t i = 0; i < to.blocks.size(); ++i)
    if (is_freed(from, to, i))
      for (std::int32_t& unknown : all.of[i]) unknown = all.count++;
  all.of.insert(all.of.end(), nodes, unknowns.of.end());
  return all;
}

}  // namespace voussoir
