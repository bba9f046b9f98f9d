#include "hybrid/first_exit.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/lists.hpp"

namespace gearlash::hybrid {
namespace {

/// Not initialised. The steps of a simulation have few enough to need no heap.
class Coefficients {
 public:
  explicit Coefficients(std::size_t size) : size_(size) {
    if (size > few_.size()) many_.resize(size);
  }
  std::size_t size() const { return size_; }
  double* data() { return many_.empty() ? few_.data() : many_.data(); }
  const double* data() const { return many_.empty() ? few_.data() : many_.data(); }
  double* begin() { return data(); }
  double* end() { return data() + size_; }
  const double* begin() const { return data(); }
  const double* end() const { return data() + size_; }
  double& operator[](std::size_t i) { return data()[i]; }
  double operator[](std::size_t i) const { return data()[i]; }

 private:
  std::size_t size_;
  std::array<double, 36> few_;
  std::vector<double> many_;
};

constexpr std::size_t sums_at_once = 4;

/// Four independent sums of every fourth coefficient each, which the processor can overlap.
/// Precondition: a multiple of four coefficients.
double value_at(std::span<const double> coefficients, double x) {
  const double square = x * x;
  const double fourth = square * square;
  std::array<double, sums_at_once> sums{};
  for (std::size_t k = coefficients.size(); k >= sums_at_once; k -= sums_at_once) {
    const double* here = coefficients.data() + k - sums_at_once;
    for (std::size_t i = 0; i < sums_at_once; ++i) sums[i] = sums[i] * fourth + here[i];
  }
  return (sums[0] + x * sums[1]) + square * (sums[2] + x * sums[3]);
}

Coefficients in_fours(std::span<const double> coefficients) {
  Coefficients padded((coefficients.size() + sums_at_once - 1) / sums_at_once * sums_at_once);
  const auto end = std::copy(coefficients.begin(), coefficients.end(), padded.begin());
  std::fill(end, padded.end(), 0.0);
  return padded;
}

/// The same number of coefficients, the last one 0.
template <class Values>
Values derivative_of(const Values& coefficients) {
  Values result(coefficients);
  const std::size_t last = coefficients.size() - 1;
  for (std::size_t k = 0; k < last; ++k) {
    result[k] = static_cast<double>(k + 1) * coefficients[k + 1];
  }
  result[last] = 0.0;
  return result;
}

constexpr std::size_t table_degrees = 40;
using Reciprocals = std::array<std::array<double, table_degrees>, table_degrees>;

/// [n][i]: 1/C(n, i).
constexpr Reciprocals reciprocal_binomials = [] {
  Reciprocals all{};
  for (std::size_t n = 0; n < table_degrees; ++n) {
    double binomial = 1.0;
    for (std::size_t i = 0; i <= n; ++i) {
      all[n][i] = 1.0 / binomial;
      binomial *= static_cast<double>(n - i) / static_cast<double>(i + 1);
    }
  }
  return all;
}();

/// Bernstein's coefficients on [0, 1]: b_j = Σ_{i≤j} C(j, i)/C(n, i) a_i. Sums of neighbours lose
/// no digits: the weights are between 0 and 1.
Coefficients bernstein_of(std::span<const double> power) {
  const std::size_t count = power.size();
  Coefficients last_first(count);
  if (count <= table_degrees) {
    const auto& factors = reciprocal_binomials[count - 1];
    for (std::size_t i = 0; i < count; ++i) last_first[count - 1 - i] = power[i] * factors[i];
  } else {
    double binomial = 1.0;
    for (std::size_t i = 0; i < count; ++i) {
      last_first[count - 1 - i] = power[i] / binomial;
      binomial *= static_cast<double>(count - 1 - i) / static_cast<double>(i + 1);
    }
  }
  double* sums = last_first.data();
  for (std::size_t level = 1; level < count; ++level) {
    for (std::size_t j = 0; j < count - level; ++j) sums[j] += sums[j + 1];
  }
  std::reverse(last_first.begin(), last_first.end());
  return last_first;
}

/// [i][j]: C(j, i)/C(n, i) for n = most_leading − 1.
constexpr auto leading_weights = [] {
  std::array<std::array<double, most_leading>, most_leading> weights{};
  for (std::size_t i = 0; i < most_leading; ++i) {
    double binomial = 1.0;  // C(j, i)
    for (std::size_t j = i; j < most_leading; ++j) {
      weights[i][j] = binomial * reciprocal_binomials[most_leading - 1][i];
      binomial *= static_cast<double>(j + 1) / static_cast<double>(j + 1 - i);
    }
  }
  return weights;
}();

using Leading = std::array<double, most_leading>;

/// The same as products with a table, which the processor can overlap.
Leading bernstein_of(const Leading& power) {
  using Lanes = Eigen::Array<double, sums_at_once, 1>;
  static_assert(most_leading % sums_at_once == 0);
  Leading values;
  for (std::size_t first = 0; first < most_leading; first += sums_at_once) {
    Lanes sum = Lanes::Zero();
    for (std::size_t i = 0; i < first + sums_at_once; ++i) {
      sum += power[i] * Eigen::Map<const Lanes>(leading_weights[i].data() + first);
    }
    Eigen::Map<Lanes>(values.data() + first) = sum;
  }
  return values;
}

/// Where on [0, 1] the polygon of Bernstein's coefficients, an approximation of p, falls below 0.
template <class Values>
double where_polygon_falls(const Values& values) {
  const auto negative =
      std::find_if(values.begin(), values.end(), [](double value) { return value < 0.0; });
  if (negative == values.begin() || negative == values.end()) return 0.0;
  const double before = *(negative - 1);
  const double place =
      static_cast<double>(negative - 1 - values.begin()) + before / (before - *negative);
  return place / static_cast<double>(values.size() - 1);
}

/// A stretch of [0, 1] with the polynomial's Bernstein coefficients on it.
struct Stretch {
  double low;
  double high;
  Coefficients coefficients;
};

/// By de Casteljau's scheme; the stretch becomes its left half.
Stretch split_off_right_half(Stretch& stretch) {
  Coefficients& left = stretch.coefficients;
  const std::size_t count = left.size();
  Coefficients right(count);
  for (std::size_t level = 0; level < count; ++level) {
    right[count - 1 - level] = left[count - 1];
    for (std::size_t j = count - 1; j > level; --j) left[j] = 0.5 * (left[j] + left[j - 1]);
  }
  const double middle = 0.5 * (stretch.low + stretch.high);
  Stretch half{middle, stretch.high, std::move(right)};
  stretch.high = middle;
  return half;
}

class Search {
 public:
  Search(std::span<const double> power, double uncertainty)
      : power_(in_fours(power)), uncertainty_(uncertainty) {}

  FirstExit run(std::span<const double> power) {
    Stretch whole{0.0, 1.0, bernstein_of(power)};
    if (never_negative(whole.coefficients)) {
      note_touch(whole);
      return found_;
    }
    if (falls_once(whole.coefficients)) return exit_at(root_within(whole));
    std::vector<Stretch> open;  // the leftmost last
    open.push_back(std::move(whole));
    while (!open.empty()) {
      Stretch& stretch = open.back();
      if (never_negative(stretch.coefficients)) {
        note_touch(stretch);
        open.pop_back();
      } else if (falls_once(stretch.coefficients)) {
        return exit_at(root_within(stretch));
      } else if (stretch.high - stretch.low <= narrow) {
        // p is below −uncertainty somewhere in this stretch, and no narrower one can be resolved.
        return exit_at(stretch.low);
      } else {
        Stretch right = split_off_right_half(stretch);
        std::swap(stretch, right);
        open.push_back(std::move(right));
      }
    }
    return found_;
  }

 private:
  static constexpr double narrow = 0x1p-50;

  /// A touch from which p stays 0 up to the exit is part of the exit.
  FirstExit exit_at(double place) {
    found_.at = place;
    if (found_.touch && is_zero(0.5 * (*found_.touch + place))) found_.touch.reset();
    return found_;
  }

  bool is_zero(double place) const {
    return std::abs(value_at(power_, place)) <= 4.0 * uncertainty_;
  }

  bool never_negative(const Coefficients& coefficients) const {
    return all_of(coefficients, [&](double c) { return c >= -uncertainty_; });
  }

  /// Positive, then negative: one zero and no more.
  bool falls_once(const Coefficients& coefficients) const {
    const auto first_negative =
        std::find_if(coefficients.begin(), coefficients.end(), [](double c) { return c < 0.0; });
    return std::none_of(first_negative, coefficients.end(), [](double c) { return c > 0.0; });
  }

  void note_touch(const Stretch& stretch) {
    if (found_.touch) return;
    const auto lowest = std::min_element(stretch.coefficients.begin(), stretch.coefficients.end());
    const auto index = static_cast<double>(lowest - stretch.coefficients.begin());
    const double share = index / static_cast<double>(stretch.coefficients.size() - 1);
    const double place = stretch.low + share * (stretch.high - stretch.low);
    if (*lowest > uncertainty_) return;
    // At an end of the whole interval the neighbouring step decides whether p touches.
    if (place > 0.0 && place < 1.0) {
      const double least = lowest_near(place);
      if (is_zero(least)) found_.touch = least;
    }
    const bool ends_at_zero = stretch.high == 1.0 && stretch.coefficients.end()[-1] <= uncertainty_;
    if (!found_.touch && ends_at_zero) found_.touch = 1.0;
  }

  /// Minimum of p by Newton's method on p′, or `place` itself if that leads away.
  double lowest_near(double place) const {
    const Coefficients slope = derivative_of(power_);
    const Coefficients curvature = derivative_of(slope);
    double x = place;
    for (int i = 0; i < 5; ++i) x -= value_at(slope, x) / value_at(curvature, x);
    constexpr double near = 1e-3;
    return x > 0.0 && x < 1.0 && std::abs(x - place) < near ? x : place;
  }

  /// Precondition: p falls once on the stretch.
  double root_within(const Stretch& stretch) const {
    if (const auto root = newtons_root(stretch)) return *root;
    const auto [low, high, bernstein] = stretch;
    const auto value = [&](double x) { return value_at(power_, x); };
    const double at_low = value(low);
    const double at_high = value(high);
    if (!(at_low > 0.0)) return low;
    if (!(at_high < 0.0)) return high;
    std::uintmax_t most = 200;
    const auto is_close = [](double a, double b) {
      return b - a <= std::numeric_limits<double>::epsilon() * b;
    };
    const auto [below, above] =
        boost::math::tools::toms748_solve(value, low, high, at_low, at_high, is_close, most);
    return 0.5 * (below + above);
  }

  /// Empty if a step leaves the stretch, or is not much shorter than the one before.
  std::optional<double> newtons_root(const Stretch& stretch) const {
    constexpr int most = 8;
    const Coefficients derivative = derivative_of(power_);
    double last = stretch.high - stretch.low;
    double x = stretch.low + last * where_polygon_falls(stretch.coefficients);
    for (int i = 0; i < most; ++i) {
      const double step = -value_at(power_, x) / value_at(derivative, x);
      const double size = std::abs(step);
      x += step;
      if (!(x >= stretch.low && x <= stretch.high) || !(size <= 0.5 * last)) return std::nullopt;
      // The remaining error is about C size². The size over the square of the last one estimates C.
      const double curved = std::max(16.0, size / (last * last));
      if (curved * size * size <= 0.25 * std::numeric_limits<double>::epsilon() * x) return x;
      last = size;
    }
    return std::nullopt;
  }

  Coefficients power_;
  double uncertainty_;
  FirstExit found_;
};

}  // namespace

namespace {

/// Lower bound of p on [0, 1]: the least partial sum S_k = Σ_{i≤k} a_i, because p is a mean of
/// them, Σ_{k<n} S_k (τᵏ − τᵏ⁺¹) + S_n τⁿ.
double lower_bound(std::span<const double> coefficients) {
  double sum = coefficients.empty() ? 0.0 : coefficients[0];
  double lowest = sum;
  for (std::size_t k = 1; k < coefficients.size(); ++k) {
    sum += coefficients[k];
    lowest = std::min(lowest, sum);
  }
  return lowest;
}

}  // namespace

std::optional<RoughExit> rough_exit(std::span<const double> leading, double rest, int last) {
  if (lower_bound(leading) > rest) return RoughExit{};
  Leading power{};
  std::copy(leading.begin(), leading.end(), power.begin());
  const Leading bernstein = bernstein_of(power);
  const auto fall = std::find_if_not(bernstein.begin(), bernstein.end(),
                                     [rest](double value) { return value > rest; });
  if (fall == bernstein.end()) return RoughExit{};
  const bool falls_once =
      std::all_of(fall, bernstein.end(), [rest](double value) { return value < -rest; });
  if (fall == bernstein.begin() || !falls_once) return std::nullopt;
  double curvature = rest * last * (last - 1);
  for (std::size_t k = 2; k < most_leading; ++k) {
    curvature += static_cast<double>(k * (k - 1)) * std::abs(power[k]);
  }
  const auto derivative = derivative_of(power);
  double x = where_polygon_falls(bernstein);
  constexpr int most = 6;
  for (int i = 0; i < most; ++i) {
    const double value = value_at(power, x);
    const double slope = value_at(derivative, x);
    if (std::abs(value) <= rest) {
      const double steep = -slope - rest * last;
      if (!(steep > 0.0) || !(16.0 * rest * curvature <= steep * steep)) return std::nullopt;
      return RoughExit{x, 8.0 * rest / steep};
    }
    x -= value / slope;
    if (!(x > 0.0 && x < 1.0)) return std::nullopt;
  }
  return std::nullopt;
}

FirstExit first_exit(std::span<const double> coefficients, double uncertainty) {
  if (lower_bound(coefficients) > uncertainty) return {};
  // The last terms are often far below the uncertainty. Isolating zeros is cheaper without them.
  double neglected = 0.0;
  std::size_t count = coefficients.size();
  while (count > 1) {
    const double more = neglected + std::abs(coefficients[count - 1]);
    if (more > negligible_share * uncertainty) break;
    neglected = more;
    --count;
  }
  return Search(coefficients, uncertainty + neglected).run(coefficients.first(count));
}

}  // namespace gearlash::hybrid
