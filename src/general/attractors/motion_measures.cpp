#include "general/attractors/motion_measures.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "hybrid/disturbances.hpp"
#include "hybrid/turns.hpp"
#include "numeric/linear_algebra.hpp"
#include "numeric/zero_between.hpp"

namespace gearlash::drive {
namespace {

using hybrid::Event;
using hybrid::HybridSystem;
using hybrid::Matrix;
using hybrid::State;
using hybrid::Trajectory;
using hybrid::Vector;

constexpr unsigned bits_of_time = 40;

}  // namespace

Watched watched(const HybridSystem& system, hybrid::AffineForm value, hybrid::AffineForm speed) {
  hybrid::PreparedSystem turns(with_turns(system, speed, hybrid::OtherEvents::left_out));
  return {std::move(value), std::move(speed), std::move(turns)};
}

double largest_size(const Trajectory& motion, const HybridSystem& system,
                    const std::function<std::optional<hybrid::AffineForm>(std::size_t)>& form_of) {
  // Modes without a form are not entered.
  const auto rate = [form_of](std::size_t index, const hybrid::AffineMode& mode) {
    return rate_of(form_of(index).value(), mode.flow);
  };
  const hybrid::PreparedSystem turns(with_turns(system, rate, hybrid::OtherEvents::left_out));
  double largest = 0.0;
  for_each_turn(
      motion, turns, [&](std::size_t mode) { return form_of(mode).has_value(); },
      [&](double, std::size_t mode, const Vector& numbers) {
        largest = std::max(largest, std::abs(form_of(mode)->at(numbers)));
      });
  return largest;
}

std::vector<Sample> samples(const Trajectory& motion, const Watched& watched) {
  std::vector<Sample> result;
  for_each_turn(
      motion, watched.turns, [](std::size_t) { return true; },
      [&](double time, std::size_t, const Vector& numbers) {
        result.push_back({time, watched.value.at(numbers)});
      });
  return result;
}

std::vector<Sample> rough_samples(const Trajectory& motion, const Watched& watched) {
  std::vector<Sample> result;
  std::size_t step = 0;
  State here;  // outlives the search of a turn, which calls for a state often
  for_each_stretch(motion, [&](const State& start, double from, double to, const Vector& end) {
    result.push_back({from, watched.value.at(start.numbers)});
    double before = watched.speed.at(start.numbers);
    const auto pass = [&](double until, double after) {
      if (before * after < 0.0) {
        const auto speed_at = [&](double time) {
          motion.at(time, here);
          return watched.speed.at(here.numbers);
        };
        const double turn = zero_between(from, until, before, after, speed_at, bits_of_time);
        motion.at(turn, here);
        result.push_back({turn, watched.value.at(here.numbers)});
      }
      from = until;
      before = after;
    };
    for (; step < motion.steps() && motion.step_time(step) < to; ++step) {
      if (motion.step_time(step) <= from) continue;
      pass(motion.step_time(step), watched.speed.at(motion.step_start(step)));
    }
    if (to > from) pass(to, watched.speed.at(end));
    result.push_back({to, watched.value.at(end)});
  });
  return result;
}

std::vector<Sample> extremes(const std::vector<Sample>& samples, double least) {
  std::vector<Sample> result;
  if (samples.empty()) return result;
  double way = 0.0;
  Sample farthest = samples.front();
  for (const Sample& sample : samples) {
    const double change = sample.value - farthest.value;
    if (way * change >= 0.0 && way != 0.0) {
      farthest = sample;
    } else if (std::abs(change) > least) {
      if (way != 0.0) result.push_back(farthest);
      way = change > 0.0 ? 1.0 : -1.0;
      farthest = sample;
    }
  }
  return result;
}

std::vector<Sample> after(const std::vector<Sample>& all, double from) {
  // Times rise.
  const auto first = std::partition_point(all.begin(), all.end(),
                                          [&](const Sample& sample) { return sample.time < from; });
  return {first, all.end()};
}

Extent extent_of(const std::vector<Sample>& samples) {
  Extent range;
  for (const Sample& sample : samples) range.include(sample.value);
  return range;
}

std::vector<Extent> extents(const Trajectory& motion, double from, double to) {
  std::vector<Extent> result(static_cast<std::size_t>(motion.end().numbers.size()));
  const auto include = [&](const Vector& numbers) {
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i].include(numbers[static_cast<Eigen::Index>(i)]);
    }
  };
  constexpr int between = 8;  // samples between events
  to = std::min(to, motion.end_time());
  for (int i = 0; i <= between; ++i) include(motion.at(from + (to - from) * i / between).numbers);
  for (const Event& event : motion.events()) {
    if (event.time <= from || event.time > to) continue;
    include(event.before);
    include(event.after);
  }
  return result;
}

Spread spread_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  Spread spread{0.0, 0.0};
  for (const double value : values) spread.mean += value;
  spread.mean /= static_cast<double>(values.size());
  for (const double value : values) {
    spread.deviation += (value - spread.mean) * (value - spread.mean);
  }
  spread.deviation = std::sqrt(spread.deviation / static_cast<double>(values.size()));
  return spread;
}

std::vector<double> upward_passings(const Trajectory& motion, const Watched& watched,
                                    const std::vector<Sample>& samples, double level,
                                    double after) {
  std::vector<double> times;
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const Sample& low = samples[i];
    const Sample& high = samples[i + 1];
    if (low.time < after || low.value >= level || high.value < level) continue;
    const auto above_at = [&](double time) {
      return watched.value.at(motion.at(time).numbers) - level;
    };
    times.push_back(zero_between(low.time, high.time, low.value - level, high.value - level,
                                 above_at, bits_of_time));
  }
  return times;
}

std::vector<double> upward_passings(const std::vector<Sample>& extremes, double level) {
  std::vector<double> times;
  for (std::size_t i = 0; i + 1 < extremes.size(); ++i) {
    const Sample& low = extremes[i];
    const Sample& high = extremes[i + 1];
    if (low.value >= level || high.value < level) continue;
    const double share = (level - low.value) / (high.value - low.value);
    times.push_back(low.time +
                    (high.time - low.time) * std::acos(1.0 - 2.0 * share) / std::numbers::pi);
  }
  return times;
}

double size_exceeded_for(double share, const std::vector<Sample>& samples) {
  const auto share_below = [](const Sample& one, const Sample& other, double level) {
    const double low = std::min(one.value, other.value);
    const double high = std::max(one.value, other.value);
    if (level <= low) return 0.0;
    if (level >= high) return 1.0;
    return std::acos(1.0 - 2.0 * (level - low) / (high - low)) / std::numbers::pi;
  };
  const auto time_beyond = [&](double level) {
    double time = 0.0;
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
      const double within = share_below(samples[i], samples[i + 1], level) -
                            share_below(samples[i], samples[i + 1], -level);
      time += (1.0 - within) * (samples[i + 1].time - samples[i].time);
    }
    return time;
  };
  const double permitted = share * (samples.back().time - samples.front().time);
  double inside = 0.0;
  double beyond = 0.0;
  for (const Sample& sample : samples) beyond = std::max(beyond, std::abs(sample.value));
  constexpr int bisections = 40;
  for (int i = 0; i < bisections; ++i) {
    const double middle = 0.5 * (inside + beyond);
    (time_beyond(middle) > permitted ? inside : beyond) = middle;
  }
  return beyond;
}

double least_mismatch(const std::vector<Sample>& extremes) {
  constexpr std::size_t most = 1000;  // the comparison takes the square of this
  std::vector<double> swings;
  for (std::size_t i = extremes.size() > most ? extremes.size() - most : 0; i + 1 < extremes.size();
       ++i) {
    swings.push_back(std::abs(extremes[i + 1].value - extremes[i].value));
  }
  double least = std::numeric_limits<double>::quiet_NaN();
  const double mean_swing = spread_of(swings).mean;
  for (std::size_t lag = 1; 2 * lag <= swings.size(); ++lag) {
    double sum = 0.0;
    for (std::size_t i = 0; i + lag < swings.size(); ++i) {
      sum += std::abs(swings[i + lag] - swings[i]);
    }
    const double mean = sum / static_cast<double>(swings.size() - lag) / mean_swing;
    if (!(mean >= least)) least = mean;
  }
  return least;
}

namespace {

/// Exponentials of the modes' flows, kept for times that recur, as between the ticks of a clock.
class Exponentials {
 public:
  /// Times that differ by less than `apart` count as one.
  Exponentials(const HybridSystem& system, double apart) : system_(system), apart_(apart) {}

  const Matrix& of(std::size_t mode, double time) {
    const auto [place, is_new] = kept_.try_emplace({mode, std::llround(time / apart_)});
    if (is_new) place->second = exponential(system_.mode(mode).flow.matrix * time);
    return place->second;
  }

 private:
  const HybridSystem& system_;
  double apart_;
  std::map<std::pair<std::size_t, long long>, Matrix> kept_;
};

}  // namespace

double largest_exponent(const HybridSystem& system, const Trajectory& motion, Eigen::Index own) {
  Matrix disturbance = Matrix::Zero(system.size(), 1);
  Eigen::RowVectorXd delay = Eigen::RowVectorXd::Zero(1);
  // A direction with a component along any growing one.
  for (Eigen::Index i = 0; i < own; ++i) {
    disturbance(i, 0) = 1.0 / std::sqrt(2.0 + static_cast<double>(i));
  }
  double logarithm = 0.0;
  std::size_t next = 0;
  const std::vector<Event>& events = motion.events();
  constexpr double share = 1e-9;  // of the mean time between events
  const double duration = motion.end_time() - motion.start_time();
  Exponentials exponentials(system, share * duration / static_cast<double>(events.size() + 1));
  for_each_stretch(motion, [&](const State& start, double from, double to, const Vector&) {
    if (to > from) disturbance = exponentials.of(start.mode, to - from) * disturbance;
    if (next == events.size()) return;
    const bool is_chained = next > 0 && events[next].time == events[next - 1].time;
    carry_over(system, start.mode, events[next++], is_chained, disturbance, delay);
    const double size = disturbance.norm();
    if (!(size > 0.0)) return;
    logarithm += std::log(size);
    disturbance /= size;
    delay /= size;
  });
  const double last = disturbance.norm();
  if (last == 0.0) return -std::numeric_limits<double>::infinity();
  return (logarithm + std::log(last)) / duration;
}

}  // namespace gearlash::drive
