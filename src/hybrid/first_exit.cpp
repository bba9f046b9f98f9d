#include "gearlash/hybrid/first_exit.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

namespace gearlash::hybrid {
namespace {

/// By Horner's scheme.
double value_at(const std::vector<double>& coefficients, double x) {
  double value = 0.0;
  for (std::size_t k = coefficients.size(); k-- > 0;) value = value * x + coefficients[k];
  return value;
}

/// Bernstein's coefficients on [0, 1]: b_j = Σ_{i≤j} C(j, i)/C(n, i) a_i. By sums of neighbours:
/// the weights are between 0 and 1, so that no digits are lost.
std::vector<double> bernstein_of(const std::vector<double>& power) {
  const std::size_t count = power.size();
  std::vector<double> result(count);
  double binomial = 1.0;  // C(n, i)
  for (std::size_t i = 0; i < count; ++i) {
    result[i] = power[i] / binomial;
    binomial *= static_cast<double>(count - 1 - i) / static_cast<double>(i + 1);
  }
  for (std::size_t level = 1; level < count; ++level) {
    for (std::size_t j = count - 1; j >= level; --j) result[j] += result[j - 1];
  }
  return result;
}

/// A stretch of [0, 1] and the polynomial's Bernstein coefficients there.
struct Stretch {
  double low;
  double high;
  std::vector<double> coefficients;
};

/// By de Casteljau's scheme; the stretch becomes its left half.
Stretch split_off_right_half(Stretch& stretch) {
  std::vector<double>& left = stretch.coefficients;
  const std::size_t count = left.size();
  std::vector<double> right(count);
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
  Search(const std::vector<double>& power, double uncertainty)
      : power_(power), uncertainty_(uncertainty) {}

  FirstExit run() {
    std::vector<Stretch> open;  // the leftmost last
    open.push_back({0.0, 1.0, bernstein_of(power_)});
    while (!open.empty()) {
      Stretch& stretch = open.back();
      if (never_negative(stretch.coefficients)) {
        note_touch(stretch);
        open.pop_back();
      } else if (falls_once(stretch.coefficients)) {
        return exit_at(root_within(stretch.low, stretch.high));
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

  bool never_negative(const std::vector<double>& coefficients) const {
    return std::all_of(coefficients.begin(), coefficients.end(),
                       [&](double c) { return c >= -uncertainty_; });
  }

  /// Positive, then negative: one zero and no more.
  bool falls_once(const std::vector<double>& coefficients) const {
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
    if (is_zero(place)) found_.touch = place;
  }

  double root_within(double low, double high) const {
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

  const std::vector<double>& power_;
  double uncertainty_;
  FirstExit found_;
};

}  // namespace

FirstExit first_exit(const std::vector<double>& coefficients, double uncertainty) {
  double lowest = coefficients.empty() ? 0.0 : coefficients[0];
  for (std::size_t k = 1; k < coefficients.size(); ++k) lowest += std::min(0.0, coefficients[k]);
  if (lowest > uncertainty) return {};
  return Search(coefficients, uncertainty).run();
}

}  // namespace gearlash::hybrid
