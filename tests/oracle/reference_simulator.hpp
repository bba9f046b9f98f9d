// The reference: raw equations carried forward by small steps, events found by watching signs.
// It shares no code and no formula with the library; only the types that name an event are common.
//
// Rule for events (the written rule of the library's documentation, in the words of a simulator):
//   engaged     while N ≥ 0 (towards the face); where N falls through zero the faces part
//   gap         until the distance to either face falls through zero: impact
//   impact      J_M v_M + J_L v_L is kept, relative speed p becomes −e p; with e = 0, or one side
//               massless, it becomes 0
//   touching with relative speed 0: engaged if N ≥ 0, else apart at once
//   0 < e < 1   bounces are followed one by one until the relative speed is 1e-13 of the first of
//               their chain and N presses; the rest of their time is the geometric tail.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "closed_form/trajectory.hpp"
#include "propagator.hpp"
#include "raw_equations.hpp"

namespace gearlash::oracle {

/// Both shafts, not mirrored, reference included.
struct Shafts {
  Extended motor_position;
  Extended motor_speed;
  Extended load_position;
  Extended load_speed;
};

struct ReferenceEvent {
  Extended time;
  EventKind kind;
  Face face;
  Shafts before;
  Shafts after;
  Mode mode_after;
};

/// Motion between two events, from which any state in between can be found again.
struct ReferencePiece {
  Extended start;
  Motion motion;
  Face face;
  ExtendedState state;
};

struct ReferenceRun {
  std::vector<ReferenceEvent> events;
  std::vector<ReferencePiece> pieces;
  std::vector<Extended> turning_times;  ///< load speed zero while engaged: extremes of position
  bool exhausted = false;               ///< stopped at the limit of events, not at the end
};

/// Relative errors thrown in on purpose, to see how far they are amplified.
struct Perturbation {
  Extended size = 0;
  std::uint64_t seed = 0;
};

struct ReferenceOptions {
  Extended until = 0;
  Extended reference = 0;
  std::size_t event_limit = 300'000;
  Perturbation perturbation{};
};

template <class Propagator>
class ReferenceSimulator {
 public:
  ReferenceSimulator(const NormalizedServo& servo, Propagator propagator)
      : servo_(raw_servo<Extended>(servo)), propagator_(std::move(propagator)) {}

  ReferenceRun run(const ServoState& initial, const ReferenceOptions& options) {
    options_ = options;
    random_.seed(options.perturbation.seed);
    run_ = {};
    time_ = 0;
    begin(initial);
    while (time_ < options_.until && !run_.exhausted) {
      if (!follow_piece()) break;
      if (run_.events.size() >= options_.event_limit) run_.exhausted = true;
    }
    return run_;
  }

  /// The shafts at a time within the run last made.
  Shafts at(Extended time) {
    auto piece = std::upper_bound(
        run_.pieces.begin(), run_.pieces.end(), time,
        [](Extended t, const ReferencePiece& candidate) { return t < candidate.start; });
    if (piece != run_.pieces.begin()) --piece;
    return shafts(piece->face, carry(piece->motion, piece->state, time - piece->start));
  }

 private:
  struct Guard {
    Extended value, slope, curvature;
  };
  enum class Watch { mesh_force, near_face, far_face };
  struct Crossing {
    Watch watch;
    Extended offset;
    ExtendedState state;
  };

  // --- what is watched

  Guard guard(Watch watch, const ExtendedState& z) const {
    if (watch == Watch::mesh_force) {
      const ExtendedState rate = engaged_derivative(servo_, z);
      return {engaged_torque(servo_, z), engaged_torque(servo_, rate),
              engaged_torque(servo_, engaged_derivative(servo_, rate))};
    }
    const ExtendedState rate = gap_derivative(servo_, z);
    if (watch == Watch::near_face) return {z[distance], rate[distance], rate[opening_speed]};
    return {servo_.backlash - z[distance], -rate[distance], -rate[opening_speed]};
  }

  static bool opposite(Extended a, Extended b) { return (a < 0 && b > 0) || (a > 0 && b < 0); }

  /// First fall of the guard through zero within one step. A step is halved until the slope keeps
  /// its sign in it, which the curvature must confirm by keeping its own; then the guard is
  /// monotone there and its sign at the end decides. So two crossings in one step are not missed.
  std::optional<Crossing> crossing_in(Watch watch, Motion motion, const ExtendedState& start,
                                      const Guard& first, int level, int deepest) {
    const ExtendedState end = propagator_.advance(motion, start, level);
    const Guard last = guard(watch, end);
    const Extended step = std::ldexp(Extended(1), -level);
    const Extended bend = 2 * step * std::max(std::abs(first.curvature), std::abs(last.curvature));
    const Extended reach =
        2 * step * (std::max(std::abs(first.slope), std::abs(last.slope)) + bend);
    if (std::min(first.value, last.value) > reach) return std::nullopt;
    const bool monotone = !opposite(first.slope, last.slope) &&
                          (!opposite(first.curvature, last.curvature) ||
                           std::min(std::abs(first.slope), std::abs(last.slope)) > bend);
    if (monotone || level >= deepest) {
      if (last.value >= 0) return std::nullopt;
      return bisect(watch, motion, start, level);
    }
    if (auto found = crossing_in(watch, motion, start, first, level + 1, deepest)) return found;
    const ExtendedState middle = propagator_.advance(motion, start, level + 1);
    auto found = crossing_in(watch, motion, middle, guard(watch, middle), level + 1, deepest);
    if (found) found->offset += step / 2;
    return found;
  }

  Crossing bisect(Watch watch, Motion motion, const ExtendedState& start, int level) {
    constexpr int bits = 66;  // beyond the 64 of the arithmetic
    ExtendedState z = start;
    Extended offset = 0;
    const int finest = std::min(level + bits, shortest_step_level);
    for (int finer = level + 1; finer <= finest; ++finer) {
      const ExtendedState middle = propagator_.advance(motion, z, finer);
      if (guard(watch, middle).value < 0) continue;
      z = middle;
      offset += std::ldexp(Extended(1), -finer);
    }
    return {watch, offset, z};
  }

  // --- one piece of motion

  void begin(const ServoState& initial) {
    const Extended half = servo_.backlash / 2;
    const Extended gap = Extended(initial.motor_position) - initial.load_position;
    const bool backward = servo_.backlash > 0 && gap == -half;
    const Extended sign = backward ? -1 : 1;
    face_ = backward ? Face::backward : Face::forward;
    state_ = {sign * (Extended(initial.load_position) - options_.reference),
              sign * Extended(initial.load_speed), half - sign * gap,
              -sign * (Extended(initial.motor_speed) - initial.load_speed)};
    if (servo_.backlash == 0) {
      motion_ = Motion::engaged;
      shake(true);
      record_piece();
      return;
    }
    if (state_[distance] == 0 && state_[opening_speed] == 0) {
      rest_on_face();
    } else {
      enter_gap();
    }
    shake(true);
    record_piece();
  }

  /// Follows the motion to the next event; false when the end of the run comes first.
  bool follow_piece() {
    Extended offset = 0;
    const Extended remaining = options_.until - time_;
    const int first_level = opening_level();
    bool first_step = true;
    while (offset < remaining) {
      const int level = std::max(step_level(offset, first_level), level_below(remaining - offset));
      if (level > shortest_step_level) break;
      if (const auto found = next_crossing(level, first_step)) {
        note_turning(found->state, level, time_ + offset);
        time_ += offset + found->offset;
        state_ = found->state;
        happen(found->watch);
        return true;
      }
      const ExtendedState next = propagator_.advance(motion_, state_, level);
      note_turning(next, level, time_ + offset);
      state_ = next;
      offset += std::ldexp(Extended(1), -level);
      first_step = false;
      if (remaining - offset < remaining * 1e-18L) break;
    }
    time_ = options_.until;
    return false;
  }

  std::optional<Crossing> next_crossing(int level, bool first_step) {
    constexpr int splits = 50;
    if (motion_ == Motion::engaged) {
      if (servo_.backlash == 0) return std::nullopt;
      return crossing_in(Watch::mesh_force, motion_, state_, guard(Watch::mesh_force, state_),
                         level, level + splits);
    }
    Guard near = guard(Watch::near_face, state_);
    if (first_step && tangent_start_) near.curvature = 0;  // exactly, but for rounding
    auto found = crossing_in(Watch::near_face, motion_, state_, near, level, level + splits);
    auto far = crossing_in(Watch::far_face, motion_, state_, guard(Watch::far_face, state_), level,
                           level + splits);
    if (far && (!found || far->offset < found->offset)) return far;
    return found;
  }

  /// Short enough at first for the fastest decay and for the bounce ahead, if any.
  int opening_level() const {
    Extended step = std::ldexp(Extended(1), -8) / servo_.fastest_rate();
    if (motion_ == Motion::gap && state_[opening_speed] != 0) {
      const Extended curvature = std::abs(guard(Watch::near_face, state_).curvature);
      if (curvature > 0) step = std::min(step, std::abs(state_[opening_speed]) / (8 * curvature));
    }
    return level_below(step);
  }

  /// Steps grow in proportion to the time since the event, so that every decay is resolved.
  static int step_level(Extended offset, int first_level) {
    return offset == 0 ? first_level : std::min(first_level, level_below(offset / 8));
  }

  static int level_below(Extended step) { return std::max(longest_step_level, -std::ilogb(step)); }

  void note_turning(const ExtendedState& next, int level, Extended start) {
    if (motion_ != Motion::engaged || !opposite(state_[load_speed], next[load_speed])) return;
    const Extended sign = state_[load_speed];
    ExtendedState z = state_;
    Extended offset = 0;
    for (int finer = level + 1; finer < level + 40; ++finer) {
      const ExtendedState middle = propagator_.advance(motion_, z, finer);
      if (opposite(middle[load_speed], sign)) continue;
      z = middle;
      offset += std::ldexp(Extended(1), -finer);
    }
    run_.turning_times.push_back(start + offset);
  }

  // --- events

  void happen(Watch watch) {
    if (watch == Watch::far_face) turn_to_other_face();
    const Shafts before = shafts(face_, state_);
    if (watch != Watch::mesh_force) {
      collide(before);
      return;
    }
    enter_gap();
    state_[distance] = 0;
    state_[opening_speed] = 0;  // exactly, also where a massless side's law leaves a rounding error
    tangent_start_ = true;
    shake_along_line();
    record_event(EventKind::separation, before);
  }

  void turn_to_other_face() {
    face_ = face_ == Face::forward ? Face::backward : Face::forward;
    state_ = {-state_[load_position], -state_[load_speed], servo_.backlash - state_[distance],
              -state_[opening_speed]};
    chain_speed_ = 0;
  }

  void collide(const Shafts& before) {
    const Extended closing = -state_[opening_speed];
    state_[distance] = 0;
    const Extended momentum = servo_.motor_inertia * (state_[load_speed] + closing) +
                              servo_.load_inertia * state_[load_speed];
    const Extended rebound = servo_.plastic() ? Extended(0) : servo_.restitution * closing;
    const Extended inertia = servo_.motor_inertia + servo_.load_inertia;
    state_[load_speed] = (momentum + servo_.motor_inertia * rebound) / inertia;
    state_[opening_speed] = rebound;
    const bool first_of_chain = chain_speed_ == 0;
    chain_speed_ = std::max(chain_speed_, closing);
    if (rebound == 0) {
      rest_on_face();
    } else {
      enter_gap();
    }
    shake(first_of_chain);
    record_event(EventKind::impact, before);
    constexpr Extended settled = 1e-13L;
    if (servo_.restitution < 1 && rebound > 0 && rebound < settled * chain_speed_ &&
        engaged_torque(servo_, state_) > 0) {
      settle();
    }
  }

  /// The bounces left take 2p/a (1 + e + e² + …), during which the load moves as if engaged.
  void settle() {
    const Extended approach = -gap_derivative(servo_, state_)[opening_speed];
    const Extended tail = 2 * state_[opening_speed] / (approach * (1 - servo_.restitution));
    state_[load_speed] -= servo_.motor_inertia * state_[opening_speed];  // momentum is kept
    state_[opening_speed] = 0;
    state_[distance] = 0;
    state_ = carry(Motion::engaged, state_, tail);
    time_ += tail;
    const Shafts before = shafts(face_, state_);
    rest_on_face();
    shake(true);
    record_event(EventKind::settling, before);
  }

  /// Touching without relative speed: pressed together, or apart at once.
  void rest_on_face() {
    if (engaged_torque(servo_, state_) >= 0) {
      motion_ = Motion::engaged;
      tangent_start_ = false;
      chain_speed_ = 0;
    } else {
      enter_gap();
    }
  }

  /// Massless sides take the speed their law demands.
  void enter_gap() {
    motion_ = Motion::gap;
    tangent_start_ = false;
    if (servo_.massless_load()) {
      state_[opening_speed] -= state_[load_speed];
      state_[load_speed] = 0;
    }
    if (servo_.massless_motor()) {
      state_[opening_speed] = state_[load_speed] + state_[load_position] / servo_.motor_friction;
    }
  }

  // --- records

  Shafts shafts(Face face, const ExtendedState& z) const {
    const Extended sign = face == Face::forward ? 1 : -1;
    const Extended load = options_.reference + sign * z[load_position];
    return {load + sign * (servo_.backlash / 2 - z[distance]),
            sign * (z[load_speed] - z[opening_speed]), load, sign * z[load_speed]};
  }

  Mode mode() const {
    if (servo_.backlash == 0) return Mode::no_gap;
    if (motion_ == Motion::gap) return Mode::separated;
    return face_ == Face::forward ? Mode::engaged_forward : Mode::engaged_backward;
  }

  void record_piece() { run_.pieces.push_back({time_, motion_, face_, state_}); }

  void record_event(EventKind kind, const Shafts& before) {
    run_.events.push_back({time_, kind, face_, before, shafts(face_, state_), mode()});
    record_piece();
  }

  ExtendedState carry(Motion motion, ExtendedState z, Extended time) {
    while (time > 0) {
      const int level = level_below(time);
      if (level > shortest_step_level) break;
      z = propagator_.advance(motion, z, level);
      time -= std::ldexp(Extended(1), -level);
    }
    return z;
  }

  // --- deliberate errors

  Extended error() {
    const Extended unit = static_cast<Extended>(random_() >> 11) * std::ldexp(Extended(1), -52);
    return options_.perturbation.size * (unit - 1);  // −size … +size
  }

  Extended state_scale() const {
    return std::abs(state_[load_position]) + std::abs(state_[load_speed]) + servo_.backlash;
  }

  /// The load by an absolute error, the relative speed by a relative one: the small bounces at the
  /// end of a chain are not blurred by errors of the size of the whole.
  void shake(bool load_too) {
    if (options_.perturbation.size == 0) return;
    if (load_too) {
      const Extended scale = state_scale();
      state_[load_position] += scale * error();
      if (!servo_.massless_load() || motion_ == Motion::engaged) {
        state_[load_speed] += scale * error();
      }
    }
    state_[opening_speed] *= 1 + error();
    if (motion_ == Motion::gap) enter_gap_consistently();
  }

  void enter_gap_consistently() {
    const bool tangent = tangent_start_;
    enter_gap();
    tangent_start_ = tangent;
  }

  /// At a separation the state must stay on the line N = 0.
  void shake_along_line() {
    if (options_.perturbation.size == 0) return;
    const Extended factor = 1 + error();
    state_[load_position] *= factor;
    state_[load_speed] *= factor;
    state_[opening_speed] *= factor;
  }

  RawServo<Extended> servo_;
  Propagator propagator_;
  ReferenceOptions options_;
  std::mt19937_64 random_;
  ReferenceRun run_;
  Extended time_ = 0;
  Motion motion_ = Motion::gap;
  Face face_ = Face::forward;
  ExtendedState state_{};
  bool tangent_start_ = false;  ///< the gap opens with no relative speed and no acceleration
  Extended chain_speed_ = 0;    ///< closing speed of the first impact of the bounces under way
};

}  // namespace gearlash::oracle
