#include "analysis/design/target.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/analyse.hpp"
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

bool asks_for_rest(const Target& target) {
  return target.no_hunting || target.no_hunting_if_disturbed;
}

bool asks_for_motion(const Target& target) {
  return std::any_of(target.limits.begin(), target.limits.end(), [](const QuantityLimit& limit) {
    return info_of(limit.quantity).scope == QuantityScope::motion;
  });
}

/// Whether small disturbances do not die down.
bool is_unstable(Verdict verdict) {
  switch (verdict) {
    case Verdict::hunts:
    case Verdict::hunts_irregularly:
    case Verdict::grows_without_bound:
    case Verdict::runs_away:
    case Verdict::forced:
    case Verdict::undamped:
      return true;
    default:
      return false;
  }
}

bool runs_away(const Performance& performance) {
  return performance.verdict == Verdict::grows_without_bound;
}

bool runs_away(const Answer& answer) {
  switch (answer.verdict) {
    case Verdict::runs_away:
    case Verdict::runs_away_if_disturbed:
    case Verdict::grows_without_bound:
      return true;
    default:
      return answer.search && answer.search->count("diverges") > 0;
  }
}

bool hunts_if_disturbed(const Performance& performance) {
  return performance.verdict == Verdict::hunts_if_disturbed;
}

/// Beside running away too.
bool hunts_if_disturbed(const Answer& answer) {
  const bool is_led_there = answer.search && answer.search->count("cycle") > 0;
  return answer.verdict == Verdict::hunts_if_disturbed || !answer.irregular.empty() ||
         (is_led_there && answer.largest_stable() != nullptr);
}

template <class Judged>
bool permits_verdict(const Target& target, const Judged& judged) {
  if (asks_for_rest(target) && is_unstable(judged.verdict)) return false;
  if (target.no_hunting_if_disturbed && hunts_if_disturbed(judged)) return false;
  return !target.no_runaway || !runs_away(judged);
}

/// Whether the verdict or growth at rest alone shows that the target is missed.
template <class Judged>
bool is_missed(const Target& target, const Judged& judged) {
  if (is_at_rest(judged.verdict)) return false;
  const std::optional<double> growth = judged.value(Quantity::growth_at_rest);
  return !permits_verdict(target, judged) || (growth && is_ruled_out(target, *growth));
}

/// Whether the limit does not apply: a drive at rest has no frequency.
bool is_idle(Verdict verdict, Quantity quantity) {
  return is_at_rest(verdict) && quantity != Quantity::amplitude &&
         quantity != Quantity::motor_amplitude && info_of(quantity).scope == QuantityScope::motion;
}

/// The value that an upper limit is for. Of an amplitude it is the largest of all motions that are
/// not unstable, irregular ones beside stable cycles included.
std::optional<double> highest_value(const Performance& performance, Quantity quantity) {
  return performance.value(quantity);
}

std::optional<double> highest_value(const Answer& answer, Quantity quantity) {
  std::optional<double> value = answer.value(quantity);
  const bool is_of_motor = quantity == Quantity::motor_amplitude;
  if (!value || (!is_of_motor && quantity != Quantity::amplitude)) return value;
  for (const Cycle& cycle : answer.cycles) {
    if (cycle.stability == Stability::unstable) continue;
    value = std::max(*value, is_of_motor ? cycle.motor_amplitude : cycle.amplitude);
  }
  for (const IrregularMotion& motion : answer.irregular) {
    value = std::max(*value, is_of_motor ? motion.motor_amplitude.value_or(0.0) : motion.amplitude);
  }
  return value;
}

/// The excess of one quantity. `highest`: the value that the upper limit is for.
double excess_of(const Bounds& limits, const std::optional<double>& value,
                 const std::optional<double>& highest) {
  if (!value) return infinity;
  const auto beyond = [](double more, double less) {
    if (more == less) return 0.0;
    if (more >= 0.0 && less >= 0.0) return std::log(more / less);
    return more > less ? 1.0 : -1.0;  // no ratio
  };
  const double above = std::isinf(limits.high) ? -infinity : beyond(*highest, limits.high);
  const double below =
      std::isinf(limits.low) || limits.low == 0.0 ? -infinity : beyond(limits.low, *value);
  return std::max(above, below);
}

bool asks_for_step(const Target& target) {
  return std::any_of(target.limits.begin(), target.limits.end(), [](const QuantityLimit& limit) {
    return info_of(limit.quantity).scope == QuantityScope::step;
  });
}

/// Whether the response to a step is unknown, or was not followed to its end.
bool is_cut_short(const Performance&) { return false; }
bool is_cut_short(const Answer& answer) { return !answer.step || !answer.step->is_whole; }

/// As a target is typed.
std::string written(Quantity quantity) {
  std::string name(name_of(quantity));
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

Judgement both(Judgement a, Judgement b) { return std::min(a, b); }
Judgement either(Judgement a, Judgement b) { return a == b ? a : Judgement::some; }

/// The judgement of those drives of the box that hunt.
Judgement judge_hunting(const Target& target, const DriveBox& box, const CycleBounds& cycles) {
  if (asks_for_rest(target)) return Judgement::none;
  const Interval amplitude = Interval(box.backlash) * Interval(cycles.amplitude);
  const Interval frequency = 1.0 / (Interval(cycles.period) * Interval(box.time_unit));
  return both(judge(target.permitted(Quantity::amplitude), amplitude.bounds()),
              judge(target.permitted(Quantity::frequency), frequency.bounds()));
}

Judgement judge_quiet(const Target& target) {
  const bool may_be_quiet = target.permitted(Quantity::amplitude).contains(0.0);
  return may_be_quiet ? Judgement::all : Judgement::none;
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

std::optional<double> Performance::value(Quantity quantity) const {
  const auto known = [](double number) {
    return std::isnan(number) ? std::nullopt : std::optional(number);
  };
  switch (quantity) {
    case Quantity::growth_at_rest:
      return known(growth_at_rest);
    case Quantity::amplitude:
      return known(amplitude);
    case Quantity::frequency:
      return known(frequency);
    default:
      return std::nullopt;
  }
}

Wanted wanted_for(const Target& target, const Drive& base) {
  Wanted wanted{.proofs = false, .borders = asks_for_motion(target)};
  for (const QuantityLimit& limit : target.limits) ask_for(limit.quantity, base, wanted);
  return wanted;
}

bool is_of_performance(Quantity quantity) {
  return quantity == Quantity::growth_at_rest || quantity == Quantity::amplitude ||
         quantity == Quantity::frequency;
}

bool is_of_performance(const Target& target) {
  return std::all_of(target.limits.begin(), target.limits.end(),
                     [](const QuantityLimit& limit) { return is_of_performance(limit.quantity); });
}

std::vector<Fault> faults_for_performance(const Target& target) {
  std::vector<Fault> found = faults(target);
  for (const QuantityLimit& limit : target.limits) {
    if (is_of_performance(limit.quantity)) continue;
    found.push_back({"target", written(limit.quantity),
                     "must be growth-at-rest, amplitude, frequency or period where the closed form "
                     "answers",
                     ""});
  }
  return found;
}

bool is_ruled_out(const Target& target, double growth_at_rest) {
  if (asks_for_rest(target) && growth_at_rest > 1.0) return true;
  const Bounds permitted = target.permitted(Quantity::growth_at_rest);
  return permitted != Target{}.permitted(Quantity::growth_at_rest) &&
         !permitted.contains(growth_at_rest);
}

Performance performance_for(const Target& target, const Drivetrain& drive) {
  const NormalizedServo servo = normalize(drive);
  if (servo.restitution == 0.0 || servo.backlash == 0.0) return performance_of(drive);
  require_none(validate(servo));
  const double growth = growth_at_rest(servo_dynamics(servo));
  if (!is_ruled_out(target, growth)) return performance_of(drive);
  return {.verdict = growth > 1.0 ? Verdict::hunts : Verdict::undecided, .growth_at_rest = growth};
}

template <class Judged>
bool is_met(const Target& target, const Judged& judged) {
  if (is_missed(target, judged) || !is_known(target, judged)) return false;
  return std::all_of(target.limits.begin(), target.limits.end(), [&](const QuantityLimit& limit) {
    if (is_idle(judged.verdict, limit.quantity)) return true;
    const std::optional<double> value = judged.value(limit.quantity);
    return value && *value >= limit.permitted.low &&
           *highest_value(judged, limit.quantity) <= limit.permitted.high;
  });
}

template <class Judged>
bool is_known(const Target& target, const Judged& judged) {
  if (is_missed(target, judged)) return true;
  if (asks_for_step(target) && is_cut_short(judged)) return false;
  switch (judged.verdict) {
    case Verdict::undecided:
      return !asks_for_rest(target) && !target.no_runaway && !asks_for_motion(target);
    case Verdict::hunts_irregularly:
      return !asks_for_motion(target) || judged.value(Quantity::amplitude).has_value();
    default:
      return true;
  }
}

template <class Judged>
double excess(const Target& target, const Judged& judged) {
  double worst = -infinity;
  if (asks_for_rest(target)) {
    const double growth = std::log(judged.value(Quantity::growth_at_rest).value_or(not_a_number));
    // A cycle beside a stable rest has no known distance to the target; 1 means far.
    worst = growth > 0.0 || permits_verdict(target, judged) ? std::fmax(growth, -infinity) : 1.0;
  } else if (!permits_verdict(target, judged)) {
    worst = 1.0;
  }
  for (const QuantityLimit& limit : target.limits) {
    if (is_idle(judged.verdict, limit.quantity)) continue;
    worst = std::max(worst, excess_of(limit.permitted, judged.value(limit.quantity),
                                      highest_value(judged, limit.quantity)));
  }
  return worst;
}

template bool is_met(const Target&, const Performance&);
template bool is_met(const Target&, const Answer&);
template bool is_known(const Target&, const Performance&);
template bool is_known(const Target&, const Answer&);
template double excess(const Target&, const Performance&);
template double excess(const Target&, const Answer&);

Judgement judge(const Target& target, const DriveBox& box, double guessed_flight_time) {
  const CycleBounds cycles = bound_cycles(box.servo, guessed_flight_time);
  const Judgement growth = judge(target.permitted(Quantity::growth_at_rest), cycles.growth_at_rest);
  if (growth == Judgement::none) return growth;
  if (cycles.none_hunt() || box.backlash.high == 0.0) return both(growth, judge_quiet(target));
  const Judgement hunting = judge_hunting(target, box, cycles);
  if (cycles.all_hunt()) return both(growth, hunting);
  return both(growth, either(hunting, judge_quiet(target)));
}

Bounds Target::permitted(Quantity quantity) const {
  for (const QuantityLimit& limit : limits) {
    if (limit.quantity == quantity) return limit.permitted;
  }
  return {-infinity, infinity};
}

Target& Target::require(Quantity quantity, const Bounds& permitted) {
  const auto known = std::find_if(limits.begin(), limits.end(), [&](const QuantityLimit& limit) {
    return limit.quantity == quantity;
  });
  if (known == limits.end()) {
    limits.push_back({quantity, permitted});
  } else {
    known->permitted.low = std::max(known->permitted.low, permitted.low);
    known->permitted.high = std::min(known->permitted.high, permitted.high);
  }
  return *this;
}

Target always_at_rest() { return {.no_hunting = true, .no_hunting_if_disturbed = true}; }

std::vector<Fault> faults(const Target& target) {
  RangeCheck check;
  for (const QuantityLimit& limit : target.limits) {
    if (limit.permitted.low <= limit.permitted.high) continue;
    const std::string name = written(limit.quantity);
    std::string both = name + " >= " + exact_text(limit.permitted.low);
    both += " and " + name;
    both += " <= " + exact_text(limit.permitted.high);
    check.refuse("target", both, "must not contradict itself");
  }
  if (!asks_for_rest(target)) return check.faults();
  const std::string rest =
      target.no_hunting_if_disturbed ? "no-hunting-if-disturbed" : "no-hunting";
  if (const double low = target.permitted(Quantity::amplitude).low;
      low > 0.0 && target.no_hunting_if_disturbed) {
    check.refuse("target", rest + " and amplitude >= " + exact_text(low),
                 "must not contradict itself");
  }
  if (const double low = target.permitted(Quantity::growth_at_rest).low; low > 1.0) {
    check.refuse("target", rest + " and growth-at-rest >= " + exact_text(low),
                 "must not contradict itself: a servo with a growth at rest above 1 hunts");
  }
  return check.faults();
}

}  // namespace gearlash
