#include "analysis/grid/cubic_table.hpp"

#include <algorithm>
#include <cmath>

namespace gearlash {
namespace {

/// The first of the four values for an interval, kept within the axis.
std::size_t first_of_four(std::size_t interval, std::size_t values) {
  const std::size_t before = interval == 0 ? 0 : interval - 1;
  return std::min(before, values - 4);
}

double inverse_span(const std::array<double, 4>& places, std::size_t k) {
  double span = 1.0;
  for (std::size_t j = 0; j < places.size(); ++j) {
    if (j != k) span *= places[k] - places[j];
  }
  return 1.0 / span;
}

/// Even to within a tolerance: a place slightly outside its interval does no harm.
bool evenly_spaced(const std::vector<double>& places) {
  constexpr double tolerance = 1e-9;
  const double step = (places.back() - places.front()) / (static_cast<double>(places.size()) - 1.0);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double even = places.front() + static_cast<double>(i) * step;
    if (!(std::abs(places[i] - even) <= tolerance * step)) return false;
  }
  return true;
}

/// The sum over this axis and those after it; the last axis has stride 1.
template <std::size_t axes>
double cubic_sum(const double* first, const CubicPlace* place, const std::size_t* stride) {
  std::array<double, 4> terms;
  for (std::size_t k = 0; k < 4; ++k) {
    if constexpr (axes == 1) {
      terms[k] = place->weights[k] * first[k];
    } else {
      terms[k] =
          place->weights[k] * cubic_sum<axes - 1>(first + k * *stride, place + 1, stride + 1);
    }
  }
  return (terms[0] + terms[1]) + (terms[2] + terms[3]);
}

}  // namespace

CubicAxis::CubicAxis(const Axis& axis)
    : logarithmic_(axis.logarithmic), lowest_(axis.values.front()), highest_(axis.values.back()) {
  for (const double value : axis.values) places_.push_back(place_of(value));
  even_ = evenly_spaced(places_);
  const std::size_t count = places_.size() - 1;
  intervals_a_place_ = static_cast<double>(count) / (places_.back() - places_.front());
  for (std::size_t i = 0; i < count; ++i) {
    Interval& interval = intervals_.emplace_back();
    const std::size_t first = first_of_four(i, places_.size());
    for (std::size_t k = 0; k < 4; ++k) interval.places[k] = places_[first + k];
    for (std::size_t k = 0; k < 4; ++k) {
      interval.inverse_spans[k] = inverse_span(interval.places, k);
    }
  }
}

CubicPlace CubicAxis::at(double value) const {
  const double place = place_of(value);
  return weighted(place, interval_of(place));
}

CubicPlace CubicAxis::at(double value, std::size_t interval) const {
  return weighted(place_of(value), interval);
}

double CubicAxis::place_of(double value) const { return logarithmic_ ? std::log(value) : value; }

std::size_t CubicAxis::interval_of(double place) const {
  const std::size_t last = intervals_.size() - 1;
  if (even_) {
    const double found = (place - places_.front()) * intervals_a_place_;
    return std::min(static_cast<std::size_t>(std::max(found, 0.0)), last);
  }
  const auto above = std::upper_bound(places_.begin() + 1, places_.end() - 1, place);
  return static_cast<std::size_t>(above - places_.begin()) - 1;
}

CubicPlace CubicAxis::weighted(double place, std::size_t interval) const {
  const Interval& of = intervals_[interval];
  const double a = place - of.places[0];
  const double b = place - of.places[1];
  const double c = place - of.places[2];
  const double d = place - of.places[3];
  const double ab = a * b;
  const double cd = c * d;
  return {.interval = interval,
          .first = first_of_four(interval, places_.size()),
          .weights = {b * cd * of.inverse_spans[0], a * cd * of.inverse_spans[1],
                      ab * d * of.inverse_spans[2], ab * c * of.inverse_spans[3]}};
}

CubicTable::CubicTable(const std::vector<Axis>& axes, std::vector<double> values)
    : axes_(axes.begin(), axes.end()), values_(std::move(values)) {
  std::size_t stride = 1;
  for (std::size_t axis = axes.size(); axis-- > 0;) {
    strides_[axis] = stride;
    stride *= axes[axis].values.size();
  }
}

double CubicTable::at(std::span<const CubicPlace> places) const {
  const double* first = values_.data();
  for (std::size_t axis = 0; axis < places.size(); ++axis) {
    first += strides_[axis] * places[axis].first;
  }
  switch (places.size()) {
    case 1:
      return cubic_sum<1>(first, places.data(), strides_.data());
    case 2:
      return cubic_sum<2>(first, places.data(), strides_.data());
    case 3:
      return cubic_sum<3>(first, places.data(), strides_.data());
    case 4:
      return cubic_sum<4>(first, places.data(), strides_.data());
    default:
      return cubic_sum<5>(first, places.data(), strides_.data());
  }
}

}  // namespace gearlash
