#include "hybrid/periodic_orbit.hpp"

#include <algorithm>
#include <cmath>

#include "base/lists.hpp"
#include "hybrid/shooting.hpp"

namespace gearlash::hybrid {
namespace {

/// Among the intervals between successive events from `first` to `last`.
double middle_of_longest(const std::vector<Event>& events, std::size_t first, std::size_t last) {
  double longest = 0.0;
  double middle = events[first].time;
  for (std::size_t i = first; i < last; ++i) {
    const double interval = events[i + 1].time - events[i].time;
    if (!(interval > longest)) continue;
    longest = interval;
    middle = events[i].time + 0.5 * interval;
  }
  return middle;
}

/// Whether an orbit repeats itself after `count` events. Precondition: `count` divides their
/// number.
bool repeats_after(const PeriodicOrbit& orbit, std::size_t count) {
  constexpr double alike = 1e-9;
  const std::vector<Event>& events = orbit.events;
  const double turn =
      orbit.period * static_cast<double>(count) / static_cast<double>(events.size());
  double scale = 0.0;
  for (const Event& event : events) scale = std::max(scale, largest_entry(event.after));
  for (std::size_t i = 0; i + count < events.size(); ++i) {
    const Event& now = events[i];
    const Event& later = events[i + count];
    const bool is_alike = now.is_alike(later) &&
                          std::abs(later.time - now.time - turn) <= alike * orbit.period &&
                          largest_entry(later.after - now.after) <= alike * scale;
    if (!is_alike) return false;
  }
  return true;
}

/// The orbit's shortest period, if the orbit found repeats itself within its period.
PeriodicOrbit once_around(const PreparedSystem& system, PeriodicOrbit orbit,
                          const ShootingOptions& options) {
  const std::size_t all = orbit.events.size();
  for (std::size_t count = 1; 2 * count <= all; ++count) {
    if (all % count != 0 || !repeats_after(orbit, count)) continue;
    const double turn = orbit.period * static_cast<double>(count) / static_cast<double>(all);
    auto shooting =
        Shooting::about(system, orbit.start, orbit.start_time, turn, count, options.phases);
    if (!shooting) continue;
    auto shorter = solved_by_newton(*shooting, options.most_steps);
    if (shorter) return *shorter;
  }
  return orbit;
}

}  // namespace

bool PeriodicOrbit::is_stable() const {
  return all_of(multipliers, [](const auto& multiplier) { return std::abs(multiplier) < 1.0; });
}

std::optional<PeriodicOrbit> closing_orbit(const PreparedSystem& system, const Trajectory& motion,
                                           const ShootingOptions& options) {
  const std::vector<Event>& events = motion.events();
  const bool has_clocks = has_periodic_clocks(system.system());
  std::size_t last = events.size();
  while (last > 0 && has_clocks && events[last - 1].kind != EventKind::timed) --last;
  if (last == 0) return std::nullopt;
  --last;
  const Event& end = events[last];
  double scale = 0.0;
  const std::size_t first = last > options.most_events ? last - options.most_events : 0;
  for (std::size_t i = first; i <= last; ++i)
    scale = std::max(scale, largest_entry(events[i].after));
  double farthest = largest_entry(end.before - end.after);
  constexpr int most_tries_at_rest = 3;
  int tries_at_rest = 0;
  int tries = 0;
  for (std::size_t back = 1; back <= std::min(last, options.most_events); ++back) {
    const Event& begin = events[last - back];
    const double distance = largest_entry(begin.after - end.after);
    constexpr double returned = 0.1;
    const bool has_returned = distance <= returned * farthest;
    farthest = std::max({farthest, distance, largest_entry(begin.before - end.after)});
    if (distance > options.nearness * scale) continue;
    if (!begin.is_alike(end) || !(begin.time < end.time)) continue;
    // A motion that has hardly moved creeps, or rests from tick to tick. The latter gets a few
    // tries.
    if (!has_returned && tries_at_rest++ >= most_tries_at_rest) continue;
    if (tries++ >= options.most_tries) break;
    const double start = middle_of_longest(events, last - back, last);
    auto shooting = Shooting::about(system, motion.at(start), start, end.time - begin.time, back,
                                    options.phases);
    if (!shooting) continue;
    auto orbit = solved_by_newton(*shooting, options.most_steps);
    if (orbit) return once_around(system, std::move(*orbit), options);
  }
  return std::nullopt;
}

std::optional<PeriodicOrbit> neighbouring_orbit(const PreparedSystem& system,
                                                const PeriodicOrbit& near,
                                                const ShootingOptions& options) {
  auto shooting = Shooting::about(system, near.start, near.start_time, near.period,
                                  near.events.size(), options.phases);
  return shooting ? solved_by_newton(*shooting, options.most_steps) : std::nullopt;
}

std::optional<PeriodicOrbit> neighbouring_orbit(const PreparedSystem& system,
                                                const PeriodicOrbit& near,
                                                const PreparedSystem& system_of_near,
                                                const ShootingOptions& options) {
  if (has_periodic_clocks(system.system())) return std::nullopt;
  const auto known = Shooting::about(system_of_near, near.start, near.start_time, near.period,
                                     near.events.size(), options.phases);
  if (!known) return std::nullopt;
  Shooting shooting = known->of(system);
  return solved_by_newton(shooting, options.most_steps);
}

}  // namespace gearlash::hybrid
