// Cycles of dry friction, beside closed forms and an independent motion in many digits; and faces
// that give, as they become rigid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "base/references.hpp"
#include "controllers.hpp"
#include "drives.hpp"
#include "general/attractors/attractors.hpp"

namespace gearlash::drive::stick_slip_test {
namespace {

// ---- a mass on a belt ---------------------------------------------------------------------------

/// A mass on a spring, drawn at a steady speed, or held on a belt that moves at it.
struct Belt {
  double mass = 1.0;
  double spring = 1.0;
  double speed = 0.1;
  double breakaway = 0.5;
  double sliding = 0.3;

  double frequency() const { return std::sqrt(spring / mass); }
  /// Of the spring's length beyond that of steady sliding, at breakaway.
  double excess() const { return (breakaway - sliding) / spring; }

  // Sliding, z″ = −ω²(z − sliding/k) from z = breakaway/k, z′ = v to z′ = v again; then held.
  double size() const { return std::hypot(excess(), speed / frequency()); }
  double period() const {
    const double slide =
        2.0 / frequency() * (std::numbers::pi - std::atan(excess() * frequency() / speed));
    return slide + 2.0 * excess() / speed;
  }
};

/// x the mass's position, fast and slow side of friction never reversed.
hybrid::HybridSystem belt_system(const Belt& belt) {
  using hybrid::Direction;
  const double v = belt.speed;
  const double square = belt.spring / belt.mass;
  const hybrid::AffineMode held{
      .name = "held",
      .flow = {hybrid::Matrix::Zero(2, 2), hybrid::Vector{{v, 0.0}}},
      .transitions = {{.name = "breaks away",
                       .guard = {hybrid::Vector{{belt.spring, 0.0}}, -belt.breakaway},
                       .direction = Direction::rising,
                       .target = 1}}};
  const hybrid::AffineMode slides{
      .name = "slides",
      .flow = {hybrid::Matrix{{0.0, 1.0}, {-square, 0.0}},
               hybrid::Vector{{0.0, belt.sliding / belt.mass}}},
      .transitions = {{.name = "is caught",
                       .guard = {hybrid::Vector{{0.0, 1.0}}, -v},
                       .direction = Direction::rising,
                       .reset = {hybrid::Matrix{{1.0, 0.0}, {0.0, 0.0}}, hybrid::Vector{{0.0, v}}},
                       .target = 0}}};
  return {.state_names = {"position", "speed"}, .modes = {held, slides}};
}

/// The same seen from the ground: shafts that stay together, drawn by proportional control, the
/// friction on the load.
ReducedDrive belt_drive(const Belt& belt) {
  ReducedDrive drive;
  drive.motor.inertia = 0.9 * belt.mass;
  drive.load = {0.1 * belt.mass, {.coulomb = belt.sliding, .breakaway = belt.breakaway}};
  drive.backlash = 0.1;
  drive.contact = RigidContact{0.0};
  drive.controller = at_load(PID{.proportional = belt.spring});
  drive.reference = Ramp{0.0, belt.speed, 0.0};
  return drive;
}

/// Each half swing takes 2 F/K off the amplitude; the shaft stays where the spring's torque is
/// below the breakaway as it stops, though above what friction is while it slides.
TEST(OracleStickSlip, AShaftThatStopsWithinItsBreakawayStaysThere) {
  ReducedDrive drive = lone_motor({2.0, {.coulomb = 0.3, .breakaway = 0.5}});
  drive.controller = at_load(PID{.proportional = 1.0});
  for (const auto& [start, end] : {std::pair{1.0, -0.4}, std::pair{1.3, 0.1}, {-1.0, 0.4}}) {
    const auto motion = moved(drive, {.motor_position = start}, 99.0);
    EXPECT_NEAR(motion.end().numbers[motor_position], end, 1e-14) << start;
    EXPECT_EQ(motion.end().numbers[motor_speed], 0.0) << start;
  }
}

std::vector<Belt> random_belts() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<Belt> belts = {Belt{}};
  for (int i = 0; i < 9; ++i) {
    Belt belt;
    belt.mass = 0.5 + share(random);
    belt.spring = 0.5 + share(random);
    belt.speed = 0.05 + 0.2 * share(random);
    belt.sliding = 0.3 + 0.2 * share(random);
    belt.breakaway = belt.sliding * (1.2 + 0.5 * share(random));
    belts.push_back(belt);
  }
  return belts;
}

TEST(OracleStickSlip, AMassOnABeltIsTheClosedForm) {
  for (const Belt& belt : random_belts()) {
    const hybrid::HybridSystem system = belt_system(belt);
    const auto motion =
        simulate(system, {0, hybrid::Vector{{0.0, belt.speed}}}, {.until = 8.0 * belt.period()});
    const auto orbit = closing_orbit(system, motion);
    ASSERT_TRUE(orbit);
    EXPECT_NEAR(orbit->period, belt.period(), 1e-12 * belt.period());
    EXPECT_LT(std::abs(orbit->multipliers.front()), 1e-12);  // each sticking forgets
  }
}

/// Without viscous friction the mass may also swing at its own frequency and never be caught: a
/// family of cycles, of any amplitude below v/ω, that share the period 2π/ω.
TEST(OracleStickSlip, SwingsThatAreNeverCaughtAreAFamily) {
  const Belt belt;
  const double center = -belt.sliding / belt.spring;
  AttractorOptions options;
  for (const double amplitude : {0.02, 0.05, 0.09}) {
    const double load = center + amplitude;
    options.starts.push_back({load + 0.05, belt.speed, load, belt.speed});
  }
  const AttractorSearch found = find_attractors(belt_drive(belt), options);
  ASSERT_EQ(found.cycles.size(), 1U);
  const FoundCycle& cycle = found.cycles.front();
  EXPECT_EQ(cycle.starts, 3U);
  EXPECT_EQ(cycle.stability, Stability::neutral);
  EXPECT_NEAR(cycle.period(), 2.0 * std::numbers::pi, 1e-10);
  EXPECT_NEAR(cycle.amplitudes.low, 0.02, 1e-10);
  EXPECT_NEAR(cycle.amplitudes.high, 0.09, 1e-10);
  EXPECT_NEAR(cycle.center, center, 1e-10);
}

/// A disturbance is forgotten in each sticking: what is left is rounding.
TEST(OracleStickSlip, ADriveThatDrawsALoadIsTheMassOnABelt) {
  for (const Belt& belt : random_belts()) {
    const AttractorSearch found = find_attractors(
        belt_drive(belt), {.starts = {{0.05, 0.0, 0.0, 0.0}, {-0.25, 0.0, -0.3, 0.0}}});
    EXPECT_EQ(found.coordinates, Coordinates::co_moving);
    ASSERT_EQ(found.cycles.size(), 1U);
    const FoundCycle& cycle = found.cycles.front();
    EXPECT_EQ(cycle.starts, 2U);
    EXPECT_NEAR(cycle.amplitude, belt.size(), 1e-12 * belt.size());
    EXPECT_NEAR(cycle.period(), belt.period(), 1e-12 * belt.period());
    EXPECT_NEAR(cycle.center, -belt.sliding / belt.spring, 1e-12);
    EXPECT_LT(cycle.multiplier, 1e-12);
  }
}

// ---- a PID drive that hunts by stiction ---------------------------------------------------------

/// Friction on the motor, sensor of position on the load, of speed on the motor, plastic faces.
TEST(OracleStickSlip, APidDriveWithStictionHuntsAsInManyDigits) {
  const References references("general", "stiction_hunting");
  const Reference& exact = references.front();
  const auto number = [&](const char* name) { return exact.input(name); };
  ReducedDrive drive;
  drive.motor = {number("motor_inertia"),
                 {.viscous = number("motor_friction"),
                  .coulomb = number("sliding"),
                  .breakaway = number("breakaway")}};
  drive.load = {number("load_inertia"), {.viscous = number("load_friction")}};
  drive.backlash = number("backlash");
  drive.contact = RigidContact{0.0};
  drive.controller = at_load(PID{.terms = PIDTerms::PID,
                                 .proportional = number("proportional"),
                                 .integral = number("integral"),
                                 .derivative = number("derivative"),
                                 .derivative_of_speed = true});
  const AttractorSearch found = find_attractors(
      drive, {.starts = {{0.515625, 0.0, 0.5, 0.0}, {0.0, 0.0, 0.01, 0.0}, {5.0, 0.0, 5.0, 0.0}}});
  ASSERT_EQ(found.cycles.size(), 1U);
  const FoundCycle& cycle = found.cycles.front();
  EXPECT_EQ(cycle.starts, 3U);
  EXPECT_EQ(cycle.stability, Stability::stable);
  EXPECT_NEAR(cycle.amplitude, number("amplitude"), 1e-10 * cycle.amplitude);
  EXPECT_NEAR(cycle.period(), number("period"), 1e-10 * cycle.period());
}

// ---- faces that give, as they become rigid ------------------------------------------------------

/// Of about the thesis's servo.
double hunting_amplitude(const Contact& contact) {
  ReducedDrive drive = servo_drive(0.19, 2.0, 0.1);
  drive.contact = contact;
  const AttractorSearch found = find_attractors(drive, {.starts = {{0.45, 0.0, 0.3, 0.0}}});
  return found.cycles.empty() ? std::nan("") : found.cycles.front().amplitude;
}

/// Mean slopes of log error over log stiffness, from decade to decade.
std::vector<double> orders(const std::vector<double>& errors) {
  std::vector<double> result;
  for (std::size_t i = 0; i + 1 < errors.size(); ++i) {
    result.push_back(std::log10(std::abs(errors[i + 1] / errors[i])));
  }
  return result;
}

/// Damping in proportion to stiffness: at contact the relative speed is used up in a time μ/c and a
/// way of v μ/c, and what the spring then gives back is e ≈ μ k/c²; all go as 1/stiffness.
TEST(OracleCompliantToRigid, WithDampingAsStiffnessContactBecomesPlastic) {
  const double rigid = hunting_amplitude(RigidContact{0.0});
  std::vector<double> errors;
  for (const double stiffness : {1e3, 1e4, 1e5}) {
    errors.push_back(
        hunting_amplitude(CompliantContact{stiffness, 0.1 * stiffness, ContactDamping::full}) -
        rigid);
  }
  for (const double order : orders(errors)) EXPECT_NEAR(order, -1.0, 0.1);
  EXPECT_LT(std::abs(errors.back()), 1e-5);
}

/// Critical damping: a contact of k δ + c δ′ that never pulls lasts until ω t = 2 and gives back
/// e⁻² of the relative speed. So it tends to rigid faces of that restitution, by the time and way
/// of a contact, 1/ω.
TEST(OracleCompliantToRigid, WithCriticalDampingRestitutionIsExpMinus2) {
  const double rigid = hunting_amplitude(RigidContact{std::exp(-2.0)});
  constexpr double reduced_inertia = 2.0 / 9.0;
  std::vector<double> errors;
  for (const double stiffness : {1e4, 1e5, 1e6}) {
    const double critical = 2.0 * std::sqrt(stiffness * reduced_inertia);
    errors.push_back(
        hunting_amplitude(CompliantContact{stiffness, critical, ContactDamping::full}) - rigid);
  }
  for (const double order : orders(errors)) EXPECT_NEAR(order, -0.5, 0.05);
}

}  // namespace
}  // namespace gearlash::drive::stick_slip_test
