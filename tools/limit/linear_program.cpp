#include "tools/limit/linear_program.h"

#include <cmath>
#include <limits>

#include "solver/base/error.h"
#ifdef VOUSSOIR_GLPK
#include <glpk.h>
#endif

namespace voussoir::limit {

int LinearProgram::add_row(double low, double high) {
  rows.push_back({low, high});
  return int(rows.size()) - 1;
}

int LinearProgram::add_column(double low, double high, double in_objective) {
  columns.push_back({low, high});
  objective.push_back(in_objective);
  return int(columns.size()) - 1;
}

void LinearProgram::add(int row, int column, double value) {
  if (value != 0.0) entries.push_back({row, column, value});
}

#ifdef VOUSSOIR_GLPK

namespace {

int bound_kind(const LinearProgram::Bounds& b) {
  const bool low = std::isfinite(b[0]), high = std::isfinite(b[1]);
  if (low && high) return b[0] == b[1] ? GLP_FX : GLP_DB;
  return low ? GLP_LO : high ? GLP_UP : GLP_FR;
}

/// GLPK's problem object, freed at the end.
struct Problem {
  glp_prob* p = glp_create_prob();
  Problem() = default;
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;
  ~Problem() { glp_delete_prob(p); }
};

void fill_in(glp_prob* p, const LinearProgram& program) {
  glp_set_obj_dir(p, GLP_MAX);
  if (!program.rows.empty()) glp_add_rows(p, int(program.rows.size()));
  if (!program.columns.empty()) glp_add_cols(p, int(program.columns.size()));
  for (std::size_t i = 0; i < program.rows.size(); ++i)
    glp_set_row_bnds(p, int(i) + 1, bound_kind(program.rows[i]), program.rows[i][0], program.rows[i][1]);
  for (std::size_t i = 0; i < program.columns.size(); ++i) {
    glp_set_col_bnds(p, int(i) + 1, bound_kind(program.columns[i]), program.columns[i][0], program.columns[i][1]);
    glp_set_obj_coef(p, int(i) + 1, program.objective[i]);
  }
  std::vector<int> row = {0}, column = {0};  // GLPK counts from 1
  std::vector<double> value = {0.0};
  for (const LinearProgram::Entry& e : program.entries) {
    row.push_back(e.row + 1), column.push_back(e.column + 1), value.push_back(e.value);
  }
  glp_load_matrix(p, int(program.entries.size()), row.data(), column.data(), value.data());
}

}  // namespace

bool can_solve_linear_programs() {
  return true;
}

namespace {

/// Variants of the simplex method. Equilibrium of blocks is degenerate, and sometimes one variant cycles or loses
/// accuracy.
struct Way {
  int method, pricing, ratio;
  bool presolve;
};
constexpr Way ways[] = {{GLP_PRIMAL, GLP_PT_PSE, GLP_RT_HAR, false},
                        {GLP_PRIMAL, GLP_PT_STD, GLP_RT_STD, false},
                        {GLP_DUALP, GLP_PT_PSE, GLP_RT_HAR, false},
                        {GLP_PRIMAL, GLP_PT_PSE, GLP_RT_HAR, true}};

/// The meaning of the result of GLPK; `known` is false if there is none.
struct Answer {
  bool known = false;
  LinearOptimum::Kind kind = LinearOptimum::Kind::infeasible;
};

Answer answer_of(int failed, int status) {
  if (failed == GLP_ENOPFS) return {true, LinearOptimum::Kind::infeasible};
  if (failed != 0) return {};
  if (status == GLP_OPT) return {true, LinearOptimum::Kind::found};
  if (status == GLP_NOFEAS) return {true, LinearOptimum::Kind::infeasible};
  if (status == GLP_UNBND) return {true, LinearOptimum::Kind::unbounded};
  return {};
}

Answer try_one(glp_prob* p, const Way& way, int iterations) {
  glp_smcp settings;
  glp_init_smcp(&settings);
  settings.msg_lev = GLP_MSG_OFF;
  settings.meth = way.method, settings.pricing = way.pricing, settings.r_test = way.ratio;
  settings.presolve = way.presolve ? GLP_ON : GLP_OFF;
  settings.it_lim = iterations;
  if (!way.presolve) glp_adv_basis(p, 0);
  const int failed = glp_simplex(p, &settings);
  return answer_of(failed, glp_get_status(p));
}

}  // namespace

LinearOptimum solve(const LinearProgram& program) {
  glp_term_out(GLP_OFF);
  const int size = int(program.rows.size() + program.columns.size());
  for (const Way& way : ways) {
    const Problem problem;
    glp_prob* p = problem.p;
    fill_in(p, program);
    glp_scale_prob(p, GLP_SF_AUTO);
    const Answer answer = try_one(p, way, 1000 + 20 * size);
    if (!answer.known) continue;
    LinearOptimum optimum;
    optimum.kind = answer.kind;
    if (answer.kind != LinearOptimum::Kind::found) return optimum;
    optimum.value = glp_get_obj_val(p);
    for (std::size_t i = 0; i < program.columns.size(); ++i) optimum.x.push_back(glp_get_col_prim(p, int(i) + 1));
    for (std::size_t i = 0; i < program.rows.size(); ++i) optimum.dual.push_back(glp_get_row_dual(p, int(i) + 1));
    return optimum;
  }
  throw RunError("GLPK could not solve the linear program of {} rows and {} columns with any of {} methods",
                 program.rows.size(), program.columns.size(), std::size(ways));
}

#else

bool can_solve_linear_programs() {
  return false;
}

LinearOptimum solve(const LinearProgram&) {
  throw RunError("this program was built without a solver for linear programs. Install libglpk-dev and build again");
}

#endif

}  // namespace voussoir::limit
