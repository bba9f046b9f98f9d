#include "numeric/box_minimum.hpp"

#include <nlopt.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <memory>

namespace gearlash {
namespace {

/// Keeps the best point, and what was thrown, while the optimiser, which is written in C, goes on.
class Evaluation {
 public:
  Evaluation(const FunctionOnCube& function, CubeMinimum& best)
      : function_(function), best_(best) {}

  double operator()(std::span<const double> point) {
    std::optional<double> value;
    try {
      value = function_(point);
    } catch (...) {
      thrown_ = std::current_exception();
    }
    ++best_.evaluations;
    if (!value) {
      best_.stopped = true;
      if (optimiser_ != nullptr) nlopt_force_stop(optimiser_);
      return std::numeric_limits<double>::max();
    }
    if (best_.point.empty() || *value < best_.value) {
      best_.point.assign(point.begin(), point.end());
      best_.value = *value;
    }
    return *value;
  }

  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }
  void of(nlopt_opt optimiser) { optimiser_ = optimiser; }

 private:
  const FunctionOnCube& function_;
  CubeMinimum& best_;
  std::exception_ptr thrown_;
  nlopt_opt optimiser_ = nullptr;
};

double evaluate(unsigned size, const double* point, double* /*gradient*/, void* evaluation) {
  return (*static_cast<Evaluation*>(evaluation))({point, size});
}

void run(nlopt_algorithm algorithm, int evaluations, const CubeSearch& search,
         Evaluation& evaluation, const std::vector<double>& start) {
  const auto size = static_cast<unsigned>(start.size());
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimiser(
      nlopt_create(algorithm, size), &nlopt_destroy);
  if (!optimiser) throw std::bad_alloc();
  evaluation.of(optimiser.get());
  nlopt_set_lower_bounds1(optimiser.get(), 0.0);
  nlopt_set_upper_bounds1(optimiser.get(), 1.0);
  nlopt_set_min_objective(optimiser.get(), &evaluate, &evaluation);
  nlopt_set_maxeval(optimiser.get(), evaluations);
  nlopt_set_xtol_abs1(optimiser.get(), search.last_step);
  nlopt_set_initial_step1(optimiser.get(), search.first_step);
  std::vector<double> point = start;
  double value = 0.0;
  nlopt_optimize(optimiser.get(), point.data(), &value);  // `evaluation` keeps the best point
  evaluation.of(nullptr);
}

}  // namespace

CubeMinimum minimum_on_cube(const FunctionOnCube& function, std::span<const double> start,
                            const CubeSearch& search) {
  CubeMinimum best;
  Evaluation evaluation(function, best);
  evaluation(start);
  if (!best.stopped && search.global_evaluations > 0) {
    run(NLOPT_GN_DIRECT_L, search.global_evaluations, search, evaluation, best.point);
  }
  if (!best.stopped && search.local_evaluations > 0) {
    run(NLOPT_LN_SBPLX, search.local_evaluations, search, evaluation, best.point);
  }
  evaluation.rethrow();
  if (best.point.empty()) best.point.assign(start.begin(), start.end());
  return best;
}

}  // namespace gearlash
