// The first crossing: nothing missed, nothing invented, grazing included, to rounding.
#include "closed_form/first_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/references.hpp"
#include "base/special_numbers.hpp"
#include "base/traced_draws.hpp"

namespace gearlash::first_contact_test {
namespace {

/// u after `time`, as the flight under test gives it (gap_flight_test.cpp checks that).
double gap_at(const GapFlight& flight, double time) {
  return flight.gap + point_in_flight(flight, time).gap_displacement;
}

/// What rounding does to u: its terms are added in an order of their own.
double noise(const GapFlight& flight, double backlash, double time) {
  const FlightMotion motion = motion_in_flight(flight, time);
  const double terms = std::abs(flight.gap_speed) * time +
                       std::abs(flight.gap_acceleration) * time * time +
                       std::abs(motion.gap_speed) * time;
  return 64.0 * epsilon * (backlash + terms);
}

/// Times at which to look: even and logarithmic, so that early and late contacts are both seen.
std::vector<double> looks(double end) {
  std::vector<double> times;
  for (int k = 1; k <= 600; ++k) times.push_back(end * k / 600.0);
  for (double time = end; time > 1e-12; time *= 0.9) times.push_back(time);
  std::sort(times.begin(), times.end());
  return times;
}

void expect_first(const GapFlight& flight, double backlash, double horizon) {
  const FirstContact contact = first_contact(flight, backlash, horizon);
  const bool found = contact.toward != 0.0;
  const double end = found ? contact.time : std::min(horizon, 1e4);
  if (found) {
    ASSERT_GT(contact.time, 0.0);
    ASSERT_LE(contact.time, horizon);
    ASSERT_NEAR(gap_at(flight, contact.time), 0.5 * backlash * contact.toward,
                noise(flight, backlash, contact.time))
        << "invented at " << contact.time;
    // It arrives at the face from within the gap.
    ASSERT_GE(motion_in_flight(flight, contact.time).gap_speed * contact.toward,
              -1e-7 * (1.0 + std::abs(flight.gap_speed)));
  }
  for (const double time : looks(end)) {
    if (time >= end) break;
    ASSERT_LE(std::abs(gap_at(flight, time)), 0.5 * backlash + noise(flight, backlash, time))
        << "missed one before " << time << ", answer " << contact.time;
  }
}

ServoDynamics random_dynamics(SeededDraws& draws, double backlash) {
  const double damping = draws.happens(0.15) ? draws.one_of({0.0, 1.0}) : draws.uniform(0.0, 2.0);
  double friction_ratio = draws.happens(0.3) ? draws.one_of({0.0, 1.0}) : draws.uniform(0.0, 1.0);
  double ratio = draws.log_uniform(1e-3, 1e3);
  if (draws.happens(0.1)) friction_ratio = ratio / (1.0 + ratio);
  if (draws.happens(0.1) && damping > 0.0) {
    ratio = draws.one_of({0.0, infinity});
    // The massless side needs friction; the other may go without.
    if (friction_ratio == (ratio == 0.0 ? 0.0 : 1.0)) friction_ratio = 0.5;
  }
  return servo_dynamics({.damping = damping,
                         .inertia_ratio = ratio,
                         .friction_ratio = friction_ratio,
                         .backlash = backlash});
}

TEST(PropertyFirstContact, RandomFlightsFromWithinTheGap) {
  TracedDraws draws(577);
  for (int i = 0; i < 4000 && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const double backlash = draws.log_uniform(1e-3, 3.0);
    const ServoDynamics dynamics = random_dynamics(draws, backlash);
    const GapState start{draws.uniform(-1.0, 1.0), draws.uniform(-1.0, 1.0),
                         0.5 * backlash * draws.uniform(-1.0, 1.0), draws.uniform(-1.0, 1.0)};
    const double horizon = draws.happens(0.5) ? infinity : draws.log_uniform(1e-3, 30.0);
    expect_first(flight_from(dynamics, start), backlash, horizon);
  }
}

TEST(PropertyFirstContact, RandomReboundsFromEitherFace) {
  TracedDraws draws(578);
  for (int i = 0; i < 4000 && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const double backlash = draws.log_uniform(1e-3, 3.0);
    const ServoDynamics dynamics = random_dynamics(draws, backlash);
    const double face = draws.sign();
    // Rebounds from violent to barely noticeable.
    const GapState start{draws.uniform(-1.0, 1.0), draws.uniform(-1.0, 1.0), face * 0.5 * backlash,
                         -face * draws.log_uniform(1e-9, 1.0)};
    const GapFlight flight = flight_from(dynamics, start);
    if (flight.gap_speed * face >= 0.0) continue;  // a massless motor goes where it is driven
    expect_first(flight, backlash, infinity);
  }
}

TEST(PropertyFirstContact, CleanSeparationsFromEitherFace) {
  TracedDraws draws(579);
  for (int i = 0; i < 4000 && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const double backlash = draws.log_uniform(1e-3, 3.0);
    const ServoDynamics dynamics = random_dynamics(draws, backlash);
    const TorqueFreeLine line = dynamics.torque_free_line;
    const double face = draws.sign();
    const double amplitude = face * draws.log_uniform(1e-3, 10.0);
    const GapFlight flight = flight_from_separation(dynamics, amplitude * line.position,
                                                    amplitude * line.speed, face * 0.5 * backlash);
    // Overdamped servos may have D between the two rates: the faces would not part.
    const double departure =
        flight.gap_acceleration != 0.0 ? flight.gap_acceleration : flight.gap_drive;
    if (departure * face >= 0.0) continue;
    expect_first(flight, backlash, infinity);
  }
}

/// Without friction and with the load at rest at y: u = u₀ + w t − y t² (J_M = ½).
GapFlight parabola(double gap, double speed, double load_position) {
  const ServoDynamics frictionless = servo_dynamics(
      {.damping = 0.0, .inertia_ratio = 1.0, .friction_ratio = 0.0, .backlash = 1.0});
  return flight_from(frictionless, {load_position, 0.0, gap, speed});
}

TEST(EdgeFirstContact, GrazingParabolaWithinAFewUlpsOfTheFace) {
  // u = t − t²: apex 0.25 at t = 0.5. The face lies k ulps beyond it.
  for (int k = -8; k <= 8; ++k) {
    double face = 0.25;
    for (int i = 0; i < std::abs(k); ++i) face = std::nextafter(face, k > 0 ? 1.0 : 0.0);
    const FirstContact contact = first_contact(parabola(0.0, 1.0, 1.0), 2.0 * face, infinity);
    SCOPED_TRACE(k);
    const double back = 0.5 + std::sqrt(0.25 + face);  // u = t − t² = −face
    if (contact.toward > 0.0) {
      EXPECT_LE(k, 2) << "a face beyond the apex's rounding was touched";
      // √(ulps/curvature) is how far from the apex the crossing can lie.
      EXPECT_NEAR(contact.time, 0.5, std::sqrt(16.0 * epsilon));
    } else {
      EXPECT_GE(k, -2) << "a face within the apex's reach was missed";
      EXPECT_EQ(contact.toward, -1.0);
      EXPECT_NEAR(contact.time, back, 8.0 * epsilon);
    }
  }
}

TEST(EdgeFirstContact, GrazingOfRandomFlightsAtTheirTurningPoints) {
  TracedDraws draws(580);
  int grazed = 0;
  for (int i = 0; i < 3000 && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const ServoDynamics dynamics = random_dynamics(draws, 0.3);
    const GapState start{draws.uniform(-1.0, 1.0), draws.uniform(-1.0, 1.0), 0.0,
                         draws.uniform(-1.0, 1.0)};
    const GapFlight flight = flight_from(dynamics, start);
    // First turning point by bisection of u̇ between looks.
    double low = 0.0;
    double high = 0.0;
    const double direction = flight.gap_speed > 0.0 ? 1.0 : -1.0;
    for (double time = 1e-3; time < 20.0 && high == 0.0; time += 1e-2) {
      if (motion_in_flight(flight, time).gap_speed * direction < 0.0)
        high = time;
      else
        low = time;
    }
    if (high == 0.0) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (motion_in_flight(flight, middle).gap_speed * direction < 0.0 ? high : low) = middle;
    }
    const double apex = std::abs(gap_at(flight, low));
    if (apex < 1e-3) continue;
    ++grazed;
    const double slack = noise(flight, apex, low) / apex;
    const FirstContact inside = first_contact(flight, 2.0 * apex * (1.0 - 2.0 * slack), infinity);
    ASSERT_EQ(inside.toward, direction) << "missed a grazing contact";
    const FirstContact outside = first_contact(flight, 2.0 * apex * (1.0 + 2.0 * slack), infinity);
    ASSERT_TRUE(outside.toward != direction || outside.time > high) << "invented a grazing contact";
    // At the face to rounding either answer may be given, but it has to be one of the two.
    const FirstContact exact = first_contact(flight, 2.0 * apex, infinity);
    if (exact.toward == direction && exact.time < 1.5 * high) {
      ASSERT_NEAR(gap_at(flight, exact.time) * direction, apex, noise(flight, apex, low));
    } else {
      ASSERT_EQ(exact.toward, outside.toward);
      if (outside.toward != 0.0) {
        ASSERT_NEAR(exact.time, outside.time, 1e-6 * outside.time);
      }
    }
  }
  EXPECT_GT(grazed, 500);
}

TEST(EdgeFirstContact, HorizonZeroAndExactlyAtTheContact) {
  const GapFlight flight = parabola(-0.5, 1.0, 0.0);  // leaves the backward face at speed 1
  EXPECT_EQ(first_contact(flight, 1.0, 0.0).toward, 0.0);
  EXPECT_EQ(first_contact(flight, 1.0, 0.0).time, infinity);
  EXPECT_EQ(first_contact(flight, 1.0, std::nextafter(1.0, 0.0)).toward, 0.0);
  EXPECT_EQ(first_contact(flight, 1.0, 1.0).toward, 1.0);
  EXPECT_NEAR(first_contact(flight, 1.0, 1.0).time, 1.0, epsilon);
  EXPECT_NEAR(first_contact(flight, 1.0, infinity).time, 1.0, epsilon);
}

TEST(EdgeFirstContact, MotionlessAndReceding) {
  EXPECT_EQ(first_contact(GapFlight{}, 1.0, infinity).toward, 0.0);
  // u̇ = e^{−t} (c = 1, load at rest at the reference): ends at u = 1, short of the face or beyond.
  const ServoDynamics dynamics = servo_dynamics(
      {.damping = 0.25, .inertia_ratio = 1.0, .friction_ratio = 0.0, .backlash = 1.0});
  ASSERT_EQ(dynamics.motor_rate, 1.0);
  const GapFlight creeping = flight_from(dynamics, {0.0, 0.0, 0.0, 1.0});
  EXPECT_EQ(first_contact(creeping, 2.0 * (1.0 + 1e-6), infinity).toward, 0.0);
  const FirstContact late = first_contact(creeping, 2.0 * (1.0 - 1e-6), infinity);
  EXPECT_EQ(late.toward, 1.0);
  EXPECT_NEAR(late.time, std::log(1e6), 1e-8);  // 1 − e^{−t} near 1 loses 1e6 epsilons
}

TEST(EdgeFirstContact, TinyReboundsComeBackWhenTheyShould) {
  // u̇₀ = −w, ü₀ = a: back at 2w/a, with the next order from c and D.
  const ServoDynamics dynamics = servo_dynamics(
      {.damping = 0.3, .inertia_ratio = 2.0, .friction_ratio = 0.3, .backlash = 0.3});
  for (const double speed : {1e-1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-100}) {
    const GapFlight flight = flight_from(dynamics, {-0.8, 0.1, 0.15, -speed});
    const FirstContact contact = first_contact(flight, 0.3, infinity);
    ASSERT_EQ(contact.toward, 1.0) << speed;
    // u/t = u̇₀ + ü₀ t exp[0,0,−ct] + G t² exp[0,0,−Dt,−ct], by series in extended precision.
    const Wide c = flight.motor_rate;
    const Wide d = flight.load_rate;
    Wide time = 2 * Wide(speed) / flight.gap_acceleration;
    for (int step = 0; step < 200; ++step) {
      Wide motor = 0;
      Wide power = Wide(1) / 2;
      for (int k = 0; k < 60; ++k) {
        motor += power;
        power *= -c * time / (k + 3);
      }
      Wide drive = 0;
      Wide symmetric = 1;
      Wide load_power = 1;
      Wide factorial = 6;
      for (int k = 0; k < 60; ++k) {
        drive += symmetric / factorial;
        load_power *= -d * time;
        symmetric = load_power - c * time * symmetric;
        factorial *= k + 4;
      }
      time = Wide(speed) / (flight.gap_acceleration * motor + flight.gap_drive * time * drive);
    }
    EXPECT_LE(epsilons_off(contact.time, time), 16.0) << speed;
  }
}

TEST(EdgeFirstContact, WithoutFrictionTheCubicIsExact) {
  // c = D = 0 from a clean separation: u − u₀ = G t³/6.
  const ServoDynamics frictionless = servo_dynamics(
      {.damping = 0.0, .inertia_ratio = 1.0, .friction_ratio = 0.0, .backlash = 1.0});
  const GapFlight flight = flight_from_separation(frictionless, 0.0, 3.0, 0.5);  // G = −v/J_M
  const FirstContact contact = first_contact(flight, 1.0, infinity);
  EXPECT_EQ(contact.toward, -1.0);
  EXPECT_NEAR(contact.time, 1.0, 4.0 * epsilon);
}

TEST(EdgeFirstContact, HugeAndTinyGaps) {
  const ServoDynamics dynamics = servo_dynamics(
      {.damping = 0.2, .inertia_ratio = 2.0, .friction_ratio = 0.0, .backlash = 1.0});
  for (const double backlash : {1e-300, 1e-30, 1e-9, 1e6}) {
    const double size = backlash;
    const GapFlight flight =
        flight_from(dynamics, {-0.3 * size, 0.4 * size, 0.1 * size, -0.2 * size});
    const FirstContact contact = first_contact(flight, backlash, infinity);
    const GapFlight unit = flight_from(dynamics, {-0.3, 0.4, 0.1, -0.2});
    const FirstContact expected = first_contact(unit, 1.0, infinity);
    EXPECT_EQ(contact.toward, expected.toward) << backlash;
    EXPECT_NEAR(contact.time, expected.time, 16.0 * epsilon * expected.time) << backlash;
  }
}

}  // namespace
}  // namespace gearlash::first_contact_test
