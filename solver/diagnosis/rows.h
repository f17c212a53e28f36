// Ranges of consecutive rows. Not for use outside this folder.
#pragma once
#include <algorithm>

#include "solver/diagnosis/problem.h"

namespace voussoir {

struct RowRange {
  std::size_t begin = 0, end = 0;
  Eigen::Index at() const { return Eigen::Index(begin); }
  Eigen::Index count() const { return Eigen::Index(end - begin); }
};

/// The rows of one kind of a measured mode.
inline RowRange rows_of(const std::vector<ResidualRow>& rows, int mode, ResidualRow::Kind kind) {
  const auto is = [&](const ResidualRow& row) { return row.mode == mode && row.kind == kind; };
  const auto first = std::find_if(rows.begin(), rows.end(), is);
  const auto last = std::find_if_not(first, rows.end(), is);
  return {std::size_t(first - rows.begin()), std::size_t(last - rows.begin())};
}

/// Selects the values of these rows from one value for each sensor.
inline Eigen::VectorXd seen(const std::vector<ResidualRow>& rows, const RowRange& range, const Eigen::VectorXd& all) {
  Eigen::VectorXd v(range.count());
  for (std::size_t i = range.begin; i < range.end; ++i) v[Eigen::Index(i - range.begin)] = all[rows[i].sensor];
  return v;
}

}  // namespace voussoir
