#include "closed_form/cycle_bounds.hpp"

#include <cmath>

#include "base/arithmetic.hpp"
#include "base/decimal.hpp"
#include "base/special_numbers.hpp"
#include "closed_form/boxed_half_cycle.hpp"

namespace gearlash {
namespace {

Interval known(double value, double error) { return value * Interval(1.0 - error, 1.0 + error); }

Interval number(double value, Reading reading) {
  if (reading == Reading::converted && std::isfinite(value)) return known(value, DataError{}.each);
  if (reading == Reading::exact || std::isinf(value) || is_short_decimal(value)) return value;
  return {outward::below(value), outward::above(value)};
}

/// A drivetrain whose numbers are known to their data's errors.
struct KnownDrive {
  Interval motor_inertia, load_inertia, motor_friction, load_friction, stiffness, backlash;

  KnownDrive(const Drivetrain& drive, const DataError& error)
      : motor_inertia(known(drive.motor_inertia, error.each)),
        load_inertia(known(drive.load_inertia, error.each)),
        motor_friction(motor_friction_of(drive, error)),
        load_friction(known(drive.load_friction, error.each)),
        stiffness(known(drive.stiffness, error.each)),
        backlash(known(drive.backlash, error.each)) {}

  /// A 0 is exact, unless it hides something.
  static Interval motor_friction_of(const Drivetrain& drive, const DataError& error) {
    const Interval given = known(drive.motor_friction, error.motor_friction);
    if (error.hidden_motor_friction == 0.0) return given;
    return {given.low, outward::above(given.high + error.hidden_motor_friction)};
  }
  /// A shaft's friction over its inertia, and its share of the total inertia.
  static Interval rate(const Interval& friction, const Interval& inertia) {
    return inertia.high == 0.0 ? Interval(infinity) : friction / inertia;
  }
  static Interval share(const Interval& inertia, const Interval& other) {
    return inertia.high == 0.0 ? Interval(0.0) : 1.0 / (1.0 + other / inertia);
  }
};

}  // namespace

DriveBox box_between(const Drivetrain& low, const Drivetrain& high, const DataError& error) {
  const KnownDrive ends[] = {{low, error}, {high, error}};
  const auto sum_of_both = [&](auto quantity) {
    return hull(quantity(ends[0]), quantity(ends[1]));
  };
  using Drive = KnownDrive;
  const Interval inertia = sum_of_both([](const Drive& d) { return d.motor_inertia; }) +
                           sum_of_both([](const Drive& d) { return d.load_inertia; });
  const Interval stiffness = sum_of_both([](const Drive& d) { return d.stiffness; });
  const Interval friction =
      sum_of_both([](const Drive& d) { return d.motor_friction + d.load_friction; });
  const Interval motor_rate =
      sum_of_both([](const Drive& d) { return Drive::rate(d.motor_friction, d.motor_inertia); });
  const Interval load_rate =
      sum_of_both([](const Drive& d) { return Drive::rate(d.load_friction, d.load_inertia); });
  const Interval motor_share =
      sum_of_both([](const Drive& d) { return Drive::share(d.motor_inertia, d.load_inertia); });
  const Interval load_share =
      sum_of_both([](const Drive& d) { return Drive::share(d.load_inertia, d.motor_inertia); });
  const Interval time_unit = sqrt(inertia) / sqrt(stiffness);
  const auto of_time = [&](const Interval& rate) {
    return std::isinf(rate.low) ? rate : rate * time_unit;
  };
  return {.servo = {.damping = (friction / (2.0 * sqrt(inertia) * sqrt(stiffness))).bounds(),
                    .motor_inertia = motor_share.bounds(),
                    .load_inertia = load_share.bounds(),
                    .motor_rate = of_time(motor_rate).bounds(),
                    .load_rate = of_time(load_rate).bounds()},
          .time_unit = time_unit.bounds(),
          .backlash = sum_of_both([](const Drive& d) { return d.backlash; }).bounds()};
}

ServoBox box_of(const NormalizedServo& servo, Reading reading) {
  const Interval damping = number(servo.damping, reading);
  const Interval ratio = number(servo.inertia_ratio, reading);
  const Interval load_share = number(servo.friction_ratio, reading);
  const Interval motor_share = not_negative(1.0 - load_share);
  const bool massless_motor = std::isinf(servo.inertia_ratio);
  const bool massless_load = servo.inertia_ratio == 0.0;
  const Interval motor_inertia = massless_motor ? Interval(0.0) : 1.0 / (1.0 + ratio);
  const Interval load_inertia = massless_motor  ? Interval(1.0)
                                : massless_load ? Interval(0.0)
                                                : 1.0 / (1.0 + 1.0 / ratio);
  const Interval motor_rate =
      massless_motor ? Interval(infinity) : 2.0 * damping * motor_share * (1.0 + ratio);
  const Interval load_rate = massless_load    ? Interval(infinity)
                             : massless_motor ? 2.0 * damping * load_share
                                              : 2.0 * damping * load_share * (1.0 + 1.0 / ratio);
  return {.damping = damping.bounds(),
          .motor_inertia = motor_inertia.bounds(),
          .load_inertia = load_inertia.bounds(),
          .motor_rate = motor_rate.bounds(),
          .load_rate = load_rate.bounds()};
}

CycleBounds bound_cycles(const ServoBox& box, double guessed_flight_time,
                         MultiplierBounds multiplier) {
  CycleBounds bounds;
  if (!proves()) return bounds;
  const detail::BoxedHalfCycle half(box);
  bounds.growth_at_rest = half.growth_at_rest().bounds();
  if (bounds.none_hunt() || !(guessed_flight_time > 0.0)) return bounds;
  if (!(half.form_at_parting().low > 0.0)) return bounds;
  const detail::FlightTimes times =
      detail::bounding_flight_times(half, guessed_flight_time, bounds.all_hunt());
  const Interval time{times.shortest, times.longest};
  const detail::BoxedEnd end = half.end(time);
  bounds.period = not_negative(2.0 * (time + end.engaged)).bounds();
  if (end.gap.low > 0.0) bounds.amplitude = (half.amplitude(end) / end.gap).bounds();
  bounds.has_cycle = time.low > 0.0 && std::isfinite(time.high);
  if (multiplier == MultiplierBounds::left_out || !bounds.has_cycle) return bounds;
  // On the cycle ρ = 1, so that R′ = 1 − J_M U (y + cP)/Q; it lies between 0 and 1.
  const Interval slope = 1.0 - half.thrust(time, end) / end.form;
  const Interval square_of_slope = square(slope);
  bounds.multiplier = {square_of_slope.low, std::min(1.0, square_of_slope.high)};
  return bounds;
}

}  // namespace gearlash
