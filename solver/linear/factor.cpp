#include "solver/linear/factor.h"

#include <dlfcn.h>

#include <mutex>
#include <optional>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/parallel.h"

namespace voussoir {

namespace {

template <class Function>
Function* of_blas(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

/// What a call of CHOLMOD needs: neither it nor the BLAS opens threads, so that the bits do not depend on how many
/// there are; and with Debian's OpenBLAS for one thread, which gives wrong products when two threads call it at once,
/// one call waits for the other.
class Turn {
 public:
  Turn() {
    static const bool takes_turns = [] {
      if (auto* set = of_blas<void(int)>("openblas_set_num_threads")) set(1);
      auto* kind = of_blas<int()>("openblas_get_parallel");  // 0: for one thread
      return kind && kind() == 0;
    }();
    static std::mutex one_at_a_time;
    if (takes_turns) lock_.emplace(one_at_a_time);
  }

 private:
  Alone alone_;
  std::optional<std::scoped_lock<std::mutex>> lock_;
};

}  // namespace

Factor::Factor() {
  // Nested dissection: bridges are long, and its fronts are what the dense kernels are quick with.
  cholesky_.cholmod().nmethods = 1;
  cholesky_.cholmod().method[0].ordering = CHOLMOD_METIS;
  cholesky_.cholmod().print = 0;
}

bool Factor::compute(const SparseMatrix& a, double most_operations) {
  const Turn turn;
  const auto same = [](const std::vector<int>& known, const int* begin, Eigen::Index n) {
    return known.size() == std::size_t(n) && std::equal(known.begin(), known.end(), begin);
  };
  if (!same(outer_, a.outerIndexPtr(), a.cols() + 1) || !same(inner_, a.innerIndexPtr(), a.nonZeros())) {
    // METIS draws from the C library's one random sequence, which it starts anew each time: two at once would disturb
    // each other's orders, and with them the last bits.
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    cholesky_.analyzePattern(a);
    if (cholesky_.cholmod().status < CHOLMOD_OK) {  // there is no factor to continue with
      outer_.clear(), inner_.clear();
      return false;
    }
    outer_.assign(a.outerIndexPtr(), a.outerIndexPtr() + a.cols() + 1);
    inner_.assign(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros());
  }
  if (operations() > most_operations) return false;
  cholesky_.factorize(a);
  return !lacked_memory() && cholesky_.info() == Eigen::Success;
}

bool Factor::lacked_memory() {
  return cholesky_.cholmod().status == CHOLMOD_OUT_OF_MEMORY || cholesky_.cholmod().status == CHOLMOD_TOO_LARGE;
}

Eigen::MatrixXd Factor::solve(const Eigen::MatrixXd& x) const {
  const Turn turn;
  cholmod_common own;  // what a call keeps books in: the factor's own is for one thread
  cholmod_start(&own);
  own.print = 0;
  Eigen::MatrixXd right = x;
  cholmod_dense b = Eigen::viewAsCholmod(right);
  cholmod_dense* found = cholmod_solve(CHOLMOD_A, cholesky_.factor(), &b, &own);
  Eigen::MatrixXd result(x.rows(), x.cols());
  const bool solved = found != nullptr;
  if (solved) result = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(found->x), x.rows(), x.cols());
  cholmod_free_dense(&found, &own);
  cholmod_finish(&own);
  if (!solved && result.size() > 0)
    throw RunError("there is not enough memory to solve for {}", counted(x.rows(), "unknown"));
  return result;
}

}  // namespace voussoir
