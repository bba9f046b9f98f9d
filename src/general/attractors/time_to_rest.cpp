#include "general/attractors/time_to_rest.hpp"

#include <algorithm>
#include <cmath>

#include "base/special_numbers.hpp"

namespace gearlash::drive {
namespace {

using hybrid::State;
using hybrid::Trajectory;

/// The state from which a motion is known at a time: the last that the watch kept before it.
const Mark& mark_before(double time, const Watch& watch) {
  const auto after = std::partition_point(watch.marks.begin(), watch.marks.end(),
                                          [&](const Mark& one) { return one.time <= time; });
  return after == watch.marks.begin() ? *after : *(after - 1);
}

/// Keeps the piece of a motion in which its load was outside a band for the last time.
class LastOutside : public hybrid::MotionObserver {
 public:
  LastOutside(double band, double final, const Watched& load)
      : band_(band), final_(final), load_(load), watched_{load.speed} {}

  const std::vector<hybrid::AffineForm>& watched() const override { return watched_; }

  void moved(double from, double to, const hybrid::Vector& before,
             const hybrid::Vector& after) override {
    const auto is_outside = [&](const hybrid::Vector& numbers) {
      return std::abs(load_.value.at(numbers) - final_) > band_;
    };
    if (is_outside(after)) {
      outside = inside = to;
    } else if (is_outside(before)) {
      outside = from;
      inside = to;
    }
  }

  double outside = 0.0;
  double inside = 0.0;

 private:
  double band_;
  double final_;
  const Watched& load_;
  std::vector<hybrid::AffineForm> watched_;
};

/// Within a motion, between a time at which the load is outside and a later one at which it is not.
double crossing(const Trajectory& motion, double outside, double inside, double band, double final,
                const Watched& load) {
  constexpr double enough = 1e-9;
  State here;
  while (inside - outside > enough * inside) {
    const double middle = 0.5 * (outside + inside);
    if (!(outside < middle && middle < inside)) break;
    motion.at(middle, here);
    (std::abs(load.value.at(here.numbers) - final) > band ? outside : inside) = middle;
  }
  return inside;
}

}  // namespace

double time_until_within(double band, const ShrinkingSteps& steps) {
  if (!(steps.size > band)) return 0.0;
  const double count = std::ceil(std::log(band / steps.size) / std::log(steps.ratio));
  const double q = steps.duration_ratio;
  const double each = q == 1.0 ? count : q * std::expm1(count * std::log(q)) / (q - 1.0);
  return steps.duration * each;
}

std::optional<double> last_time_outside(double band, double final, const Watch& watch,
                                        const SearchSetting& setting, std::size_t step_limit) {
  constexpr double rounding = 1e-9;  // a start may lie on the band's end
  band *= 1.0 + rounding;
  const auto is_outside = [&](double value) { return std::abs(value - final) > band; };
  const auto last = std::find_if(watch.load.rbegin(), watch.load.rend(),
                                 [&](const Sample& sample) { return is_outside(sample.value); });
  if (last == watch.load.rend()) return 0.0;
  double outside = last->time;
  const bool is_over = last != watch.load.rbegin();  // it is inside at the end of the watch
  constexpr double near = 1e-3;  // of the time: nearer samples need nothing between them
  if (is_over && (last - 1)->time - outside < near * outside) return (last - 1)->time;
  double most = is_over ? (last - 1)->time : 1e3 * (watch.time + setting.settling_time);
  Mark mark = is_over ? mark_before(outside, watch) : Mark{watch.time, watch.here};
  if (setting.drive.sampling) {
    // Its ticks are too many to be kept: only those are about which the load enters the band.
    const auto followed = [&](double until, hybrid::MotionObserver& observer) {
      return observe(setting.system, mark.here,
                     {.from = mark.time,
                      .until = until,
                      .event_limit = watch.events + 1,
                      .progress = watch.progress},
                     observer);
    };
    LastOutside seen(band, final, setting.load);
    followed(most, seen);
    if (seen.inside - seen.outside <= near * seen.outside) return seen.inside;
    const double before = setting.between_ticks(seen.outside - setting.drive.sampling->period);
    if (before > mark.time) {
      LastOutside ignored(band, final, setting.load);
      hybrid::Observed there = followed(before, ignored);
      mark = {there.time, std::move(there.end)};
    }
    most = setting.between_ticks(seen.inside);
  }
  State here = mark.here;
  double from = mark.time;
  double length = is_over ? most - from : setting.swing_time;
  while (from < most) {
    const Trajectory motion = simulate(setting.system, here,
                                       {.from = from,
                                        .until = from + length,
                                        .step_limit = step_limit,
                                        .progress = watch.progress});
    const bool is_stopped = motion.stop_reason() == hybrid::StopReason::stopped;
    if (is_stopped || !(motion.end_time() > from)) return std::nullopt;
    here = motion.end();
    from = motion.end_time();
    const std::vector<Sample> all = rough_samples(motion, setting.load);
    const auto passed = std::find_if(
        all.rbegin(), all.rend(), [&](const Sample& sample) { return is_outside(sample.value); });
    if (passed == all.rend() && !is_over) return outside;
    if (passed == all.rbegin()) {
      outside = from;
    } else if (passed != all.rend()) {
      outside = crossing(motion, passed->time, (passed - 1)->time, band, final, setting.load);
    }
    length = is_over ? most - from : 2.0 * length;
  }
  return is_over ? std::optional(outside) : std::nullopt;
}

}  // namespace gearlash::drive
