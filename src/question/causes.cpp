#include "question/causes.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "base/lists.hpp"
#include "base/overloaded.hpp"
#include "base/range_check.hpp"
#include "model/firmware.hpp"
#include "model/quantities.hpp"
#include "model/reduced_drive.hpp"
#include "question/analyse.hpp"

namespace gearlash {
namespace {

constexpr double share_of_gap = 1e-3;
constexpr Cause all_causes[] = {Cause::gap,   Cause::dry_friction, Cause::integral_action,
                                Cause::delay, Cause::encoder,      Cause::load_torque};

void take_gap(Drive& drive) {
  (drive.servo ? drive.servo->backlash : drive.gearbox.backlash) *= share_of_gap;
}

void take_dry_friction(Drive& drive) {
  drive.motor.no_load_current.reset();
  for (Friction* friction : {&drive.motor.friction, &drive.load.friction}) {
    *friction = {.viscous = friction->viscous};
  }
}

void take_integral_action(Drive& drive) {
  drive = without_registers(drive);
  std::visit(
      Overloaded{[](PID& law) {
                   law.integral = law.tracking_time = 0.0;
                   if (law.terms == PIDTerms::PI) law.terms = PIDTerms::P;
                   if (law.terms == PIDTerms::PID) law.terms = PIDTerms::PD;
                 },
                 [](CascadeController& law) { law.speed_integral = law.tracking_time = 0.0; },
                 [](auto&) {}},
      drive.controller.law);
}

void take_delay(Drive& drive) {
  if (!drive.sampling) return;
  Drive continuous = drive;
  continuous.sampling.reset();
  const drive::ReducedDrive reduced = reduce(drive);
  const bool reads_steps =
      reduced.sensing.resolution > 0.0 || reduced.sensing.resolution_of_speed > 0.0;
  if (!reads_steps && !drive.controller.firmware && faults(continuous).empty()) {
    drive = std::move(continuous);
  } else {
    drive.sampling->delay = 0.0;
  }
}

void take(Cause cause, Drive& drive) {
  switch (cause) {
    case Cause::gap:
      return take_gap(drive);
    case Cause::dry_friction:
      return take_dry_friction(drive);
    case Cause::integral_action:
      return take_integral_action(drive);
    case Cause::delay:
      return take_delay(drive);
    case Cause::encoder:
      drive.sensor.encoder = drive.sensor.speed_encoder = {};
      return;
    case Cause::load_torque:
      drive.load_torque.reset();
      drive.load.gravity = 0.0;
  }
}

/// In the gap without a cause.
drive::ShaftStates fitted(drive::ShaftStates start, Cause cause) {
  const double apart = start.motor_position - start.load_position;
  if (cause == Cause::gap) start.motor_position = start.load_position + share_of_gap * apart;
  return start;
}

/// The first starts decide Quantity::error: the smallest displacements. The others swing.
struct TellingStarts {
  std::vector<drive::ShaftStates> all{};
  std::size_t smallest = 0;
  std::vector<drive::ShaftStates> running_away{};  ///< the nearest
};

TellingStarts telling_starts(const Analysis& analysis) {
  TellingStarts starts;
  if (!analysis.search || !analysis.answer.search) return starts;
  const std::vector<drive::Outcome>& outcomes = analysis.search->outcomes;
  starts.all = of_each(smallest_starts(*analysis.answer.search),
                       [&](std::size_t i) { return outcomes[i].start; });
  starts.smallest = starts.all.size();
  const auto* const away = first_of(outcomes, [](const drive::Outcome& outcome) {
    return outcome.end == drive::MotionEnd::diverges;
  });
  if (away != nullptr) starts.running_away = {away->start};
  const auto swinging =
      those_of(outcomes, [](const drive::Outcome& outcome) { return swings(outcome.end); });
  if (swinging.empty()) return starts;
  starts.all.push_back(swinging.back().start);
  if (swinging.size() > 2) starts.all.push_back(swinging[swinging.size() / 2].start);
  return starts;
}

double extent_of(const Answer& answer) {
  double extent = 0.0;
  for (const Cycle& cycle : answer.cycles) {
    if (cycle.stability == Stability::unstable) continue;
    extent = std::max({extent, cycle.amplitude, cycle.motor_amplitude});
  }
  for (const IrregularMotion& motion : answer.irregular) {
    extent = std::max({extent, motion.amplitude, motion.motor_amplitude.value_or(0.0)});
  }
  return extent;
}

/// Whether swings shrank with the gap.
bool has_shrunk(const Answer& without_gap, const Answer& own) {
  constexpr double clearly = 10.0;
  return hunts(without_gap.verdict) &&
         extent_of(without_gap) <= clearly * share_of_gap * extent_of(own);
}

Fulfilment fulfilment(const std::optional<double>& error, double permitted) {
  if (!error) return Fulfilment::not_known;
  return *error <= permitted ? Fulfilment::met : Fulfilment::not_met;
}

/// The tracking time that anti-windup is usually given, s: the integral time of the law, which the
/// member belongs to.
struct AntiWindup {
  double* tracking_time = nullptr;
  double integral_time = 0.0;
};

AntiWindup missing_anti_windup(Drive& drive) {
  if (drive.controller.firmware) return {};
  return std::visit(
      Overloaded{[](PID& law) {
                   const bool winds_up = law.integral > 0.0 && law.tracking_time == 0.0;
                   return winds_up ? AntiWindup{&law.tracking_time, law.proportional / law.integral}
                                   : AntiWindup{};
                 },
                 [](CascadeController& law) {
                   const bool winds_up = law.speed_integral > 0.0 && law.tracking_time == 0.0;
                   return winds_up ? AntiWindup{&law.tracking_time, law.speed / law.speed_integral}
                                   : AntiWindup{};
                 },
                 [](auto&) { return AntiWindup{}; }},
      drive.controller.law);
}

bool runs_away(Verdict verdict) {
  return verdict == Verdict::runs_away || verdict == Verdict::runs_away_if_disturbed;
}

}  // namespace

std::optional<Note> note_on_wind_up(const Drive& drive, const Analysis& analysis,
                                    Progress& progress) {
  const TellingStarts starts = telling_starts(analysis);
  const Without* proportional = first_of(analysis.answer.without, [](const Without& one) {
    return one.cause == Cause::integral_action;
  });
  const bool is_unstable = analysis.answer.loop && !analysis.answer.loop->is_stable;
  if (is_unstable || starts.running_away.empty() || proportional == nullptr ||
      runs_away(proportional->verdict)) {
    return std::nullopt;
  }
  std::string text =
      "The drive winds up: its integral grows while the torque is at its limit, and throws it "
      "farther than it came from. Anti-windup is the cure";
  Drive cured = drive;
  const AntiWindup missing = missing_anti_windup(cured);
  if (missing.tracking_time != nullptr && missing.integral_time > 0.0) {
    *missing.tracking_time = missing.integral_time;
    const Verdict verdict = analyse_in_full(cured, {.proofs = false, .borders = false}, progress,
                                            {.starts = starts.running_away})
                                .answer.verdict;
    if (is_at_rest(verdict)) {
      text += ": with controller.tracking_time = \"" + exact_text(1e3 * missing.integral_time) +
              " ms\", the integral time, it comes to rest after the same step";
    }
  }
  return Note{"wind-up", text + "."};
}

std::optional<Drive> without(const Drive& drive, Cause cause) {
  Drive changed = drive;
  take(cause, changed);
  // A drive without registers is the same drive.
  const Drive& same = cause == Cause::integral_action ? without_registers(drive) : drive;
  if (changed == same || !faults(changed).empty()) return std::nullopt;
  return changed;
}

std::vector<Without> without_causes(const Drive& drive, const Analysis& analysis,
                                    const Wanted& wanted, Progress& progress) {
  const TellingStarts starts = telling_starts(analysis);
  SearchScope scope;
  scope.is_enough = [&](const drive::AttractorSearch& so_far) {
    const std::size_t done = count_of(so_far.outcomes, [](const drive::Outcome& outcome) {
      return outcome.watched > 0.0 || outcome.end != drive::MotionEnd::undecided;
    });
    return done >= starts.smallest && so_far.swings();
  };
  scope.may_hurry = [](const drive::AttractorSearch&) { return true; };
  std::vector<Without> all;
  for (const Cause cause : all_causes) {
    const std::optional<Drive> changed = without(drive, cause);
    if (!changed) continue;
    scope.starts = of_each(starts.all, [&](const auto& start) { return fitted(start, cause); });
    if (cause == Cause::integral_action) add_all(scope.starts, starts.running_away);
    const Answer answer =
        analyse_in_full(*changed,
                        {.proofs = false, .borders = false, .motion_bytes = wanted.motion_bytes},
                        progress, scope)
            .answer;
    if (answer.search && !answer.search->is_complete) break;
    Without one{cause, answer.verdict, answer.value(Quantity::error)};
    if (cause == Cause::gap && has_shrunk(answer, analysis.answer)) {
      one.verdict = Verdict::comes_to_rest;
    }
    all.push_back(one);
  }
  return all;
}

std::optional<bool> is_quantization(const Answer& answer) {
  std::optional<double> steps;
  if (const Cycle* cycle = answer.largest_stable()) {
    steps = cycle->encoder_steps;
  } else if (!answer.irregular.empty()) {
    steps = answer.irregular.front().encoder_steps;
  }
  if (!steps || *steps > steps_of_quantization || answer.verdict == Verdict::forced) {
    return std::nullopt;
  }
  const Without* exact =
      first_of(answer.without, [](const Without& one) { return one.cause == Cause::encoder; });
  if (exact == nullptr || exact->verdict == Verdict::undecided) return std::nullopt;
  return !hunts(exact->verdict);
}

std::optional<SpecificationAnswer> judged_specification(const Drive& drive, const Answer& answer) {
  if (!drive.specification.error) return std::nullopt;
  const double permitted = *drive.specification.error;
  const std::optional<double> error = answer.value(Quantity::error);
  SpecificationAnswer judged{
      .permitted = permitted,
      .small = fulfilment(error, permitted),
      .if_disturbed = fulfilment(answer.value(Quantity::error_if_disturbed), permitted)};
  if (judged.small != Fulfilment::not_met) return judged;
  judged.excess = *error - permitted;
  double least = *error;
  for (const Without& one : answer.without) {
    if (!one.error || !(*one.error < least)) continue;
    least = *one.error;
    judged.cause = one.cause;
  }
  return judged;
}

}  // namespace gearlash
