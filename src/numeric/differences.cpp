#include "numeric/differences.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/lists.hpp"
#include "base/special_numbers.hpp"

namespace gearlash {
namespace {

constexpr double exact = 1e-12;
constexpr double acceptable = 1e-6;

/// Estimates of steps that are halved, whose error is a series of powers of the step: Neville's
/// table, of which the last row is kept. The best of a row counts as much as that of the row before
/// agrees with it: that of one row may agree with its neighbours by chance. An estimate that is NaN
/// begins the table anew.
class Extrapolation {
 public:
  /// The first power, and how far the powers lie apart.
  Extrapolation(double first, double apart) : first_(first), apart_(apart) {
    last_.fill(not_a_number);
  }

  void add(double estimate) {
    std::array<double, columns> row;
    row.fill(not_a_number);
    row[0] = estimate;
    Difference here{not_a_number, infinity};
    for (std::size_t j = 1; j < columns; ++j) {
      const double power = first_ + apart_ * static_cast<double>(j - 1);
      row[j] = row[j - 1] + (row[j - 1] - last_[j - 1]) / (std::exp2(power) - 1.0);
      const double error = std::max(std::abs(row[j] - row[j - 1]), std::abs(row[j] - last_[j - 1]));
      if (error < here.error) here = {row[j], error};
    }
    ++rows_since_best_;
    const double moved = std::abs(here.slope - best_of_last_.slope);
    const double error = std::max({moved, here.error, best_of_last_.error});
    if (error < best_.error) {
      best_ = {here.slope, error};
      rows_since_best_ = 0;
    }
    last_ = row;
    best_of_last_ = here;
  }

  const Difference& best() const { return best_; }
  bool exists() const { return std::isfinite(best_.error); }
  int rows_since_best() const { return rows_since_best_; }

 private:
  static constexpr std::size_t columns = 8;
  double first_, apart_;
  std::array<double, columns> last_;
  Difference best_of_last_{not_a_number, infinity};
  Difference best_{not_a_number, infinity};
  int rows_since_best_ = 0;
};

/// The differences of one number.
class NumberDifferences {
 public:
  NumberDifferences(double present, double size_per_unit)
      : present_(std::isfinite(present) ? present : not_a_number), size_per_unit_(size_per_unit) {}

  void add(double below, double above, double step_down, double step_up) {
    if (std::isnan(present_)) return;
    const double up = (above - present_) / step_up;
    const double down = (present_ - below) / step_down;
    central_.add((above - below) / (step_up + step_down));
    jump_.add(up - down);
    upwards_.add(up);
    downwards_.add(down);
  }

  /// Of both sides where they exist, with half of what their slopes differ.
  Difference found() const {
    const Difference best = used().best();
    if (!central_.exists()) return best;
    return {best.slope, std::max(best.error, 0.5 * std::abs(jump_.best().slope))};
  }

  bool is_within(const Difference& found, double share) const {
    return found.error <= share * std::max(std::abs(found.slope), size_per_unit_);
  }

  bool is_settled() const {
    constexpr int rows = 3;
    const Difference now = found();
    return std::isnan(present_) || is_within(now, exact) ||
           (is_within(now, acceptable) && used().rows_since_best() >= rows);
  }

 private:
  const Extrapolation& used() const {
    if (central_.exists()) return central_;
    return upwards_.exists() ? upwards_ : downwards_;
  }

  double present_, size_per_unit_;
  Extrapolation central_{2.0, 2.0};
  Extrapolation jump_{1.0, 2.0};
  Extrapolation upwards_{1.0, 1.0};
  Extrapolation downwards_{1.0, 1.0};
};

}  // namespace

std::vector<Difference> differences(const NumbersAt& numbers, double present,
                                    const DifferenceSteps& steps) {
  const std::vector<double> here = numbers(present);
  std::vector<NumberDifferences> all;
  for (std::size_t i = 0; i < here.size(); ++i) {
    const double size = steps.sizes.empty() ? std::abs(here[i]) : steps.sizes[i];
    all.emplace_back(here[i], size / steps.unit);
  }
  const auto are_settled = [&] {
    return all_of(all, [](const auto& one) { return one.is_settled(); });
  };
  double step = steps.first * steps.unit;
  for (int i = 0; i <= steps.halvings && !are_settled(); ++i, step *= 0.5) {
    const double high = present + step;
    const double low = present - step;
    std::vector<double> above = numbers(high);
    std::vector<double> below = numbers(low);
    above.resize(here.size(), not_a_number);
    below.resize(here.size(), not_a_number);
    for (std::size_t k = 0; k < all.size(); ++k) {
      all[k].add(below[k], above[k], present - low, high - present);
    }
  }
  return of_each(all, [](const NumberDifferences& one) {
    const Difference difference = one.found();
    return one.is_within(difference, acceptable) ? difference : Difference{not_a_number, infinity};
  });
}

}  // namespace gearlash
