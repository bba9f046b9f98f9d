#include "analysis/grid/contours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "analysis/grid/hunting_boundary.hpp"

namespace gearlash {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// For a picture: 2⁻²⁴ of the plane.
constexpr CurveAccuracy picture_accuracy{
    .halvings = 24, .straightness = 3e-4, .shortest_chord = 4e-3};

/// The cell's first point on an axis, and how far a value is on its way to the next.
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

/// Between the four points round a place; NaN where one of them has none.
double interpolated(const ServoGrid& grid, const std::vector<double>& values,
                    const MapPoint& point) {
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

double limit_beside(const NormalizedServo& servo, CycleQuantity quantity) {
  return limit_where_hunting_ends(quantity, servo.backlash).value_or(nothing);
}

/// The quantity of a servo with plastic contact, or its limit where it does not hunt.
double worked_out(const NormalizedServo& servo, CycleQuantity quantity) {
  if (!validate(servo).empty()) return nothing;
  CycleTable row(1);
  find_limit_cycles({&servo, 1}, row.columns());
  const double value = row[quantity][0];
  return std::isnan(value) && row.verdict[0] == Verdict::cannot_hunt ? limit_beside(servo, quantity)
                                                                     : value;
}

Side side_of(double value, double level) {
  if (std::isnan(value)) return Side::unknown;
  return value > level ? Side::inside : Side::outside;
}

constexpr std::array coarse_digits = {1.0, 2.0, 5.0};
constexpr std::array fine_digits = {1.0, 1.5, 2.0, 3.0, 5.0, 7.0};

/// One of the digits times a power of ten, the first that is not below `number`.
double round_number_from(double number, std::span<const double> digits) {
  const double power = std::pow(10.0, std::floor(std::log10(number) + 1e-9));
  for (const double digit : digits) {
    if (digit * power >= number * (1.0 - 1e-9)) return digit * power;
  }
  return 10.0 * power;
}

std::vector<double> even_levels(double low, double high) {
  constexpr double most = 10.0;
  const double step = round_number_from((high - low) / most, coarse_digits);
  std::vector<double> levels;
  for (double i = std::ceil(low / step); i * step <= high; i += 1.0) levels.push_back(i * step);
  return levels;
}

std::vector<double> levels_by_factors(double low, double high, std::span<const double> digits) {
  constexpr double more = 1.0 + 1e-6;
  std::vector<double> levels;
  for (double level = round_number_from(low, digits); level <= high;
       level = round_number_from(more * level, digits)) {
    levels.push_back(level);
  }
  return levels;
}

constexpr std::size_t most_levels = 12;

/// Every second, fourth, … of them if need be.
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
  const std::vector<double> fine = levels_by_factors(low, high, fine_digits);
  if (fine.size() <= most_levels) return fine;
  return thinned_out(levels_by_factors(low, high, coarse_digits));
}

std::vector<Contour> contours_of(const ServoGrid& grid, const CycleTable& cycles,
                                 CycleQuantity quantity, const std::vector<double>& levels) {
  const bool plastic = !grid.may_bounce();
  std::vector<double> values = cycles[quantity];
  for (std::size_t row = 0; plastic && row < values.size(); ++row) {
    if (std::isnan(values[row]) && cycles.verdict[row] == Verdict::cannot_hunt) {
      values[row] = limit_beside(grid.at(row), quantity);
    }
  }
  std::vector<Contour> contours;
  for (const double level : levels) {
    std::vector<Side> corners;
    corners.reserve(values.size());
    for (const double value : values) corners.push_back(side_of(value, level));
    const auto side_at = [&](const MapPoint& point) {
      return side_of(
          plastic ? worked_out(servo_at(grid, point), quantity) : interpolated(grid, values, point),
          level);
    };
    contours.push_back({level, boundary_of_region(grid.axes[1], grid.axes[0], corners, side_at,
                                                  picture_accuracy)});
  }
  return contours;
}

}  // namespace gearlash
