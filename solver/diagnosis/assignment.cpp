#include "solver/diagnosis/assignment.h"

#include <limits>

namespace voussoir {

namespace {

/// Columns not fewer than rows. Index 0 of the arrays is a column that stands for the row being placed.
std::vector<int> assign(const Eigen::MatrixXd& cost) {
  const auto rows = std::size_t(cost.rows()), columns = std::size_t(cost.cols());
  std::vector<double> of_row(rows + 1, 0.0), of_column(columns + 1, 0.0);  // dual prices
  std::vector<std::size_t> row_of(columns + 1, 0), before(columns + 1, 0);
  for (std::size_t row = 1; row <= rows; ++row) {
    row_of[0] = row;
    std::size_t column = 0;
    std::vector<double> least(columns + 1, std::numeric_limits<double>::infinity());
    std::vector<bool> done(columns + 1, false);
    do {
      done[column] = true;
      const std::size_t from = row_of[column];
      double step = std::numeric_limits<double>::infinity();
      std::size_t next = 0;
      for (std::size_t j = 1; j <= columns; ++j) {
        if (done[j]) continue;
        const double reduced = cost(Eigen::Index(from - 1), Eigen::Index(j - 1)) - of_row[from] - of_column[j];
        if (reduced < least[j]) least[j] = reduced, before[j] = column;
        if (least[j] < step) step = least[j], next = j;
      }
      for (std::size_t j = 0; j <= columns; ++j) {
        if (done[j])
          of_row[row_of[j]] += step, of_column[j] -= step;
        else
          least[j] -= step;
      }
      column = next;
    } while (row_of[column] != 0);
    for (; column != 0; column = before[column]) row_of[column] = row_of[before[column]];
  }
  std::vector<int> partner(rows, -1);
  for (std::size_t j = 1; j <= columns; ++j)
    if (row_of[j] != 0) partner[row_of[j] - 1] = int(j) - 1;
  return partner;
}

}  // namespace

std::vector<int> least_cost_assignment(const Eigen::MatrixXd& cost) {
  if (cost.rows() <= cost.cols()) return assign(cost);
  std::vector<int> partner(std::size_t(cost.rows()), -1);
  const std::vector<int> rows = assign(cost.transpose());
  for (std::size_t column = 0; column < rows.size(); ++column) partner[std::size_t(rows[column])] = int(column);
  return partner;
}

}  // namespace voussoir
