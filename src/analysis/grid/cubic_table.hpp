// Cubic interpolation in a table over one or more axes.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "analysis/grid/axis.hpp"

namespace gearlash {

/// The cubic through four neighboring values of an axis, at one place: Σ weights[k] f[first + k].
struct CubicPlace {
  std::size_t interval;  ///< the place lies between value number `interval` and the next
  std::size_t first;     ///< the first of the four values
  std::array<double, 4> weights;
};

/// Lagrange's cubic in s, which is the parameter's value or, on a logarithmic axis, its logarithm:
///   weights[k] = Π_{j≠k} (s − s_j)/(s_k − s_j),
/// with two values on either side of the place, or the four at an end of the axis. The interval is
/// computed directly where the values are evenly spaced in s, else found by bisection.
class CubicAxis {
 public:
  static constexpr std::size_t fewest_values = 4;

  /// Precondition: rising; fewest_values or more, finite, positive where logarithmic.
  explicit CubicAxis(const Axis& axis);

  std::size_t intervals() const { return intervals_.size(); }

  /// Whether the value lies between the ends of the axis, including them; false for NaN.
  bool contains(double value) const { return value >= lowest_ && value <= highest_; }

  /// Precondition: contains(value).
  CubicPlace at(double value) const;
  /// The cubic of that interval, whether or not the value lies in it.
  CubicPlace at(double value, std::size_t interval) const;

 private:
  struct Interval {
    std::array<double, 4> places;         ///< s_k
    std::array<double, 4> inverse_spans;  ///< 1/Π_{j≠k} (s_k − s_j)
  };

  double place_of(double value) const;
  std::size_t interval_of(double place) const;
  CubicPlace weighted(double place, std::size_t interval) const;

  bool logarithmic_;
  bool even_;
  double lowest_;
  double highest_;
  double intervals_a_place_;  ///< for even spacing
  std::vector<double> places_;
  std::vector<Interval> intervals_;
};

/// The tensor product of the axes' cubics: 4ⁿ values for n axes.
class CubicTable {
 public:
  static constexpr std::size_t most_axes = 5;

  CubicTable() = default;
  /// Precondition: 1 to most_axes axes as CubicAxis requires them; one value for each combination,
  /// the last axis fastest.
  CubicTable(const std::vector<Axis>& axes, std::vector<double> values);

  const std::vector<CubicAxis>& axes() const { return axes_; }

  /// NaN where one of the 4ⁿ values is NaN. Precondition: one place for each axis.
  double at(std::span<const CubicPlace> places) const;

 private:
  std::vector<CubicAxis> axes_;
  std::array<std::size_t, most_axes> strides_ = {};
  std::vector<double> values_;
};

}  // namespace gearlash
