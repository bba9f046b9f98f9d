#include "analysis/grid/cycle_following.hpp"

#include <algorithm>
#include <cmath>

#include "model/reduced_drive.hpp"

namespace gearlash {

bool is_same_cycle(const drive::FoundCycle& one, const drive::FoundCycle& other) {
  constexpr double share = 1e-6;
  const auto agree = [](double a, double b, double scale) {
    return std::abs(a - b) <= share * scale;
  };
  const double size = std::max(one.motor_amplitude, one.amplitude);
  return one.stability == other.stability && agree(one.period(), other.period(), one.period()) &&
         agree(one.amplitude, other.amplitude, size) &&
         agree(one.motor_amplitude, other.motor_amplitude, size);
}

FollowedCycle CycleFollowing::known(double parameter, const drive::AttractorSearch& search,
                                    const drive::FoundCycle& cycle) const {
  FollowedCycle known{.parameter = parameter, .cycle = cycle, .context = {}};
  known.context.system = search.system;
  known.context.outcomes = {search.outcomes.front()};
  known.context.cycles = {cycle};
  return known;
}

std::optional<FollowedCycle> CycleFollowing::step(const FollowedCycle& from,
                                                  double parameter) const {
  constexpr double alike = 0.25;
  Drive there = drive_;
  set_on(axis_, there, parameter);
  if (!faults(there).empty()) return std::nullopt;
  const drive::AttractorSearch found = drive::follow_cycles(reduce_settled(there), from.context);
  if (found.cycles.empty()) return std::nullopt;
  FollowedCycle next = known(parameter, found, found.cycles.front());
  const double size = std::max(from.cycle.motor_amplitude, from.cycle.amplitude);
  const bool is_near =
      std::abs(next.cycle.amplitude - from.cycle.amplitude) <= alike * size &&
      std::abs(next.cycle.motor_amplitude - from.cycle.motor_amplitude) <= alike * size;
  return is_near ? std::optional(std::move(next)) : std::nullopt;
}

FollowedWay CycleFollowing::to(const FollowedCycle& from, double parameter) const {
  constexpr double shortest = 1.0 / 512.0;
  const double begin = position_on(axis_, from.parameter);
  const double end = position_on(axis_, parameter);
  FollowedWay way;
  FollowedCycle last = from;
  double share = 0.0;
  double length = 1.0;
  while (share < 1.0 && length >= shortest) {
    const bool is_last = share + length >= 1.0;
    const double next = is_last ? 1.0 : share + length;
    std::optional<FollowedCycle> found =
        step(last, is_last ? parameter : value_at(axis_, begin + next * (end - begin)));
    if (!found) {
      length *= 0.5;
      continue;
    }
    share = next;
    last = *found;
    if (is_last) {
      way.end = std::move(found);
    } else {
      way.passed.push_back(*std::move(found));
    }
  }
  return way;
}

FollowedCycle CycleFollowing::stability_change(const FollowedCycle& one,
                                               const FollowedCycle& other) const {
  constexpr int halvings = 12;
  FollowedCycle low = one;
  double high = position_on(axis_, other.parameter);
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (position_on(axis_, low.parameter) + high);
    const std::optional<FollowedCycle> found = step(low, value_at(axis_, middle));
    if (!found) break;
    if (found->cycle.stability == one.cycle.stability) {
      low = *found;
    } else {
      high = middle;
    }
  }
  return low;
}

}  // namespace gearlash
