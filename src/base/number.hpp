// What formulas that are written once for doubles and for intervals ask of their numbers.
#pragma once

#include <cmath>
#include <numbers>

#include "base/interval.hpp"

namespace gearlash {

/// Whether the number is known to be this one.
template <class Number>
bool is_exactly(const Number& number, double value) {
  return number == value;
}
inline bool is_exactly(const Interval& number, double value) {
  return number.low == value && number.high == value;
}

/// Whether both are known to be the same number.
template <class Number>
bool are_equal(const Number& one, const Number& other) {
  return one == other;
}
inline bool are_equal(const Interval& one, const Interval& other) {
  return is_exactly(one, one.low) && is_exactly(other, one.low);
}

/// Of a datum that is 0 or positive: whether it is not 0.
template <class Number>
bool is_above_zero(const Number& number) {
  return number > 0.0;
}
inline bool is_above_zero(const Interval& number) { return number.high > 0.0; }

/// Of a number that is known not to be negative: the part of an interval that may be it.
template <class Number>
Number not_negative(const Number& number) {
  return number;
}

template <class Number>
double approximate(const Number& number) {
  return static_cast<double>(number);
}
inline double approximate(const Interval& number) { return middle(number); }

// ---- data ---------------------------------------------------------------------------------------

/// A datum is the double that was read.
struct AsRead {
  double operator()(double value) const { return value; }
  double converted(double value) const { return value; }
  static double pi() { return std::numbers::pi; }
};

/// A datum is a number that may have been written where the double was read; 0 and infinity are
/// exact.
///
/// Rounding between both, in units of 2⁻⁵³ of the value: 1 of the decimal, 1 of its product with
/// the unit, and those of the unit's factor: at most `most_roundings` of unit_database.hpp, 50.
/// A reciprocal form (parameter = inverse/number) adds some, a fraction or a percentage has one in
/// the place of a unit's.
struct AsWritten {
  static constexpr double units = 64.0;

  Interval operator()(double value) const { return widened(value, units); }
  /// Of a gain that a firmware's registers stand for: at most five such data multiplied or divided
  /// (model/firmware.cpp), with 16 operations.
  Interval converted(double value) const { return widened(value, 5.0 * units + 16.0); }
  static Interval pi() { return {std::numbers::pi, outward::above(std::numbers::pi)}; }

 private:
  static Interval widened(double value, double by_units) {
    if (std::isinf(value)) return value;
    const double error = by_units * 0x1p-53 * std::abs(value);
    return {outward::below(value - error), outward::above(value + error)};
  }
};

}  // namespace gearlash
