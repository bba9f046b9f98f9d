// Data sheet to ratios: round trips, invariance under the choice of units, extreme magnitudes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/traced_draws.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::normalization_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();

void expect_close(double actual, double expected, double epsilons) {
  EXPECT_LE(std::abs(actual - expected), epsilons * epsilon * std::abs(expected))
      << actual << " against " << expected;
}

/// The drivetrain that has these ratios, the given total inertia (kg m²) and frequency (rad/s).
Drivetrain drivetrain_of(const NormalizedServo& servo, double inertia, double frequency) {
  const double friction = 2.0 * servo.damping * frequency * inertia;
  const bool massless_motor = std::isinf(servo.inertia_ratio);
  return {.motor_inertia = massless_motor ? 0.0 : inertia / (1.0 + servo.inertia_ratio),
          .load_inertia = massless_motor
                              ? inertia
                              : inertia * servo.inertia_ratio / (1.0 + servo.inertia_ratio),
          .motor_friction = (1.0 - servo.friction_ratio) * friction,
          .load_friction = servo.friction_ratio * friction,
          .stiffness = inertia * frequency * frequency,
          .backlash = servo.backlash,
          .restitution = servo.restitution};
}

// Each ratio comes of fewer than ten roundings of half an epsilon on either way; the friction ratio
// near 1 is 1 − (1 − r) rounded once more.
constexpr double round_trip_epsilons = 10.0;

TEST(PropertyNormalization, RoundTripThroughPhysicalUnits) {
  TracedDraws draws(1960);
  for (int i = 0; i < 10000; ++i) {
    NormalizedServo servo{.damping = draws.uniform(0.001, 3.0),
                          .inertia_ratio = draws.log_uniform(1e-8, 1e8),
                          .friction_ratio = draws.uniform(0.0, 1.0),
                          .backlash = draws.log_uniform(1e-6, 1.0),
                          .restitution = draws.uniform(0.0, 1.0)};
    const double inertia = draws.log_uniform(1e-30, 1e30);
    const double frequency = draws.log_uniform(1e-6, 1e6);
    const Drivetrain drivetrain = drivetrain_of(servo, inertia, frequency);
    const NormalizedServo back = normalize(drivetrain);
    expect_close(back.damping, servo.damping, round_trip_epsilons);
    expect_close(back.inertia_ratio, servo.inertia_ratio, round_trip_epsilons);
    expect_close(back.friction_ratio, servo.friction_ratio, round_trip_epsilons);
    expect_close(natural_frequency(drivetrain), frequency, round_trip_epsilons);
    EXPECT_EQ(back.backlash, servo.backlash);
    EXPECT_EQ(back.restitution, servo.restitution);
    if (HasFailure()) FAIL() << "draw " << i;
  }
}

TEST(EdgeNormalization, MasslessSides) {
  const NormalizedServo motor_only = normalize({.motor_inertia = 4.0,
                                                .load_inertia = 0.0,
                                                .motor_friction = 1.0,
                                                .load_friction = 3.0,
                                                .stiffness = 1.0});
  EXPECT_EQ(motor_only.inertia_ratio, 0.0);
  EXPECT_EQ(motor_only.friction_ratio, 0.75);
  EXPECT_EQ(motor_only.damping, 1.0);
  const NormalizedServo load_only = normalize({.motor_inertia = 0.0,
                                               .load_inertia = 4.0,
                                               .motor_friction = 1.0,
                                               .load_friction = 3.0,
                                               .stiffness = 1.0});
  EXPECT_EQ(load_only.inertia_ratio, infinity);
  EXPECT_EQ(load_only.damping, 1.0);
}

TEST(EdgeNormalization, WithoutFrictionTheRatioIsZero) {
  const NormalizedServo servo =
      normalize({.motor_inertia = 1.0, .load_inertia = 1.0, .stiffness = 1.0});
  EXPECT_EQ(servo.damping, 0.0);
  EXPECT_EQ(servo.friction_ratio, 0.0);
  EXPECT_FALSE(std::signbit(servo.friction_ratio));
}

TEST(EdgeNormalization, ExtremeMagnitudesNeitherOverflowNorUnderflow) {
  const NormalizedServo servo{
      .damping = 0.25, .inertia_ratio = 3.0, .friction_ratio = 0.5, .backlash = 0.1};
  for (const double inertia : {0x1p-1000, 1e-300, 1e-200, 1e-30, 1.0, 1e30, 1e200, 1e300}) {
    for (const double stiffness : {1e-300, 1e-30, 1.0, 1e30, 1e300}) {
      const double root = std::sqrt(stiffness) * std::sqrt(inertia);
      const double friction = 2.0 * servo.damping * root;
      const Drivetrain drivetrain{.motor_inertia = 0.25 * inertia,
                                  .load_inertia = 0.75 * inertia,
                                  .motor_friction = 0.5 * friction,
                                  .load_friction = 0.5 * friction,
                                  .stiffness = stiffness,
                                  .backlash = 0.1};
      SCOPED_TRACE(inertia);
      SCOPED_TRACE(stiffness);
      const NormalizedServo back = normalize(drivetrain);
      expect_close(back.damping, 0.25, round_trip_epsilons);
      expect_close(back.inertia_ratio, 3.0, round_trip_epsilons);
      expect_close(back.friction_ratio, 0.5, round_trip_epsilons);
      expect_close(natural_frequency(drivetrain), std::sqrt(stiffness) / std::sqrt(inertia),
                   round_trip_epsilons);
    }
  }
}

TEST(EdgeNormalization, ATotalInertiaBeyondDoublesIsNotTakenForZeroDamping) {
  const Drivetrain drivetrain{.motor_inertia = 1.5e308,
                              .load_inertia = 1.5e308,
                              .motor_friction = 1e300,
                              .load_friction = 1e300,
                              .stiffness = 1e300};
  // 2e300/(2 √1e300 √3e308) = 5.8e-5: either that number or a refusal, never a silent zero.
  if (faults(drivetrain).empty()) {
    EXPECT_NEAR(normalize(drivetrain).damping, 5.7735e-5, 1e-8);
  }
}

}  // namespace
}  // namespace gearlash::normalization_test
