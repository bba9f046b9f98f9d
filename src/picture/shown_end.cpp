#include "picture/shown_end.hpp"

#include <algorithm>

namespace gearlash {
namespace {

constexpr double third = 2.0 / 3.0;  // of the time, after which the last third begins
constexpr double periods_shown = 3.0;

void include(const Extent& other, Extent& extent) {
  extent.include(other.low);
  extent.include(other.high);
}

/// The mean time from one passing of the middle upwards to the next, counted only after the lower
/// part of the swing was reached. 0 with less than two passings.
double measured_period(const std::vector<DrawnPiece>& pieces, double from, const Extent& swing,
                       double DrawnPoint::*shaft) {
  constexpr double share = 0.15;
  bool was_low = false;
  int passings = 0;
  double first = 0.0;
  double last = 0.0;
  const auto pass = [&](const DrawnPoint& point) {
    const double error = point.*shaft - point.reference;
    if (error < swing.middle() - share * swing.width()) was_low = true;
    if (!was_low || error < swing.middle() + share * swing.width()) return;
    was_low = false;
    if (passings++ == 0) first = point.time;
    last = point.time;
  };
  for_each_point(pieces, pass, from);
  return passings > 1 ? (last - first) / (passings - 1) : 0.0;
}

}  // namespace

Bounds ShownEnd::shown_errors() const {
  constexpr double far = 2.0;  // widths
  Extent both = load;
  include(motor, both);
  const double away = std::max({both.low, -both.high, 0.0});
  if (away <= far * both.width()) both.include(0.0);
  return both;
}

ShownEnd end_of(const std::vector<DrawnPiece>& pieces, double end_time, double period) {
  ShownEnd end;
  const double last_third = third * end_time;
  const auto include_in_third = [&](const DrawnPoint& point) {
    end.load_third.include(point.load_position - point.reference);
    end.motor_third.include(point.motor_position - point.reference);
  };
  for_each_point(pieces, include_in_third, last_third);
  const bool load_swings_more = end.load_third.width() >= end.motor_third.width();
  end.period = period > 0.0 ? period
                            : measured_period(pieces, last_third,
                                              load_swings_more ? end.load_third : end.motor_third,
                                              load_swings_more ? &DrawnPoint::load_position
                                                               : &DrawnPoint::motor_position);
  end.from =
      end.period > 0.0 ? std::max(last_third, end_time - periods_shown * end.period) : last_third;
  bool is_first = true;
  const auto include_in_end = [&](const DrawnPoint& point) {
    end.load.include(point.load_position - point.reference);
    end.motor.include(point.motor_position - point.reference);
    if (is_first) end.reference = point.reference;
    if (end.reference && *end.reference != point.reference) end.reference.reset();
    is_first = false;
  };
  for_each_point(pieces, include_in_end, end.from);
  return end;
}

bool is_worth_enlarging(const ShownEnd& end, const Extent& positions, double gap, double end_time) {
  constexpr double small = 0.2;     // of all positions
  constexpr double nothing = 0.01;  // of the gap
  constexpr double fast = 0.05;     // a period, of the time
  const Bounds shown = end.shown_errors();
  const double height = shown.high - shown.low;
  if (!(height > nothing * gap)) return false;
  const double swing = std::max(end.load.width(), end.motor.width());
  const bool is_fast = end.period > 0.0 && end.period < fast * end_time && swing > nothing * gap;
  return height < small * positions.width() || is_fast;
}

}  // namespace gearlash
