#include "analysis/design/feasible_values.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "analysis/design/target.hpp"
#include "base/bracketed_root.hpp"
#include "base/on_threads.hpp"
#include "base/range_check.hpp"
#include "closed_form/growth_at_rest.hpp"

namespace gearlash {
namespace {

/// A part of the range and its judgement.
struct Part {
  Bounds values;
  Judgement judgement;
  /// No cycle is known at one of its ends, or at a value tried between them.
  bool is_unknown = false;
};

/// A value and the drive's performance there.
struct TriedValue {
  double value = 0.0;
  Performance performance{};
};

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

void sort_by_value(std::vector<TriedValue>& tried) {
  std::sort(tried.begin(), tried.end(),
            [](const TriedValue& a, const TriedValue& b) { return a.value < b.value; });
}

bool has_two_masses(const ChangeableDrive& drive) {
  return drive.drivetrain().motor_inertia > 0.0 && drive.drivetrain().load_inertia > 0.0;
}

bool has_bounces(const ChangeableDrive& drive, const ChangeableNumber& number) {
  return has_two_masses(drive) && (number.is_restitution() || drive.drivetrain().restitution > 0.0);
}

class Search {
 public:
  Search(const ChangeableDrive& drive, const ChangeableNumber& number, const Target& target)
      : drive_(drive), number_(number), target_(target) {
    if (number.is_backlash() && has_bounces(drive, number)) {
      at_present_ = performance_of(drive.drivetrain());
    }
  }

  std::size_t evaluations() const { return evaluations_; }

  bool is_met_at(double value) {
    ++evaluations_;
    return is_met(target_, performance_at(value));
  }

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
        const double middle = middle_of(values.low, values.high);
        halves.push_back({values.low, middle});
        halves.push_back({middle, values.high});
      }
      open = std::move(halves);
      constexpr std::size_t most_open = 20'000;
      if (open.size() <= most_open) continue;
      for (const Bounds& values : open) proved.push_back({values, Judgement::some});
      break;
    }
    std::sort(proved.begin(), proved.end(),
              [](const Part& a, const Part& b) { return a.values.low < b.values.low; });
    return proved;
  }

  /// The parts of a scan. None is a sliver; the ends of each decide its judgement.
  std::vector<Part> scanned(const Bounds& range) {
    std::vector<Part> parts;
    const std::vector<TriedValue> tried = tried_values(range);
    for (std::size_t i = 0; i + 1 < tried.size(); ++i) {
      const Performance& low = tried[i].performance;
      const Performance& high = tried[i + 1].performance;
      const bool met = is_met(target_, low);
      const Judgement alike = met ? Judgement::all : Judgement::none;
      parts.push_back({{tried[i].value, tried[i + 1].value},
                       met == is_met(target_, high) ? alike : Judgement::some,
                       !is_known(target_, low) || !is_known(target_, high)});
    }
    return parts;
  }

  /// The last value that meets the target, between one that meets it and one that does not.
  struct LastMet {
    double value;
    bool met_unknown = false;  ///< somewhere between the two no cycle is known
  };
  LastMet last_met(double met, double unmet) {
    bool met_unknown = false;
    const bool bounces = has_bounces(drive_, number_);
    if (bounces) {
      // Growth at rest is cheap, and what it does not rule out usually meets the target.
      const double allowed = last_allowed_by_growth(met, unmet);
      if (allowed == met || is_met_at(allowed)) return {allowed};
      unmet = allowed;
    }
    double met_by = 1.0;
    double missed_by = 1.0;
    const auto signed_excess = [&](double value) {
      ++evaluations_;
      const Performance performance = performance_at(value);
      const bool here = is_met(target_, performance);
      met_unknown = met_unknown || (bounces && !is_known(target_, performance));
      (here ? met : unmet) = value;
      // Only the sign decides; the magnitude speeds up the root finder.
      const double size = std::abs(excess(target_, performance));
      const double usable = std::clamp(std::isnan(size) ? 1.0 : size, least, 1.0);
      (here ? met_by : missed_by) = usable;
      return here ? -usable : usable;
    };
    // At a jump higher resolution is not worth a search for cycles per step.
    const auto resolution = [&] {
      constexpr double near = 1e-3;
      const bool jumps = bounces && !(met_by < near && missed_by < near);
      return jumps ? 1e-6 : 4.0 * std::numeric_limits<double>::epsilon();
    };
    const auto is_close = [&](double low, double high) {
      return high - low <= resolution() * high;
    };
    const double low = std::min(met, unmet);
    const double high = std::max(met, unmet);
    if (is_close(low, high)) return {met};
    const double at_low = signed_excess(low);
    const double at_high = signed_excess(high);
    std::uintmax_t most = 400;
    boost::math::tools::toms748_solve(signed_excess, low, high, at_low, at_high, is_close, most);
    return {met, met_unknown};
  }

  /// The tried value that comes closest to the target.
  double closest(const Bounds& range) {
    std::vector<TriedValue> tried = tried_values(range);
    tried.push_back(at(number_.present));
    const auto beyond = [&](const TriedValue& one) { return excess(target_, one.performance); };
    const auto nearest =
        std::min_element(tried.begin(), tried.end(),
                         [&](const auto& a, const auto& b) { return beyond(a) < beyond(b); });
    return nearest->value;
  }

 private:
  bool is_unknown(const TriedValue& tried) const { return !is_known(target_, tried.performance); }

  static bool hunts(const TriedValue& tried) {
    return tried.performance.verdict != Verdict::cannot_hunt;
  }

  static double middle_of(double low, double high) {
    return low == 0.0 && high < least ? 0.5 * high : detail::middle_of(low, high);
  }

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

  TriedValue at(double value) const { return {value, performance_at(value)}; }

  std::vector<TriedValue> at_all(const std::vector<double>& values) {
    std::vector<TriedValue> tried(values.size());
    on_threads(0, values.size(), [&](std::size_t i) { tried[i] = at(values[i]); });
    evaluations_ += values.size();
    return tried;
  }

  /// Values over the whole range, in order, denser near a limit.
  const std::vector<TriedValue>& tried_values(const Bounds& range) {
    if (!tried_.empty()) return tried_;
    tried_ = at_all(first_values(range));
    constexpr int most_halvings = 6;
    constexpr int halvings_everywhere = 2;
    for (int i = 0; i < most_halvings; ++i) {
      const bool met_unknown = std::any_of(tried_.begin(), tried_.end(),
                                           [&](const auto& one) { return is_unknown(one); });
      const bool everywhere = met_unknown && i < halvings_everywhere;
      const std::vector<TriedValue> between = at_all(middles_to_try(everywhere));
      if (between.empty()) break;
      tried_.insert(tried_.end(), between.begin(), between.end());
      sort_by_value(tried_);
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
    on_threads(0, looked_at.size(), [&](std::size_t i) { growths[i] = growth_at(looked_at[i]); });
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
    const auto is_allowed = [&](double value) {
      const double growth = growth_at(value);
      return !is_ruled_out(target_, growth) && !(target_.no_hunting && growth > 1.0 - told_apart);
    };
    if (is_allowed(unmet)) return unmet;
    for (;;) {
      const double middle = middle_of(std::min(met, unmet), std::max(met, unmet));
      if (middle == met || middle == unmet) return met;
      (is_allowed(middle) ? met : unmet) = middle;
    }
  }

  /// The middles of intervals whose ends lie on one side of a limit of the cycle and no farther
  /// from it than the performance changes there or in an adjacent interval; of intervals next to
  /// motion without a known cycle; and, if `everywhere`, of all intervals that hunt, because
  /// irregular motion has windows of other motion in it.
  std::vector<double> middles_to_try(bool everywhere) const {
    const Target of_cycles{.amplitude = target_.amplitude, .frequency = target_.frequency};
    std::vector<double> beyond;
    for (const TriedValue& one : tried_) beyond.push_back(excess(of_cycles, one.performance));
    const auto change = [&](std::size_t i) {
      return i + 1 < beyond.size() ? std::abs(beyond[i + 1] - beyond[i]) : 0.0;
    };
    std::vector<double> middles;
    const auto is_near_limit = [&](std::size_t i) {
      const bool is_crossed = (beyond[i] > 0.0) != (beyond[i + 1] > 0.0);
      const double distance = std::min(std::abs(beyond[i]), std::abs(beyond[i + 1]));
      const double steepest = std::max({change(i), i > 0 ? change(i - 1) : 0.0, change(i + 1)});
      return !is_crossed && std::isfinite(distance) && steepest > distance;
    };
    const auto is_wanted = [&](std::size_t i) {
      if (is_near_limit(i) || is_unknown(tried_[i]) != is_unknown(tried_[i + 1])) return true;
      return everywhere && hunts(tried_[i]) && hunts(tried_[i + 1]);
    };
    for (std::size_t i = 0; i + 1 < beyond.size(); ++i) {
      if (!is_wanted(i)) continue;
      const double low = tried_[i].value;
      const double high = tried_[i + 1].value;
      middles.push_back(low == 0.0 ? 0.5 * high : middle_of(low, high));
    }
    return middles;
  }

  Judgement judge_part(const Bounds& values) {
    ++evaluations_;
    return judge(target_, drive_.box(number_.name, values), guessed_flight_time(values));
  }

  /// The flight time at the middle, else at an end.
  double guessed_flight_time(const Bounds& values) {
    for (const double value : {middle_of(values.low, values.high), values.low, values.high}) {
      const double time = performance_at(value).flight_time;
      if (!std::isnan(time)) return time;
    }
    return std::numeric_limits<double>::quiet_NaN();
  }

  static bool is_sliver(const Bounds& values, double top) {
    constexpr double width = 1e-10;
    return values.high - values.low <= width * values.high || values.high <= width * width * top;
  }

  static constexpr double least = 1e-300;
  static constexpr std::size_t coarse = 64;  ///< a servo with bounces takes milliseconds
  static constexpr std::size_t fine = 1024;

  const ChangeableDrive& drive_;
  const ChangeableNumber& number_;
  const Target& target_;
  std::optional<Performance> at_present_;  ///< for backlash: amplitudes are proportional to it
  std::vector<TriedValue> tried_;
  std::size_t evaluations_ = 0;
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

FeasibleValues feasible_values(const ChangeableDrive& drive, std::string_view parameter,
                               const Target& target) {
  const ChangeableNumber& number = drive.number(parameter);
  FeasibleValues found;
  found.parameter = number.name;
  found.present = number.present;
  found.searched = drive.range(parameter);
  found.kind = has_bounces(drive, number) ? SearchKind::scanned : SearchKind::certified;
  Search search(drive, number, target);
  const std::vector<Part> parts = found.kind == SearchKind::certified
                                      ? joined(search.certified(found.searched))
                                      : search.scanned(found.searched);
  const auto add = [&](double low, double high) {
    if (!found.intervals.empty() && found.intervals.back().high >= low) {
      found.intervals.back().high = high;
    } else {
      found.intervals.push_back({low, high});
    }
  };
  const auto add_undecided = [&](double low, double high) {
    if (!found.undecided.empty() && found.undecided.back().high >= low) {
      found.undecided.back().high = high;
    } else {
      found.undecided.push_back({low, high});
    }
  };
  for (const Part& part : parts) {
    const Bounds& values = part.values;
    if (part.is_unknown) {
      add_undecided(values.low, values.high);
      continue;
    }
    if (part.judgement == Judgement::all) add(values.low, values.high);
    if (part.judgement != Judgement::some) continue;
    // The ends of a sliver belong to its neighbors, which are decided.
    const bool low_met = search.is_met_at(values.low);
    const bool high_met = search.is_met_at(values.high);
    if (low_met == high_met) {
      if (values.low > 0.0) add_undecided(values.low, values.high);  // a sliver at 0 ends the range
      if (low_met) add(values.low, values.high);
    } else if (low_met) {
      const auto [last, met_unknown] = search.last_met(values.low, values.high);
      add(values.low, last);
      if (met_unknown) add_undecided(last, values.high);
    } else {
      const auto [first, met_unknown] = search.last_met(values.high, values.low);
      if (met_unknown) add_undecided(values.low, first);
      add(first, values.high);
    }
  }
  if (found.intervals.empty()) found.closest = search.closest(found.searched);
  found.evaluations = search.evaluations();
  return found;
}

FeasibleValues feasible_values(const Drive& drive, std::string_view parameter,
                               const Target& target) {
  require_none(faults(target));
  return feasible_values(ChangeableDrive(drive), parameter, target);
}

}  // namespace gearlash
