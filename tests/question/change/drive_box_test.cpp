// Boxes of drives, from a point to a factor of three wide: what is bounded of them holds for the
// drives within, in many digits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "base/references.hpp"
#include "base/traced_draws.hpp"
#include "model/reduced_drive.hpp"
#include "question/change/derivatives.hpp"
#include "question/change/drives.hpp"
#include "question/change/target.hpp"

namespace gearlash::drive_box_test {
namespace {

/// All but restitution.
constexpr std::string_view parameters[] = {
    "servo.backlash",       "gearbox.ratio",      "controller.proportional",
    "load.friction",        "motor.friction",     "controller.motor_speed_feedback",
    "load.inertia",         "motor.inertia",      "servo.damping",
    "servo.friction_ratio", "servo.inertia_ratio"};

void expect_holds(const Bounds& bounds, Wide exact) {
  EXPECT_TRUE(bounds.low <= exact && exact <= bounds.high)
      << exact << " is not in " << bounds.low << " … " << bounds.high;
}

/// Between which a value lies: a third are points, a third slivers.
Bounds drawn_about(double value, SeededDraws& draws, std::size_t index) {
  if (index % 3 == 0) return {value, value};
  const double width =
      index % 3 == 1 ? draws.log_uniform(1e-14, 1e-4) : draws.log_uniform(1e-4, 2.0);
  const double share = draws.uniform(0.0, 1.0);
  return {value / (1.0 + share * width), value * (1.0 + (1.0 - share) * width)};
}

/// The box of values of a parameter holds the servo that has one of them.
TEST(OracleDriveBox, HoldsAServoWithin) {
  SeededDraws draws(1841);
  std::size_t count = 0;
  int hunting = 0;
  std::vector<double> widths;  // of points, in epsilons
  for (const Reference& exact : References("closed_form", "plastic_cycles")) {
    const std::size_t i = count++;
    const std::string_view parameter = parameters[i % std::size(parameters)];
    SCOPED_TRACE(testing::Message() << "case " << i << ", " << parameter);
    const NormalizedServo servo{.damping = exact.input("damping"),
                                .inertia_ratio = exact.input("inertia_ratio"),
                                .friction_ratio = exact.input("friction_ratio"),
                                .backlash = draws.log_uniform(1e-4, 1.0)};
    const double frequency = draws.log_uniform(0.1, 100.0);
    const Drive drive = drive_of(servo, frequency);
    const ServoLine line = line_of(drive, parameter);
    const double present = line.present();
    const Bounds range = line.range();
    if (!range.contains(present)) continue;  // damping beyond ten times critical
    Bounds values = drawn_about(present, draws, i);
    if (parameter == "controller.motor_speed_feedback")
      values.high = range.high * draws.log_uniform(1e-6, 0.3);
    values = {std::max(range.low, values.low), std::min(range.high, values.high)};
    const double guess = flight_time_of(line.answer_at(values.low));
    const DriveBox box = line.box(values);
    const CycleBounds bounds = bound_cycles(box.servo, guess);
    expect_holds(bounds.growth_at_rest, exact["growth"]);
    if (i % 3 == 0 && exact["growth"] > 0 && values.low == values.high) {
      widths.push_back((bounds.growth_at_rest.high - bounds.growth_at_rest.low) /
                       exact.input("growth") / epsilon);
    }
    if (!(exact["growth"] > 1)) continue;
    ++hunting;
    EXPECT_FALSE(bounds.none_hunt());
    expect_holds(bounds.amplitude, exact["amplitude"]);
    expect_holds(bounds.period, exact["period"]);
    expect_holds(box.time_unit, 1 / Wide(frequency));
    expect_holds(box.backlash, servo.backlash);
  }
  EXPECT_GT(hunting, 1500);
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  RecordProperty("median width of the growth of points, epsilons", std::to_string(*middle));
  EXPECT_LT(*middle, 2000.0);
}

// ---- data sheets --------------------------------------------------------------------------------

/// One of four kinds of motor, half of them with speed fed back, some of it negative.
Drive drawn_data_sheet(SeededDraws& draws) {
  const MotorKind kinds[] = {
      ArmatureControl{draws.log_uniform(0.01, 1.0), draws.log_uniform(0.01, 1.0),
                      draws.log_uniform(0.5, 50.0)},
      FieldControl{draws.log_uniform(0.01, 1.0), draws.log_uniform(0.5, 50.0)},
      TwoPhase{draws.log_uniform(1e-3, 0.1), draws.log_uniform(1e-5, 1e-3)}, TorqueControl{}};
  Drive drive = drive_of(kinds[static_cast<std::size_t>(draws.uniform(0.0, 4.0))],
                         {.motor_inertia = draws.log_uniform(1e-6, 1e-4),
                          .motor_friction = draws.log_uniform(1e-5, 1e-3),
                          .ratio = draws.log_uniform(1.0, 100.0),
                          .backlash = draws.log_uniform(1e-4, 1.0),
                          .load_inertia = draws.log_uniform(1e-4, 1e-1),
                          .load_friction = draws.log_uniform(1e-4, 1e-1),
                          .error_gain = draws.log_uniform(1.0, 1000.0)});
  if (draws.happens(0.5)) {
    const double feedback = draws.log_uniform(1e-5, 1e-2);
    drive.controller.law = PID{.terms = PIDTerms::PD,
                               .proportional = std::get<PID>(drive.controller.law).proportional,
                               .derivative = draws.happens(0.5) ? feedback : -feedback};
    drive.sensor.speed = ShaftName::motor;
    drive.controller.shaft = draws.happens(0.5) ? GainShaft::load : GainShaft::motor;
  }
  return drive;
}

/// The closed form of growth_at_rest.hpp in extended precision: rounding is far below the error
/// that numbers of a data sheet are taken to have.
Wide growth_of(const Drivetrain& drive) {
  const Wide inertia = Wide(drive.motor_inertia) + drive.load_inertia;
  const Wide frequency = std::sqrt(drive.stiffness / inertia);
  const Wide z = (Wide(drive.motor_friction) + drive.load_friction) / (2 * inertia * frequency);
  const Wide c = drive.motor_friction / (drive.motor_inertia * frequency);
  const Wide d = drive.load_friction / (drive.load_inertia * frequency);
  if (z < 1) {
    const Wide w = std::sqrt(1 - z * z);
    const Wide angle = std::atan2(w * (drive.motor_inertia * d + drive.load_inertia * c) / inertia,
                                  w * w - (c - z) * (d - z));
    const auto form = [&](Wide rate) { return rate * rate - 2 * z * rate + 1; };
    return std::sqrt(form(c) * form(d)) / (c * d) * std::exp(-z * angle / w);
  }
  const Wide w = std::sqrt(z * z - 1);
  const Wide slow = 1 / (z + w);
  const Wide fast = z + w;
  const auto product = [&](Wide rate) { return (1 - rate / c) * (1 - rate / d); };
  if (product(slow) >= 0) return 0;
  return -product(slow) * std::pow(product(slow) / product(fast), slow / (fast - slow));
}

/// Every number of the box of two ends holds those of every drive between, and so does its growth.
TEST(PropertyDriveBox, HoldsEveryDataSheetBetweenItsEnds) {
  TracedDraws draws(1843);
  int compared = 0;
  for (std::size_t i = 0; i < 4000 && !HasFailure(); ++i) {
    const Drive sheet = drawn_data_sheet(draws);
    if (!faults(sheet).empty() || !proportional_servo(sheet)) continue;  // feedback beyond friction
    const std::vector<std::string> names = drive_sensitivity(sheet).paths;
    const std::string& name = names[i % names.size()];
    const ServoLine line = line_of(sheet, name);
    const Bounds range = line.range();
    if (line.is_share() || !(range.high > range.low)) continue;
    SCOPED_TRACE(testing::Message() << "case " << i << ", " << name);
    const double low = range.low + draws.uniform(0.0, 0.5) * (range.high - range.low);
    const Bounds values{low, std::min(range.high, drawn_about(low, draws, i).high)};
    const CycleBounds bounds =
        bound_cycles(line.box(values).servo, std::numeric_limits<double>::quiet_NaN());
    for (int k = 0; k < 4; ++k) {
      const double value =
          std::min(values.high, values.low + draws.uniform(0.0, 1.0) * (values.high - values.low));
      const Drivetrain drawn = line.at(value)->drivetrain;
      expect_holds(bounds.growth_at_rest, growth_of(drawn));
      ++compared;
    }
  }
  EXPECT_GT(compared, 8000);
}

}  // namespace
}  // namespace gearlash::drive_box_test
