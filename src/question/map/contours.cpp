#include "question/map/contours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/lists.hpp"
#include "base/special_numbers.hpp"
#include "question/analyse.hpp"
#include "question/family/evaluation.hpp"
#include "question/map/hunting_boundary.hpp"

namespace gearlash {
namespace {

/// The cell's first point on an axis, and the fraction of the way to the next point.
struct CellPlace {
  std::size_t first;
  double share;
};

CellPlace cell_of(const Axis& axis, double value) {
  const std::size_t first = interval_of(axis, value);
  const double from = position_on(axis, axis.values[first]);
  const double to = position_on(axis, axis.values[first + 1]);
  return {first, std::clamp((position_on(axis, value) - from) / (to - from), 0.0, 1.0)};
}

/// Interpolates between the four points around a place; NaN where one of them has no value.
double interpolated(const Grid& grid, const std::vector<double>& values, const MapPoint& point) {
  const Axis& x_axis = grid.axes[1];
  const CellPlace y = cell_of(grid.axes[0], point.y);
  const CellPlace x = cell_of(x_axis, point.x);
  double sum = 0.0;
  for (const std::size_t up : {0U, 1U}) {
    for (const std::size_t along : {0U, 1U}) {
      const double weight =
          (up == 1 ? y.share : 1.0 - y.share) * (along == 1 ? x.share : 1.0 - x.share);
      if (weight == 0.0) continue;
      sum += weight * values[(y.first + up) * x_axis.values.size() + x.first + along];
    }
  }
  return sum;
}

double limit_beside(const NormalizedServo& servo, Quantity quantity) {
  return limit_where_hunting_ends(quantity, servo.backlash).value_or(not_a_number);
}

/// The quantity of a row, or with plastic contact its limit if the servo does not hunt.
double known_or_limit(const Family& family, const Table& table, std::size_t row, Quantity quantity,
                      const MapPoint& place) {
  const double value = motion_value(table, quantity, row);
  const bool has_limit = std::isnan(value) && table.verdict(row) == Verdict::cannot_hunt;
  return has_limit ? limit_beside(servo_at(family, place).value(), quantity) : value;
}

double worked_out(const Family& family, Quantity quantity, const MapPoint& place) {
  return known_or_limit(family, answer_at(family, std::array{place.y, place.x}, quantity), 0,
                        quantity, place);
}

Side side_of(double value, double level) {
  if (std::isnan(value)) return Side::unknown;
  return value > level ? Side::inside : Side::outside;
}

constexpr std::array coarse_digits = {1.0, 2.0, 5.0};
constexpr std::array fine_digits = {1.0, 1.5, 2.0, 3.0, 5.0, 7.0};

constexpr double of_rounding = 1e-9;

std::vector<double> even_levels(double low, double high) {
  constexpr double most = 10.0;
  const double step = round_number_from((high - low) / most, coarse_digits, of_rounding);
  std::vector<double> levels;
  for (double i = std::ceil(low / step); i * step <= high; i += 1.0) levels.push_back(i * step);
  return levels;
}

std::vector<double> levels_by_factors(double low, double high, std::span<const double> digits) {
  constexpr double more = 1.0 + 1e-6;
  std::vector<double> levels;
  for (double level = round_number_from(low, digits, of_rounding); level <= high;
       level = round_number_from(more * level, digits, of_rounding)) {
    levels.push_back(level);
  }
  return levels;
}

constexpr std::size_t most_levels = 12;

/// Every second, fourth, … level as needed.
std::vector<double> thinned_out(std::vector<double> levels) {
  while (levels.size() > most_levels) {
    std::vector<double> fewer;
    for (std::size_t i = 0; i < levels.size(); i += 2) fewer.push_back(levels[i]);
    levels = std::move(fewer);
  }
  return levels;
}

}  // namespace

std::vector<double> round_levels(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value) || !(value > 0.0); });
  if (values.empty()) return {};
  const auto quantile = [&](double share) {
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(
                                            share * static_cast<double>(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  const double low = quantile(0.02);
  const double high = quantile(0.98);
  if (!(low < high)) return {};
  if (high <= 12.0 * low) return even_levels(low, quantile(0.92));
  std::vector<double> fine = levels_by_factors(low, high, fine_digits);
  if (fine.size() <= most_levels) return fine;
  return thinned_out(levels_by_factors(low, high, coarse_digits));
}

std::vector<Contour> contours_of(const Grid& grid, const Table& table, Quantity quantity,
                                 const std::vector<double>& levels) {
  const Family family(grid);
  const bool plastic = !family.engines().bounces && !family.engines().search;
  const bool is_solved = plastic && !is_figure(quantity);
  const std::size_t width = grid.axes[1].values.size();
  std::vector<double> values(table.rows());
  for (std::size_t row = 0; row < values.size(); ++row) {
    const MapPoint place{grid.axes[1].values[row % width], grid.axes[0].values[row / width]};
    values[row] = plastic ? known_or_limit(family, table, row, quantity, place)
                          : motion_value(table, quantity, row);
  }
  std::vector<Contour> contours;
  for (const double level : levels) {
    const std::vector<Side> corners =
        of_each(values, [&](double value) { return side_of(value, level); });
    const auto side_at = [&](const MapPoint& place) {
      return side_of(
          is_solved ? worked_out(family, quantity, place) : interpolated(grid, values, place),
          level);
    };
    contours.push_back({level, boundary_of_region(grid.axes[1], grid.axes[0], corners, side_at,
                                                  picture_accuracy)});
  }
  return contours;
}

}  // namespace gearlash
