#include "gearlash/design/feasible_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gearlash/chart/on_threads.hpp"
#include "gearlash/motion/bracketed_root.hpp"

namespace gearlash {
namespace {

/// A part of the range, and what is known of it.
struct Part {
  Bounds values;
  Judgement judgement;
};

/// Undecided where there is no such drive: beside a shaft without friction a little on the other is
/// less than a servo may have.
Performance performance_if_sound(const Drivetrain& drive) {
  return validate(drive).empty() ? performance_of(drive) : Performance{};
}

class Search {
 public:
  Search(const ChangeableDrive& drive, Parameter parameter, const Target& target)
      : drive_(drive), parameter_(parameter), target_(target) {}

  std::size_t evaluations() const { return evaluations_; }

  Performance performance_at(double value) {
    ++evaluations_;
    return performance_if_sound(drive_.with(parameter_, value));
  }
  bool is_met_at(double value) { return is_met(target_, performance_at(value)); }

  /// The range in parts, in order: proved ones, and slivers of which nothing is known. What is not
  /// proved is halved, all of it by turns, so that a stretch that resists leaves no other
  /// unsearched.
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

  /// The parts of a scan: none is a sliver, and each is judged by its ends.
  std::vector<Part> scanned(const Bounds& range);

  /// Of two values, the one that meets the target and one that does not, the last to meet it.
  double last_met(double met, double unmet) {
    for (;;) {
      const double middle = middle_of(std::min(met, unmet), std::max(met, unmet));
      if (middle == met || middle == unmet) return met;
      (is_met_at(middle) ? met : unmet) = middle;
    }
  }

 private:
  static double middle_of(double low, double high) {
    return low == 0.0 && high < least ? 0.5 * high : detail::middle_of(low, high);
  }

  Judgement judge_part(const Bounds& values) {
    ++evaluations_;
    const Drivetrain low = drive_.with(parameter_, values.low);
    const Drivetrain high = drive_.with(parameter_, values.high);
    return judge(target_, box_between(low, high), guessed_flight_time(values));
  }

  /// Of a servo in the middle, or at an end.
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

  const ChangeableDrive& drive_;
  Parameter parameter_;
  const Target& target_;
  std::size_t evaluations_ = 0;
};

/// Values all over a range: by ratio where that is wide and has no 0.
std::vector<double> spread_over(const Bounds& range) {
  constexpr std::size_t count = 64;
  const bool by_ratio = range.low > 0.0 && range.high > 4.0 * range.low;
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count);
    values.push_back(by_ratio ? range.low * std::pow(range.high / range.low, share)
                              : range.low + share * (range.high - range.low));
  }
  values.push_back(range.high);
  return values;
}

/// At each value, on all cores: with bounces a servo takes some hundredths of a second.
std::vector<Performance> performances_at(const ChangeableDrive& drive, Parameter parameter,
                                         const std::vector<double>& values) {
  std::vector<Performance> performances(values.size());
  on_threads(0, values.size(), [&](std::size_t i) {
    performances[i] = performance_if_sound(drive.with(parameter, values[i]));
  });
  return performances;
}

std::vector<Part> Search::scanned(const Bounds& range) {
  const std::vector<double> values = spread_over(range);
  const std::vector<Performance> performances = performances_at(drive_, parameter_, values);
  evaluations_ += values.size();
  std::vector<Part> parts;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    const bool met = is_met(target_, performances[i]);
    const Judgement alike = met ? Judgement::all : Judgement::none;
    parts.push_back({{values[i], values[i + 1]},
                     met == is_met(target_, performances[i + 1]) ? alike : Judgement::some});
  }
  return parts;
}

/// How far beyond its limits, as a logarithm; infinite where that is not known.
double excess(const Target& target, const Performance& performance) {
  const auto beyond = [](const Bounds& limits, double value) {
    if (limits.low == 0.0 && std::isinf(limits.high)) return 0.0;
    if (std::isnan(value)) return std::numeric_limits<double>::infinity();
    const double above = std::isinf(limits.high) ? 0.0 : std::log(value / limits.high);
    const double below = limits.low == 0.0 ? 0.0 : std::log(limits.low / value);
    return std::max({0.0, above, below});
  };
  const bool is_quiet = performance.verdict == Verdict::cannot_hunt;
  const double sum = beyond(target.growth_at_rest, performance.growth_at_rest) +
                     (target.no_hunting && !is_quiet ? std::log(performance.growth_at_rest) : 0.0) +
                     beyond(target.size, performance.size) +
                     (is_quiet ? 0.0 : beyond(target.frequency, performance.frequency));
  return std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum;  // growth not known
}

/// Neighbours that are judged alike are one.
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

bool can_be_certified(const ChangeableDrive& drive, Parameter parameter) {
  const Drivetrain& present = drive.drivetrain();
  return present.motor_inertia > 0.0 && present.load_inertia > 0.0 && present.restitution == 0.0 &&
         parameter != Parameter::restitution;
}

}  // namespace

bool FeasibleValues::contains(double value) const {
  return std::any_of(intervals.begin(), intervals.end(), [&](const Bounds& interval) {
    return value >= interval.low && value <= interval.high;
  });
}

double FeasibleValues::nearest() const {
  double nearest = std::numeric_limits<double>::quiet_NaN();
  const auto distance = [&](double value) {
    return present > 0.0 && value > 0.0 ? std::abs(std::log(value / present))
                                        : std::abs(value - present);
  };
  for (const Bounds& interval : intervals) {
    const double here = std::clamp(present, interval.low, interval.high);
    if (std::isnan(nearest) || distance(here) < distance(nearest)) nearest = here;
  }
  return nearest;
}

ClosestValue closest_value(const ChangeableDrive& drive, Parameter parameter,
                           const Target& target) {
  std::vector<double> values = spread_over(drive.range(parameter));
  values.push_back(drive.present_value(parameter));
  const std::vector<Performance> performances = performances_at(drive, parameter, values);
  std::size_t closest = values.size() - 1;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (excess(target, performances[i]) < excess(target, performances[closest])) closest = i;
  }
  return {values[closest], performances[closest]};
}

FeasibleValues feasible_values(const ChangeableDrive& drive, Parameter parameter,
                               const Target& target) {
  FeasibleValues found;
  found.parameter = parameter;
  found.present = drive.present_value(parameter);
  found.searched = drive.range(parameter);
  found.kind = can_be_certified(drive, parameter) ? SearchKind::certified : SearchKind::scanned;
  Search search(drive, parameter, target);
  const std::vector<Part> parts =
      joined(found.kind == SearchKind::certified ? search.certified(found.searched)
                                                 : search.scanned(found.searched));
  const auto add = [&](double low, double high) {
    if (!found.intervals.empty() && found.intervals.back().high >= low) {
      found.intervals.back().high = high;
    } else {
      found.intervals.push_back({low, high});
    }
  };
  for (const Part& part : parts) {
    const Bounds& values = part.values;
    if (part.judgement == Judgement::all) add(values.low, values.high);
    if (part.judgement != Judgement::some) continue;
    // What its ends are is what its neighbours are.
    const bool low_met = search.is_met_at(values.low);
    const bool high_met = search.is_met_at(values.high);
    if (low_met == high_met) {
      if (values.low > 0.0) found.undecided.push_back(values);  // at 0 the range ends
      if (low_met) add(values.low, values.high);
    } else if (low_met) {
      add(values.low, search.last_met(values.low, values.high));
    } else {
      add(search.last_met(values.high, values.low), values.high);
    }
  }
  found.evaluations = search.evaluations();
  return found;
}

}  // namespace gearlash
