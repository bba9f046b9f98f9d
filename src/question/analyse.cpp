#include "question/analyse.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "base/arithmetic.hpp"
#include "base/interval.hpp"
#include "base/lists.hpp"
#include "base/names.hpp"
#include "base/number.hpp"
#include "base/range_check.hpp"
#include "base/special_numbers.hpp"
#include "closed_form/closed_answer.hpp"
#include "closed_form/drive_box.hpp"
#include "general/attractors/search_setting.hpp"
#include "model/proportional_servo.hpp"
#include "question/causes.hpp"
#include "question/contradictions.hpp"
#include "question/drive_notes.hpp"
#include "question/loop/ceiling/ceiling.hpp"
#include "question/loop/energy/absence_by_energy.hpp"
#include "question/loop/energy/computed_rest.hpp"
#include "question/loop/energy/mesh_torque.hpp"
#include "question/loop/linear_loop.hpp"
#include "question/step_response.hpp"

namespace gearlash {
namespace {

// ---- search -------------------------------------------------------------------------------------

struct ContactTimes {
  double together = 0.0;
  double apart = 0.0;
};

/// Times with faces together and apart within a period.
ContactTimes contact_times(const drive::DriveSystem& system, const drive::FoundCycle& cycle) {
  ContactTimes times;
  double from = cycle.orbit.start_time;
  std::size_t mode = cycle.orbit.start.mode;
  const auto add = [&](double to) {
    const bool is_apart = system.modes.mode(mode).contact == drive::ContactState::apart;
    (is_apart ? times.apart : times.together) += to - from;
    from = to;
  };
  for (const hybrid::Event& event : cycle.orbit.events) {
    add(event.time);
    mode = event.mode_after;
  }
  add(cycle.orbit.start_time + cycle.orbit.period);
  return times;
}

Cycle cycle_of(const drive::FoundCycle& found, const drive::DriveSystem& system) {
  const ContactTimes times = contact_times(system, found);
  Cycle cycle;
  cycle.kind = found.is_symmetric ? CycleKind::symmetric : CycleKind::asymmetric;
  cycle.stability = found.stability;
  cycle.amplitude = found.amplitude;
  cycle.motor_amplitude = found.motor_amplitude;
  cycle.center = found.is_symmetric ? 0.0 : found.center;
  cycle.error = found.error;
  cycle.period = found.period();
  cycle.multiplier = found.multiplier;
  cycle.residual = found.orbit.residual;
  cycle.impact_speed = found.impact_speed;
  cycle.mesh_torque = found.mesh_torque;
  cycle.engaged_time = times.together;
  cycle.separated_time = times.apart;
  cycle.events_per_period = found.orbit.events.size();
  cycle.has_mirror_image = found.has_mirror_image;
  cycle.energy = found.energy;
  cycle.starts = found.starts;
  return cycle;
}

/// Peak to peak of the measured position, in steps. Both shafts swing together, or one alone.
std::optional<double> encoder_steps(const drive::ReducedDrive& drive, double load, double motor) {
  const drive::Sensing& sensing = drive.sensing;
  if (!(sensing.resolution > 0.0)) return std::nullopt;
  const double share = sensing.load_share_of_position;
  return 2.0 * (share * load + (1.0 - share) * motor) / sensing.resolution;
}

IrregularMotion irregular_of(const drive::IrregularFound& found) {
  // A motion of which too few swings were seen has no mean period, and perhaps an infinite
  // mismatch.
  const auto finite = [](double value) {
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  };
  return {.amplitude = found.amplitude,
          .motor_amplitude = found.motor_amplitude,
          .center = found.center,
          .error = found.error,
          .is_motor_alone = found.is_motor_alone,
          .mean_amplitude = finite(found.half_swing),
          .amplitude_deviation = finite(found.half_swing_deviation),
          .mean_period = finite(found.period),
          .period_deviation = finite(found.period_deviation),
          .mismatch = finite(found.mismatch),
          .exponent = found.exponent,
          .watched = found.watched,
          .starts = found.starts};
}

const char* name_of(drive::MotionEnd end) {
  constexpr Names<drive::MotionEnd::undecided> names("rest", "cycle", "irregular", "diverges",
                                                     "undecided");
  return names[end];
}

/// Takes equilibria for where it rests: the ends are those where no torque limit acts.
void add_pieces(const std::vector<RestPiece>& pieces, Rest& rest) {
  rest.pieces = pieces;
  rest.certainty = Certainty::computed;
  const auto acts = [](const RestPiece& piece) { return piece.kind == RestKind::torque_limit; };
  const bool all_are_limited = all_of(pieces, acts);
  Extent load;
  Extent motor;
  for (const RestPiece& piece : pieces) {
    if (acts(piece) && !all_are_limited) continue;
    load.include(piece.load);
    motor.include(piece.motor);
  }
  rest.load = load;
  rest.motor = motor;
  rest.error = {0.0 - load.high, 0.0 - load.low};  // no −0
}

RestPlace mirrored(const RestPlace& place) {
  RestPlace image = place;
  image.load = -place.load;
  if (place.motor) image.motor = -*place.motor;
  return image;
}

/// Whether a start came to rest there; or at the mirror image, of a drive that is its own.
bool is_reached(const RestPiece& piece, const drive::AttractorSearch& search, bool has_image) {
  return any_of(search.outcomes, [&](const auto& start) {
    return start.rest &&
           (may_hold(piece, *start.rest) || (has_image && may_hold(piece, mirrored(*start.rest))));
  });
}

std::optional<TimeToRest> time_of(const drive::AttractorSearch& search) {
  std::vector<double> times;
  for (const drive::Outcome& outcome : search.outcomes) {
    if (outcome.end != drive::MotionEnd::rest) continue;
    if (!outcome.time_to_rest) return std::nullopt;
    times.push_back(*outcome.time_to_rest);
  }
  if (times.empty()) return std::nullopt;
  std::sort(times.begin(), times.end());
  const double median = std::midpoint(times[(times.size() - 1) / 2], times[times.size() / 2]);
  return TimeToRest{search.band, times.back(), median};
}

/// The rest that starts led to, with all equilibria where they are known. Without dry friction,
/// which holds the shafts, those count that starts approach: small disturbances leave others. A
/// drive that creeps is still on its way to them.
Rest rest_of(const drive::AttractorSearch& search, const drive::ReducedDrive& reduced) {
  const drive::RestFound& found = *search.rest;
  Rest rest{.load = found.load,
            .motor = found.motor,
            .error = found.error,
            .starts = found.starts,
            .swing_ratio = known(found.swing_ratio),
            .creeping_starts = found.creeping_starts,
            .time = time_of(search)};
  std::vector<RestPiece> pieces = computed_rest(reduced);
  const bool has_image = drive::is_own_image(reduced);
  const auto reached = [&](const RestPiece& piece) { return is_reached(piece, search, has_image); };
  // Where none is reached the answer contradicts itself, and keeps what shows it.
  if (!drive::has_dry_friction(reduced) && any_of(pieces, reached)) {
    std::erase_if(pieces, std::not_fn(reached));
  }
  if (pieces.empty()) return rest;
  const Rest seen = rest;
  add_pieces(pieces, rest);
  if (found.creeping_starts == 0) return rest;
  widen(rest.load, seen.load);
  widen(rest.motor, seen.motor);
  rest.error = {0.0 - rest.load.high, 0.0 - rest.load.low};
  rest.certainty = Certainty::searched;
  return rest;
}

StartOutcome outcome_of(const drive::Outcome& found) {
  StartOutcome outcome{.load_position = found.start.load_position,
                       .load_speed = found.start.load_speed,
                       .motor_position = found.start.motor_position,
                       .motor_speed = found.start.motor_speed,
                       .end = name_of(found.end),
                       .watched = found.watched,
                       .reason = found.reason,
                       .rest = found.rest,
                       .time_to_rest = found.time_to_rest};
  if (swings(found.end)) outcome.which = found.which;
  return outcome;
}

/// The verdict that follows from the outcomes of the starts and the motions found. A few starts
/// that stay undecided, a tenth at most, are told beside it.
Verdict verdict_of(const drive::AttractorSearch& search, const drive::ReducedDrive& reduced,
                   const std::vector<IrregularMotion>& motions) {
  const bool rests = search.count(drive::MotionEnd::rest) > 0;
  const bool cycles = search.count(drive::MotionEnd::cycle) > 0;
  const bool swings = search.swings();
  const bool diverges = search.count(drive::MotionEnd::diverges) > 0;
  const std::size_t undecided = search.count(drive::MotionEnd::undecided);
  const bool is_open = undecided > 0 || !search.is_complete;
  constexpr std::size_t few = 10;
  const bool is_open_at_large = !search.is_complete || few * undecided > search.outcomes.size();
  if (swings && is_driven(reduced)) return Verdict::forced;
  if (swings && rests) return Verdict::hunts_if_disturbed;
  if (cycles || any_of(motions, [](const IrregularMotion& motion) { return motion.repeats(); }))
    return Verdict::hunts;
  if (swings) return Verdict::hunts_irregularly;
  // An undecided start may stay bounded, or hunt.
  if (diverges) return rests || is_open ? Verdict::runs_away_if_disturbed : Verdict::runs_away;
  return rests && !is_open_at_large ? Verdict::comes_to_rest : Verdict::undecided;
}

std::vector<Note> notes_of(const drive::AttractorSearch& search) {
  std::vector<Note> notes;
  if (search.coordinates == drive::Coordinates::co_moving) {
    notes.push_back({"co-moving", "The reference is a ramp. Positions are relative to it."});
  }
  if (search.coordinates == drive::Coordinates::in_place) {
    notes.push_back(
        {"in-place",
         "The reference is a ramp, and the encoder or the controller does not move with "
         "it. The motion was measured, and no cycle was closed."});
  }
  std::set<std::string> reasons;
  for (const drive::Outcome& outcome : search.outcomes) {
    if (outcome.end == drive::MotionEnd::undecided && !outcome.reason.empty()) {
      reasons.insert(outcome.reason);
    }
  }
  for (const std::string& reason : reasons) {
    notes.push_back({"undecided-start", "Undecided: " + reason + "."});
  }
  return notes;
}

/// Proved, without a search.
Answer answer_by_energy(const drive::ReducedDrive& reduced) {
  Answer answer;
  answer.verdict = Verdict::cannot_hunt;
  answer.certainty = Certainty::enclosed;
  answer.completeness = Certainty::enclosed;
  answer.engine = Engine::general;
  answer.is_dissipative = true;
  const std::vector<RestPiece> pieces = computed_rest(reduced);
  if (!pieces.empty()) add_pieces(pieces, answer.rest.emplace());
  return answer;
}

}  // namespace

Answer answer_of(const drive::AttractorSearch& search, const drive::ReducedDrive& reduced) {
  Answer answer;
  const drive::DriveSystem system = drive::drive_system(reduced);
  for (const drive::FoundCycle& cycle : search.cycles) {
    answer.cycles.push_back(cycle_of(cycle, system));
    answer.cycles.back().encoder_steps =
        encoder_steps(reduced, cycle.amplitude, cycle.motor_amplitude);
  }
  for (const drive::IrregularFound& motion : search.irregular) {
    answer.irregular.push_back(irregular_of(motion));
    answer.irregular.back().encoder_steps =
        encoder_steps(reduced, motion.amplitude, motion.motor_amplitude);
  }
  answer.verdict = verdict_of(search, reduced, answer.irregular);
  answer.rests_engaged = search.rests_until_disturbed;
  answer.thresholds = search.thresholds;
  if (search.rest) answer.rest = rest_of(search, reduced);
  answer.search = SearchRecord{.watch_time = search.watch_time,
                               .reference = drive::middle_of(reduced.reference),
                               .is_complete = search.is_complete,
                               .borders = search.edges.size(),
                               .starts = of_each(search.outcomes, outcome_of)};
  answer.notes = notes_of(search);
  return answer;
}

namespace {

bool has_limit(const drive::ReducedDrive& drive) {
  return std::isfinite(drive.torque_limit) || std::isfinite(drive.winding.torque_limit) ||
         drive.error_shape.is_limit();
}

/// Where the arithmetic is not that of proofs the data were read in it too.
void take_for_computed(Answer& answer) {
  const auto demote = [](Certainty& certainty) {
    certainty = std::min(certainty, Certainty::computed);
  };
  demote(answer.certainty);
  demote(answer.completeness);
  for (Cycle& cycle : answer.cycles) demote(cycle.certainty);
  answer.is_dissipative = false;
  answer.bounds.reset();
}

}  // namespace

bool is_decided(const Answer& answer) {
  if (answer.search && !answer.search->is_complete) return false;
  switch (answer.verdict) {
    case Verdict::hunts:
    case Verdict::hunts_if_disturbed:
    case Verdict::hunts_irregularly:
      return answer.largest_stable() != nullptr || !answer.irregular.empty();
    case Verdict::undecided:
      return false;
    default:
      return true;
  }
}

bool is_at_rest(Verdict verdict) {
  return verdict == Verdict::cannot_hunt || verdict == Verdict::comes_to_rest;
}

bool is_figure(Quantity quantity) {
  const QuantityScope scope = info_of(quantity).scope;
  return scope != QuantityScope::answer && scope != QuantityScope::motion;
}

void ask_for(Quantity quantity, Wanted& wanted) {
  switch (info_of(quantity).scope) {
    case QuantityScope::ceiling:
      wanted.ceiling = true;
      break;
    case QuantityScope::loop:
      wanted.loop = true;
      break;
    case QuantityScope::step:
      wanted.step = true;
      break;
    case QuantityScope::answer:
    case QuantityScope::motion:
      break;
  }
}

void add_figures(const SoundDrive& of, const Wanted& wanted, Answer& answer, Progress& progress) {
  if (wanted.ceiling) answer.ceiling = ceiling_of(of);
  const drive::ReducedDrive& drive = of.settled();
  // The closed form permits what cannot be followed: no gap, which the loop leaves out anyway, and
  // a shaft without inertia.
  drive::ReducedDrive with_gap = drive;
  if (drive.backlash == 0.0) with_gap.backlash = 1.0;
  if (wanted.loop && faults(with_gap).empty()) answer.loop = drive::loop_figures(with_gap);
  if (wanted.step && faults(drive).empty()) {
    answer.step = drive::step_response_to_end(drive, drive::step_of(of.given()),
                                              drive::band_of(of.given(), drive), progress);
  }
}

std::optional<AnswerBounds> proved_bounds(const Drive& drive, const Answer& answer) {
  const std::optional<ProportionalServo> servo = settled_servo(drive);
  if (!servo || !servo_dynamics(servo->servo).plastic_contact()) return std::nullopt;
  return bounds_of(box_of(drive, *servo), flight_time_of(answer));
}

Analysis analyse_in_full(const SoundDrive& sound, const Wanted& wanted, Progress& progress,
                         const SearchScope& scope) {
  const Drive& drive = sound.given();
  Analysis analysis;
  analysis.reduced = sound.settled();
  if ((analysis.servo = settled_servo(sound))) {
    ClosedAnswer found = closed_answer(drive, *analysis.servo, wanted.proofs);
    analysis.answer = std::move(found.answer);
    analysis.closed = std::move(found.cycles);
  } else if (is_absent_by_energy(sound)) {
    analysis.search = drive::AttractorSearch{};
    analysis.answer = answer_by_energy(analysis.reduced);
  } else {
    const drive::AttractorOptions options{
        .starts = scope.starts,
        .is_enough = scope.is_enough,
        .may_hurry = scope.may_hurry,
        .most_edges = wanted.borders ? drive::AttractorOptions{}.most_edges : 0,
        .band = drive::band_of(drive, analysis.reduced),
        .tolerances = scope.tolerances,
        .budget = {.bytes_kept = wanted.motion_bytes}};
    if (scope.near != nullptr && scope.near->search) {
      drive::IsEnough suffices;
      if (scope.suffices) {
        suffices = [&](const drive::AttractorSearch& found) {
          return scope.suffices(answer_of(found, analysis.reduced));
        };
      }
      analysis.search = drive::follow_attractors(analysis.reduced, *scope.near->search, progress,
                                                 suffices, options);
      analysis.is_followed = analysis.search.has_value();
    }
    if (!analysis.search) {
      analysis.search = drive::find_attractors(analysis.reduced, options, progress);
    }
    analysis.answer = answer_of(*analysis.search, analysis.reduced);
  }
  add_figures(sound, wanted, analysis.answer, progress);
  if (wanted.ceiling) {
    Ceiling& ceiling = *analysis.answer.ceiling;
    ceiling.mesh_torque = highest_mean_mesh_torque(sound);
    ceiling.is_below_limit = has_limit(analysis.reduced);
  }
  // The motion from which a ceiling is measured stands in the end, unless a sine drives it.
  if (!is_driven(analysis.reduced)) withdraw_if_contradictory(analysis.answer);
  if (wanted.causes && !(analysis.answer.search && !analysis.answer.search->is_complete)) {
    analysis.answer.without = without_causes(drive, analysis, wanted, progress);
    analysis.answer.is_quantization = is_quantization(analysis.answer);
    if (auto note = note_on_wind_up(drive, analysis, progress)) {
      analysis.answer.notes.push_back(std::move(*note));
    }
  }
  analysis.answer.specification = judged_specification(drive, analysis.answer);
  std::vector<Note> notes = notes_on(sound);
  if (!proves()) {
    take_for_computed(analysis.answer);
    notes.push_back(
        {"arithmetic", "Nothing is proved: " + std::string(fault_of_arithmetic()) + "."});
  }
  analysis.answer.notes.insert(analysis.answer.notes.begin(), notes.begin(), notes.end());
  return analysis;
}

Answer analyse(const Drive& drive, const Wanted& wanted, Progress& progress) {
  return analyse_in_full(drive, wanted, progress).answer;
}

}  // namespace gearlash
