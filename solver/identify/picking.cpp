#include "solver/identify/picking.h"

#include <algorithm>
#include <cmath>

namespace voussoir {

namespace {

/// The poles of each order as ranges of a list ascending in order.
std::vector<std::pair<int, int>> orders_of(const std::vector<Pole>& poles) {
  std::vector<std::pair<int, int>> ranges;
  for (int i = 0; i < int(poles.size()); ++i) {
    if (i == 0 || poles[std::size_t(i)].order != poles[std::size_t(i) - 1].order) ranges.emplace_back(i, i);
    ranges.back().second = i + 1;
  }
  return ranges;
}

/// A greedy search for the fullest neighbourhoods.
class Neighbourhoods {
 public:
  Neighbourhoods(const std::vector<Pole>& poles, double lowest, double largest_damping, double radius)
      : poles_(&poles), orders_(orders_of(poles)), radius_(radius), free_(poles.size()) {
    for (std::size_t i = 0; i < poles.size(); ++i)
      free_[i] = poles[i].frequency() >= lowest && std::abs(poles[i].damping()) < largest_damping;
    const auto n = Eigen::Index(poles.size());
    distance_.setZero(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < i; ++j)
        distance_(i, j) = distance_(j, i) = distance(poles[std::size_t(i)], poles[std::size_t(j)]);
  }

  /// Removes and returns the largest remaining cluster; without members if nothing remains.
  std::vector<int> take() {
    std::vector<int> best;
    double least = 0.0;
    for (std::size_t i = 0; i < poles_->size(); ++i) {
      if (!free_[i]) continue;
      const std::vector<int> members = about(int(i));
      const double spread = sum(int(i), members);
      if (members.size() > best.size() || (members.size() == best.size() && spread < least)) {
        best = members;
        least = spread;
      }
    }
    for (const int i : best) free_[std::size_t(i)] = false;
    return best;
  }
  double sum(int pole, const std::vector<int>& members) const {
    double total = 0.0;
    for (const int j : members) total += distance_(pole, j);
    return total;
  }

 private:
  std::vector<int> about(int pole) const {
    std::vector<int> members;
    for (const auto& [first, last] : orders_) {
      int closest = -1;
      for (int j = first; j < last; ++j)
        if (free_[std::size_t(j)] && distance_(pole, j) <= radius_ &&
            (closest < 0 || distance_(pole, j) < distance_(pole, closest)))
          closest = j;
      if (closest >= 0) members.push_back(closest);
    }
    return members;
  }

  const std::vector<Pole>* poles_;
  std::vector<std::pair<int, int>> orders_;
  double radius_;
  std::vector<bool> free_;
  Eigen::MatrixXd distance_;
};

}  // namespace

void mark_stable(std::vector<Pole>& poles, double frequency_tolerance, double damping_tolerance,
                 double shape_tolerance) {
  const auto orders = orders_of(poles);
  for (std::size_t k = 1; k < orders.size(); ++k) {
    const std::vector<Pole> before(poles.begin() + orders[k - 1].first, poles.begin() + orders[k - 1].second);
    for (int i = orders[k].first; i < orders[k].second; ++i) {
      Pole& pole = poles[std::size_t(i)];
      const Pole& old = before[std::size_t(nearest(before, pole))];
      pole.stable_frequency = std::abs(pole.frequency() - old.frequency()) <= frequency_tolerance * old.frequency();
      pole.stable_damping = std::abs(pole.damping() - old.damping()) <= damping_tolerance * std::abs(old.damping());
      pole.stable_shape = 1.0 - assurance(pole.shape, old.shape) <= shape_tolerance;
    }
  }
}

std::vector<Cluster> find_clusters(const std::vector<Pole>& poles, double lowest, double largest_damping, double radius,
                                   int least_members) {
  Neighbourhoods neighbourhoods(poles, lowest, largest_damping, radius);
  std::vector<Cluster> clusters;
  for (;;) {
    Cluster c;
    c.members = neighbourhoods.take();
    if (c.members.empty() || int(c.members.size()) < least_members) return clusters;
    c.centre = *std::min_element(c.members.begin(), c.members.end(), [&](int a, int b) {
      return neighbourhoods.sum(a, c.members) < neighbourhoods.sum(b, c.members);
    });
    for (const int i : c.members) c.hits += poles[std::size_t(i)].stable();
    clusters.push_back(std::move(c));
  }
}

}  // namespace voussoir
