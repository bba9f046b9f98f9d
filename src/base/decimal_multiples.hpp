// Multiples of a step as its author would write them.
#pragma once

#include <cstddef>

namespace gearlash {

/// 3 × 0.003 is 0.009, not 0.009000000000000001: if the step has a short decimal text, m × 10⁻ᵖ,
/// the multiple is k m / 10ᵖ, rounded once.
class DecimalMultiples {
 public:
  explicit DecimalMultiples(double step);
  double operator()(std::size_t count) const;

 private:
  double step_;
  double mantissa_ = 0.0;
  double divisor_ = 0.0;  ///< 0: the text is not short
};

/// Number of samples at 0, every, 2 every, … up to `end`. 10 s every 0.1 s give 101, although the
/// double 0.1 is slightly more than a tenth.
std::size_t count_of_samples(double end, double every);

}  // namespace gearlash
