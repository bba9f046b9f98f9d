#include "following.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "gearlash/motion.hpp"

namespace gearlash::oracle {
namespace {

Bounds extremes_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low, *high};
}

double width_of(const Bounds& bounds) { return bounds.high - bounds.low; }

std::vector<double> even_times(double from, double until, std::size_t count) {
  std::vector<double> times(count);
  for (std::size_t i = 0; i < count; ++i) {
    times[i] = std::lerp(from, until, static_cast<double>(i) / static_cast<double>(count - 1));
  }
  return times;
}

/// Positions of a window; on a ramp less the reference, which takes its hunting along.
struct Window {
  std::vector<double> times{}, load{}, motor{};
};

Window window_of(const Motion& motion, double from, double until, std::size_t count) {
  Window window{.times = even_times(from, until, count)};
  const Samples samples = motion.at(window.times);
  window.load = samples.load_position;
  window.motor = samples.motor_position;
  return window;
}

bool is_on_ramp(const Drive& drive) {
  return drive.reference && std::holds_alternative<RampSignal>(*drive.reference);
}

/// Empty if it moves.
std::optional<double> constant_reference(const Drive& drive) {
  if (!drive.reference) return 0.0;
  const auto* constant = std::get_if<double>(&*drive.reference);
  return constant != nullptr ? std::optional(*constant) : std::nullopt;
}

void subtract_ramp(const Drive& drive, Window& window) {
  if (!is_on_ramp(drive)) return;
  const auto& ramp = std::get<RampSignal>(*drive.reference);
  for (std::size_t i = 0; i < window.times.size(); ++i) {
    const double way = ramp.rate * (window.times[i] - ramp.time);
    window.load[i] -= way;
    window.motor[i] -= way;
  }
}

/// The search knows a signal by its end alone.
Drive as_searched(const Drive& drive) {
  Drive searched = drive;
  if (!drive.reference) return searched;
  if (const auto* way = std::get_if<TrapezoidSignal>(&*drive.reference)) {
    searched.reference = way->to;
  }
  return searched;
}

Span span_of(const Drive& drive, const StartOutcome& start, double until, std::size_t most_events) {
  double gap = start.motor_position - start.load_position;
  const double half = 0.5 * drive.gearbox.backlash;
  if (std::holds_alternative<RigidContact>(drive.contact)) gap = std::clamp(gap, -half, half);
  return {.until = until,
          .start = Start{.load_position = start.load_position,
                         .load_speed = start.load_speed,
                         .gap = gap,
                         .gap_speed = start.motor_speed - start.load_speed},
          .most_events = most_events};
}

std::string text(const char* form, double one, double other) {
  std::array<char, 200> line{};
  std::snprintf(line.data(), line.size(), form, one, other);
  return line.data();
}

/// The last time outside `band` about the last position, to a ten-thousandth of it.
double last_time_outside(const Motion& motion, double until, double band) {
  double from = 0.0;
  double to = until;
  const double last = motion.at(until).shafts.load_position;
  for (int round = 0; round < 3; ++round) {
    constexpr std::size_t count = 20'001;
    const Window window = window_of(motion, from, to, count);
    std::size_t i = count;
    while (i > 0 && std::abs(window.load[i - 1] - last) <= band) --i;
    if (i == 0) return from;
    if (i == count) return to;
    // Swings between the samples may leave the band later.
    from = window.times[i - 1];
    to = std::min(until, from + (round == 0 ? 40.0 : 1.0) * (window.times[i] - from));
  }
  return from;
}

FollowedStart follow_rest(const Drive& drive, const Answer& answer, const StartOutcome& start,
                          const FollowOptions& options) {
  FollowedStart result;
  const double began = std::max(start.watched, start.time_to_rest.value_or(0.0));
  if (!(began > 0.0)) return result;
  const Motion motion =
      simulate(drive, span_of(drive, start, options.times_of_rest * began, options.most_events));
  const double until = motion.end_time();
  result.followed = until / began;
  if (motion.stop() == MotionStop::diverged) {
    result.contradiction = text("runs away within %.4g s (%.4g)", until, until);
    return result;
  }
  constexpr double enough = 1.2;
  if (result.followed < enough || !answer.rest || !answer.rest->time) return result;
  const double band = answer.rest->time->band;
  constexpr std::size_t count = 4001;
  Window late = window_of(motion, began, until, count);
  subtract_ramp(drive, late);
  const Bounds load = extremes_of(late.load);
  result.amplitude = 0.5 * width_of(load);
  result.motor_amplitude = 0.5 * width_of(extremes_of(late.motor));
  constexpr double rounding = 1.001;
  if (width_of(load) > 2.0 * band * rounding) {
    result.contradiction =
        text("the load still moves over %.4g rad, band %.4g rad", width_of(load), band);
  }
  Window last = window_of(motion, until - 0.1 * (until - began), until, count);
  subtract_ramp(drive, last);
  const double still = 0.1 * drive.gearbox.backlash;
  const Bounds motor = extremes_of(last.motor);
  if (width_of(motor) > still) {
    result.contradiction = text("the motor still moves over %.4g rad of a gap of %.4g rad",
                                width_of(motor), drive.gearbox.backlash);
  }
  if (result.followed > 2.0 && start.time_to_rest && !is_on_ramp(drive)) {
    result.time_to_rest = last_time_outside(motion, until, band);
    if (const auto reference = constant_reference(drive)) {
      result.place = motion.at(until).shafts.load_position - *reference;
    }
  }
  return result;
}

double step_of(const Drive& drive) {
  constexpr double turn = 6.283185307179586;
  const Encoder& encoder = drive.sensor.encoder;
  const double turns = drive.sensor.position == SensorPlace::motor ? drive.gearbox.ratio : 1.0;
  if (encoder.resolution) return *encoder.resolution / turns;
  return encoder.counts_per_turn ? turn / *encoder.counts_per_turn / turns : 0.0;
}

/// rad, of the shaft that hunts.
double swings_of(const IrregularMotion& motion) {
  return motion.is_motor_alone ? motion.motor_amplitude.value_or(0.0) : motion.amplitude;
}

FollowedStart follow_hunting(const Drive& drive, const Answer& answer, const StartOutcome& start,
                             const FollowOptions& options) {
  FollowedStart result;
  if (!start.which || !(start.watched > 0.0)) return result;
  const bool is_cycle = start.end == "cycle";
  const double listed =
      is_cycle ? answer.cycles[*start.which].amplitude : swings_of(answer.irregular[*start.which]);
  const Motion motion = simulate(
      drive, span_of(drive, start, options.times_of_hunting * start.watched, options.most_events));
  const double until = motion.end_time();
  result.followed = until / start.watched;
  if (motion.stop() == MotionStop::diverged) {
    result.contradiction = text("runs away within %.4g s, listed %.4g rad", until, listed);
    return result;
  }
  constexpr double enough = 1.2;
  if (result.followed < enough) return result;
  constexpr std::size_t count = 20'001;
  Window late = window_of(motion, 0.5 * (start.watched + until), until, count);
  subtract_ramp(drive, late);
  const bool is_motor_alone = !is_cycle && answer.irregular[*start.which].is_motor_alone;
  const double of_load = 0.5 * width_of(extremes_of(late.load));
  const double motor = 0.5 * width_of(extremes_of(late.motor));
  const double amplitude = is_motor_alone ? motor : of_load;
  const double share = permitted_share(answer, start, options.share, options.irregular_share);
  const double least = std::max(step_of(drive), 1e-3 * drive.gearbox.backlash);
  if (std::abs(amplitude - listed) > std::max(share * std::max(amplitude, listed), least)) {
    result.contradiction = text("it swings by ±%.4g rad, listed ±%.4g rad", amplitude, listed);
  }
  result.amplitude = of_load;
  result.motor_amplitude = motor;
  const bool rests = amplitude < 1e-3 * listed && motor < 1e-3 * drive.gearbox.backlash;
  if (rests && answer.rests_engaged) {
    result.contradiction.clear();
  } else if (rests) {
    result.contradiction = text("it rests (±%.4g rad), listed ±%.4g rad", amplitude, listed);
  }
  return result;
}

/// Whether a controller that begins with its numbers 0 holds what it would hold at rest: it has no
/// integral, its filtered derivative is that of the speed, and nothing pulls before its first
/// output.
bool holds_at_once(const Drive& drive) {
  const auto* pid = std::get_if<PID>(&drive.controller.law);
  const bool pulls = drive.load_torque || drive.load.gravity != 0.0;
  return pid != nullptr && pid->integral == 0.0 &&
         (pid->filter == 0.0 || pid->derivative == 0.0 || pid->derivative_of_speed) &&
         !(drive.sampling && pulls);
}

bool is_in_another(const Rest& rest, const RestPiece& piece, double load) {
  return std::any_of(rest.pieces.begin(), rest.pieces.end(), [&](const RestPiece& other) {
    return &other != &piece && load >= other.load.low && load <= other.load.high;
  });
}

/// Whether it stays from a place of the gap, followed for some swings of the slowest drive.
bool stays(const Drive& drive, double load, double least) {
  const double gap = drive.gearbox.backlash;
  for (const double place : {-0.5, -0.25, 0.0, 0.25, 0.5}) {
    const Motion motion =
        simulate(drive, {.until = 2.0,
                         .start = Start{.load_position = load, .gap = place * gap},
                         .most_events = 200'000});
    if (motion.stop() == MotionStop::diverged) continue;
    const Window window = window_of(motion, 0.0, motion.end_time(), 401);
    const Bounds range = extremes_of(window.load);
    if (width_of(range) <= least) return true;
  }
  return false;
}

FollowedStart follow_with_time(const Drive& drive, const Answer& answer, const StartOutcome& start,
                               const FollowOptions& options) {
  FollowedStart followed = follow(drive, answer, start, options);
  constexpr double permitted = 0.01;
  if (followed.contradiction.empty() && followed.time_to_rest &&
      std::abs(*start.time_to_rest - *followed.time_to_rest) > permitted * *followed.time_to_rest) {
    followed.contradiction =
        text("time to rest %.6g s, simulated %.6g s", *start.time_to_rest, *followed.time_to_rest);
  }
  return followed;
}

/// Whether it rests at another place of those that are listed than the search saw.
bool rests_elsewhere(const Answer& answer, const StartOutcome& start,
                     const FollowedStart& followed) {
  if (!followed.place || !start.rest || !answer.rest || !answer.rest->time) return false;
  const double band = answer.rest->time->band;
  const Bounds& all = answer.rest->load;
  constexpr double near = 1e-3;
  return std::abs(*followed.place - start.rest->load) >
             start.rest->uncertainty.value_or(0.0) + near * band &&
         *followed.place >= all.low - band && *followed.place <= all.high + band;
}

/// Whether it swings by the size of another motion of the list than the one it was called.
bool hunts_as_listed(const Answer& answer, const FollowedStart& followed,
                     const FollowOptions& options) {
  const auto agrees = [](double amplitude, double listed, double share) {
    return std::abs(amplitude - listed) <= share * listed;
  };
  const auto is_cycle = [&](const Cycle& cycle) {
    const bool is_of_motor = cycle.amplitude < 0.01 * cycle.motor_amplitude;
    return is_of_motor ? agrees(followed.motor_amplitude, cycle.motor_amplitude, options.share)
                       : agrees(followed.amplitude, cycle.amplitude, options.share);
  };
  const auto is_irregular = [&](const IrregularMotion& motion) {
    return agrees(motion.is_motor_alone ? followed.motor_amplitude : followed.amplitude,
                  swings_of(motion), options.irregular_share);
  };
  return std::ranges::any_of(answer.cycles, is_cycle) ||
         std::ranges::any_of(answer.irregular, is_irregular);
}

/// The motor by half as much: a motion that an encoder reads the same goes along with both.
StartOutcome displaced(const StartOutcome& start, double way) {
  StartOutcome beside = start;
  beside.load_position += way;
  beside.motor_position += 0.5 * way;
  return beside;
}

/// Whether a rounding's displacement leads it elsewhere by the time at which the search decided it.
bool is_decided_by_rounding(const Drive& drive, const StartOutcome& start,
                            const FollowedStart& followed, const FollowOptions& options) {
  constexpr double rounding = 1e-9;
  const auto end_of = [&](const StartOutcome& one) {
    const Motion motion = simulate(drive, span_of(drive, one, start.watched, options.most_events));
    constexpr double last = 0.1;
    constexpr std::size_t count = 401;
    return window_of(motion, (1.0 - last) * motion.end_time(), motion.end_time(), count).motor;
  };
  const std::vector<double> own = end_of(start);
  const double away = std::copysign(rounding * drive.gearbox.backlash,  // from the face
                                    start.motor_position - start.load_position);
  const std::vector<double> beside = end_of(displaced(start, away));
  double apart = 0.0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    apart = std::max(apart, std::abs(own[i] - beside[i]));
  }
  constexpr double much = 0.1;
  return apart > much * followed.motor_amplitude;
}

/// A rounding may lead one that hunts to another motion of the list, one that rests to another
/// place of the list or out of chaotic motion of the list, and a small displacement to its own end.
bool is_near_border(const Drive& drive, const Answer& answer, const StartOutcome& start,
                    const FollowedStart& followed, const FollowOptions& options) {
  const bool hunts = hunts_as_listed(answer, followed, options);
  if (start.end == "rest" ? rests_elsewhere(answer, start, followed) ||
                                (hunts && is_decided_by_rounding(drive, start, followed, options))
                          : hunts) {
    return true;
  }
  for (const double share : {1.0, 0.5, 0.25, 0.125}) {
    for (const double side : {-1.0, 1.0}) {
      const double way = side * share * options.border * drive.gearbox.backlash;
      const StartOutcome beside = displaced(start, way);
      if (follow_with_time(drive, answer, beside, options).contradiction.empty()) return true;
    }
  }
  return false;
}

}  // namespace

FollowedDrive follow_pieces(const Drive& drive, const Answer& answer) {
  FollowedDrive result;
  const bool is_rigid = std::holds_alternative<RigidContact>(drive.contact);
  if (!answer.rest || !is_rigid || !holds_at_once(drive)) return result;
  const Drive searched = as_searched(drive);
  const std::optional<double> reference = constant_reference(searched);
  if (!reference) return result;
  for (const RestPiece& piece : answer.rest->pieces) {
    const double width = piece.load.high - piece.load.low;
    if (!(width > 0.0)) continue;
    ++result.pieces;
    for (const double way : {-1.0, 1.0}) {
      const double end = way < 0.0 ? piece.load.low : piece.load.high;
      const double inside = end - way * 1e-6 * width;
      const double beyond = end + way * 0.01 * width;
      if (!stays(searched, *reference + inside, 1e-3 * width)) {
        result.contradictions.push_back(
            text("piece of rest: from its end at %.9g rad (width %.3g) it leaves", end, width));
      }
      if (!is_in_another(*answer.rest, piece, beyond) &&
          stays(searched, *reference + beyond, 1e-3 * width)) {
        result.contradictions.push_back(text(
            "piece of rest: 1 %% beyond its end at %.9g rad (width %.3g) it stays", end, width));
      }
    }
  }
  return result;
}

double permitted_share(const Answer& answer, const StartOutcome& start, double share,
                       double irregular_share) {
  if (!start.which) return share;
  if (start.end == "cycle") {
    // Neutral cycles are a family, of which one is listed.
    const bool is_family = answer.cycles[*start.which].stability == Stability::neutral;
    return is_family ? irregular_share : share;
  }
  const IrregularMotion& motion = answer.irregular[*start.which];
  const double extent = std::max(motion.amplitude, motion.motor_amplitude.value_or(0.0));
  return irregular_share + 2.0 * motion.amplitude_deviation.value_or(0.0) / extent;
}

FollowedStart follow(const Drive& drive, const Answer& answer, const StartOutcome& start,
                     const FollowOptions& options) {
  const Drive searched = as_searched(drive);
  if (start.end == "rest") return follow_rest(searched, answer, start, options);
  if (start.end != "cycle" && start.end != "irregular") return {};
  FollowedStart followed = follow_hunting(searched, answer, start, options);
  if (followed.contradiction.empty()) return followed;
  // A chaotic transient may last much longer after a rounding, as long as that of another start; in
  // the end it hunts about as far.
  double longest = 0.0;
  for (const StartOutcome& one : answer.search->starts) longest = std::max(longest, one.watched);
  FollowOptions longer = options;
  longer.share = options.irregular_share;
  longer.times_of_hunting = std::max(8.0 * options.times_of_hunting, 2.0 * longest / start.watched);
  longer.most_events = std::max<std::size_t>(longer.most_events, 1'000'000);
  return follow_hunting(searched, answer, start, longer);
}

FollowedDrive follow_all(const Drive& drive, const Answer& answer, const FollowOptions& options) {
  FollowedDrive result;
  const std::vector<StartOutcome> none;
  for (const StartOutcome& start : answer.search ? answer.search->starts : none) {
    if (start.end == "undecided") continue;
    FollowedStart followed = follow_with_time(drive, answer, start, options);
    const double wanted = start.end == "rest" ? options.times_of_rest : options.times_of_hunting;
    ++(followed.followed < 0.99 * wanted ? result.cut_short : result.starts);
    if (followed.time_to_rest && *followed.time_to_rest > 0.0) ++result.times;
    if (followed.contradiction.empty()) continue;
    if (is_near_border(drive, answer, start, followed, options)) {
      ++result.near_border;
      continue;
    }
    result.contradictions.push_back(
        "from load " + text("%.9g at %.6g", start.load_position, start.load_speed) +
        text(", motor %.9g at %.6g: ", start.motor_position, start.motor_speed) +
        followed.contradiction);
  }
  FollowedDrive rest = follow_pieces(drive, answer);
  result.pieces = rest.pieces;
  std::move(rest.contradictions.begin(), rest.contradictions.end(),
            std::back_inserter(result.contradictions));
  return result;
}

}  // namespace gearlash::oracle
