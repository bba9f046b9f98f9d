#include "picture/answer_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/lists.hpp"
#include "picture/attractor_picture.hpp"
#include "picture/phase_portrait.hpp"
#include "question/axis.hpp"

namespace gearlash {
namespace {

/// A round number not far above `value`.
double round_up(double value) {
  return round_number_from(value, std::array{1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0});
}

/// A step from rest that shows both the approach and the cycle. Its height is free, because
/// everything scales with the backlash.
struct Step {
  double size;   ///< rad
  double until;  ///< normalised
};

Step step_to_draw(const AnswerReport& report, const Analysis& analysis) {
  const NormalizedServo& servo = analysis.servo->servo;
  const AngleUnit& unit = report.drive.angle_unit;
  const auto rounded = [&](double size) {
    return unit.radians * round_up(unit.from_radians(size));
  };
  constexpr double turn = 2.0 * std::numbers::pi;
  if (const LimitCycle* cycle = largest_stable(*analysis.closed)) {
    // Until a disturbance is down to a hundredth, which the cycle's line hides, but at most eight
    // periods, because more lines cannot be told apart.
    const double periods = std::log(0.01) / std::log(std::abs(cycle->multiplier));
    return {rounded(1.8 * std::max(cycle->amplitude, cycle->motor_amplitude)),
            cycle->period * std::clamp(std::ceil(periods), 4.0, 8.0)};
  }
  const double settling_time =
      servo.damping < 1.0 ? 5.0 / std::max(servo.damping, 0.01) : 10.0 * servo.damping;
  return {servo.backlash > 0.0 ? rounded(4.0 * servo.backlash) : 1.0,
          servo.damping < 1.0 ? std::clamp(settling_time, 2.0 * turn, 20.0 * turn) : settling_time};
}

/// At rest on a face. If such a step may end at rest, a small motion in the gap instead, which
/// grows into the cycle.
ServoState start_to_draw(const Analysis& analysis, const Step& step) {
  const LimitCycle* cycle = largest_stable(*analysis.closed);
  if (cycle == nullptr || !analysis.closed->rests_engaged) {
    return engaged_start(analysis.servo->servo, 0.0, 0.0, step.size);
  }
  constexpr double share = 0.2;
  const ServoState& start = cycle->start;
  const double load_position = step.size + share * start.load_position;
  return {load_position + (start.motor_position - start.load_position), share * start.motor_speed,
          load_position, share * start.load_speed};
}

/// The motion from `state` until `until`, both in the normal form.
Motion motion_from(const AnswerReport& report, const Analysis& analysis, const ServoState& state,
                   double reference, double until) {
  Drive drive = report.drive;
  drive.reference = reference;
  drive.load_torque.reset();
  const double rate = analysis.servo->natural_frequency;
  const Start start{.load_position = state.load_position,
                    .load_speed = state.load_speed * rate,
                    .gap = state.motor_position - state.load_position,
                    .gap_speed = state.gap_speed() * rate};
  return simulate(drive, {.until = until / rate, .start = start});
}

MotionPicture servo_picture(const AnswerReport& report, const Analysis& analysis) {
  const Step step = step_to_draw(report, analysis);
  const LimitCycle* cycle = largest_stable(*analysis.closed);
  MotionPicture picture{.title = headline(report),
                        .drive = report.drive,
                        .period = 2.0 * std::numbers::pi / analysis.servo->natural_frequency};
  picture.motions.push_back(
      {.motion =
           motion_from(report, analysis, start_to_draw(analysis, step), step.size, step.until),
       .name = cycle != nullptr ? "on its way" : "",
       .role = cycle != nullptr ? MotionRole::background : MotionRole::subject});
  if (cycle != nullptr) {
    picture.motions.push_back(
        {.motion = motion_from(report, analysis, cycle->start, 0.0, cycle->period),
         .name = "limit cycle",
         .is_cycle = true});
  }
  constexpr std::size_t most_others = 2;  // more cannot be told apart
  for (const LimitCycle& other : analysis.closed->cycles) {
    if (&other == cycle || picture.motions.size() >= 2 + most_others) continue;
    const double stays = std::abs(other.multiplier);
    const std::string swing = " ±" + angle_text(other.amplitude, report.drive.angle_unit, 3);
    const std::string name = (stays < 1.0 ? "stable cycle" : "unstable cycle") + swing;
    const auto is_named = [&](const DrawnMotion& drawn) { return drawn.name == name; };
    if (any_of(picture.motions, is_named)) continue;  // cannot be told apart either
    picture.motions.push_back(
        {.motion = motion_from(report, analysis, other.start, 0.0, other.period),
         .name = name,
         .is_cycle = true,
         .role = stays < 1.0 ? MotionRole::subject : MotionRole::unstable});
  }
  return picture;
}

/// The cycles of a search with the ways to them. The basins are watched if there are several.
MotionPicture search_picture(const AnswerReport& report, const Analysis& analysis,
                             Progress& progress) {
  const drive::AttractorSearch& search = *analysis.search;
  const drive::ReducedDrive& reduced = analysis.reduced;
  MotionPicture picture = attractor_picture(headline(report), report.drive, reduced, search);
  const std::optional<StartPlane> plane = plane_to_draw(picture, reduced, search);
  if (!plane || search.outcomes.empty()) return picture;
  std::optional<Basins> basins;
  if (has_several_basins(search)) {
    basins = basins_of(reduced, search, *plane, progress);
    if (!basins->is_complete) basins.reset();
  }
  add_portrait(picture, reduced, search, *plane, basins ? &*basins : nullptr);
  return picture;
}

}  // namespace

MotionPicture phase_picture(const AnswerReport& report, const Analysis& analysis,
                            Progress& progress) {
  return analysis.closed ? servo_picture(report, analysis)
                         : search_picture(report, analysis, progress);
}

MotionPicture response_picture(const AnswerReport& report, const Analysis& analysis) {
  if (!analysis.closed) {
    return hunting_picture(headline(report), report.drive, analysis.reduced, *analysis.search);
  }
  MotionPicture picture = servo_picture(report, analysis);
  picture.motions.resize(1);
  if (const LimitCycle* cycle = largest_stable(*analysis.closed)) {
    picture.hunting_period = cycle->period / analysis.servo->natural_frequency;
  }
  return picture;
}

}  // namespace gearlash
