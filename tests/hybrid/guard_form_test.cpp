// The coefficients of a guard over a step, and how uncertain they are, in extended
// precision.
#include "hybrid/guard_form.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "base/references.hpp"
#include "base/traced_draws.hpp"

namespace gearlash::hybrid::guard_form_test {
namespace {

constexpr Eigen::Index size = 6;

struct Step {
  AffineFlow flow{Matrix(size, size), Vector(size)};
  AffineForm guard{Vector(size), 0.0};
  Vector state{size};
};

Step random_step(SeededDraws& draws) {
  Step step;
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) step.flow.matrix(i, j) = draws.uniform(-1.0, 1.0);
    step.flow.offset[i] = draws.uniform(-1.0, 1.0);
    step.guard.normal[i] = draws.uniform(-1.0, 1.0);
    step.state[i] = draws.uniform(-1.0, 1.0);
  }
  return step;
}

/// Of g over a time: cᵀ A^{k−1} v timeᵏ/k!, from k = 1 on, with v as doubles have it.
std::vector<Wide> exact_coefficients(const Step& step, const Velocity& velocity, const Wide& time,
                                     std::size_t orders) {
  std::array<Wide, size> derivative;
  for (std::size_t i = 0; i < size; ++i) derivative[i] = velocity.values[i];
  std::vector<Wide> all;
  Wide factor = 1;
  for (std::size_t k = 1; k <= orders; ++k) {
    factor *= time / static_cast<double>(k);
    Wide sum = 0;
    std::array<Wide, size> next{};
    for (std::size_t i = 0; i < size; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      sum += step.guard.normal[row] * derivative[i];
      for (std::size_t j = 0; j < size; ++j) {
        next[i] += step.flow.matrix(row, static_cast<Eigen::Index>(j)) * derivative[j];
      }
    }
    all.push_back(sum * factor);
    derivative = next;
  }
  return all;
}

TEST(OracleGuardTable, CoefficientsOfRandomFlowsAreAsUncertainAsItSays) {
  TracedDraws draws(1978);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const Step step = random_step(draws);
    const LinearFlow flow(step.flow);
    const GuardTable table(flow, SparseForm(step.guard));
    Velocity velocity;
    const Vector none = Vector::Zero(size);
    flow.velocity_at(step.state.data(), none.data(), velocity);
    velocity.noise.assign(size, 0.0);  // the oracle has the same velocity
    for (const double share : {1.0, 0.37}) {
      const double length = share * flow.longest_step();
      const int orders = flow.order(length);
      const auto exact =
          exact_coefficients(step, velocity, length, static_cast<std::size_t>(orders));
      std::vector<double> found(static_cast<std::size_t>(orders) + 4);
      table.coefficients(velocity, share, orders, found.data());
      for (int first = 1; first <= orders; ++first) {
        double sum = 0.0;
        for (int order = first; order <= orders; ++order) {
          sum += table.uncertainty_of(velocity, share, order);
        }
        const double uncertainty = table.uncertainty(velocity, share, first, orders);
        EXPECT_NEAR(uncertainty, sum, 1e-12 * sum) << first;
        EXPECT_LE(uncertainty, table.bound_of_uncertainty(velocity, share, first)) << first;
        const auto k = static_cast<std::size_t>(first);
        EXPECT_LE(std::abs(exact[k - 1] - found[k]), table.uncertainty_of(velocity, share, first));
      }
    }
  }
}

}  // namespace
}  // namespace gearlash::hybrid::guard_form_test
