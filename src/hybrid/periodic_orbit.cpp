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

}  // namespace

bool PeriodicOrbit::is_stable() const {
  return std::all_of(multipliers.begin(), multipliers.end(),
                     [](const auto& multiplier) { return std::abs(multiplier) < 1.0; });
}

std::optional<PeriodicOrbit> closing_orbit(const HybridSystem& system, const Trajectory& motion,
                                           const ShootingOptions& options) {
  const std::vector<Event>& events = motion.events();
  const bool ticks_alone = has_periodic_clocks(system);
  std::size_t last = events.size();
  while (last > 0 && ticks_alone && events[last - 1].kind != EventKind::timed) --last;
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
    const std::vector<Event> between(events.begin() + static_cast<std::ptrdiff_t>(last - back + 1),
                                     events.begin() + static_cast<std::ptrdiff_t>(last + 1));
    const State start{begin.mode_after, begin.after};
    Shooting shooting(system, start, begin.time, end.time - begin.time,
                      shared_out(between, options.phases, ticks_alone));
    if (!shooting.follow()) continue;
    auto orbit = solved_by_newton(shooting, options.most_steps);
    if (orbit) return orbit;
  }
  return std::nullopt;
}

std::optional<PeriodicOrbit> neighbouring_orbit(const HybridSystem& system,
                                                const PeriodicOrbit& near,
                                                const ShootingOptions& options) {
  Shooting shooting(system, near.start, near.start_time, near.period,
                    shared_out(near.events, options.phases, has_periodic_clocks(system)));
  if (!shooting.follow()) return std::nullopt;
  return solved_by_newton(shooting, options.most_steps);
}

}  // namespace gearlash::hybrid
