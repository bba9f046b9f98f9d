// Intervals against extended precision, the C library against what is documented of it, and the
// ends of the range.
#include "base/interval.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>

#include "base/references.hpp"
#include "base/seeded_draws.hpp"

namespace gearlash::interval_test {
namespace {

void expect_holds(const Interval& x, Wide exact, const char* what) {
  EXPECT_TRUE(Wide(x.low) <= exact && exact <= Wide(x.high))
      << what << ": " << x.low << " … " << x.high << " without " << exact;
}

/// One in ten is a point; ends have either sign.
Interval random_interval(SeededDraws& draws) {
  const double a = draws.either_sign(1e-20, 1e20);
  if (draws.happens(0.1)) return a;
  const double width = std::abs(a) * draws.log_uniform(1e-16, 10.0);
  return {a, a + width};
}

double random_within(SeededDraws& draws, const Interval& x) {
  const double share = draws.uniform(0.0, 1.0);
  return std::fmin(x.high, std::fmax(x.low, x.low + share * (x.high - x.low)));
}

TEST(PropertyInterval, ArithmeticHoldsForEveryPairOfNumbers) {
  constexpr std::uint64_t seed = 1801;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  for (int i = 0; i < 20000; ++i) {
    const Interval x = random_interval(draws);
    const Interval y = random_interval(draws);
    const Wide a = random_within(draws, x);
    const Wide b = random_within(draws, y);
    expect_holds(x + y, a + b, "sum");
    expect_holds(x - y, a - b, "difference");
    expect_holds(x * y, a * b, "product");
    if (b != 0) expect_holds(x / y, a / b, "quotient");
    expect_holds(square(x), a * a, "square");
    expect_holds(abs(x), std::abs(a), "size");
    if (a > 0) expect_holds(sqrt(x), std::sqrt(a), "root");
  }
}

/// Angles within some turns, often about an extreme or a zero, and beyond.
TEST(PropertyInterval, CosineAndSineHoldForEveryAngle) {
  constexpr std::uint64_t seed = 1804;
  SCOPED_TRACE(seed);
  SeededDraws draws(seed);
  double widest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double quarter = 0x1.921fb54442d18p+0 * std::round(draws.uniform(-40.0, 40.0));
    const double from = draws.happens(0.6) ? quarter - draws.log_uniform(1e-17, 1.0)
                                           : draws.either_sign(1e-20, 3e3);
    const Interval x{from, from + draws.log_uniform(1e-17, 8.0)};
    const Interval cosine = cos(x);
    const Interval sine = sin(x);
    for (int k = 0; k < 5; ++k) {
      const Wide angle = random_within(draws, x);
      expect_holds(cosine, std::cos(angle), "cosine");
      expect_holds(sine, std::sin(angle), "sine");
    }
    const Interval point = x.low;
    if (std::abs(x.low) < 1e3) widest = std::fmax(widest, cos(point).width());
    EXPECT_LE(cosine.high, 1.0);
    EXPECT_GE(sine.low, -1.0);
  }
  EXPECT_LT(widest, 3e-15);
}

TEST(Interval, CosineReachesItsExtremes) {
  const double turn = 6.283185307179586;
  EXPECT_EQ(cos(Interval(turn - 0.1, turn + 0.1)).high, 1.0);
  EXPECT_EQ(cos(Interval(0.5 * turn - 0.1, 0.5 * turn + 0.1)).low, -1.0);
  EXPECT_EQ(sin(Interval(0.25 * turn - 0.1, 0.25 * turn + 0.1)).high, 1.0);
  EXPECT_EQ(sin(Interval(-0.25 * turn - 0.1, -0.25 * turn + 0.1)).low, -1.0);
  EXPECT_LT(cos(Interval(0.1, 3.0)).high, 0.996);
  EXPECT_EQ(cos(Interval(0.1, 9.0)).high, 1.0);
  EXPECT_EQ(sin(Interval(0.0)).high, 0.0);
  EXPECT_EQ(sin(Interval(0.0)).low, 0.0);
  EXPECT_EQ(cos(Interval(0.0, infinity)).low, -1.0);
}

TEST(PropertyInterval, PointsWidenToNeighbours) {
  SeededDraws draws(1802);
  for (int i = 0; i < 20000; ++i) {
    const Interval x = draws.either_sign(1e-100, 1e100);
    const Interval y = draws.either_sign(1e-100, 1e100);
    for (const Interval& result : {x + y, x - y, x * y, x / y}) {
      const double unit = std::nextafter(std::abs(result.high), infinity) - std::abs(result.high);
      EXPECT_LT(result.low, result.high);
      EXPECT_LE(result.high - result.low, 4.0 * unit);
    }
  }
}

/// Of a function that increases, at points and between them.
struct Known {
  const char* name;
  std::function<Interval(const Interval&)> enclosed;
  std::function<double(double)> library;
  std::function<Wide(Wide)> exact;
  std::function<double(SeededDraws&)> draw;
};

TEST(OracleInterval, TheLibrarysFunctionsAreAsExactAsDocumented) {
  const Known functions[] = {
      {"exp", [](const Interval& x) { return exp(x); }, [](double x) { return std::exp(x); },
       [](Wide x) { return std::exp(x); },
       [](SeededDraws& draws) {
         return draws.happens(0.5) ? draws.uniform(-740.0, 705.0) : draws.either_sign(1e-18, 1.0);
       }},
      {"log", [](const Interval& x) { return log(x); }, [](double x) { return std::log(x); },
       [](Wide x) { return std::log(x); },
       [](SeededDraws& draws) {
         return draws.happens(0.5) ? draws.log_uniform(1e-300, 1e300)
                                   : 1.0 + draws.either_sign(1e-15, 0.5);
       }},
      {"log1p", [](const Interval& x) { return log1p(x); }, [](double x) { return std::log1p(x); },
       [](Wide x) { return std::log1p(x); },
       [](SeededDraws& draws) {
         return draws.happens(0.5) ? draws.log_uniform(1e-15, 1e300) : -draws.uniform(0.0, 1.0);
       }},
      {"cos", [](const Interval& x) { return cos(x); }, [](double x) { return std::cos(x); },
       [](Wide x) { return std::cos(x); },
       [](SeededDraws& draws) { return draws.either_sign(1e-10, 1e3); }},
      {"sin", [](const Interval& x) { return sin(x); }, [](double x) { return std::sin(x); },
       [](Wide x) { return std::sin(x); },
       [](SeededDraws& draws) { return draws.either_sign(1e-10, 1e3); }}};
  for (const Known& function : functions) {
    SeededDraws draws(1803);
    double worst = 0.0;
    for (int i = 0; i < 15000; ++i) {
      const double x = function.draw(draws);
      const Wide exact = function.exact(x);
      if (std::isnormal(function.library(x))) {
        worst = std::fmax(worst, epsilons_off(function.library(x), exact));
      }
      expect_holds(function.enclosed(x), exact, function.name);
      const double y = x + std::abs(x) * 0.01;
      const Interval wide = function.enclosed({x, y});
      EXPECT_TRUE(Wide(wide.low) <= exact && function.exact(y) <= Wide(wide.high));
    }
    // An epsilon is one to two units in the last place; the manual says 1 unit.
    EXPECT_LE(worst, 1.0) << function.name;
  }
}

TEST(OracleInterval, AnglesHold) {
  SeededDraws draws(1804);
  double worst = 0.0;
  for (int i = 0; i < 15000; ++i) {
    const double y = draws.log_uniform(1e-10, 1e10);
    const double x =
        draws.happens(0.5) ? draws.either_sign(1e-10, 1e10) : draws.either_sign(y, 2.0 * y);
    const Wide exact = std::atan2(Wide(y), Wide(x));
    expect_holds(atan2(Interval(y), Interval(x)), exact, "angle");
    worst = std::fmax(worst, epsilons_off(std::atan2(y, x), exact));
    const Interval wide_y{y, y * 1.1};
    const Interval wide_x{x, x + 0.1 * y};
    const Interval wide = atan2(wide_y, wide_x);
    for (const double share : {0.0, 0.3, 1.0}) {
      const Wide inside = std::atan2(Wide(y * (1.0 + 0.1 * share)), Wide(x + 0.05 * y));
      expect_holds(wide, inside, "angle of a box");
    }
  }
  EXPECT_LE(worst, 1.0);
}

TEST(EdgeInterval, NothingIsProvedByWhatIsNoNumber) {
  const Interval unbounded{0.0, infinity};
  const auto is_whole_line = [](const Interval& x) {
    return x.low == -infinity && x.high == infinity;
  };
  EXPECT_TRUE(is_whole_line(unbounded - unbounded));
  EXPECT_TRUE(is_whole_line(unbounded / unbounded) || (unbounded / unbounded).low == 0.0);
  EXPECT_TRUE(is_whole_line(Interval(1.0) / Interval(-1.0, 1.0)));
  EXPECT_TRUE(is_whole_line(settled(std::nan(""), 1.0)));
  EXPECT_TRUE(is_whole_line(settled(1.0, std::nan(""))));
  EXPECT_EQ((Interval(0.0) * unbounded).low, 0.0);
  EXPECT_EQ((Interval(0.0) * unbounded).high, 0.0);
  EXPECT_EQ((Interval(1.0) / Interval(0.0, 2.0)).high, infinity);
}

TEST(EdgeInterval, OverflowAndUnderflowAreBounded) {
  const double most = std::numeric_limits<double>::max();
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_LE((Interval(most) * Interval(2.0)).low, most);
  EXPECT_EQ((Interval(most) * Interval(2.0)).high, infinity);
  EXPECT_EQ((Interval(most) + Interval(most)).low, most);
  const Interval tiny = Interval(least) * Interval(0.25);
  EXPECT_EQ(tiny.low, 0.0);
  EXPECT_GT(tiny.high, 0.0);
  const Interval below_zero = Interval(-least) * Interval(0.25);
  EXPECT_LT(below_zero.low, 0.0);
  EXPECT_GE(below_zero.high, 0.0);
  EXPECT_GT((Interval(-least) / Interval(4.0)).high, -least);
  EXPECT_LE((Interval(-least) / Interval(4.0)).low, -least);
  EXPECT_EQ(exp(Interval(-2000.0)).low, 0.0);
  EXPECT_GT(exp(Interval(-2000.0)).high, 0.0);
  EXPECT_EQ(exp(Interval(2000.0)).high, infinity);
  EXPECT_EQ(log(Interval(0.0, 1.0)).low, -infinity);
  EXPECT_EQ(log(Interval(-1.0, 0.0)).high, -infinity);
  EXPECT_EQ(log1p(Interval(-2.0, -1.0)).high, -infinity);
}

}  // namespace
}  // namespace gearlash::interval_test
