#include "gearlash/hybrid/periodic_orbit.hpp"

#include <algorithm>
#include <cmath>

#include "shooting.hpp"

namespace gearlash::hybrid {
namespace {

bool is_same_event(const Event& a, const Event& b) {
  return a.kind == b.kind && a.mode == b.mode && a.transition == b.transition &&
         a.mode_after == b.mode_after;
}

double size_of(const Vector& vector) { return vector.cwiseAbs().maxCoeff(); }

/// Of the intervals from one event to the next, first to last.
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

}  // namespace

bool PeriodicOrbit::is_stable() const {
  return std::all_of(multipliers.begin(), multipliers.end(),
                     [](const auto& multiplier) { return std::abs(multiplier) < 1.0; });
}

std::optional<PeriodicOrbit> closing_orbit(const HybridSystem& system, const Trajectory& motion,
                                           const ShootingOptions& options) {
  const std::vector<Event>& events = motion.events();
  const bool has_clocks = has_periodic_clocks(system);
  std::size_t last = events.size();
  while (last > 0 && has_clocks && events[last - 1].kind != EventKind::timed) --last;
  if (last == 0) return std::nullopt;
  --last;
  const Event& end = events[last];
  double scale = 0.0;
  const std::size_t first = last > options.most_events ? last - options.most_events : 0;
  for (std::size_t i = first; i <= last; ++i) scale = std::max(scale, size_of(events[i].after));
  for (std::size_t back = 1; back <= std::min(last, options.most_events); ++back) {
    const Event& begin = events[last - back];
    if (!is_same_event(begin, end) || !(begin.time < end.time)) continue;
    if (size_of(begin.after - end.after) > options.nearness * scale) continue;
    const double start = middle_of_longest(events, last - back, last);
    auto shooting = Shooting::about(system, motion.at(start), start, end.time - begin.time, back,
                                    options.phases);
    if (!shooting) continue;
    auto orbit = solved_by_newton(*shooting, options.most_steps);
    if (orbit) return orbit;
  }
  return std::nullopt;
}

std::optional<PeriodicOrbit> neighbouring_orbit(const HybridSystem& system,
                                                const PeriodicOrbit& near,
                                                const ShootingOptions& options) {
  auto shooting = Shooting::about(system, near.start, near.start_time, near.period,
                                  near.events.size(), options.phases);
  return shooting ? solved_by_newton(*shooting, options.most_steps) : std::nullopt;
}

}  // namespace gearlash::hybrid
