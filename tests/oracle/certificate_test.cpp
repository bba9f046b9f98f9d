// The everyday part of million_servos, and proof that its certificates are not given away.

#include <gtest/gtest.h>

#include <cstdint>

#include "closed_form/trajectory.hpp"
#include "segment_certificate.hpp"

namespace gearlash::oracle::certificate_test {
namespace {

constexpr std::uint64_t seed = 1960;
constexpr double until = 12.566370614359172;  // two undamped periods
constexpr std::size_t event_limit = 20;

TEST(Certificate, NoCrossingOfFiveHundredServosIsMissed) {
  CertificateCounts total;
  for (std::uint64_t index = 0; index < 500; ++index) {
    const RandomCase drawn = random_case(seed, index);
    const CertificateCounts counts = certify(drawn, until, event_limit);
    EXPECT_EQ(counts.first_fault, "")
        << "seed " << seed << ", servo " << index << ": " << describe(drawn);
    total.add(counts);
  }
  EXPECT_EQ(total.servos, 500U);
  EXPECT_GT(total.events, 4000U);
}

/// A servo that hunts with one impact and one separation per half cycle, and its motion.
RandomCase hunting_servo() {
  RandomCase hunting;
  hunting.servo = {.damping = 0.19, .inertia_ratio = 2, .friction_ratio = 0.1, .backlash = 0.25};
  hunting.initial = {.motor_position = 0.125};
  hunting.reference = 1.0;
  return hunting;
}

Trajectory motion_of(const RandomCase& drawn) {
  return simulate(drawn.servo, drawn.initial,
                  {.until = until, .reference = drawn.reference, .event_limit = event_limit});
}

TEST(Certificate, TheMotionOfAnotherServoIsRefused) {
  const RandomCase hunting = hunting_servo();
  EXPECT_EQ(certify(hunting, motion_of(hunting)).faults, 0U);
  for (double NormalizedServo::*field :
       {&NormalizedServo::damping, &NormalizedServo::inertia_ratio,
        &NormalizedServo::friction_ratio, &NormalizedServo::backlash}) {
    RandomCase other = hunting;
    other.servo.*field *= 1.0 + 1e-9;
    EXPECT_EQ(certify(hunting, motion_of(other)).faults, 1U);
  }
}

TEST(Certificate, AnImpactThatIsPassedOverIsSeen) {
  // In the narrower gap the faces would have met before the wider one's impact.
  RandomCase narrower = hunting_servo();
  const Trajectory motion = motion_of(narrower);
  narrower.servo.backlash = 0.2;
  EXPECT_EQ(certify(narrower, motion).faults, 1U);
}

}  // namespace
}  // namespace gearlash::oracle::certificate_test
