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

using Optimiser = std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)>;

Optimiser optimiser_of(nlopt_algorithm algorithm, std::size_t size) {
  Optimiser optimiser(nlopt_create(algorithm, static_cast<unsigned>(size)), &nlopt_destroy);
  if (!optimiser) throw std::bad_alloc();
  return optimiser;
}

void run(nlopt_algorithm algorithm, int evaluations, const CubeSearch& search,
         Evaluation& evaluation, const std::vector<double>& start) {
  const Optimiser optimiser = optimiser_of(algorithm, start.size());
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

/// The least coordinate t with sizes − t ≤ 0 and all that is limited ≤ 0.
class SlopesEvaluation {
 public:
  SlopesEvaluation(const SlopesOnCube& function, std::span<const double> start)
      : function_(function) {
    look(start);
  }

  /// Empty where the start has no derivatives.
  const std::optional<SlopedNumbers>& at_start() const { return last_; }
  const std::optional<CubeMinimum>& best() const { return best_; }
  void of(nlopt_opt optimiser) { optimiser_ = optimiser; }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

  /// The constraints at a point, of which the last coordinate is t.
  void constrain(unsigned count, double* values, std::span<const double> point, double* slopes) {
    const std::size_t width = point.size() - 1;
    look(point.first(width));
    const std::size_t sizes = last_->sizes.size();
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_size = i < sizes;
      const SlopedNumber& one = is_size ? last_->sizes[i] : last_->limited[i - sizes];
      constexpr double worse = 10.0;   // than any near the last point with derivatives
      constexpr double within = 1e-9;  // so that rounding does not exceed a limit
      values[i] = one.value + (is_size ? -point[width] : within) + (is_missing_ ? worse : 0.0);
      if (slopes == nullptr) continue;
      std::copy(one.slopes.begin(), one.slopes.end(), slopes + i * point.size());
      slopes[i * point.size() + width] = is_size ? -1.0 : 0.0;
    }
  }

  static double largest(const std::vector<SlopedNumber>& numbers) {
    double largest = -std::numeric_limits<double>::infinity();
    for (const SlopedNumber& one : numbers) largest = std::max(largest, one.value);
    return largest;
  }

 private:
  void look(std::span<const double> point) {
    if (std::equal(point.begin(), point.end(), point_.begin(), point_.end())) return;
    point_.assign(point.begin(), point.end());
    ++evaluations_;
    std::optional<SlopedNumbers> found;
    try {
      if (!thrown_) found = function_(point);
    } catch (...) {
      thrown_ = std::current_exception();
      if (optimiser_ != nullptr) nlopt_force_stop(optimiser_);
    }
    is_missing_ = !found;
    if (!found) return;
    last_ = std::move(found);
    const double size = largest(last_->sizes);
    if (largest(last_->limited) > 0.0 || (best_ && best_->value <= size)) return;
    best_ = CubeMinimum{.point = point_, .value = size, .evaluations = evaluations_};
  }

  const SlopesOnCube& function_;
  std::vector<double> point_;
  std::optional<SlopedNumbers> last_;  ///< with derivatives
  bool is_missing_ = false;            ///< at the point
  std::size_t evaluations_ = 0;
  std::optional<CubeMinimum> best_;
  std::exception_ptr thrown_;
  nlopt_opt optimiser_ = nullptr;
};

void constrain(unsigned count, double* values, unsigned size, const double* point, double* slopes,
               void* evaluation) {
  static_cast<SlopesEvaluation*>(evaluation)->constrain(count, values, {point, size}, slopes);
}

double last_coordinate(unsigned size, const double* point, double* slopes, void* /*evaluation*/) {
  if (slopes != nullptr) {
    std::fill(slopes, slopes + size - 1, 0.0);
    slopes[size - 1] = 1.0;
  }
  return point[size - 1];
}

}  // namespace

std::optional<CubeMinimum> minimum_by_slopes(const SlopesOnCube& function,
                                             std::span<const double> start, int evaluations) {
  SlopesEvaluation evaluation(function, start);
  evaluation.rethrow();
  if (!evaluation.at_start()) return std::nullopt;
  const SlopedNumbers first = *evaluation.at_start();
  const std::size_t size = start.size() + 1;
  const Optimiser optimiser = optimiser_of(NLOPT_LD_SLSQP, size);
  evaluation.of(optimiser.get());
  constexpr double no_bound = std::numeric_limits<double>::infinity();
  std::vector<double> low(size, 0.0);
  std::vector<double> high(size, 1.0);
  low.back() = -no_bound;
  high.back() = no_bound;
  nlopt_set_lower_bounds(optimiser.get(), low.data());
  nlopt_set_upper_bounds(optimiser.get(), high.data());
  nlopt_set_min_objective(optimiser.get(), &last_coordinate, nullptr);
  const std::size_t count = first.sizes.size() + first.limited.size();
  nlopt_add_inequality_mconstraint(optimiser.get(), static_cast<unsigned>(count), &constrain,
                                   &evaluation, nullptr);
  constexpr double content = 1e-10;
  nlopt_set_xtol_abs1(optimiser.get(), content);
  nlopt_set_maxeval(optimiser.get(), evaluations);
  std::vector<double> point(start.begin(), start.end());
  point.push_back(SlopesEvaluation::largest(first.sizes));
  double value = 0.0;
  nlopt_optimize(optimiser.get(), point.data(), &value);  // `evaluation` keeps the best point
  evaluation.rethrow();
  return evaluation.best();
}

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
