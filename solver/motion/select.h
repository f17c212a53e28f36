// Selects and scales ground motions so that their mean spectrum is close to a target.
#pragma once
#include <Eigen/Dense>
#include <cstdint>
#include <vector>

namespace voussoir {

struct SelectionProblem {
  Eigen::MatrixXd ratios;          // [period][record], spectral ordinate over target at factor 1
  std::vector<int> events;         // of each record, any numbers
  std::size_t count = 7;           // required number of records
  std::size_t per_event = 3;       // largest number of records of one event
  double low = 0.9, high = 1.3;    // bounds of the mean over the target at every period
  double least = 0.3, most = 3.0;  // bounds of the factors
  double weight = 0.01;            // weight of deviations of the factors from 1, see Selection::score
  std::uint64_t seed = 1;          // of the random search if there are too many sets to try all
  std::size_t tries = 1'000'000;   // largest number of tried sets; if there are more sets, the search exchanges
                                   // records from random starts
};

struct Selection {
  bool found = false;                // all bounds are satisfied; else the result is the closest set
  std::vector<std::size_t> records;  // ascending
  std::vector<double> factors;       // one for each record
  std::vector<double> mean;          // over the target, at each period
  double score = 0.0;                // mean (mean/target − 1)² + weight · mean (factor − 1)²
  double tried = 0.0;                // number of tried sets
  bool all_tried = false;
};

/// The set with the least score whose mean is within the bounds. For a set, score and bounds form a convex quadratic
/// programme in the factors. It is first solved by coordinate descent with only the bounds of the factors. For the best
/// few thousand sets, the dual method of Hildreth (1957) then applies the bounds of the mean. The same input gives the
/// same result. Throws InputError if the bounds contradict each other or there are too few records.
Selection select_records(const SelectionProblem& problem);

}  // namespace voussoir
