#include "closed_form/closed_answer.hpp"

#include <cmath>

#include "base/interval.hpp"
#include "base/number.hpp"
#include "base/special_numbers.hpp"
#include "closed_form/drive_box.hpp"

namespace gearlash {
namespace {

Cycle cycle_of(const LimitCycle& found, Certainty certainty, double time_unit,
               const std::optional<double>& stiffness) {
  Cycle cycle;
  cycle.kind = found.kind;
  cycle.stability = found.stable ? Stability::stable : Stability::unstable;
  cycle.certainty = certainty;
  cycle.amplitude = found.amplitude;
  cycle.error = found.amplitude;
  cycle.motor_amplitude = found.motor_amplitude;
  cycle.period = found.period * time_unit;
  cycle.multiplier = found.multiplier;
  cycle.residual = found.residual;
  cycle.impact_speed = found.impact_speed / time_unit;
  cycle.engaged_time = found.engaged_time * time_unit;
  cycle.separated_time = found.separated_time * time_unit;
  cycle.events_per_period = found.impacts_per_period;
  cycle.settles = found.settles;
  if (stiffness) cycle.mesh_torque = found.mesh_torque * *stiffness;
  if (stiffness && !std::isnan(found.energy.total())) {
    const double unit = *stiffness;
    cycle.energy = EnergyBalance{.motor = found.energy.total() * unit,
                                 .motor_friction = found.energy.motor_friction * unit,
                                 .load_friction = found.energy.load_friction * unit,
                                 .impacts = found.energy.impacts * unit};
  }
  return cycle;
}

/// Factors from the normal form to SI, with the error of the data.
struct Scales {
  Interval backlash;
  Interval time_unit;
};

Scales scales_of(const Drive& drive, const ProportionalServo& servo, const DriveBox& box) {
  if (!servo.is_as_given) return {Interval(box.backlash), Interval(box.time_unit)};
  // They may have units; 1 is what they are without a backlash and a natural frequency.
  const auto known_number = [&](double number) {
    return number == 1.0 && !drive.is_rounded ? Interval(1.0) : AsWritten()(number);
  };
  return {known_number(servo.servo.backlash),
          Interval(1.0) / known_number(servo.natural_frequency)};
}

Bounds scaled(const Bounds& bounds, const Interval& unit) {
  return (Interval(bounds) * unit).bounds();
}

ProvedBounds bounds_of(const CycleBounds& bounds, const Scales& scales) {
  ProvedBounds proved{.growth_at_rest = bounds.growth_at_rest};
  if (!bounds.has_cycle) return proved;
  proved.has_cycle = true;
  proved.amplitude = scaled(bounds.amplitude, scales.backlash);
  proved.period = scaled(bounds.period, scales.time_unit);
  proved.multiplier = bounds.multiplier;
  return proved;
}

LimitCycleAnalysis enclosed_cycles(const Drive& drive, const ProportionalServo& servo,
                                   const DriveBox& box) {
  if (servo.is_as_given) return enclose_limit_cycles(servo.servo, reading_of(drive));
  return enclose_limit_cycles(servo.servo, box.servo);
}

}  // namespace

Answer answer_of(const LimitCycleAnalysis& analysis, const ProportionalServo& servo) {
  const double time_unit = 1.0 / servo.natural_frequency;
  const NormalizedServo& normal = servo.servo;
  Answer answer;
  answer.verdict = analysis.verdict;
  answer.certainty = analysis.certainty;
  answer.completeness = analysis.certainty;
  answer.engine = Engine::closed_form;
  answer.normal_form = NormalFormNumbers{.damping = normal.damping,
                                         .inertia_ratio = normal.inertia_ratio,
                                         .friction_ratio = normal.friction_ratio,
                                         .backlash = normal.backlash,
                                         .restitution = normal.restitution,
                                         .natural_frequency = servo.natural_frequency,
                                         .stiffness = servo.stiffness};
  answer.growth_at_rest = known(analysis.growth_at_rest);
  answer.is_dissipative = analysis.is_dissipative;
  answer.rests_engaged = analysis.rests_engaged;
  answer.neutral_swings = analysis.neutral_swings;
  const bool may_rest = analysis.verdict == Verdict::cannot_hunt ||
                        analysis.verdict == Verdict::hunts_if_disturbed || analysis.rests_engaged;
  if (may_rest) {  // at the reference, with the motor anywhere in the gap
    const double half_gap = 0.5 * servo.servo.backlash;
    answer.rest = Rest{.motor = {-half_gap, half_gap}, .certainty = Certainty::computed};
  }
  const Certainty of_cycles = analysis.is_proved() ? analysis.certainty : Certainty::computed;
  for (const LimitCycle& cycle : analysis.cycles) {
    answer.cycles.push_back(cycle_of(cycle, of_cycles, time_unit, servo.stiffness));
  }
  if (const auto amplitude = known(analysis.irregular_amplitude)) {
    answer.irregular.push_back({.amplitude = *amplitude, .error = *amplitude});
  }
  return answer;
}

Answer answer_of(const ProportionalServo& servo) {
  return answer_of(analyse_limit_cycles(servo.servo), servo);
}

ClosedAnswer closed_answer(const Drive& drive, const ProportionalServo& servo, bool proofs) {
  const DriveBox box = box_of(drive, servo);
  ClosedAnswer found{.cycles = proofs ? enclosed_cycles(drive, servo, box)
                                      : analyse_limit_cycles(servo.servo)};
  found.answer = answer_of(found.cycles, servo);
  if (found.cycles.bounds) {
    found.answer.bounds = bounds_of(*found.cycles.bounds, scales_of(drive, servo, box));
  }
  return found;
}

AnswerBounds bounds_of(const DriveBox& box, double guessed_flight_time) {
  const CycleBounds cycles = bound_cycles(box.servo, guessed_flight_time);
  AnswerBounds bounds;
  bounds.may_hunt = !cycles.none_hunt() && box.backlash.high != 0.0;
  bounds.may_rest = !cycles.all_hunt() || box.backlash.low == 0.0;
  bounds.may_run_away = bounds.may_hunt && !cycles.has_cycle;
  const Interval amplitude = Interval(box.backlash) * Interval(cycles.amplitude);
  const Interval period = Interval(cycles.period) * Interval(box.time_unit);
  bounds.quantities = {{Quantity::growth_at_rest, cycles.growth_at_rest},
                       {Quantity::amplitude, amplitude.bounds()},
                       {Quantity::period, period.bounds()},
                       {Quantity::frequency, Interval(1.0 / period).bounds()}};
  return bounds;
}

double flight_time_of(const Answer& answer) {
  const Cycle* cycle = answer.largest_stable();
  if (cycle == nullptr || !answer.normal_form) return not_a_number;
  return 0.5 * cycle->separated_time * answer.normal_form->natural_frequency;
}

}  // namespace gearlash
