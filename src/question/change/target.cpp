#include "question/change/target.hpp"

#include <algorithm>
#include <cmath>

#include "base/lists.hpp"
#include "base/range_check.hpp"
#include "question/analyse.hpp"

namespace gearlash {
namespace {

/// The judgement of numbers that lie within `bounds`.
Judgement judge(const Bounds& limits, const Bounds& bounds) {
  if (bounds.low >= limits.low && bounds.high <= limits.high) return Judgement::all;
  if (bounds.high < limits.low || bounds.low > limits.high) return Judgement::none;
  return Judgement::some;
}

bool has_limits_of(const Target& target, QuantityScope scope) {
  return any_of(target.limits,
                [&](const QuantityLimit& limit) { return info_of(limit.quantity).scope == scope; });
}

bool asks_for_motion(const Target& target) { return has_limits_of(target, QuantityScope::motion); }

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

/// Beside running away too.
bool hunts_if_disturbed(const Answer& answer) {
  const bool is_led_there = answer.search && answer.search->count("cycle") > 0;
  return answer.verdict == Verdict::hunts_if_disturbed || !answer.irregular.empty() ||
         (is_led_there && answer.largest_stable() != nullptr);
}

bool permits_verdict(const Target& target, const Answer& answer) {
  if (asks_for_rest(target) && is_unstable(answer.verdict)) return false;
  if (target.no_hunting_if_disturbed && hunts_if_disturbed(answer)) return false;
  return !target.no_runaway || !runs_away(answer);
}

/// Whether the limit does not apply: a drive at rest has no frequency.
bool is_idle(Verdict verdict, Quantity quantity) {
  return is_at_rest(verdict) && quantity != Quantity::amplitude &&
         quantity != Quantity::motor_amplitude && info_of(quantity).scope == QuantityScope::motion;
}

/// The value that an upper limit is for. Of an amplitude it is the largest of all motions that are
/// not unstable, irregular ones beside stable cycles included.
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

/// Whether the response to a step is unknown, or was not followed to its end.
bool is_cut_short(const Answer& answer) { return !answer.step || !answer.step->is_whole; }

/// As a target is typed.
std::string written(Quantity quantity) {
  std::string name(name_of(quantity));
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

Judgement both(Judgement a, Judgement b) { return std::min(a, b); }
Judgement either(Judgement a, Judgement b) { return a == b ? a : Judgement::some; }

/// The judgement of one limit over all drives that it applies to.
Judgement judge(const QuantityLimit& limit, const AnswerBounds& bounds) {
  const std::optional<Bounds> of = bounds.of(limit.quantity);
  return of ? judge(limit.permitted, *of) : Judgement::some;
}

/// The limits of motion, or all others.
Judgement judge_limits(const Target& target, const AnswerBounds& bounds, bool of_motion) {
  Judgement judgement = Judgement::all;
  for (const QuantityLimit& limit : target.limits) {
    if ((info_of(limit.quantity).scope == QuantityScope::motion) != of_motion) continue;
    judgement = both(judgement, judge(limit, bounds));
  }
  return judgement;
}

/// The judgement of those drives of the box that hunt.
Judgement judge_hunting(const Target& target, const AnswerBounds& bounds) {
  if (asks_for_rest(target)) return Judgement::none;
  const bool is_open = target.no_runaway && bounds.may_run_away;
  return both(is_open ? Judgement::some : Judgement::all, judge_limits(target, bounds, true));
}

Judgement judge_resting(const Target& target) {
  const auto may_be_0 = [&](Quantity amplitude) {
    return target.permitted(amplitude).contains(0.0);
  };
  return may_be_0(Quantity::amplitude) && may_be_0(Quantity::motor_amplitude) ? Judgement::all
                                                                              : Judgement::none;
}

}  // namespace

bool hides_error(const Target& target, double error) {
  for (const Quantity quantity :
       {Quantity::error, Quantity::error_if_disturbed, Quantity::static_error}) {
    if (target.permitted(quantity).high < infinity) return false;
  }
  constexpr double rounding = 1.0 + 1e-9;
  return error > rounding * target.permitted(Quantity::amplitude).high;
}

Wanted wanted_for(const Target& target) {
  Wanted wanted{.proofs = false, .borders = asks_for_motion(target)};
  for (const QuantityLimit& limit : target.limits) ask_for(limit.quantity, wanted);
  return wanted;
}

bool is_empty(const Target& target) { return target == Target{}; }

bool asks_for_rest(const Target& target) {
  return target.no_hunting || target.no_hunting_if_disturbed;
}

TargetParts parts_of(const Target& target, bool (*is_chosen)(Quantity)) {
  TargetParts parts{.chosen = target};
  parts.chosen.limits.clear();
  for (const QuantityLimit& limit : target.limits) {
    (is_chosen(limit.quantity) ? parts.chosen : parts.others).limits.push_back(limit);
  }
  return parts;
}

bool is_of_boxes(Quantity quantity) {
  return quantity == Quantity::growth_at_rest || quantity == Quantity::amplitude ||
         quantity == Quantity::frequency;
}

bool is_of_boxes(const Target& target) {
  return all_of(target.limits,
                [](const QuantityLimit& limit) { return is_of_boxes(limit.quantity); });
}

std::vector<Fault> faults_of_boxes(const Target& target) {
  std::vector<Fault> found = faults(target);
  for (const QuantityLimit& limit : target.limits) {
    if (is_of_boxes(limit.quantity)) continue;
    found.push_back({"target", written(limit.quantity),
                     "must be growth-at-rest, amplitude, frequency or period where the closed form "
                     "answers"});
  }
  return found;
}

bool is_ruled_out(const Target& target, double growth_at_rest) {
  if (asks_for_rest(target) && growth_at_rest > 1.0) return true;
  const Bounds permitted = target.permitted(Quantity::growth_at_rest);
  return permitted != Target{}.permitted(Quantity::growth_at_rest) &&
         !permitted.contains(growth_at_rest);
}

bool is_missed(const Target& target, const Answer& answer) {
  if (is_at_rest(answer.verdict)) return false;
  const std::optional<double> growth = answer.value(Quantity::growth_at_rest);
  return !permits_verdict(target, answer) || (growth && is_ruled_out(target, *growth));
}

bool is_met(const Target& target, const Answer& answer) {
  if (is_missed(target, answer) || !is_known(target, answer)) return false;
  return all_of(target.limits, [&](const QuantityLimit& limit) {
    if (is_idle(answer.verdict, limit.quantity)) return true;
    const std::optional<double> value = answer.value(limit.quantity);
    return value && *value >= limit.permitted.low &&
           *highest_value(answer, limit.quantity) <= limit.permitted.high;
  });
}

bool is_known(const Target& target, const Answer& answer) {
  if (is_missed(target, answer)) return true;
  if (has_limits_of(target, QuantityScope::step) && is_cut_short(answer)) return false;
  switch (answer.verdict) {
    case Verdict::undecided:
      return !asks_for_rest(target) && !target.no_runaway && !asks_for_motion(target);
    case Verdict::hunts_irregularly:
      return !asks_for_motion(target) || answer.value(Quantity::amplitude).has_value();
    default:
      return true;
  }
}

double excess(const Target& target, const Answer& answer) {
  double worst = -infinity;
  if (asks_for_rest(target)) {
    const double growth = std::log(answer.value(Quantity::growth_at_rest).value_or(not_a_number));
    // A cycle beside a stable rest has no known distance to the target; 1 means far.
    worst = growth > 0.0 || permits_verdict(target, answer) ? std::fmax(growth, -infinity) : 1.0;
  } else if (!permits_verdict(target, answer)) {
    worst = 1.0;
  }
  for (const QuantityLimit& limit : target.limits) {
    if (is_idle(answer.verdict, limit.quantity)) continue;
    worst = std::max(worst, excess_of(limit.permitted, answer.value(limit.quantity),
                                      highest_value(answer, limit.quantity)));
  }
  return worst;
}

Judgement judge(const Target& target, const AnswerBounds& bounds) {
  const Judgement of_drive = judge_limits(target, bounds, false);
  if (of_drive == Judgement::none) return of_drive;
  if (!bounds.may_hunt) return both(of_drive, judge_resting(target));
  const Judgement hunting = judge_hunting(target, bounds);
  if (!bounds.may_rest) return both(of_drive, hunting);
  return both(of_drive, either(hunting, judge_resting(target)));
}

Bounds Target::permitted(Quantity quantity) const {
  const QuantityLimit* limit =
      first_of(limits, [&](const QuantityLimit& one) { return one.quantity == quantity; });
  return limit != nullptr ? limit->permitted : Bounds{-infinity, infinity};
}

Target& Target::require(Quantity quantity, const Bounds& permitted) {
  const auto is_known = [&](const QuantityLimit& limit) { return limit.quantity == quantity; };
  if (QuantityLimit* known = first_of(limits, is_known)) {
    known->permitted.low = std::max(known->permitted.low, permitted.low);
    known->permitted.high = std::min(known->permitted.high, permitted.high);
  } else {
    limits.push_back({quantity, permitted});
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
