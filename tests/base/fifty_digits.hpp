// Fifty-digit references: exponentials of matrices, which is all that the motion is made of.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/special_numbers.hpp"

namespace gearlash {

using Wide = boost::multiprecision::cpp_bin_float_50;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// |actual − exact|/|exact| in epsilons of a double.
inline double epsilons_off(double actual, const Wide& exact) {
  if (Wide(actual) == exact) return 0.0;
  return static_cast<double>(abs((Wide(actual) - exact) / exact)) / epsilon;
}

/// |actual − exact| in units of epsilon × scale.
inline double epsilons_of(double actual, const Wide& exact, double scale) {
  if (Wide(actual) == exact) return 0.0;
  return static_cast<double>(abs(Wide(actual) - exact)) / (epsilon * scale);
}

template <std::size_t size>
using WideMatrix = std::array<std::array<Wide, size>, size>;

template <std::size_t size>
WideMatrix<size> product(const WideMatrix<size>& a, const WideMatrix<size>& b) {
  WideMatrix<size> result{};
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t k = 0; k < size; ++k) {
      if (a[i][k] == 0) continue;
      for (std::size_t j = 0; j < size; ++j) result[i][j] += a[i][k] * b[k][j];
    }
  }
  return result;
}

/// exp(A) by Taylor's series of A/2^s, ‖A/2^s‖ ≤ 1/4, squared s times. Twenty-six terms leave
/// 4^−27/27! < 1e-44; each squaring at most doubles the relative error, and s stays below 40, so
/// thirty digits are left at worst.
template <std::size_t size>
WideMatrix<size> exponential(WideMatrix<size> a) {
  Wide norm = 0;
  for (const auto& row : a) {
    Wide sum = 0;
    for (const Wide& entry : row) sum += abs(entry);
    if (sum > norm) norm = sum;
  }
  int squarings = 0;
  while (norm > 0.25) {
    norm /= 2;
    ++squarings;
  }
  const Wide shrink = ldexp(Wide(1), -squarings);
  for (auto& row : a) {
    for (Wide& entry : row) entry *= shrink;
  }
  WideMatrix<size> sum{};
  WideMatrix<size> term{};
  for (std::size_t i = 0; i < size; ++i) sum[i][i] = term[i][i] = 1;
  for (int k = 1; k <= 26; ++k) {
    term = product(term, a);
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j < size; ++j) {
        term[i][j] /= k;
        sum[i][j] += term[i][j];
      }
    }
  }
  for (int k = 0; k < squarings; ++k) sum = product(sum, sum);
  return sum;
}

}  // namespace gearlash
