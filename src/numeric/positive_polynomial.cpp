#include "numeric/positive_polynomial.hpp"

#include <algorithm>
#include <cmath>

#include "base/lists.hpp"
#include "base/number.hpp"

namespace gearlash {
namespace {

constexpr int deepest = 40;

/// Whether the polynomial with these Bernstein coefficients is positive from 0 to 1.
bool is_positive_between(const std::vector<Interval>& coefficients, int depth) {
  if (!(coefficients.front().low > 0.0 && coefficients.back().low > 0.0)) return false;
  const bool is_shown =
      all_of(coefficients, [](const Interval& number) { return number.low > 0.0; });
  if (is_shown) return true;
  if (depth == deepest) return false;
  // De Casteljau's rule, in halves.
  const std::size_t count = coefficients.size();
  std::vector<Interval> left;
  std::vector<Interval> right(count);
  std::vector<Interval> row = coefficients;
  for (std::size_t i = 0; i < count; ++i) {
    left.push_back(row.front());
    right[count - 1 - i] = row.back();
    for (std::size_t k = 0; k + 1 < row.size(); ++k) row[k] = 0.5 * (row[k] + row[k + 1]);
    row.pop_back();
  }
  return is_positive_between(left, depth + 1) && is_positive_between(right, depth + 1);
}

}  // namespace

IntervalPolynomial sum(const IntervalPolynomial& a, const IntervalPolynomial& b) {
  IntervalPolynomial result(std::max(a.size(), b.size()), Interval(0.0));
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i];
  for (std::size_t i = 0; i < b.size(); ++i) result[i] = result[i] + b[i];
  return result;
}

IntervalPolynomial product(const IntervalPolynomial& a, const IntervalPolynomial& b) {
  if (a.empty() || b.empty()) return {};
  IntervalPolynomial result(a.size() + b.size() - 1, Interval(0.0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) result[i + k] = result[i + k] + a[i] * b[k];
  }
  return result;
}

IntervalPolynomial real_part(const IntervalPolynomial& polynomial) {
  IntervalPolynomial result;
  for (std::size_t i = 0; i < polynomial.size(); i += 2) {
    result.push_back(i % 4 == 0 ? polynomial[i] : -polynomial[i]);
  }
  return result;
}

bool is_positive(IntervalPolynomial polynomial) {
  const auto is_nothing = [](const Interval& number) { return is_exactly(number, 0.0); };
  while (!polynomial.empty() && is_nothing(polynomial.back())) polynomial.pop_back();
  const auto first = std::find_if_not(polynomial.begin(), polynomial.end(), is_nothing);
  polynomial.erase(polynomial.begin(), first);
  if (polynomial.empty()) return false;
  // Both ends alike.
  const auto degree = static_cast<double>(polynomial.size() - 1);
  const double ratio = middle(polynomial.front()) / middle(polynomial.back());
  if (!(ratio > 0.0)) return false;
  const double scale = degree > 0.0 ? std::exp2(std::round(std::log2(ratio) / degree)) : 1.0;
  Interval power = 1.0;
  Interval binomial = 1.0;
  std::vector<Interval> coefficients;
  for (std::size_t k = 0; k < polynomial.size(); ++k) {
    const auto number = static_cast<double>(k);
    coefficients.push_back(polynomial[k] * power / binomial);
    power = power * scale;
    binomial = binomial * (degree - number) / Interval(number + 1.0);
  }
  return is_positive_between(coefficients, 0);
}

}  // namespace gearlash
