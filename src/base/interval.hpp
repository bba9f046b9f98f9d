// Interval arithmetic: results that hold for every number within the operands, rounding included.
//
// Method (Moore, Interval Analysis, 1966, chapter 3). Each operation computes its ends with
// rounding to nearest and moves them outward to the neighbouring double, or one beyond. The
// rounding mode is never changed: WebAssembly has none, and compilers move code across its changes.
//
//   +, −, ×, ÷, √   rounded to nearest by IEEE 754, off by at most half a unit in the last place:
//                   one neighbour is enough. Neighbours as in Rump, Zimmermann, Boldo & Melquiond,
//                   "Computing predecessor and successor in rounding to nearest", BIT 49 (2009).
//   exp, log, …     from the C library, which states errors of at most 1 unit in the last place for
//                   them on every platform that Gearlash supports (GNU C Library manual, "Known
//                   Maximum Errors in Math Functions"; musl: below 1; fdlibm's atan2: below 2).
//                   They are widened by `library_error` units, four times that. tests/base measures
//                   them.
//
// A not-a-number (0·∞ within infinite bounds, a division by an interval around 0) becomes the whole
// line, so that it never proves anything. Compile without -ffast-math and with -ffp-contract=off.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/special_numbers.hpp"
#include "gearlash/bounds.hpp"

#ifdef __FAST_MATH__
#error "interval arithmetic needs IEEE 754: compile without -ffast-math"
#endif

namespace gearlash {

namespace outward {

/// Results of the C library are widened by this many units in the last place.
inline constexpr double library_error = 4.0;

/// Slightly more than half a unit in the last place of a number between 1 and 2.
inline constexpr double half_unit = 0x1p-53 * (1.0 + 0x1p-52);

/// The neighbour of x below it, or the next. For results that are 0 only if exact.
inline double below(double x) {
  if (x == 0.0) return x;
  const double lower = x - (half_unit * std::abs(x) + std::numeric_limits<double>::denorm_min());
  // An overflow: only a large lower bound is known.
  return x == std::numeric_limits<double>::infinity() ? std::numeric_limits<double>::max() : lower;
}
inline double above(double x) { return -below(-x); }

/// The same for positive products and quotients, which may be rounded to 0 or to infinity. The
/// lower end is then 0 (std::max drops the not-a-number).
inline double positive_below(double x) {
  return std::max(0.0, x - (half_unit * x + std::numeric_limits<double>::denorm_min()));
}
inline double positive_above(double x) {
  return x + (half_unit * x + std::numeric_limits<double>::denorm_min());
}

/// For a product or quotient, which may be rounded to 0.
inline double product_below(double x, bool is_exact) {
  return x == 0.0 && !is_exact ? -std::numeric_limits<double>::denorm_min() : below(x);
}
inline double product_above(double x, bool is_exact) { return -product_below(-x, is_exact); }

/// Further below x ≥ 0, a result of the C library. The true value of such a function is never below
/// 0.
inline double well_below(double x) { return std::max(0.0, below(x - library_error * 0x1p-52 * x)); }
inline double well_above(double x) {
  return above(x + library_error * 0x1p-52 * x) + std::numeric_limits<double>::denorm_min();
}

}  // namespace outward

/// The numbers from low to high. An end may be infinite, which stands for "no bound".
struct Interval {
  double low = 0.0;
  double high = 0.0;

  constexpr Interval() = default;
  constexpr Interval(double point) : low(point), high(point) {}
  constexpr Interval(double lowest, double highest) : low(lowest), high(highest) {}
  constexpr explicit Interval(const Bounds& bounds) : low(bounds.low), high(bounds.high) {}

  static constexpr Interval whole_line() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }

  constexpr Bounds bounds() const { return {low, high}; }
  constexpr bool contains(double value) const { return low <= value && value <= high; }
  double width() const { return outward::above(high - low); }
};

/// The same, or the whole line if an end is not a number.
inline Interval settled(double low, double high) {
  return low <= high ? Interval(low, high) : Interval::whole_line();
}

inline Interval operator-(const Interval& x) { return {-x.high, -x.low}; }

inline Interval operator+(const Interval& x, const Interval& y) {
  return settled(outward::below(x.low + y.low), outward::above(x.high + y.high));
}

inline Interval operator-(const Interval& x, const Interval& y) { return x + -y; }

/// For any signs. A separate call, so that the other case is small enough to be inlined: certified
/// searches take a fifteenth less time.
[[gnu::noinline]] inline Interval product_of_any_signs(const Interval& x, const Interval& y) {
  // 0 times no bound is 0.
  const auto product = [](double a, double b) { return a == 0.0 || b == 0.0 ? 0.0 : a * b; };
  const double a = product(x.low, y.low);
  const double b = product(x.low, y.high);
  const double c = product(x.high, y.low);
  const double d = product(x.high, y.high);
  const bool is_exact = (x.low == 0.0 && x.high == 0.0) || (y.low == 0.0 && y.high == 0.0);
  // std::min and std::max would drop a not-a-number.
  if (!(a == a && b == b && c == c && d == d)) return Interval::whole_line();
  const double low = outward::product_below(std::min(std::min(a, b), std::min(c, d)), is_exact);
  const double high = outward::product_above(std::max(std::max(a, b), std::max(c, d)), is_exact);
  return settled(x.low >= 0.0 && y.low >= 0.0 ? std::max(0.0, low) : low, high);
}

inline Interval operator*(const Interval& x, const Interval& y) {
  // The most frequent case: both positive and bounded.
  if (x.low > 0.0 && y.low > 0.0) {
    return {outward::positive_below(x.low * y.low), outward::positive_above(x.high * y.high)};
  }
  return product_of_any_signs(x, y);
}

/// The whole line if y contains 0, but [x.low/y.high, ∞) if both are not negative.
inline Interval operator/(const Interval& x, const Interval& y) {
  if (x.low > 0.0 && y.low > 0.0 && y.low < infinity) {
    return {outward::positive_below(x.low / y.high), outward::positive_above(x.high / y.low)};
  }
  if (y.high < 0.0) return -x / -y;
  if (y.low > 0.0) {
    const double low = x.low / (x.low >= 0.0 ? y.high : y.low);
    const double high = x.high / (x.high >= 0.0 ? y.low : y.high);
    return settled(
        x.low >= 0.0 ? std::max(0.0, outward::below(low)) : outward::product_below(low, false),
        outward::product_above(high, x.high == 0.0));
  }
  if (x.low >= 0.0 && y.low == 0.0 && y.high > 0.0) {
    return settled(std::max(0.0, outward::below(x.low / y.high)), infinity);
  }
  return Interval::whole_line();
}

/// The smallest interval around both.
inline Interval hull(const Interval& x, const Interval& y) {
  return {std::min(x.low, y.low), std::max(x.high, y.high)};
}

/// Near the middle, rounded: a number to steer by, not to prove with.
inline double middle(const Interval& x) { return 0.5 * (x.low + x.high); }

/// The intersection of two intervals that contain the same number.
inline Interval common_part(const Interval& x, const Interval& y) {
  const Interval part{std::max(x.low, y.low), std::min(x.high, y.high)};
  return part.low <= part.high ? part : hull(x, y);
}

/// For a number that is known not to be negative.
inline Interval not_negative(const Interval& x) {
  return {std::max(0.0, x.low), std::max(0.0, x.high)};
}

inline Interval abs(const Interval& x) {
  if (x.low >= 0.0) return x;
  return x.high <= 0.0 ? -x : Interval(0.0, std::max(-x.low, x.high));
}

inline Interval max(const Interval& x, const Interval& y) {
  return {std::max(x.low, y.low), std::max(x.high, y.high)};
}

inline Interval square(const Interval& x) {
  const Interval size = abs(x);
  return size * size;
}

/// For a number that is known not to be negative.
inline Interval sqrt(const Interval& x) {
  const Interval known = not_negative(x);
  return settled(std::max(0.0, outward::below(std::sqrt(known.low))),
                 outward::above(std::sqrt(known.high)));
}

inline Interval exp(const Interval& x) {
  return settled(outward::well_below(std::exp(x.low)), outward::well_above(std::exp(x.high)));
}

namespace outward {

/// For the C library's result x, of either sign.
inline double library_below(double x) { return x < 0.0 ? -well_above(-x) : well_below(x); }
inline double library_above(double x) { return -library_below(-x); }

}  // namespace outward

/// −∞ for arguments that are not positive.
inline Interval log(const Interval& x) {
  constexpr double nothing = -std::numeric_limits<double>::infinity();
  return settled(x.low > 0.0 ? outward::library_below(std::log(x.low)) : nothing,
                 x.high > 0.0 ? outward::library_above(std::log(x.high)) : nothing);
}

/// ln(1 + x); −∞ for x ≤ −1.
inline Interval log1p(const Interval& x) {
  constexpr double nothing = -std::numeric_limits<double>::infinity();
  return settled(x.low > -1.0 ? outward::library_below(std::log1p(x.low)) : nothing,
                 x.high > -1.0 ? outward::library_above(std::log1p(x.high)) : nothing);
}

/// The angle in [0, π] of the point (x, y). Precondition: y ≥ 0, and not both contain 0.
inline Interval atan2(const Interval& y, const Interval& x) {
  const double least = std::atan2(x.high >= 0.0 ? y.low : y.high, x.high);
  const double most = std::atan2(x.low >= 0.0 ? y.high : y.low, x.low);
  return settled(outward::well_below(least), outward::well_above(most));
}

namespace outward {

/// Of a function that is 1 where `half_turns` is even, −1 where it is odd, and monotone between,
/// with these values at the ends.
inline Interval swing(const Interval& half_turns, double one, double other) {
  const double first = std::ceil(half_turns.low);
  const double last = std::floor(half_turns.high);
  const auto has = [&](double remainder) {
    return (std::abs(std::fmod(first, 2.0)) == remainder ? first : first + 1.0) <= last;
  };
  return {has(1.0) ? -1.0 : std::max(-1.0, library_below(std::min(one, other))),
          has(0.0) ? 1.0 : std::min(1.0, library_above(std::max(one, other)))};
}

/// Beyond some turns an angle's error in half turns is no longer small.
inline bool is_of_few_turns(const Interval& x) { return x.low >= -1e3 && x.high <= 1e3; }

/// It contains π.
inline Interval half_turn() { return {0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1}; }

}  // namespace outward

/// −1 … 1 for angles beyond a thousand radians.
inline Interval cos(const Interval& x) {
  if (!outward::is_of_few_turns(x)) return {-1.0, 1.0};
  return outward::swing(x / outward::half_turn(), std::cos(x.low), std::cos(x.high));
}

/// The same. Of 0 it is exactly 0.
inline Interval sin(const Interval& x) {
  if (!outward::is_of_few_turns(x)) return {-1.0, 1.0};
  return outward::swing(x / outward::half_turn() - 0.5, std::sin(x.low), std::sin(x.high));
}

}  // namespace gearlash
