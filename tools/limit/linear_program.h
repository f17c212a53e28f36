// Linear programs and their solution. This is the only file that uses a solver (GLPK, whose revised simplex method
// gives a vertex and its duals). The program can be built without GLPK.
#pragma once
#include <array>
#include <string>
#include <vector>

namespace voussoir::limit {

/// Maximises `objective` · x, with each row of A x and each column of x between two bounds, which may be infinite.
struct LinearProgram {
  struct Entry {
    int row = 0, column = 0;
    double value = 0.0;
  };
  using Bounds = std::array<double, 2>;  // low, high
  std::vector<Bounds> rows;
  std::vector<Bounds> columns;
  std::vector<double> objective;  // one coefficient for each column
  std::vector<Entry> entries;     // entries of A; each position at most once

  int add_row(double low, double high);
  int add_column(double low, double high, double in_objective = 0.0);
  void add(int row, int column, double value);  // zero entries are left out
};

struct LinearOptimum {
  enum class Kind { found, infeasible, unbounded };
  Kind kind = Kind::infeasible;
  double value = 0.0;
  std::vector<double> x;     // values of the columns
  std::vector<double> dual;  // of the rows: change of the value per unit change of the active bound of a row
};

/// Whether the program was built with a solver.
bool can_solve_linear_programs();

/// Throws RunError if there is no solver, or if the solver fails.
LinearOptimum solve(const LinearProgram& program);

}  // namespace voussoir::limit
