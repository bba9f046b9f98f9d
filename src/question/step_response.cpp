#include "question/step_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "base/lists.hpp"
#include "base/range_check.hpp"
#include "general/assemble/time_scale.hpp"
#include "general/attractors/motion_measures.hpp"
#include "numeric/zero_between.hpp"
#include "question/motion.hpp"

namespace gearlash::drive {
namespace {

/// The load's path along the step: all its turning points, with samples between them.
class Path {
 public:
  Path(const hybrid::Trajectory& motion, double way) : motion_(motion) {
    const auto along = [&](Eigen::Index number) {
      return hybrid::AffineForm{way * hybrid::Vector::Unit(motion.end().numbers.size(), number)};
    };
    position_ = along(load_position);
    points_ = rough_samples(motion, {position_, along(load_speed), {}});
    constexpr int samples = 4096;
    for (int i = 0; i <= samples; ++i) {
      const double time = motion.end_time() * i / samples;
      points_.push_back({time, position(time)});
    }
    sort_by(points_, &Sample::time);
  }

  const std::vector<Sample>& points() const { return points_; }

  /// The first time at which the path crosses the level, in either direction.
  std::optional<double> first_passing(double level) const {
    for (std::size_t i = 1; i < points_.size(); ++i) {
      if ((points_[i - 1].value < level) != (points_[i].value < level)) {
        return passing_between(i - 1, i, level);
      }
    }
    return std::nullopt;
  }

  /// The time from which the path stays within the band about a level; empty if it ends outside.
  std::optional<double> time_into_band(double level, double band) const {
    const auto outside = [&](const Sample& point) { return std::abs(point.value - level) > band; };
    if (outside(points_.back())) return std::nullopt;
    for (std::size_t i = points_.size(); i-- > 1;) {
      if (!outside(points_[i - 1])) continue;
      const double edge = points_[i - 1].value < level ? level - band : level + band;
      return passing_between(i - 1, i, edge);
    }
    return 0.0;
  }

 private:
  double position(double time) const { return position_.at(motion_.at(time).numbers); }

  double passing_between(std::size_t first, std::size_t second, double level) const {
    const auto& [low, at_low] = points_[first];
    const auto& [high, at_high] = points_[second];
    return zero_between(low, high, at_low - level, at_high - level,
                        [&](double time) { return position(time) - level; });
  }

  const hybrid::Trajectory& motion_;
  hybrid::AffineForm position_;
  std::vector<Sample> points_;
};

void measure(const Path& path, bool is_stopped, StepResponse& response) {
  const double step = std::abs(response.step);
  const std::optional<double> low = path.first_passing(0.1 * step);
  const std::optional<double> high = path.first_passing(0.9 * step);
  if (low && high) response.rise_time = *high - *low;
  const double late = 0.8 * path.points().back().time;
  // A sustained oscillation may end within the band by chance. It has settled only if it stays
  // there for the whole last fifth.
  const std::optional<double> settled = path.time_into_band(step, response.band);
  if (settled && *settled <= late && !is_stopped) response.settling_time = settled;
  double highest = 0.0;
  Extent last;
  for (const Sample& point : path.points()) {
    highest = std::max(highest, point.value);
    if (point.time >= late) last.include(point.value);
  }
  if (response.is_whole) response.overshoot = std::max(0.0, highest / step - 1.0);
  const double error = step - last.middle();
  response.final_error = response.step < 0.0 ? -error : error;
  response.ripple = 0.5 * last.width();
}

/// The motion whose response is measured.
hybrid::Trajectory step_motion(ReducedDrive drive, double step, double until, Progress& progress) {
  RangeCheck check;
  if (!(std::isfinite(step) && step != 0.0)) {
    check.refuse("step", exact_text(step), "must be finite and not 0, rad");
  }
  check.positive("until", until, "s");
  require_none(check.faults());
  drive.reference = step;
  const DriveSystem system = drive_system(drive);
  const double way = step < 0.0 ? -1.0 : 1.0;
  const ShaftStates rest{.motor_position = way * 0.5 * drive.backlash};
  return hybrid::simulate(
      system.system, drive_start(drive, system, rest),
      {.until = until, .step_limit = most_steps_of_a_motion, .progress = &progress});
}

}  // namespace

double step_of(const Drive& drive) {
  constexpr double degree = std::numbers::pi / 180.0;
  return drive.specification.step.value_or(drive.servo ? 1.0 : degree);
}

double band_of(const Drive& drive, const ReducedDrive& reduced) {
  const Specification& asked = drive.specification;
  if (asked.band) return *asked.band;
  if (asked.error) return *asked.error;
  constexpr double of_step = 0.01;
  const double count = reduced.sensing.resolution;
  return count > 0.0 ? count : of_step * std::abs(step_of(drive));
}

double usual_step_time(const ReducedDrive& drive) {
  constexpr double swings = 20.0;
  return swings * time_scales(drive).swing;
}

StepResponse step_response(const ReducedDrive& drive, double step, double band, double until,
                           Progress& progress) {
  const hybrid::Trajectory motion = step_motion(drive, step, until, progress);
  StepResponse response{.step = step, .until = motion.end_time(), .band = band};
  response.is_whole = motion.stop_reason() == hybrid::StopReason::reached_end;
  const bool is_stopped = motion.stop_reason() == hybrid::StopReason::stopped;
  if (motion.end_time() > 0.0) {
    measure(Path(motion, step < 0.0 ? -1.0 : 1.0), is_stopped, response);
  }
  return response;
}

StepResponse step_response_to_end(const ReducedDrive& drive, double step, double band,
                                  Progress& progress) {
  constexpr double longest = 64.0;
  constexpr double still = 1e-6;   // of the step: the load stands
  constexpr double hardly = 1e-2;  // of what is left of the way
  const double usual = usual_step_time(drive);
  StepResponse response = step_response(drive, step, band, usual, progress);
  for (double times = 2.0; times <= longest && response.is_whole; times *= 2.0) {
    const double left = std::abs(response.final_error);
    const bool has_arrived = response.rise_time && left <= band;
    if (has_arrived || response.ripple <= still * std::abs(step)) break;
    response = step_response(drive, step, band, times * usual, progress);
    const double nearer = left - std::abs(response.final_error);
    if (nearer <= (response.rise_time ? hardly * left : 0.0)) break;
  }
  return response;
}

}  // namespace gearlash::drive
