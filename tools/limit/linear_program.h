// Linear programs and their solution: the only place that knows a solver (GLPK, whose revised simplex method gives a
// vertex and its duals). The build does without where it is not installed.
#pragma once
#include <array>
#include <string>
#include <vector>

namespace voussoir::limit {

/// Greatest `objective` · x with each row of A x and each column of x between two bounds, either of which may be
/// infinite.
struct LinearProgram {
  struct Entry {
    int row = 0, column = 0;
    double value = 0.0;
  };
  using Bounds = std::array<double, 2>;  // low, high
  std::vector<Bounds> rows;
  std::vector<Bounds> columns;
  std::vector<double> objective;  // one of each column
  std::vector<Entry> entries;     // of A; no place twice

  int add_row(double low, double high);
  int add_column(double low, double high, double in_objective = 0.0);
  void add(int row, int column, double value);  // entries of zero are left out
};

struct LinearOptimum {
  enum class Kind { found, infeasible, unbounded };
  Kind kind = Kind::infeasible;
  double value = 0.0;
  std::vector<double> x;     // of the columns
  std::vector<double> dual;  // of the rows: what the value grows by when a row's bound at work does so by one
};

/// Whether the program was built with a solver.
bool can_solve_linear_programs();

/// Throws RunError when there is no solver, and when it gives up.
LinearOptimum solve(const LinearProgram& program);

}  // namespace voussoir::limit
