#include "thesis/float_1604.hpp"

#include <bit>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace gearlash::thesis {
namespace {

constexpr int fraction_bits = 36;
constexpr int largest_exponent = 1023;
constexpr int smallest_exponent = -1023;
constexpr Word fraction_mask = (Word{1} << fraction_bits) - 1U;
constexpr Word field_of_zero_exponent = 02000;
constexpr Word field_above_negative_exponents = 01777;

constexpr std::int64_t least_fraction = std::int64_t{1} << (fraction_bits - 1);

WideInteger magnitude(WideInteger value) { return value < 0 ? -value : value; }

/// The number of bits of a value ≥ 0.
int bit_length(WideInteger value) {
  const auto high = static_cast<std::uint64_t>(value >> 64);
  const auto low = static_cast<std::uint64_t>(value);
  return high != 0 ? 128 - std::countl_zero(high) : 64 - std::countl_zero(low);
}

}  // namespace

/// fraction · 2^(exponent − 36), reduced to 36 bits.
Float1604 normalized(WideInteger fraction, int exponent, bool round) {
  if (fraction == 0) return {};
  WideInteger length = magnitude(fraction);
  const int excess = bit_length(length) - fraction_bits;
  if (excess > 0) {
    const WideInteger half = WideInteger{1} << (excess - 1);
    if (round) length += half;
    length >>= excess;
    exponent += excess;
    if (bit_length(length) > fraction_bits) {
      length >>= 1;
      ++exponent;
    }
  } else {
    length <<= -excess;
    exponent += excess;
  }
  if (exponent > largest_exponent) throw std::overflow_error("exponent fault of the CDC 1604");
  if (exponent < smallest_exponent) return {};
  const auto whole = static_cast<std::int64_t>(length);
  return {fraction < 0 ? -whole : whole, exponent};
}

Float1604 Float1604::truncated(double value) {
  if (!std::isfinite(value)) throw std::overflow_error("no number of the CDC 1604");
  int exponent = 0;
  constexpr int double_bits = 53;
  const double fraction = std::frexp(value, &exponent);
  const auto whole = static_cast<std::int64_t>(std::ldexp(fraction, double_bits));
  return normalized(whole, exponent - double_bits + fraction_bits, false);
}

Float1604 Float1604::of(Word word) {
  const bool negative = is_negative(word);
  const Word positive = negative ? complement(word) : word;
  const Word field = positive >> fraction_bits;
  const auto fraction = static_cast<std::int64_t>(positive & fraction_mask);
  const int exponent =
      field >= field_of_zero_exponent
          ? static_cast<int>(field - field_of_zero_exponent)
          : static_cast<int>(field) - static_cast<int>(field_above_negative_exponents);
  if (fraction >= least_fraction) return {negative ? -fraction : fraction, exponent};
  return normalized(negative ? -fraction : fraction, exponent, false);
}

Word Float1604::word() const {
  if (fraction_ == 0) return 0;
  const Word field = exponent_ >= 0
                         ? field_of_zero_exponent + static_cast<Word>(exponent_)
                         : field_above_negative_exponents - static_cast<Word>(-exponent_);
  const Word positive = (field << fraction_bits) | static_cast<Word>(std::abs(fraction_));
  return fraction_ < 0 ? complement(positive) : positive;
}

double Float1604::value() const {
  return std::ldexp(static_cast<double>(fraction_), exponent_ - fraction_bits);
}

Float1604 sum(const Float1604& one, const Float1604& other, SumRule rule) {
  if (one.is_zero()) return other;
  if (other.is_zero()) return one;
  const Float1604& larger = one.exponent_ >= other.exponent_ ? one : other;
  const Float1604& smaller = one.exponent_ >= other.exponent_ ? other : one;
  const int shift = larger.exponent_ - smaller.exponent_;
  const int widest = rule == SumRule::no_guard_digits ? fraction_bits : 2 * fraction_bits;
  if (shift > widest) return larger;
  if (rule == SumRule::no_guard_digits) {
    const std::int64_t kept = std::abs(smaller.fraction_) >> shift;
    const std::int64_t whole = larger.fraction_ + (smaller.fraction_ < 0 ? -kept : kept);
    const std::int64_t length = std::abs(whole);
    if (length >= least_fraction && length < 2 * least_fraction) return {whole, larger.exponent_};
    return normalized(whole, larger.exponent_, false);
  }
  const WideInteger exact =
      (static_cast<WideInteger>(larger.fraction_) << shift) + smaller.fraction_;
  return normalized(exact, larger.exponent_ - shift, rule == SumRule::exact_rounded);
}

Float1604 product(const Float1604& one, const Float1604& other, LengthRule rule) {
  return normalized(static_cast<WideInteger>(one.fraction_) * other.fraction_,
                    one.exponent_ + other.exponent_ - fraction_bits, rule == LengthRule::rounded);
}

Float1604 quotient(const Float1604& dividend, const Float1604& divisor, LengthRule rule) {
  if (divisor.is_zero()) throw std::domain_error("divide fault of the CDC 1604");
  // Enough bits of the quotient that the truncated remainder cannot decide the rounding.
  constexpr int further_bits = 48;
  const WideInteger scaled = static_cast<WideInteger>(dividend.fraction_) << further_bits;
  return normalized(scaled / divisor.fraction_,
                    dividend.exponent_ - divisor.exponent_ + fraction_bits - further_bits,
                    rule == LengthRule::rounded);
}

}  // namespace gearlash::thesis
