#include "base/decimal_multiples.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/range_check.hpp"

namespace gearlash {

DecimalMultiples::DecimalMultiples(double step) : step_(step) {
  const std::string text = exact_text(step);
  const std::size_t point = text.find('.');
  constexpr std::size_t most_digits = 9;  // k m and 10ᵖ then are exact in a double
  if (point == std::string::npos || text.size() > most_digits ||
      text.find_first_not_of("0123456789.") != std::string::npos) {
    return;
  }
  divisor_ = std::pow(10.0, static_cast<double>(text.size() - point - 1));
  mantissa_ = std::round(step * divisor_);
}

double DecimalMultiples::operator()(std::size_t count) const {
  const auto multiple = static_cast<double>(count);
  return divisor_ > 0.0 ? multiple * mantissa_ / divisor_ : multiple * step_;
}

std::size_t count_of_samples(double end, double every) {
  constexpr double rounding = 1e-9;
  constexpr double most = 9e18;  // of a std::size_t
  return static_cast<std::size_t>(std::min(std::floor(end / every + rounding), most)) + 1;
}

}  // namespace gearlash
