#include "analysis/design/feasible_values.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "analysis/design/target.hpp"
#include "analysis/design/value_scan.hpp"
#include "analysis/final_servo.hpp"
#include "analysis/grid/axis.hpp"
#include "base/on_threads.hpp"
#include "base/range_check.hpp"
#include "base/shared_progress.hpp"
#include "closed_form/growth_at_rest.hpp"

namespace gearlash {
namespace {

/// Values spread over a range: by ratio where it is wide, over the last four decades where it
/// begins at 0, evenly for a restitution.
std::vector<double> spread_over(const Bounds& range, std::size_t count, bool evenly) {
  constexpr double decades = 1e-4;
  const double low = range.low > 0.0 ? range.low : decades * range.high;
  const bool by_ratio = !evenly && range.high > 4.0 * low;
  std::vector<double> values;
  if (by_ratio && low > range.low) values.push_back(range.low);
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count);
    values.push_back(by_ratio ? low * std::pow(range.high / low, share)
                              : range.low + share * (range.high - range.low));
  }
  values.push_back(range.high);
  return values;
}

bool has_two_masses(const ChangeableDrive& drive) {
  return drive.drivetrain().motor_inertia > 0.0 && drive.drivetrain().load_inertia > 0.0;
}

bool has_bounces(const ChangeableDrive& drive, const ChangeableNumber& number) {
  return has_two_masses(drive) && (number.is_restitution() || drive.drivetrain().restitution > 0.0);
}

class Search {
 public:
  Search(const ChangeableDrive& drive, const ChangeableNumber& number, const Target& target,
         Progress& progress)
      : drive_(drive), number_(number), target_(target), shared_(progress, usual_evaluations) {
    if (number.is_backlash() && has_bounces(drive, number)) {
      at_present_ = performance_of(drive.drivetrain());
    }
    for (const Quantity quantity : {Quantity::amplitude, Quantity::frequency}) {
      of_motion_.require(quantity, target.permitted(quantity));
    }
  }

  std::size_t evaluations() const { return evaluations_; }
  bool is_stopped() const { return shared_.is_stopped(); }

  bool is_met_at(double value) { return judged(value).is_met; }

  /// The range in parts, in order: proved parts and undecided slivers. Each round halves all open
  /// parts, so that a difficult part does not leave others unsearched.
  std::vector<Part> certified(const Bounds& range) {
    std::vector<Part> proved;
    std::vector<Bounds> open = {range};
    while (!open.empty()) {
      std::vector<Bounds> halves;
      for (const Bounds& values : open) {
        const Judgement judgement = judge_part(values);
        if (judgement != Judgement::some || is_sliver(values, range.high)) {
          proved.push_back({values, judgement});
          continue;
        }
        const double middle = middle_value(values.low, values.high);
        halves.push_back({values.low, middle});
        halves.push_back({middle, values.high});
      }
      open = std::move(halves);
      constexpr std::size_t most_open = 20'000;
      if (open.size() <= most_open && shared_.go_on(0.0)) continue;
      for (const Bounds& values : open) proved.push_back({values, Judgement::some});
      break;
    }
    std::sort(proved.begin(), proved.end(),
              [](const Part& a, const Part& b) { return a.values.low < b.values.low; });
    return proved;
  }

  /// The parts of a scan. None is a sliver; the ends of each decide its judgement.
  std::vector<Part> scanned(const Bounds& range) { return parts_between(tried(range)); }

  LastMet last_met_between(double met, double unmet) {
    const auto judge = [this](double value) { return judged(value); };
    constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
    if (!has_bounces(drive_, number_)) return last_met(judge, met, unmet, {rounding, rounding});
    // Growth at rest is cheap, and what it does not rule out usually meets the target.
    const double allowed = last_allowed_by_growth(met, unmet);
    if (allowed == met || is_met_at(allowed)) return {allowed, unmet};
    constexpr double at_jump = 1e-6;  // more is not worth a search for cycles per step
    return last_met(judge, met, allowed, {rounding, at_jump});
  }

  /// The tried value that comes closest to the target.
  double closest(const Bounds& range) {
    std::vector<JudgedValue> all = tried(range);
    all.push_back(judged(number_.present));
    return closest_of(all);
  }

 private:
  /// Undecided where there is no valid drive: next to a shaft without friction, a small friction on
  /// the other shaft is less than a servo may have.
  Performance performance_at(double value) const {
    if (at_present_) {
      Performance scaled = *at_present_;
      scaled.amplitude *= value / drive_.drivetrain().backlash;
      return scaled;
    }
    const Drivetrain drive = drive_.with(number_.name, value);
    return validate(drive).empty() ? performance_for(target_, drive) : Performance{};
  }

  /// From several threads at a time.
  JudgedValue judged(double value) {
    if (!shared_.finish(evaluations_ < usual_evaluations ? 1 : 0)) {
      return {.value = value, .is_known = false, .beyond = Target::infinity};
    }
    ++evaluations_;
    const Performance performance = performance_at(value);
    return {.value = value,
            .is_met = is_met(target_, performance),
            .is_known = !has_bounces(drive_, number_) || is_known(target_, performance),
            .moves = performance.verdict != Verdict::cannot_hunt,
            .beyond = excess(target_, performance),
            .moves_beyond = excess(of_motion_, performance)};
  }

  /// Values over the whole range, in order, denser near a limit.
  const std::vector<JudgedValue>& tried(const Bounds& range) {
    if (tried_.empty()) {
      tried_ = tried_values([this](double value) { return judged(value); },
                            {.first = first_values(range)});
    }
    return tried_;
  }

  std::vector<double> first_values(const Bounds& range) {
    const bool bounces = has_bounces(drive_, number_);
    const bool evenly = number_.is_restitution();
    std::vector<double> values = spread_over(range, bounces ? coarse : fine, evenly);
    if (!bounces) return values;
    // Growth at rest is cheap; between these values it passes 1 or a limit.
    const std::vector<double> looked_at = spread_over(range, fine, evenly);
    std::vector<double> growths(looked_at.size());
    on_threads(0, looked_at.size(), [&](std::size_t i) {
      if (shared_.go_on(0.0)) growths[i] = growth_at(looked_at[i]);
    });
    const auto differ = [&](double a, double b) {
      return (a > 1.0) != (b > 1.0) || is_ruled_out(target_, a) != is_ruled_out(target_, b);
    };
    for (std::size_t i = 0; i + 1 < looked_at.size(); ++i) {
      if (!differ(growths[i], growths[i + 1])) continue;
      values.push_back(looked_at[i]);
      values.push_back(looked_at[i + 1]);
    }
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
  }

  /// NaN where there is no valid drive.
  double growth_at(double value) const {
    const Drivetrain drive = drive_.with(number_.name, value);
    if (!validate(drive).empty()) return std::numeric_limits<double>::quiet_NaN();
    return growth_at_rest(servo_dynamics(normalize(drive)));
  }

  /// The last value, starting from one that meets the target, that growth at rest does not rule
  /// out. Growth very close to 1 is excluded too, because the search for cycles cannot distinguish
  /// rest from hunting there.
  double last_allowed_by_growth(double met, double unmet) const {
    constexpr double told_apart = 1e-6;
    const bool asks_for_rest = target_.no_hunting || target_.no_hunting_if_disturbed;
    const auto is_allowed = [&](double value) {
      const double growth = growth_at(value);
      return !is_ruled_out(target_, growth) && !(asks_for_rest && growth > 1.0 - told_apart);
    };
    if (is_allowed(unmet)) return unmet;
    for (;;) {
      const double middle = middle_value(std::min(met, unmet), std::max(met, unmet));
      if (middle == met || middle == unmet) return met;
      (is_allowed(middle) ? met : unmet) = middle;
    }
  }

  Judgement judge_part(const Bounds& values) {
    ++evaluations_;
    return judge(target_, drive_.box(number_.name, values), guessed_flight_time(values));
  }

  /// The flight time at the middle, else at an end.
  double guessed_flight_time(const Bounds& values) {
    for (const double value : {middle_value(values.low, values.high), values.low, values.high}) {
      const double time = performance_at(value).flight_time;
      if (!std::isnan(time)) return time;
    }
    return std::numeric_limits<double>::quiet_NaN();
  }

  static bool is_sliver(const Bounds& values, double top) {
    constexpr double width = 1e-10;
    return values.high - values.low <= width * values.high || values.high <= width * width * top;
  }

  static constexpr std::size_t coarse = 64;  ///< a servo with bounces takes milliseconds
  static constexpr std::size_t fine = 1024;
  static constexpr std::size_t usual_evaluations = 500;  ///< for the progress alone

  const ChangeableDrive& drive_;
  const ChangeableNumber& number_;
  const Target& target_;
  std::optional<Performance> at_present_;  ///< for backlash: amplitudes are proportional to it
  Target of_motion_;
  std::vector<JudgedValue> tried_;
  std::atomic<std::size_t> evaluations_ = 0;
  SharedProgress shared_;
};

/// Joins neighbors with the same judgement.
std::vector<Part> joined(const std::vector<Part>& parts) {
  std::vector<Part> all;
  for (const Part& part : parts) {
    if (!all.empty() && all.back().judgement == part.judgement) {
      all.back().values.high = part.values.high;
    } else {
      all.push_back(part);
    }
  }
  return all;
}

}  // namespace

bool FeasibleValues::contains(double value) const {
  return std::any_of(intervals.begin(), intervals.end(),
                     [&](const Bounds& interval) { return interval.contains(value); });
}

std::optional<double> FeasibleValues::nearest() const {
  std::optional<double> nearest;
  const auto distance = [&](double value) {
    return present > 0.0 && value > 0.0 ? std::abs(std::log(value / present))
                                        : std::abs(value - present);
  };
  for (const Bounds& interval : intervals) {
    const double here = std::clamp(present, interval.low, interval.high);
    if (!nearest || distance(here) < distance(*nearest)) nearest = here;
  }
  return nearest;
}

std::vector<double> FeasibleValues::nearest_of_each() const {
  if (closest) return {*closest};
  std::vector<double> nearest;
  for (const Bounds& interval : intervals) {
    const double from = std::isnan(present) ? interval.low : present;
    nearest.push_back(std::clamp(from, interval.low, interval.high));
  }
  return nearest;
}

FeasibleValues feasible_values(const ChangeableDrive& drive, std::string_view parameter,
                               const Target& target, Progress& progress) {
  const ChangeableNumber& number = drive.number(parameter);
  FeasibleValues found;
  found.parameter = number.name;
  found.present = number.present;
  found.searched = drive.range(parameter);
  found.kind = has_bounces(drive, number) ? SearchKind::scanned : SearchKind::certified;
  Search search(drive, number, target, progress);
  const std::vector<Part> parts = found.kind == SearchKind::certified
                                      ? joined(search.certified(found.searched))
                                      : search.scanned(found.searched);
  put_together(
      parts, [&](double value) { return search.is_met_at(value); },
      [&](double met, double unmet) { return search.last_met_between(met, unmet); }, found);
  if (found.intervals.empty()) found.closest = search.closest(found.searched);
  found.evaluations = search.evaluations();
  found.stopped = search.is_stopped();
  return found;
}

bool is_closed_form_task(const Drive& drive, const Target& target,
                         const std::vector<std::string>& parameters) {
  const std::optional<Drive> closed = closed_form_drive(drive);
  if (!closed || !is_of_performance(target)) return false;
  const ChangeableDrive changeable(*closed);
  return std::none_of(parameters.begin(), parameters.end(), [&](const std::string& name) {
    const bool has_range = name.find('=') != std::string::npos;
    return has_range || (changeable.find(name) == nullptr &&
                         parameter_of({.path = path_named(name, drive)}, drive) != nullptr);
  });
}

FeasibleValues feasible_values(const Drive& drive, std::string_view parameter,
                               const Target& target) {
  require_none(faults_for_performance(target));
  return feasible_values(ChangeableDrive(drive), parameter, target);
}

}  // namespace gearlash
