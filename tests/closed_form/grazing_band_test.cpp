// How near a face a turning point may be before rounding decides whether it touches: against the
// raw equations of the servo's own numbers in many digits.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/references.hpp"
#include "base/traced_draws.hpp"
#include "closed_form/first_contact.hpp"

namespace gearlash::grazing_band_test {
namespace {

/// Start of a flight: the gap and the face are placed afterwards.
struct FlightStart {
  NormalizedServo servo;
  double load_position;
  double load_speed;
  double gap_speed;
};

GapFlight flight_of(const FlightStart& start, double gap) {
  return flight_from(servo_dynamics(start.servo),
                     {start.load_position, start.load_speed, gap, start.gap_speed});
}

/// b + Σ|terms of u|, as first_contact.hpp has them.
double terms(const GapFlight& flight, double backlash, double motor_inertia, double time) {
  const BasicFlightDecays<double> decays = decays_at(flight, time);
  const double motor_speed = std::abs(flight.load_speed) + std::abs(flight.gap_speed);
  const double acceleration =
      flight.motor_rate * motor_speed + std::abs(flight.load_position) / motor_inertia;
  return backlash +
         time * (std::abs(flight.gap_speed) +
                 time * (acceleration * decays.motor.double_integral +
                         std::abs(flight.load_deceleration) * decays.load.double_integral +
                         std::abs(flight.coupling) * time * decays.coupled.double_integral));
}

struct Tally {
  int judged = 0;
  int wrong = 0;
  int touches = 0;
  double worst_of_terms = 0.0;  ///< of wrong answers, epsilons
  double farthest_touch = 0.0;  ///< epsilons of the terms
};

/// A gap in which the turning point is short of its face, or beyond, by a share of its `travel`;
/// `before` is the travel of the turning point before it.
void judge(const FlightStart& start, Wide turning, Wide travel, double before, SeededDraws& draws,
           Tally& tally) {
  const double toward = travel > 0 ? 1.0 : -1.0;
  const auto time = static_cast<double>(turning);
  if (toward * before > 0.99 * std::abs(static_cast<double>(travel))) return;  // met by that one
  const double share = draws.happens(0.5) ? 1.0 : draws.log_uniform(1.0, 1e6);
  const double backlash =
      2.0 * share * std::max(static_cast<double>(std::abs(travel)), std::abs(before));
  const double off = draws.either_sign(1e-19, 1e-10);
  const double gap = static_cast<double>(Wide(toward) * backlash / 2 - travel * (1 + Wide(off)));
  const Wide beyond = toward * (Wide(gap) + travel) - Wide(backlash) / 2;
  if (!(std::abs(gap) < 0.5 * backlash)) return;
  const GapFlight flight = flight_of(start, gap);
  const FirstContact contact = first_contact(flight, backlash, 1.2 * time);
  const bool met = contact.toward == toward && contact.time < 1.1 * time;
  if (contact.toward == -toward && contact.time < time) return;  // the other face came first
  const double inertia = 1.0 / (1.0 + start.servo.inertia_ratio);
  const double size = terms(flight, backlash, inertia, time);
  const double distance = static_cast<double>(std::abs(beyond));
  ++tally.judged;
  if (contact.touch.toward == toward) {
    ++tally.touches;
    tally.farthest_touch = std::max(tally.farthest_touch, distance / size / epsilon);
  }
  if (met == (beyond > 0)) return;
  ++tally.wrong;
  EXPECT_EQ(contact.touch.toward, toward) << "a wrong answer that is not reported";
  tally.worst_of_terms = std::max(tally.worst_of_terms, distance / size / epsilon);
}

TEST(OracleGrazing, IsJudgedRightBeyondItsBandWhateverTheSpeed) {
  TracedDraws draws(1961);
  Tally tally;
  int flights = 0;
  for (const Reference& exact : References("closed_form", "turning_points")) {
    if (HasFailure()) break;
    ++flights;
    SCOPED_TRACE(flights);
    const FlightStart start{.servo = {.damping = exact.input("damping"),
                                      .inertia_ratio = exact.input("inertia_ratio"),
                                      .friction_ratio = exact.input("friction_ratio")},
                            .load_position = exact.input("load_position"),
                            .load_speed = exact.input("load_speed"),
                            .gap_speed = exact.input("gap_speed")};
    double farthest = 0.0;
    for (const std::string turning : {"first", "second"}) {
      const Wide time = exact[turning + "_time"];
      const Wide travel = exact[turning + "_travel"];
      if (std::isnan(time)) break;
      for (int k = 0; k < 20; ++k) judge(start, time, travel, farthest, draws, tally);
      farthest = static_cast<double>(travel);
    }
  }
  EXPECT_GT(tally.judged, 10 * flights);
  EXPECT_GT(tally.wrong, tally.judged / 100);  // draws go as far as rounding
  // Seen of 4·10⁵: 1.4, which first_contact.hpp states; it vouches for 32.
  EXPECT_LE(tally.worst_of_terms, 2.0);
  // 32, and three times as much by the bound of A's terms, |A| + 2c|v_M|.
  EXPECT_LE(tally.farthest_touch, 96.0);
}

}  // namespace
}  // namespace gearlash::grazing_band_test
