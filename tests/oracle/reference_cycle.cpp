#include "reference_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "closed_form/limit_cycle.hpp"
#include "reference_simulator.hpp"

namespace gearlash::oracle {
namespace {

struct ReferenceCycle {
  Extended amplitude = std::numeric_limits<Extended>::quiet_NaN();
  Extended period = std::numeric_limits<Extended>::quiet_NaN();
};

/// Times at which the motor arrives on the forward face from the backward one.
std::vector<Extended> arrivals(const ReferenceRun& run) {
  std::vector<Extended> times;
  for (std::size_t i = 1; i < run.events.size(); ++i) {
    const bool crossed = run.events[i - 1].face == Face::backward;
    if (crossed && run.events[i].face == Face::forward) times.push_back(run.events[i].time);
  }
  return times;
}

/// Runs from rest until `until`, then reads the last two arrivals on the forward face and the
/// extremes between them. The load's speed changes sign only while engaged (turning times) or at an
/// impact.
ReferenceCycle converged_cycle(const NormalizedServo& servo, Extended until) {
  ReferenceSimulator<ExponentialPropagator> simulator(servo, ExponentialPropagator(servo));
  ServoState start;
  start.motor_position = servo.backlash / 2.0;
  const ReferenceRun run = simulator.run(start, {.until = until, .reference = 1});
  const std::vector<Extended> times = arrivals(run);
  if (times.size() < 2) return {};
  const Extended end = times.back();
  const Extended begin = times[times.size() - 2];
  Extended high = -std::numeric_limits<Extended>::infinity();
  Extended low = -high;
  const auto note = [&](Extended time) {
    if (time < begin || time > end) return;
    const Extended position = simulator.at(time).load_position;
    high = std::max(high, position);
    low = std::min(low, position);
  };
  for (const Extended time : run.turning_times) note(time);
  for (const ReferenceEvent& event : run.events) note(event.time);
  return {(high - low) / 2, end - begin};
}

bool close(double value, double expected) {
  constexpr double tolerance = 1e-10;
  return std::abs(value - expected) <= tolerance * std::abs(expected);
}

CycleCheck check_cycle(const NormalizedServo& servo, Extended until) {
  const ReferenceCycle expected = converged_cycle(servo, until);
  CycleCheck check{.servo = servo,
                   .reference_amplitude = static_cast<double>(expected.amplitude),
                   .reference_period = static_cast<double>(expected.period),
                   .library_amplitude = std::numeric_limits<double>::quiet_NaN(),
                   .library_period = std::numeric_limits<double>::quiet_NaN(),
                   .agrees = false};
  // The run can only settle on a stable cycle; of several, it is compared with the nearest.
  for (const LimitCycle& cycle : analyse_limit_cycles(servo).cycles) {
    const double now = std::abs(cycle.amplitude - check.reference_amplitude);
    const double before = std::abs(check.library_amplitude - check.reference_amplitude);
    if (!cycle.stable || now >= before) continue;
    check.library_amplitude = cycle.amplitude;
    check.library_period = cycle.period;
  }
  check.agrees = close(check.library_amplitude, check.reference_amplitude) &&
                 close(check.library_period, check.reference_period);
  return check;
}

}  // namespace

std::vector<CycleCheck> check_known_cycles() {
  struct Row {
    double damping, inertia_ratio, friction_ratio, restitution;
    Extended until;  ///< long enough for the multiplier (in the last row 0.993 a period) to die out
  };
  constexpr Row rows[] = {{0.19, 2, 0.1, 0, 1000},   {0.2, 4, 0.25, 0, 1000},
                          {0.1, 1, 0.2, 0, 1000},    {0.1, 0.25, 0.2, 0, 1000},
                          {0.19, 2, 0.1, 0.3, 1000}, {0.19, 2, 0.1, 0.6, 30'000}};
  std::vector<CycleCheck> checks;
  for (const Row& row : rows) {
    checks.push_back(check_cycle({.damping = row.damping,
                                  .inertia_ratio = row.inertia_ratio,
                                  .friction_ratio = row.friction_ratio,
                                  .backlash = 0.3,
                                  .restitution = row.restitution},
                                 row.until));
  }
  return checks;
}

IrregularCheck check_irregular_motion() {
  constexpr Extended transient = 500;
  const NormalizedServo servo{.damping = 0.19,
                              .inertia_ratio = 2,
                              .friction_ratio = 0.1,
                              .backlash = 0.3,
                              .restitution = 0.9};
  ReferenceSimulator<ExponentialPropagator> simulator(servo, ExponentialPropagator(servo));
  ServoState start;
  start.motor_position = servo.backlash / 2.0;
  const ReferenceRun run = simulator.run(start, {.until = 5000, .reference = 1});
  Extended high = -std::numeric_limits<Extended>::infinity();
  Extended low = -high;
  for (const ReferenceEvent& event : run.events) {
    if (event.time < transient) continue;
    high = std::max(high, event.after.load_position);
    low = std::min(low, event.after.load_position);
  }
  const LimitCycleAnalysis analysis = analyse_limit_cycles(servo);
  IrregularCheck check{.servo = servo,
                       .reference_amplitude = static_cast<double>((high - low) / 2),
                       .library_amplitude = analysis.irregular_amplitude,
                       .agrees = false};
  check.agrees = analysis.verdict == Verdict::hunts_irregularly &&
                 std::abs(check.library_amplitude - check.reference_amplitude) <=
                     0.01 * check.reference_amplitude;
  return check;
}

}  // namespace gearlash::oracle
