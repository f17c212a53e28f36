// Which ground motions of many, and how much larger or smaller, have a mean spectrum close to a target.
#pragma once
#include <Eigen/Dense>
#include <cstdint>
#include <vector>

namespace voussoir {

struct SelectionProblem {
  Eigen::MatrixXd ratios;          // [period][record], spectral ordinate over target at factor 1
  std::vector<int> events;         // of each record, any numbers
  std::size_t count = 7;           // records wanted
  std::size_t per_event = 3;       // at most so many of one event
  double low = 0.9, high = 1.3;    // bounds of the mean over the target at every period
  double least = 0.3, most = 3.0;  // bounds of the factors
  double weight = 0.01;            // of factors other than 1 beside misfit, see Selection::score
  std::uint64_t seed = 1;          // of the search among more sets than can be tried one by one
  std::size_t tries = 1'000'000;   // sets tried at most; fewer than there are: by exchanges from random beginnings
};

struct Selection {
  bool found = false;                // every bound is kept; otherwise the set that comes closest
  std::vector<std::size_t> records;  // ascending
  std::vector<double> factors;       // one a record
  std::vector<double> mean;          // over the target, at each period
  double score = 0.0;                // mean (mean/target − 1)² + weight · mean (factor − 1)²
  double tried = 0.0;                // sets
  bool all_tried = false;
};

/// The set of least score whose mean stays within the bounds. For a set, score and bounds are a convex quadratic
/// programme in the factors: first within the bounds of the factors alone, by coordinate descent; the best thousands
/// are then taken into the bounds of the mean by the dual method of Hildreth (1957). Same input, same answer. Throws
/// InputError when the bounds contradict each other or there are fewer records than wanted.
Selection select_records(const SelectionProblem& problem);

}  // namespace voussoir
