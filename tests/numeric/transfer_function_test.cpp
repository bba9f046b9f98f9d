// Roots, responses and their bounds.
#include "numeric/transfer_function.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/seeded_draws.hpp"
#include "base/special_numbers.hpp"

namespace gearlash::transfer_function_test {
namespace {

using Complex = std::complex<double>;

constexpr double pi = 3.14159265358979323846;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

std::vector<double> times(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> product(a.size() + b.size() - 1, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) product[i + k] += a[i] * b[k];
  }
  return product;
}

/// Real roots of either sign, pairs of any damping, and roots at the origin.
std::vector<double> random_polynomial(SeededDraws& draws, int factors) {
  std::vector<double> polynomial{draws.either_sign(0.1, 10.0)};
  for (int i = 0; i < factors; ++i) {
    const double frequency = draws.log_uniform(0.01, 100.0);
    const double damping = draws.uniform(-0.5, 1.0);
    const double kind = draws.uniform(0.0, 1.0);
    if (kind < 0.2) {
      polynomial = times(polynomial, {1.0, 0.0});
    } else if (kind < 0.6) {
      polynomial = times(polynomial, {1.0, draws.sign() * frequency});
    } else {
      polynomial = times(polynomial, {1.0, 2.0 * damping * frequency, frequency * frequency});
    }
  }
  return polynomial;
}

TransferFunction random_transfer(SeededDraws& draws) {
  TransferFunction transfer;
  transfer.numerator = random_polynomial(draws, 2);
  transfer.denominator = random_polynomial(draws, 3);
  transfer.delay = draws.happens(0.5) ? draws.log_uniform(0.01, 1.0) : 0.0;
  return transfer;
}

TEST(TransferFunctionOracle, RootsOfKnownFactors) {
  // 2 (s − 3)(s + 1e-3)/(s² (s² + 4)) with zeros that lead.
  const FactoredTransferFunction factors =
      factored({{0.0, 2.0, -5.998, -0.006}, {1.0, 0.0, 4.0, 0.0, 0.0}, 0.5});
  EXPECT_EQ(factors.gain, 2.0);
  EXPECT_EQ(factors.delay, 0.5);
  ASSERT_EQ(factors.zeros.size(), 2U);
  const auto [least, most] = std::minmax({factors.zeros[0].real(), factors.zeros[1].real()});
  EXPECT_NEAR(least, -1e-3, 1e-15);
  EXPECT_NEAR(most, 3.0, 1e-14);
  ASSERT_EQ(factors.poles.size(), 4U);
  EXPECT_EQ(factors.poles[0], 0.0);
  EXPECT_EQ(factors.poles[1], 0.0);
  for (const std::size_t i : {2U, 3U}) {
    EXPECT_EQ(factors.poles[i].real(), 0.0);  // undamped, exactly
    EXPECT_NEAR(std::abs(factors.poles[i].imag()), 2.0, 1e-14);
  }
}

TEST(TransferFunctionOracle, ResponseOfALagAndADelay) {
  const FrequencyResponse response = frequency_response({{3.0}, {2.0, 1.0}, 0.25}, 0.5);
  EXPECT_NEAR(std::abs(response.value), 3.0 / std::sqrt(2.0), 4.0 * epsilon);
  EXPECT_NEAR(std::arg(response.value), -std::atan(1.0) - 0.125, 4.0 * epsilon);
  EXPECT_NEAR(response.log_slope.real(), -1.0, 4.0 * epsilon);         // −T²ω/(1 + T²ω²)
  EXPECT_NEAR(response.log_slope.imag(), -1.0 - 0.25, 4.0 * epsilon);  // −T/(1 + T²ω²) − delay
}

TEST(TransferFunctionProperty, FactorsGiveTheResponse) {
  SeededDraws draws(5);
  for (int count = 0; count < 300; ++count) {
    const TransferFunction transfer = random_transfer(draws);
    const double frequency = draws.log_uniform(1e-3, 1e3);
    const FrequencyResponse response = frequency_response(transfer, frequency);
    const ResponseBounds point = response_bounds(factored(transfer), frequency, frequency);
    // Roots have the relative condition of their polynomial; 1e-9 allows for near ones.
    EXPECT_NEAR(point.log_gain.low, std::log(std::abs(response.value)), 1e-9);
    EXPECT_NEAR(std::remainder(point.phase.low - std::arg(response.value), 2.0 * pi), 0.0, 1e-9);
    EXPECT_NEAR(point.log_gain_slope.low * frequency, response.log_slope.real() * frequency, 1e-6);
    EXPECT_NEAR(point.phase_slope.low * frequency, response.log_slope.imag() * frequency, 1e-6);
  }
}

bool within(const Bounds& inner, const Bounds& outer) {
  const double rounding = 1e-12 * (1.0 + std::abs(inner.low));
  return inner.low >= outer.low - rounding && inner.high <= outer.high + rounding;
}

TEST(TransferFunctionProperty, BoundsHoldWhatIsBetween) {
  SeededDraws draws(6);
  for (int count = 0; count < 300; ++count) {
    const FactoredTransferFunction factors = factored(random_transfer(draws));
    const double low = draws.log_uniform(1e-3, 1e3);
    const double high = low * (1.0 + draws.log_uniform(1e-6, 10.0));
    const ResponseBounds bounds = response_bounds(factors, low, high);
    for (int i = 0; i < 20; ++i) {
      const double frequency = draws.uniform(low, high);
      const ResponseBounds point = response_bounds(factors, frequency, frequency);
      EXPECT_TRUE(within(point.log_gain, bounds.log_gain));
      EXPECT_TRUE(within(point.phase, bounds.phase));
      EXPECT_TRUE(within(point.log_gain_slope, bounds.log_gain_slope));
      EXPECT_TRUE(within(point.phase_slope, bounds.phase_slope));
    }
  }
}

TEST(TransferFunctionEdge, EveryFaultIsNamed) {
  const auto found = faults(TransferFunction{{}, {0.0, infinity}, -1.0});
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].path, "numerator");
  EXPECT_EQ(found[1].path, "denominator");
  EXPECT_EQ(found[2].path, "delay");
  EXPECT_THROW(factored({{1.0}, {0.0}}), InvalidInput);
}

}  // namespace
}  // namespace gearlash::transfer_function_test
