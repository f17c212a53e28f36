#include "solver/diagnosis/contributions.h"

namespace voussoir {

namespace {

/// First of the unknowns of a block, or of a node, which follow each other; −1: it has none.
Eigen::Index first_of(const Unknowns& unknowns, std::int64_t block) {
  return unknowns.of[std::size_t(block)][0];
}
Eigen::Index first_of_node(const Unknowns& unknowns, std::int32_t node) {
  return unknowns.of[unknowns.bodies + std::size_t(node)][0];
}

/// So many columns at a time: what a processor keeps beside each other, and the compiler unrolls.
constexpr int columns = 8;
template <int Rows>
using Strip = Eigen::Matrix<double, Rows, columns, Eigen::RowMajor>;

/// Calls use(strip of x, strip to be added to y) for the rows of some sites, strip by strip. Rows of sites without
/// unknowns are zero and lead nowhere.
template <int Rows, std::size_t Sites, class Use>
void strip_by_strip(const std::array<Eigen::Index, Sites>& first, const std::array<int, Sites>& sizes, const Basis& x,
                    Eigen::Ref<Vectors>& y, const Use& use) {
  for (Eigen::Index column = 0; column < x.cols(); column += columns) {
    const Eigen::Index n = std::min<Eigen::Index>(columns, x.cols() - column);
    Strip<Rows> in = Strip<Rows>::Zero(), out;
    for (std::size_t s = 0, row = 0; s < Sites; row += std::size_t(sizes[s]), ++s)
      if (first[s] >= 0) in.block(Eigen::Index(row), 0, sizes[s], n) = x.block(first[s], column, sizes[s], n);
    use(in, out);
    for (std::size_t s = 0, row = 0; s < Sites; row += std::size_t(sizes[s]), ++s)
      if (first[s] >= 0) y.block(first[s], column, sizes[s], n) += out.block(Eigen::Index(row), 0, sizes[s], n);
  }
}

void add_term(const Contributions::Pair& pair, double factor, const Unknowns& unknowns, const Basis& x,
              Eigen::Ref<Vectors>& y) {
  const Eigen::Index a = first_of(unknowns, pair.a), b = first_of(unknowns, pair.b);
  const Matrix12 k = factor * pair.k;
  if (a >= 0) y.middleRows<6>(a) += k.topLeftCorner<6, 6>().lazyProduct(x.middleRows<6>(a));
  if (b >= 0) y.middleRows<6>(b) += k.bottomRightCorner<6, 6>().lazyProduct(x.middleRows<6>(b));
  if (a < 0 || b < 0) return;
  y.middleRows<6>(a) += k.topRightCorner<6, 6>().lazyProduct(x.middleRows<6>(b));
  y.middleRows<6>(b) += k.bottomLeftCorner<6, 6>().lazyProduct(x.middleRows<6>(a));
}

void add_term(const Contributions::Patch& patch, double factor, const Unknowns& unknowns, const Basis& x,
              Eigen::Ref<Vectors>& y) {
  const std::array<Eigen::Index, 4> first = {first_of(unknowns, patch.block), first_of_node(unknowns, patch.nodes[0]),
                                             first_of_node(unknowns, patch.nodes[1]),
                                             first_of_node(unknowns, patch.nodes[2])};
  const Matrix15 k = factor * patch.k;
  strip_by_strip<15>(first, {6, 3, 3, 3}, x, y, [&](const Strip<15>& in, Strip<15>& out) { out = k.lazyProduct(in); });
}

/// V μ (H + Hᵀ − ⅔ tr H 1) ∇N of the displacement gradient H: shear_block() of all corners at once.
void add_term(const Contributions::Element& e, double factor, const Unknowns& unknowns, const Basis& x,
              Eigen::Ref<Vectors>& y) {
  std::array<Eigen::Index, 4> first;
  for (std::size_t k = 0; k < 4; ++k) first[k] = first_of_node(unknowns, e.nodes[k]);
  const double scale = factor * e.scale;
  using Row = Eigen::Matrix<double, 1, columns>;
  strip_by_strip<12>(first, {3, 3, 3, 3}, x, y, [&](const Strip<12>& in, Strip<12>& out) {
    std::array<Strip<3>, 3> h;  // h[c].row(r): ∂u_r/∂x_c
    for (int c = 0; c < 3; ++c) {
      h[std::size_t(c)] = e.gradient[0][c] * in.middleRows<3>(0);
      for (int k = 1; k < 4; ++k) h[std::size_t(c)] += e.gradient[std::size_t(k)][c] * in.middleRows<3>(3 * k);
    }
    const Row third = (2.0 / 3.0) * (h[0].row(0) + h[1].row(1) + h[2].row(2));
    std::array<Strip<3>, 3> stress;
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r)
        stress[std::size_t(c)].row(r) = scale * (h[std::size_t(c)].row(r) + h[std::size_t(r)].row(c));
      stress[std::size_t(c)].row(c) -= scale * third;
    }
    for (int k = 0; k < 4; ++k) {
      const Vec3& g = e.gradient[std::size_t(k)];
      out.middleRows<3>(3 * k) = g[0] * stress[0] + g[1] * stress[1] + g[2] * stress[2];
    }
  });
}

void add_term(const Contributions::Ring& ring, double factor, const Unknowns& unknowns, const Basis& x,
              Eigen::Ref<Vectors>& y) {
  Eigen::RowVectorXd strain = Eigen::RowVectorXd::Zero(x.cols());
  for (std::size_t i = 0; i < ring.nodes.size(); ++i)
    if (const Eigen::Index at = first_of_node(unknowns, ring.nodes[i]); at >= 0)
      for (int c = 0; c < 3; ++c) strain += ring.pull[i][c] * x.row(at + c);
  strain *= factor * ring.scale;
  for (std::size_t i = 0; i < ring.nodes.size(); ++i)
    if (const Eigen::Index at = first_of_node(unknowns, ring.nodes[i]); at >= 0)
      for (int c = 0; c < 3; ++c) y.row(at + c) += ring.pull[i][c] * strain;
}

void add_term(const Contributions::Own& own, double factor, const Unknowns& unknowns, const Basis& x,
              Eigen::Ref<Vectors>& y) {
  if (const Eigen::Index at = first_of(unknowns, own.block); at >= 0)
    y.middleRows<6>(at) += (factor * own.m).lazyProduct(x.middleRows<6>(at));
}

void add_term(const Contributions::Lump& lump, double factor, const Unknowns& unknowns, const Basis& x,
              Eigen::Ref<Vectors>& y) {
  for (const std::int32_t node : lump.nodes)
    if (const Eigen::Index at = first_of_node(unknowns, node); at >= 0)
      y.middleRows<3>(at) += factor * lump.mass * x.middleRows<3>(at);
}

/// Calls use(block) and use_node(node) of each site that a term couples.
template <class Use, class UseNode>
void each_site(const Contributions::Pair& pair, const Use& use, const UseNode&) {
  use(pair.a), use(pair.b);
}
template <class Use, class UseNode>
void each_site(const Contributions::Patch& patch, const Use& use, const UseNode& use_node) {
  use(patch.block);
  for (const std::int32_t node : patch.nodes) use_node(node);
}
template <class Use, class UseNode>
void each_site(const Contributions::Own& own, const Use& use, const UseNode&) {
  use(own.block);
}
template <class Term, class Use, class UseNode>  // an element, a ring or a lump
void each_site(const Term& term, const Use&, const UseNode& use_node) {
  for (const std::int32_t node : term.nodes) use_node(node);
}

/// Calls use(term) for every term of K, or of M.
struct OfStiffness {
  template <class Use>
  static void each(const Contributions& c, const Use& use) {
    for (const auto& term : c.pairs) use(term);
    for (const auto& term : c.patches) use(term);
    for (const auto& term : c.elements) use(term);
    for (const auto& term : c.rings) use(term);
  }
  /// Of a unit.
  template <class Use>
  static void at(const Contributions& c, std::size_t unit, const Use& use) {
    if (unit < c.pairs.size()) return use(c.pairs[unit]);
    unit -= c.pairs.size();
    if (unit < c.patches.size()) return use(c.patches[unit]);
    unit -= c.patches.size();
    if (unit < c.elements.size()) return use(c.elements[unit]);
    use(c.rings[unit - c.elements.size()]);
  }
};
struct OfMass {
  template <class Use>
  static void each(const Contributions& c, const Use& use) {
    for (const auto& term : c.blocks) use(term);
    for (const auto& term : c.lumps) use(term);
  }
  template <class Use>
  static void at(const Contributions& c, std::size_t unit, const Use& use) {
    if (unit < c.blocks.size()) return use(c.blocks[unit]);
    use(c.lumps[unit - c.blocks.size()]);
  }
};

/// All terms, or those of some units.
template <class Of>
struct AllTerms {
  const Contributions& of;
  template <class Use>
  void each(const Use& use) const {
    Of::each(of, use);
  }
};
template <class Of>
struct ListedTerms {
  const Contributions& of;
  const std::vector<std::int32_t>& listed;
  template <class Use>
  void each(const Use& use) const {
    for (const std::int32_t unit : listed) Of::at(of, std::size_t(unit), use);
  }
};

template <class Terms>
void add_terms(const Terms& terms, double factor, const Unknowns& unknowns, const Basis& x, Eigen::Ref<Vectors>& y) {
  terms.each([&](const auto& term) { add_term(term, factor, unknowns, x, y); });
}

/// Renumbers the sites that terms touch, so that only their rows are read.
class Touched {
 public:
  template <class Terms>
  Touched(const Terms& terms, const Unknowns& all) : all_(all) {
    unknowns_.of.assign(all.of.size(), {-1, -1, -1, -1, -1, -1});
    unknowns_.bodies = all.bodies;
    terms.each([&](const auto& term) {
      each_site(
          term, [&](std::int64_t block) { touch(std::size_t(block)); },
          [&](std::int32_t node) { touch(all.bodies + std::size_t(node)); });
    });
  }
  const Unknowns& unknowns() const { return unknowns_; }
  Vectors rows(const Basis& v) const {
    Vectors rows(unknowns_.count, v.cols());
    for (std::size_t i = 0; i < all_.of.size(); ++i)
      if (unknowns_.any(i)) {
        const auto ways = Eigen::Index(all_.ways(i));
        rows.middleRows(unknowns_.of[i][0], ways) = v.middleRows(all_.of[i][0], ways);
      }
    return rows;
  }

 private:
  void touch(std::size_t site) {
    auto& own = unknowns_.of[site];
    if (!all_.any(site) || own[0] >= 0) return;
    for (std::size_t c = 0; c < all_.ways(site); ++c) own[c] = unknowns_.count++;
  }
  const Unknowns& all_;
  Unknowns unknowns_;
};

template <class Terms>
Eigen::MatrixXd project(const Terms& terms, const Unknowns& unknowns, const Basis& v, const Basis& w) {
  const Touched touched(terms, unknowns);
  if (touched.unknowns().count > unknowns.count / 2) {  // to pick rows would cost more than it saves
    Vectors y = Vectors::Zero(w.rows(), w.cols());
    Eigen::Ref<Vectors> sum = y;
    add_terms(terms, 1.0, unknowns, w, sum);
    return v.transpose() * y;
  }
  const Vectors rows = touched.rows(w);
  Vectors y = Vectors::Zero(rows.rows(), rows.cols());
  Eigen::Ref<Vectors> sum = y;
  add_terms(terms, 1.0, touched.unknowns(), rows, sum);
  return touched.rows(v).transpose() * y;
}

}  // namespace

Vectors times_stiffness(const Contributions& c, const Unknowns& unknowns, const Vectors& x) {
  Vectors y = Vectors::Zero(x.rows(), x.cols());
  Eigen::Ref<Vectors> sum = y;
  add_terms(AllTerms<OfStiffness>{c}, 1.0, unknowns, x, sum);
  return y;
}

Vectors times_mass(const Contributions& c, const Unknowns& unknowns, const Vectors& x) {
  Vectors y = Vectors::Zero(x.rows(), x.cols());
  Eigen::Ref<Vectors> sum = y;
  add_terms(AllTerms<OfMass>{c}, 1.0, unknowns, x, sum);
  return y;
}

Eigen::VectorXd times_stiffness(const Contributions& c, const Unknowns& unknowns, const Eigen::VectorXd& x) {
  return times_stiffness(c, unknowns, Vectors(x)).col(0);
}

Eigen::VectorXd times_mass(const Contributions& c, const Unknowns& unknowns, const Eigen::VectorXd& x) {
  return times_mass(c, unknowns, Vectors(x)).col(0);
}

void add_stiffness(const Contributions& c, const std::vector<std::int32_t>& listed, double factor,
                   const Unknowns& unknowns, const Basis& x, Eigen::Ref<Vectors> y) {
  add_terms(ListedTerms<OfStiffness>{c, listed}, factor, unknowns, x, y);
}

void add_mass(const Contributions& c, const std::vector<std::int32_t>& listed, double factor, const Unknowns& unknowns,
              const Basis& x, Eigen::Ref<Vectors> y) {
  add_terms(ListedTerms<OfMass>{c, listed}, factor, unknowns, x, y);
}

Eigen::Index stiffness_rows(const Contributions& c, const std::vector<std::int32_t>& listed, const Unknowns& unknowns) {
  return Touched(ListedTerms<OfStiffness>{c, listed}, unknowns).unknowns().count;
}

Eigen::Index mass_rows(const Contributions& c, const std::vector<std::int32_t>& listed, const Unknowns& unknowns) {
  return Touched(ListedTerms<OfMass>{c, listed}, unknowns).unknowns().count;
}

Eigen::MatrixXd project_stiffness(const Contributions& c, const Unknowns& unknowns, const Basis& v, const Basis& w) {
  return project(AllTerms<OfStiffness>{c}, unknowns, v, w);
}

Eigen::MatrixXd project_mass(const Contributions& c, const Unknowns& unknowns, const Basis& v, const Basis& w) {
  return project(AllTerms<OfMass>{c}, unknowns, v, w);
}

Eigen::MatrixXd project_stiffness(const Contributions& c, const std::vector<std::int32_t>& listed,
                                  const Unknowns& unknowns, const Basis& v, const Basis& w) {
  return project(ListedTerms<OfStiffness>{c, listed}, unknowns, v, w);
}

Eigen::MatrixXd project_mass(const Contributions& c, const std::vector<std::int32_t>& listed, const Unknowns& unknowns,
                             const Basis& v, const Basis& w) {
  return project(ListedTerms<OfMass>{c, listed}, unknowns, v, w);
}

}  // namespace voussoir
