#include "analysis/design/target.hpp"

#include <algorithm>
#include <cmath>

#include "base/interval.hpp"
#include "base/range_check.hpp"
#include "closed_form/growth_at_rest.hpp"

namespace gearlash {
namespace {

/// The judgement of numbers that lie within `bounds`.
Judgement judge(const Bounds& limits, const Bounds& bounds) {
  if (bounds.low >= limits.low && bounds.high <= limits.high) return Judgement::all;
  if (bounds.high < limits.low || bounds.low > limits.high) return Judgement::none;
  return Judgement::some;
}

bool keeps_growth(const Target& target, double growth_at_rest) {
  return target.growth_at_rest == Target{}.growth_at_rest ||
         target.growth_at_rest.contains(growth_at_rest);
}

/// The excess of one quantity.
double excess_of(const Bounds& limits, double value) {
  const bool has_low = limits.low > 0.0;
  const bool has_high = !std::isinf(limits.high);
  if ((has_low || has_high) && std::isnan(value)) return infinity;
  const double above = has_high ? std::log(value / limits.high) : -infinity;
  const double below = has_low ? std::log(limits.low / value) : -infinity;
  return std::max(above, below);
}

Judgement both(Judgement a, Judgement b) { return std::min(a, b); }
Judgement either(Judgement a, Judgement b) { return a == b ? a : Judgement::some; }

/// The judgement of those drives of the box that hunt.
Judgement judge_hunting(const Target& target, const DriveBox& box, const CycleBounds& cycles) {
  if (target.no_hunting) return Judgement::none;
  const Interval amplitude = Interval(box.backlash) * Interval(cycles.amplitude);
  const Interval frequency = 1.0 / (Interval(cycles.period) * Interval(box.time_unit));
  return both(judge(target.amplitude, amplitude.bounds()),
              judge(target.frequency, frequency.bounds()));
}

Judgement judge_quiet(const Target& target) {
  return target.amplitude.contains(0.0) ? Judgement::all : Judgement::none;
}

}  // namespace

Performance performance_of(const Drivetrain& drive) {
  const LimitCycleAnalysis analysis = analyse_limit_cycles(normalize(drive));
  Performance performance{.verdict = analysis.verdict, .growth_at_rest = analysis.growth_at_rest};
  if (analysis.verdict == Verdict::cannot_hunt) performance.amplitude = 0.0;
  if (const LimitCycle* cycle = largest_stable(analysis)) {
    performance.amplitude = cycle->amplitude;
    performance.frequency = natural_frequency(drive) / cycle->period;
    performance.flight_time = 0.5 * cycle->separated_time;
  }
  return performance;
}

bool is_ruled_out(const Target& target, double growth_at_rest) {
  return (target.no_hunting && growth_at_rest > 1.0) || !keeps_growth(target, growth_at_rest);
}

Performance performance_for(const Target& target, const Drivetrain& drive) {
  const NormalizedServo servo = normalize(drive);
  if (servo.restitution == 0.0 || servo.backlash == 0.0) return performance_of(drive);
  require_none(validate(servo));
  const double growth = growth_at_rest(servo_dynamics(servo));
  if (!is_ruled_out(target, growth)) return performance_of(drive);
  return {.verdict = growth > 1.0 ? Verdict::hunts : Verdict::undecided, .growth_at_rest = growth};
}

bool is_met(const Target& target, const Performance& performance) {
  const bool is_quiet = performance.verdict == Verdict::cannot_hunt;
  if (target.no_hunting && !is_quiet) return false;
  return keeps_growth(target, performance.growth_at_rest) &&
         target.amplitude.contains(performance.amplitude) &&
         (is_quiet || target.frequency.contains(performance.frequency));
}

bool is_known(const Target& target, const Performance& performance) {
  if (is_ruled_out(target, performance.growth_at_rest)) return true;
  const bool asks_for_cycles =
      target.amplitude != Target{}.amplitude || target.frequency != Target{}.frequency;
  switch (performance.verdict) {
    case Verdict::undecided:
      return !target.no_hunting && !asks_for_cycles;
    case Verdict::hunts_irregularly:
      return target.no_hunting || !asks_for_cycles;
    default:
      return true;
  }
}

double excess(const Target& target, const Performance& performance) {
  const bool is_quiet = performance.verdict == Verdict::cannot_hunt;
  double worst = excess_of(target.growth_at_rest, performance.growth_at_rest);
  if (target.no_hunting) {
    // A cycle beside a stable rest has no known distance to the target; 1 means far.
    const double growth = std::log(performance.growth_at_rest);
    const bool is_disturbed = !is_quiet && !(growth > 0.0);
    worst = std::max(worst, is_disturbed ? 1.0 : growth);
  }
  worst = std::max(worst, excess_of(target.amplitude, performance.amplitude));
  if (!is_quiet) worst = std::max(worst, excess_of(target.frequency, performance.frequency));
  return worst;
}

Judgement judge(const Target& target, const DriveBox& box, double guessed_flight_time) {
  const CycleBounds cycles = bound_cycles(box.servo, guessed_flight_time);
  const Judgement growth = judge(target.growth_at_rest, cycles.growth_at_rest);
  if (growth == Judgement::none) return growth;
  if (cycles.none_hunt() || box.backlash.high == 0.0) return both(growth, judge_quiet(target));
  const Judgement hunting = judge_hunting(target, box, cycles);
  if (cycles.all_hunt()) return both(growth, hunting);
  return both(growth, either(hunting, judge_quiet(target)));
}

std::vector<Fault> faults(const Target& target) {
  RangeCheck check;
  const auto require_room = [&](const char* quantity, const Bounds& limits) {
    if (limits.low <= limits.high) return;
    check.refuse("target",
                 std::string(quantity) + " >= " + exact_text(limits.low) + " and " + quantity +
                     " <= " + exact_text(limits.high),
                 "must not contradict itself");
  };
  require_room("amplitude", target.amplitude);
  require_room("frequency", target.frequency);
  require_room("growth-at-rest", target.growth_at_rest);
  if (target.no_hunting && target.amplitude.low > 0.0) {
    check.refuse("target", "no-hunting and amplitude >= " + exact_text(target.amplitude.low),
                 "must not contradict itself");
  }
  if (target.no_hunting && target.growth_at_rest.low > 1.0) {
    check.refuse("target",
                 "no-hunting and growth-at-rest >= " + exact_text(target.growth_at_rest.low),
                 "must not contradict itself: a servo with a growth at rest above 1 hunts");
  }
  return check.faults();
}

}  // namespace gearlash
