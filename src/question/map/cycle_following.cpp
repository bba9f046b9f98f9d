#include "question/map/cycle_following.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "general/attractors/search_setting.hpp"
#include "hybrid/continuation.hpp"
#include "model/sound_drive.hpp"

namespace gearlash {
namespace {

constexpr double located_by_branch = 1e-9;
constexpr double located_by_grazing = 1e-4;

BorderKind kind_of(hybrid::BifurcationKind kind) {
  switch (kind) {
    case hybrid::BifurcationKind::fold:
      return BorderKind::fold;
    case hybrid::BifurcationKind::branching:
      return BorderKind::branching;
    case hybrid::BifurcationKind::flip:
      return BorderKind::flip;
    case hybrid::BifurcationKind::neimark_sacker:
      return BorderKind::neimark_sacker;
  }
  return BorderKind::unnamed;
}

/// end_of_cycle() while the drive is sound.
Border followed_end_of_cycle(const DriveAlong& drive, const drive::FoundCycle& cycle, double from,
                             double to, Progress& progress) {
  const hybrid::Family family = [&](double value) {
    return drive::search_setting(SoundDrive(drive(value)).settled()).system.system();
  };
  hybrid::ContinuationOptions options{.low = std::min(from, to),
                                      .high = std::max(from, to),
                                      .upwards = from < to,
                                      .first_step = 1e-5,
                                      .longest_step = 0.02,
                                      .most_points = 120,
                                      .progress = &progress};
  const hybrid::Branch branch = continue_orbit(family, from, cycle.orbit, options);
  if (branch.end == hybrid::BranchEnd::stopped) return {};
  if (!branch.bifurcations.empty()) {
    const hybrid::Bifurcation& first = branch.bifurcations.front();
    return {.kind = kind_of(first.kind), .at = first.parameter, .located = located_by_branch};
  }
  if (branch.points.empty()) return {};
  const double last = branch.points.back().parameter;
  if (branch.end == hybrid::BranchEnd::grazing) {
    return {.kind = BorderKind::grazing,
            .at = last,
            .located = located_by_grazing,
            .event = branch.culprit};
  }
  if (branch.end == hybrid::BranchEnd::endless_period) {
    return {.kind = BorderKind::endless_period, .at = last, .located = located_by_grazing};
  }
  return {};
}

}  // namespace

Border end_of_cycle(const DriveAlong& drive, const drive::FoundCycle& cycle, double from, double to,
                    Progress& progress) {
  constexpr std::size_t most_events = 400;  // more take minutes to follow
  if (cycle.orbit.events.empty() || cycle.orbit.events.size() > most_events) return {};
  try {
    return followed_end_of_cycle(drive, cycle, from, to, progress);
  } catch (const InvalidInput&) {
    return {};  // the drive is unsound on the way
  }
}

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
  known.context.outcomes = search.outcomes;
  known.context.cycles = {cycle};
  return known;
}

std::optional<FollowedCycle> CycleFollowing::step(const FollowedCycle& from,
                                                  double parameter) const {
  constexpr double alike = 0.25;
  const std::optional<SoundDrive> sound = SoundDrive::of(drive_(parameter));
  if (!sound) return std::nullopt;
  const drive::AttractorSearch found = drive::follow_cycles(sound->settled(), from.context);
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
  while (share < 1.0 && length >= shortest && progress_.go_on(0.0)) {
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

}  // namespace gearlash
