#include "question/loop/ceiling/ceiling.hpp"

#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/arithmetic.hpp"
#include "base/number.hpp"
#include "question/loop/ceiling/gap_speed.hpp"
#include "question/loop/ceiling/loop_gain.hpp"

namespace gearlash {
namespace {

using drive::ReducedDrive;

constexpr std::string_view friction_compensation = "friction compensation";

struct Source {
  std::string_view name;
  Disturbance disturbance;
  Interval size;  ///< the largest |disturbance|
};

struct ScaledSource {
  Source source;
  LoopGain gain;
};

/// Why no theorem applies; empty if one does.
std::string obstacle(const ReducedDrive& drive) {
  const auto* faces = std::get_if<drive::CompliantContact>(&drive.contact);
  if (faces != nullptr && faces->damping > 0.0 && !drive::is_joined(drive)) {
    return "faces with damping: it can be exceeded (docs/explanation/ceiling.md)";
  }
  if (drive.error_shape.is_relay()) return "a relay: the controller is not linear";
  if (drive.sampling && drive::position_ticks(*drive.sampling) > 1) {
    return "the position controller runs at some ticks alone: no bound is known";
  }
  return {};
}

std::vector<Source> sources_of(const EnclosedDrive& drive) {
  const ReducedDrive& form = drive.form();
  std::vector<Source> sources;
  const auto add = [&](std::string_view name, Disturbance disturbance, const Interval& size) {
    if (size.high > 0.0) sources.push_back({name, std::move(disturbance), size});
  };
  const drive::ReducedDriveOf<Interval>& numbers = drive.numbers();
  add("gap", {LinearInput::gap}, 0.5 * numbers.backlash);
  add("motor friction", {LinearInput::torque_on_motor}, numbers.motor.friction.breakaway);
  add("load friction", {LinearInput::torque_on_load}, numbers.load.friction.breakaway);
  const drive::SensingOf<Interval>& sensing = numbers.sensing;
  const Interval of_position = 0.5 * sensing.resolution;
  const Interval of_speed = 0.5 * sensing.resolution_of_speed;
  const bool counts = form.sampling && form.sampling->speed_by_differences;
  // Else as of two encoders, whose gains add up to no less.
  const bool is_one_encoder = sensing.load_share_of_position == sensing.load_share_of_speed &&
                              sensing.resolution.low == sensing.resolution_of_speed.low &&
                              sensing.resolution.high == sensing.resolution_of_speed.high;
  if (counts && is_one_encoder) {
    add("encoder", {LinearInput::position_reading, LinearInput::speed_reading}, of_position);
  } else {
    add("encoder", {LinearInput::position_reading}, of_position);
    if (counts) add("speed encoder", {LinearInput::speed_reading}, of_speed);
  }
  // What it changes the error by is an error of the position.
  if (!form.error_shape.is_limit()) {
    add(form.error_shape.inner_gain == 0.0 ? "dead band" : "backlash compensation",
        {LinearInput::position_reading}, numbers.error_shape.largest_change());
  }
  if (!std::holds_alternative<double>(form.reference)) {
    add(friction_compensation, {LinearInput::torque_on_motor}, abs(numbers.feedforward.torque));
    add("backlash compensation", {LinearInput::position_reading},
        abs(numbers.feedforward.half_gap));
  }
  if (std::holds_alternative<drive::Sine>(form.load_torque)) {
    add("load torque", {LinearInput::torque_on_load}, abs(drive.course().load_torque_amplitude));
  }
  return sources;
}

// ---- the motion with the gap closed -------------------------------------------------------------

/// Torques of the motion with the gap closed, N m at the load's shaft.
struct Carried {
  Interval requested;
  Interval mesh;
};

/// Why they are not known: the reference or the load torque moves in another way than along a ramp,
/// or as a sine of the load torque, which is a source, or the motion does not follow the ramp.
/// Empty if they are known.
std::string obstacle_of_carried(const ReducedDrive& form, const LinearDrive<Interval>& linear) {
  const bool has_ramp = std::holds_alternative<drive::Ramp>(form.reference);
  const bool is_at_rest = std::holds_alternative<double>(form.reference);
  if (std::holds_alternative<drive::Ramp>(form.load_torque) || !(is_at_rest || has_ramp) ||
      (has_ramp && !is_exactly(linear.weight, 0.0))) {
    return "the reference or the load torque moves";
  }
  if (!has_ramp || linear.knows_error_alone()) return {};
  return "along a ramp its proof needs a controller that knows reference and position by their "
         "difference alone";
}

/// Of rest, or of an even motion along a ramp. Precondition: no obstacle.
Carried carried_by(const CourseOf<Interval>& course, const LinearDrive<Interval>& linear,
                   DisturbedLoop& loop) {
  const Interval& load_torque = course.load_torque;
  if (!is_exactly(linear.weight, 0.0)) {
    // What is constant displaces the loop by no more than anything of that size.
    const Interval reference = abs(course.reference);
    const LoopGain of_torque = loop.gain({LinearInput::torque_on_load});
    const LoopGain of_reference = loop.gain({LinearInput::reference});
    const auto displaced = [&](double LoopGain::*output) {
      Interval sum = abs(load_torque) * Interval(of_torque.*output);
      if (reference.high > 0.0) sum = sum + reference * Interval(of_reference.*output);
      return sum;
    };
    return Carried{displaced(&LoopGain::effort),
                   abs(load_torque) + abs(linear.weight) * displaced(&LoopGain::load)};
  }
  const Interval& speed = course.reference_rate;
  Interval friction = linear.motor_friction + linear.load_friction;
  if (linear.lags) friction = friction + linear.back_emf;
  return Carried{friction * speed - load_torque, linear.load_friction * speed - load_torque};
}

// ---- the gap's speed ----------------------------------------------------------------------------

/// Empty if the torque that the mesh carries is not known.
std::optional<GapMotion> gap_motion(const EnclosedDrive& drive, const LinearDrive<Interval>& linear,
                                    DisturbedLoop& loop, const std::vector<ScaledSource>& sources,
                                    const std::optional<Carried>& carried) {
  const auto* faces = std::get_if<drive::RigidContactOf<Interval>>(&drive.numbers().contact);
  if (!carried || faces == nullptr) return std::nullopt;
  // Once the faces part the mesh torque is gone.
  Interval acceleration =
      abs(carried->mesh) * (1.0 / linear.motor_inertia + 1.0 / linear.load_inertia);
  for (const ScaledSource& one : sources) {
    acceleration = acceleration + one.source.size * Interval(one.gain.gap_acceleration);
  }
  return GapMotion{.backlash = drive.numbers().backlash,
                   .restitution = faces->restitution,
                   .acceleration = acceleration,
                   .per_speed = loop.gain({LinearInput::gap_speed}).gap_acceleration,
                   .slope = loop.gap_acceleration_per_speed()};
}

// ---- starts below the torque limit --------------------------------------------------------------

/// What the effort may reach beside the start, the limit less the torque carried and all sources.
struct Margin {
  Interval left;
  Interval per_gap_speed;  ///< N m per rad/s, of the effort
  std::optional<GapMotion> gap_motion;
};

/// Starts of which the effort stays within the margin. It is at most a linear function of the
/// displacement and the speed: so is each line above the gap's speed.
std::optional<SafeStarts> starts_within(const Margin& margin, DisturbedLoop& loop,
                                        const Interval& half_gap) {
  const StartGain effort = loop.start_gain(StartOutput::effort);
  const auto starts = [&](const Interval& taken, const Interval& of_position,
                          const Interval& of_speed) {
    const Interval left = margin.left - half_gap * effort.of_gap - taken;
    return SafeStarts{(left / of_position).low, (left / of_speed).low};
  };
  SafeStarts best;
  if (!margin.gap_motion) {
    best = starts(0.0, effort.of_position, effort.of_speed);
  } else {
    const StartGain acceleration = loop.start_gain(StartOutput::gap_acceleration);
    GapMotion motion = *margin.gap_motion;
    motion.acceleration = motion.acceleration + half_gap * acceleration.of_gap;
    constexpr int doublings = 20;
    double likely = motion.acceleration.high;
    for (int i = 0; i < doublings; ++i, likely *= 2.0) {
      const GapSpeedLine line = gap_speed_line(motion, likely);
      const Interval per_acceleration = margin.per_gap_speed * line.per_acceleration;
      const SafeStarts found =
          starts(margin.per_gap_speed * line.at_rest + per_acceleration * motion.acceleration,
                 effort.of_position + per_acceleration * acceleration.of_position,
                 effort.of_speed + per_acceleration * acceleration.of_speed);
      if (found.position > best.position) best = found;
    }
  }
  if (!(best.position > 0.0 && best.speed > 0.0)) return std::nullopt;
  if (!std::isfinite(best.position) || !std::isfinite(best.speed)) return std::nullopt;
  return best;
}

// ---- the whole ----------------------------------------------------------------------------------

void add_terms(const std::vector<ScaledSource>& sources, Ceiling& ceiling, Interval& effort) {
  Interval load = 0.0;
  Interval motor = 0.0;
  for (const ScaledSource& one : sources) {
    const auto bound = [&](double gain) { return (one.source.size * Interval(gain)).high; };
    CeilingTerm term{.source = std::string(one.source.name),
                     .size = one.source.size.high,
                     .load = bound(one.gain.load),
                     .motor = bound(one.gain.motor),
                     .effort = bound(one.gain.effort)};
    if (!std::isfinite(*term.effort)) term.effort.reset();
    load = load + term.load;
    motor = motor + term.motor;
    effort = effort + Interval(term.effort.value_or(infinity));
    ceiling.terms.push_back(std::move(term));
  }
  if (std::isfinite(load.high) && std::isfinite(motor.high)) {
    ceiling.load = load.high;
    ceiling.motor = motor.high;
    if (std::isfinite(effort.high)) ceiling.effort = effort.high;
  }
}

/// Why the gap's speed has no bound.
std::string obstacle_of_gap_speed(const std::string& of_carried) {
  return "the speed of the gap has no bound here: " +
         (of_carried.empty() ? "elastic faces, or feedback of the speed that drives the gap"
                             : of_carried);
}

std::vector<ScaledSource> scaled_sources(const EnclosedDrive& drive, DisturbedLoop& loop) {
  std::vector<ScaledSource> sources;
  for (const Source& source : sources_of(drive)) {
    sources.push_back({source, loop.gain(source.disturbance)});
    // It is requested by the controller too.
    if (source.name == friction_compensation) {
      LoopGain& gain = sources.back().gain;
      gain.effort = (Interval(gain.effort) + 1.0).high;
    }
  }
  return sources;
}

}  // namespace

Ceiling ceiling_of(const EnclosedDrive& drive) {
  const ReducedDrive& form = drive.form();
  Ceiling ceiling;
  ceiling.reason = obstacle(form);
  if (ceiling.reason.empty()) ceiling.reason = fault_of_arithmetic();
  if (!ceiling.reason.empty()) return ceiling;
  const LinearDrive<Interval> linear = linear_drive(drive);
  const std::unique_ptr<DisturbedLoop> loop = disturbed_loop(linear);
  if (loop == nullptr) {
    ceiling.reason = "the loop with the gap closed is not proved stable";
    return ceiling;
  }
  std::vector<ScaledSource> sources = scaled_sources(drive, *loop);
  const bool has_other_limit =
      std::isfinite(form.winding.torque_limit) || form.error_shape.is_limit();
  ceiling.is_below_limit = std::isfinite(form.torque_limit) || has_other_limit;
  const std::string of_carried = obstacle_of_carried(form, linear);
  std::optional<Carried> carried;
  if (of_carried.empty() && (ceiling.is_below_limit || loop->reads_gap_speed())) {
    carried = carried_by(drive.course(), linear, *loop);
  }

  Margin margin;
  Interval effort = 0.0;
  if (loop->reads_gap_speed()) {
    margin.gap_motion = gap_motion(drive, linear, *loop, sources, carried);
    const LoopGain gain = loop->gain({LinearInput::gap_speed});
    margin.per_gap_speed = gain.effort;
    const GapSpeed speed = margin.gap_motion ? highest_gap_speed(*margin.gap_motion) : GapSpeed{};
    if (std::isfinite(speed.highest)) {
      sources.push_back({{"gap speed", {LinearInput::gap_speed}, speed.highest}, gain});
      ceiling.is_gap_speed_braked = speed.is_braked;
    } else if (gain.load > 0.0 || gain.motor > 0.0) {
      ceiling.reason = "a sampled tachometer: " + obstacle_of_gap_speed(of_carried);
      return ceiling;
    } else {
      effort = infinity;
    }
  }
  add_terms(sources, ceiling, effort);
  if (!ceiling.load) {
    ceiling.terms.clear();
    ceiling.reason = "its bound is beyond the numbers of this computer";
    return ceiling;
  }
  if (!ceiling.effort) ceiling.effort_reason = obstacle_of_gap_speed(of_carried);
  if (!carried || !ceiling.effort || !ceiling.is_below_limit || has_other_limit) return ceiling;
  margin.left = drive.numbers().torque_limit - abs(carried->requested) - effort;
  ceiling.meets_limit = margin.left.low >= 0.0;
  if (loop->reads_gap_speed()) {
    // The line above the gap's speed replaces its term.
    margin.left = margin.left + Interval(*ceiling.terms.back().effort);
  }
  if (!*ceiling.meets_limit) return ceiling;
  ceiling.safe_starts = starts_within(margin, *loop, 0.5 * drive.numbers().backlash);
  return ceiling;
}

}  // namespace gearlash
