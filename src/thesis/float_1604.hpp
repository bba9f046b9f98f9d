// Floating-point numbers of the CDC 1604, with candidate rules for its rounding.
#pragma once

#include <cstdint>

namespace gearlash::thesis {

/// A 48-bit word in the low bits, one's complement: −x is the complement of all 48 bits.
using Word = std::uint64_t;
inline constexpr Word word_bits = (Word{1} << 48U) - 1U;
inline constexpr Word sign_bit = Word{1} << 47U;

/// An extension of gcc and clang that holds the product of two fractions exactly.
__extension__ typedef __int128 WideInteger;  // NOLINT: `using` takes no __extension__

constexpr Word complement(Word word) { return ~word & word_bits; }
constexpr bool is_negative(Word word) { return (word & sign_bit) != 0; }

/// How FAD and FSB reduce a sum to 36 bits of fraction.
enum class SumRule {
  no_guard_digits,  ///< the smaller operand is shifted right and truncated before the addition
  exact_truncated,  ///< the exact sum, truncated
  exact_rounded     ///< the exact sum, rounded to nearest
};
/// How FMU and FDV reduce a product and a quotient.
enum class LengthRule { truncated, rounded };

struct FloatRules {
  SumRule sum = SumRule::no_guard_digits;
  LengthRule product = LengthRule::truncated;
  LengthRule quotient = LengthRule::truncated;

  bool operator==(const FloatRules&) const = default;
};

/// The value fraction · 2^(exponent − 36), normalised: |fraction| from 2^35 to 2^36 − 1, or zero
/// with exponent 0. As a word: sign (1 bit), exponent (11), |fraction| (36); the exponent field is
/// 2000₈ + E for E ≥ 0 and 1777₈ + E for E < 0 (1777₈ itself is never used), and a negative number
/// is the complement of its opposite. Source: the listing's constants, which decode exactly.
class Float1604 {
 public:
  constexpr Float1604() = default;

  /// A double truncated to 36 bits of fraction, as the listing's constants are. Throws
  /// std::overflow_error beyond ±2^1023; zero below 2^-1024.
  static Float1604 truncated(double value);
  /// The number that a word stands for. Words that are not normalised numbers are evaluated by the
  /// same formula and then normalised.
  static Float1604 of(Word word);

  Word word() const;
  double value() const;  ///< exact: 36 bits fit into a double

  constexpr bool is_zero() const { return fraction_ == 0; }
  constexpr Float1604 operator-() const { return Float1604(-fraction_, exponent_); }
  bool operator==(const Float1604&) const = default;

  friend Float1604 sum(const Float1604& one, const Float1604& other, SumRule rule);
  friend Float1604 product(const Float1604& one, const Float1604& other, LengthRule rule);
  friend Float1604 quotient(const Float1604& dividend, const Float1604& divisor, LengthRule rule);

 private:
  constexpr Float1604(std::int64_t fraction, int exponent)
      : fraction_(fraction), exponent_(exponent) {}
  friend Float1604 normalized(WideInteger fraction, int exponent, bool round);

  std::int64_t fraction_ = 0;
  int exponent_ = 0;
};

/// Throws std::overflow_error for results beyond ±2^1023 (the machine's exponent fault). Results
/// below 2^-1024 are zero.
Float1604 sum(const Float1604& one, const Float1604& other, SumRule rule);
Float1604 product(const Float1604& one, const Float1604& other, LengthRule rule);
/// Also throws std::domain_error for a divisor of zero (the divide fault).
Float1604 quotient(const Float1604& dividend, const Float1604& divisor, LengthRule rule);

/// A Float1604 with the arithmetic of one set of rules, for use like a double.
template <FloatRules rules>
class Number1604 {
 public:
  Number1604() = default;
  explicit Number1604(double value) : value_(Float1604::truncated(value)) {}
  explicit Number1604(const Float1604& value) : value_(value) {}

  explicit operator double() const { return value_.value(); }
  Number1604 operator-() const { return Number1604(-value_); }
  friend Number1604 operator+(const Number1604& a, const Number1604& b) {
    return Number1604(sum(a.value_, b.value_, rules.sum));
  }
  friend Number1604 operator-(const Number1604& a, const Number1604& b) {
    return Number1604(sum(a.value_, -b.value_, rules.sum));
  }
  friend Number1604 operator*(const Number1604& a, const Number1604& b) {
    return Number1604(product(a.value_, b.value_, rules.product));
  }
  friend Number1604 operator/(const Number1604& a, const Number1604& b) {
    return Number1604(quotient(a.value_, b.value_, rules.quotient));
  }

 private:
  Float1604 value_;
};

}  // namespace gearlash::thesis
