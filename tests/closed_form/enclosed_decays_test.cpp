// The divided differences of exp that flights are made of lie within their enclosures.
#include "closed_form/enclosed_decays.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "base/seeded_draws.hpp"
#include "seventy_digits.hpp"

namespace gearlash::enclosed_decays_test {
namespace {

/// exp[0, −x] and exp[0, 0, −x]: seventy digits can spare what the quotients lose.
struct ExactDecay {
  Real factor, integral, double_integral;
  explicit ExactDecay(const Real& x)
      : factor(exp(-x)), integral((1 - factor) / x), double_integral((1 - integral) / x) {}
};

struct ExactConvolution {
  Real value, integral, double_integral;
  ExactConvolution(const Real& x, const Real& y) {
    const ExactDecay slow(x);
    const ExactDecay fast(y);
    value = x == y ? slow.factor : Real((slow.factor - fast.factor) / (y - x));
    integral = (slow.integral - value) / y;
    double_integral = (slow.double_integral - integral) / y;
  }
};

void expect_holds(const Interval& bounds, const Real& exact) {
  ASSERT_TRUE(Real(bounds.low) <= exact && exact <= Real(bounds.high));
}

double epsilons_off(double actual, const Real& exact) {
  return static_cast<double>(abs((actual - exact) / exact)) / 0x1p-52;
}

/// In and about the region of the series, and far beyond it.
double drawn_exponent(SeededDraws& draws) {
  if (draws.happens(0.4)) return draws.uniform(0.0, 1.5);
  if (draws.happens(0.3)) return draws.uniform(0.9, 1.1);
  return draws.log_uniform(1e-8, 600.0);
}

TEST(OracleEnclosedDecays, HoldAndAreNarrow) {
  constexpr std::uint64_t seed = 1811;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  double worst_of_one = 0.0;
  double worst_of_two = 0.0;
  double widest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double x = drawn_exponent(draws);
    const double y =
        draws.happens(0.2) ? x * (1.0 + draws.either_sign(1e-15, 0.1)) : drawn_exponent(draws);
    const BasicDecay<Interval> of_x = detail::enclosed_decay(x);
    const ExactDecay exact(x);
    expect_holds(of_x.factor, exact.factor);
    expect_holds(of_x.integral, exact.integral);
    expect_holds(of_x.double_integral, exact.double_integral);
    const auto both = detail::enclosed_convolution(of_x, detail::enclosed_decay(y));
    const ExactConvolution exact_both(x, y);
    expect_holds(both.value, exact_both.value);
    expect_holds(both.integral, exact_both.integral);
    expect_holds(both.double_integral, exact_both.double_integral);
    widest = std::max(widest, both.double_integral.width() / both.double_integral.low);
    if (x < detail::series_limit) {
      worst_of_one = std::max(worst_of_one,
                              epsilons_off(detail::single_rate_series(x), exact.double_integral));
    }
    if (x < detail::series_limit && y < detail::series_limit) {
      worst_of_two = std::max(
          worst_of_two, epsilons_off(detail::two_rate_series(x, y), exact_both.double_integral));
    }
  }
  // The bounds of the header, 8 and 26 units of half an epsilon, hold with room.
  EXPECT_LE(worst_of_one, 4.0);
  EXPECT_LE(worst_of_two, 13.0);
  EXPECT_LE(widest, 400.0 * 0x1p-52);
}

}  // namespace
}  // namespace gearlash::enclosed_decays_test
