#include "gearlash/hybrid/first_exit.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace gearlash::hybrid {
namespace {

/// As many as the steps of a simulation have without the heap. Not initialised.
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

constexpr std::size_t lanes = 4;

/// In four sums, of every fourth coefficient each, so that one need not wait for the other.
/// Precondition: a multiple of four coefficients.
double value_at(const Coefficients& coefficients, double x) {
  const double square = x * x;
  const double fourth = square * square;
  std::array<double, lanes> sums{};
  for (std::size_t k = coefficients.size(); k >= lanes; k -= lanes) {
    const double* here = coefficients.data() + k - lanes;
    for (std::size_t i = 0; i < lanes; ++i) sums[i] = sums[i] * fourth + here[i];
  }
  return (sums[0] + x * sums[1]) + square * (sums[2] + x * sums[3]);
}

Coefficients in_fours(std::span<const double> coefficients) {
  Coefficients padded((coefficients.size() + lanes - 1) / lanes * lanes);
  const auto end = std::copy(coefficients.begin(), coefficients.end(), padded.begin());
  std::fill(end, padded.end(), 0.0);
  return padded;
}

Coefficients derivative_of(const Coefficients& coefficients) {
  Coefficients result(coefficients.size());
  result[result.size() - 1] = 0.0;
  for (std::size_t k = 1; k < coefficients.size(); ++k) {
    result[k - 1] = static_cast<double>(k) * coefficients[k];
  }
  return result;
}

constexpr std::size_t table_degrees = 40;
using Reciprocals = std::array<std::array<double, table_degrees>, table_degrees>;

/// [n][i]: 1/C(n, i).
const Reciprocals& reciprocal_binomials() {
  static const Reciprocals table = [] {
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
  return table;
}

/// Bernstein's coefficients on [0, 1]: b_j = Σ_{i≤j} C(j, i)/C(n, i) a_i. By sums of neighbours:
/// the weights are between 0 and 1, so that no digits are lost.
Coefficients bernstein_of(std::span<const double> power) {
  const std::size_t count = power.size();
  Coefficients last_first(count);
  if (count <= table_degrees) {
    const auto& factors = reciprocal_binomials()[count - 1];
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

/// A stretch of [0, 1] and the polynomial's Bernstein coefficients there.
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
    if (const auto fall = single_fall(power)) return {*fall, std::nullopt};
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
        // Below −uncertainty somewhere in it, and no narrower place can be told.
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

  /// What is 0 from the touch on to the exit is one with it.
  FirstExit exit_at(double place) {
    found_.at = place;
    if (found_.touch && is_zero(0.5 * (*found_.touch + place))) found_.touch.reset();
    return found_;
  }

  bool is_zero(double place) const {
    return std::abs(value_at(power_, place)) <= 4.0 * uncertainty_;
  }

  bool never_negative(const Coefficients& coefficients) const {
    return std::all_of(coefficients.begin(), coefficients.end(),
                       [&](double c) { return c >= -uncertainty_; });
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
    // At the ends of the whole interval it is what comes before or after that touches.
    const auto index = static_cast<double>(lowest - stretch.coefficients.begin());
    const double share = index / static_cast<double>(stretch.coefficients.size() - 1);
    const double place = stretch.low + share * (stretch.high - stretch.low);
    if (*lowest > uncertainty_ || place == 0.0 || place == 1.0) return;
    const double least = lowest_near(place);
    if (is_zero(least)) found_.touch = least;
  }

  /// The zero of p where its first terms q tell that there is one alone. The others are less than
  /// E altogether; where q falls from above E to below −E and, by Bernstein's coefficients, has one
  /// zero with either of them added, p's zeros are between those two. At one of them, x, with
  /// slope −D and |p″| ≤ M, p falls all the way from x − 4E/D to x + 4E/D where 4E M/D ≤ D/2, and
  /// is beyond ±2E there: it has no other.
  std::optional<double> single_fall(std::span<const double> power) const {
    constexpr std::size_t few = 12;
    if (power.size() < few + 4) return std::nullopt;
    double others = uncertainty_;
    for (std::size_t k = few; k < power_.size(); ++k) others += std::abs(power_[k]);
    const Stretch coarse{0.0, 1.0, bernstein_of(power.first(few))};
    const auto& values = coarse.coefficients;
    std::size_t positive = 0;
    while (positive < few && values[positive] > others) ++positive;
    if (positive == 0) return std::nullopt;
    for (std::size_t j = positive; j < few; ++j) {
      if (!(values[j] < -others)) return std::nullopt;
    }
    if (positive == few) return std::nullopt;
    const auto root = newtons_root(coarse);
    if (!root) return std::nullopt;
    double curvature = 0.0;
    for (std::size_t k = 2; k < power_.size(); ++k) {
      curvature += static_cast<double>(k * (k - 1)) * std::abs(power_[k]);
    }
    const double slope = value_at(derivative_of(power_), *root);
    return slope < 0.0 && 8.0 * others * curvature <= slope * slope ? root : std::nullopt;
  }

  /// Where p is least, by Newton's method on p′; the place itself where that leads away.
  double lowest_near(double place) const {
    const Coefficients slope = derivative_of(power_);
    const Coefficients curvature = derivative_of(slope);
    double x = place;
    for (int i = 0; i < 5; ++i) x -= value_at(slope, x) / value_at(curvature, x);
    constexpr double near = 1e-3;
    return x > 0.0 && x < 1.0 && std::abs(x - place) < near ? x : place;
  }

  /// On a stretch on which p falls once.
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

  /// Nothing where a step leaves the stretch, or is not much shorter than the one before.
  std::optional<double> newtons_root(const Stretch& stretch) const {
    constexpr int most = 8;
    const Coefficients derivative = derivative_of(power_);
    double x = where_polygon_falls(stretch);
    double last = stretch.high - stretch.low;
    for (int i = 0; i < most; ++i) {
      const double step = -value_at(power_, x) / value_at(derivative, x);
      const double size = std::abs(step);
      x += step;
      if (!(x >= stretch.low && x <= stretch.high) || !(size <= 0.5 * last)) return std::nullopt;
      // What is left is some C size², of which the step before has told C.
      const double curved = std::max(16.0, size / (last * last));
      if (curved * size * size <= 0.25 * std::numeric_limits<double>::epsilon() * x) return x;
      last = size;
    }
    return std::nullopt;
  }

  /// Bernstein's coefficients as a polygon that p is near.
  static double where_polygon_falls(const Stretch& stretch) {
    const Coefficients& values = stretch.coefficients;
    const auto negative =
        std::find_if(values.begin(), values.end(), [](double value) { return value < 0.0; });
    if (negative == values.begin() || negative == values.end()) return stretch.low;
    const double before = *(negative - 1);
    const double place =
        static_cast<double>(negative - 1 - values.begin()) + before / (before - *negative);
    return stretch.low +
           (stretch.high - stretch.low) * place / static_cast<double>(values.size() - 1);
  }

  Coefficients power_;
  double uncertainty_;
  FirstExit found_;
};

}  // namespace

bool stays_positive(std::span<const double> coefficients, double uncertainty) {
  double lowest = coefficients.empty() ? 0.0 : coefficients[0];
  for (std::size_t k = 1; k < coefficients.size(); ++k) lowest += std::min(0.0, coefficients[k]);
  if (lowest > uncertainty) return true;
  const Coefficients values = bernstein_of(coefficients);
  return std::all_of(values.begin(), values.end(),
                     [uncertainty](double value) { return value > uncertainty; });
}

FirstExit first_exit(std::span<const double> coefficients, double uncertainty) {
  double lowest = coefficients.empty() ? 0.0 : coefficients[0];
  for (std::size_t k = 1; k < coefficients.size(); ++k) lowest += std::min(0.0, coefficients[k]);
  if (lowest > uncertainty) return {};
  // The last terms are often far below what is known: without them zeros are isolated.
  constexpr double negligible = 0x1p-6;
  double neglected = 0.0;
  std::size_t count = coefficients.size();
  while (count > 1) {
    const double more = neglected + std::abs(coefficients[count - 1]);
    if (more > negligible * uncertainty) break;
    neglected = more;
    --count;
  }
  return Search(coefficients, uncertainty + neglected).run(coefficients.first(count));
}

}  // namespace gearlash::hybrid
