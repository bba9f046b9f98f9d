#include "general/attractors/cycle_closing.hpp"

#include <algorithm>
#include <cmath>

#include "base/lists.hpp"
#include "general/attractors/found_cycle.hpp"

namespace gearlash::drive {
namespace {

using hybrid::Event;
using hybrid::PeriodicOrbit;
using hybrid::Trajectory;
using hybrid::Vector;

bool is_prime(int number) {
  for (int factor = 2; factor * factor <= number; ++factor) {
    if (number % factor == 0) return false;
  }
  return true;
}

/// One round of an orbit that goes `times` times round a cycle. Only the moduli of its multipliers
/// are then known.
PeriodicOrbit divided(PeriodicOrbit orbit, int times, double mismatch) {
  orbit.period /= times;
  std::erase_if(orbit.events, [&](const Event& event) { return event.time > orbit.period; });
  for (auto& multiplier : orbit.multipliers) {
    multiplier = std::pow(std::abs(multiplier), 1.0 / times);
  }
  orbit.residual = std::max(orbit.residual, mismatch);
  return orbit;
}

}  // namespace

std::optional<PeriodicOrbit> CycleClosing::closed(const Trajectory& motion, double nearness) const {
  hybrid::ShootingOptions shooting = options_.shooting;
  shooting.nearness = nearness;
  if (!motion.events().empty()) return closing_orbit(setting_.system, motion, shooting);
  const Trajectory again = simulate(setting_.with_turns, motion.at(motion.start_time()),
                                    {.from = motion.start_time(),
                                     .until = motion.end_time(),
                                     .event_limit = options_.most_events});
  return closing_orbit(setting_.with_turns, again, shooting);
}

/// Whether an orbit could be `times` rounds of a cycle: each round needs an event and whole
/// sampling periods.
bool CycleClosing::may_go_round(const PeriodicOrbit& orbit, int times) const {
  const double round = orbit.period / times;
  for (int i = 0; i < times; ++i) {
    const bool has_event = any_of(orbit.events, [&](const hybrid::Event& event) {
      return event.time > i * round && event.time <= (i + 1) * round;
    });
    if (!has_event) return false;
  }
  if (!setting_.drive.sampling) return true;
  const double ticks = orbit.period / (times * position_period(*setting_.drive.sampling));
  return agree(ticks, std::round(ticks), 1.0, tolerances_.whole_ticks);
}

/// Whether an orbit moves so little that it recurs after any time.
bool CycleClosing::hardly_moves(const PeriodicOrbit& orbit) const {
  Vector low = orbit.start.numbers;
  Vector high = low;
  for (const Event& event : orbit.events) {
    low = low.cwiseMin(event.before).cwiseMin(event.after);
    high = high.cwiseMax(event.before).cwiseMax(event.after);
  }
  constexpr double much = 100.0;
  return (high - low).maxCoeff() <=
         much * tolerances_.recurrence * orbit.start.numbers.cwiseAbs().maxCoeff();
}

PeriodicOrbit CycleClosing::shortest(const PeriodicOrbit& orbit) const {
  if (hardly_moves(orbit)) return orbit;
  for (int times = 2; times < tolerances_.most_rounds; ++times) {
    if (!is_prime(times) || !may_go_round(orbit, times)) continue;
    const double mismatch = mismatch_after(setting_, orbit, 1.0 / times, 1.0);
    if (!(mismatch < tolerances_.recurrence)) continue;
    const auto shorter = closed(motion_on(setting_.system, orbit, tolerances_.closing_periods),
                                tolerances_.nearness);
    if (shorter && shorter->period < tolerances_.shorter_period * orbit.period) {
      return shortest(*shorter);
    }
    // When faces come to rest, rounding may add or remove events. Newton's method, which counts
    // them, then closes some rounds and not others.
    return shortest(divided(orbit, times, mismatch));
  }
  return orbit;
}

std::optional<FoundCycle> CycleClosing::closed_cycle(const Trajectory& motion,
                                                     double nearness) const {
  const auto orbit = closed(motion, nearness);
  if (!orbit || !(orbit->residual < tolerances_.residual)) return std::nullopt;
  const FoundCycle cycle = measured(setting_, shortest(*orbit), options_.tolerances);
  if (!(extent_of(cycle) > tolerances_.least_amplitude * setting_.small_length))
    return std::nullopt;
  if (!returns(cycle, tolerances_)) return std::nullopt;
  const Extent load = lately(motion, setting_.load, cycle.period());
  const Extent motor = lately(motion, setting_.motor, cycle.period());
  const auto is_as = [&](double seen, double wanted) {
    return agree(seen, wanted, extent_of(cycle), tolerances_.agreement);
  };
  const bool is_on_it = is_as(0.5 * load.width(), cycle.amplitude) &&
                        is_as(0.5 * motor.width(), cycle.motor_amplitude) &&
                        is_as(load.middle(), cycle.center);
  return is_on_it ? std::optional(cycle) : std::nullopt;
}

std::optional<std::size_t> CycleClosing::known_cycle_of(
    const Trajectory& motion, const std::vector<FoundCycle>& known) const {
  if (motion.events().empty() || setting_.drive.sampling) return std::nullopt;
  const Event& last = motion.events().back();
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i].stability != Stability::stable) continue;
    for (const Event& event : known[i].orbit.events) {
      if (event.is_alike(last) && (event.after - last.after).cwiseAbs().maxCoeff() <=
                                      tolerances_.known_event * event.after.cwiseAbs().maxCoeff()) {
        return i;
      }
    }
  }
  return std::nullopt;
}

Extent CycleClosing::lately(const Trajectory& motion, const Watched& watched, double period) const {
  Extent range;
  for (const Sample& sample : rough_samples(motion, watched)) {
    if (sample.time >= motion.end_time() - tolerances_.compared_periods * period) {
      range.include(sample.value);
    }
  }
  return range;
}

}  // namespace gearlash::drive
