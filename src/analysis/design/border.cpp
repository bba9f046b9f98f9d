#include "analysis/design/border.hpp"

#include <algorithm>
#include <cmath>

#include "base/range_check.hpp"
#include "general/attractors/search_setting.hpp"
#include "hybrid/continuation.hpp"

namespace gearlash {
namespace {

constexpr double located_by_branch = 1e-9;
constexpr double located_by_grazing = 1e-4;

bool are_alike(const drive::FoundCycle& a, const drive::FoundCycle& b) {
  constexpr double share = 0.02;
  const auto near = [](double one, double other) {
    return std::abs(one - other) <= share * std::max(std::abs(one), std::abs(other));
  };
  return a.stability == b.stability && near(a.period(), b.period()) &&
         near(a.amplitude, b.amplitude) && near(a.motor_amplitude, b.motor_amplitude);
}

/// The largest stable cycle that the other side does not have; nullptr if there is none.
const drive::FoundCycle* lost_cycle(const Analysis& here, const Analysis& there) {
  const drive::FoundCycle* largest = nullptr;
  for (const drive::FoundCycle& cycle : here.search->cycles) {
    if (cycle.stability == Stability::unstable) continue;
    const auto& others = there.search->cycles;
    const bool is_there = std::any_of(others.begin(), others.end(),
                                      [&](const auto& other) { return are_alike(cycle, other); });
    if (is_there) continue;
    if (largest == nullptr || cycle.amplitude > largest->amplitude) largest = &cycle;
  }
  return largest;
}

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

/// Where a cycle that exists at `from` ends or loses its stability, on the way to `to`. Unnamed if
/// it does neither.
Border end_of_cycle(const DriveAlong& drive, const drive::FoundCycle& cycle, double from,
                    double to) {
  const hybrid::Family family = [&](double value) {
    const Drive changed = drive(value);
    require_none(faults(changed));
    return drive::search_setting(reduce_settled(changed)).system.system();
  };
  hybrid::ContinuationOptions options{.low = std::min(from, to),
                                      .high = std::max(from, to),
                                      .upwards = from < to,
                                      .first_step = 1e-5,
                                      .longest_step = 0.02,
                                      .most_points = 120};
  const hybrid::Branch branch = continue_orbit(family, from, cycle.orbit, options);
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

/// Those of one side that the other does not have, followed across the border.
Border end_of_lost_cycle(const DriveAlong& drive, const AnalysedValue& here,
                         const AnalysedValue& there, double to) {
  const drive::FoundCycle* cycle = lost_cycle(here.analysis, there.analysis);
  if (cycle == nullptr) return {};
  constexpr std::size_t most_events = 400;  // more take minutes to follow
  if (cycle->orbit.events.empty() || cycle->orbit.events.size() > most_events) return {};
  try {
    return end_of_cycle(drive, *cycle, here.value, to);
  } catch (const InvalidInput&) {
    return {};  // the drive is unsound on the way
  }
}

bool has_rest(const Analysis& analysis) {
  return analysis.search->count(drive::MotionEnd::rest) > 0;
}

bool move_alike(const Analysis& a, const Analysis& b) {
  return a.answer.verdict == b.answer.verdict && lost_cycle(a, b) == nullptr &&
         lost_cycle(b, a) == nullptr && a.search->irregular.size() == b.search->irregular.size();
}

}  // namespace

const char* name_of(BorderKind kind) {
  switch (kind) {
    case BorderKind::limit:
      return "limit";
    case BorderKind::fold:
      return "fold";
    case BorderKind::branching:
      return "branching";
    case BorderKind::flip:
      return "flip";
    case BorderKind::neimark_sacker:
      return "Neimark–Sacker";
    case BorderKind::grazing:
      return "grazing";
    case BorderKind::endless_period:
      return "endless period";
    case BorderKind::rest:
      return "rest";
    case BorderKind::unnamed:
      break;
  }
  return "unnamed";
}

Border border_between(const DriveAlong& drive, const AnalysedValue& met, const AnalysedValue& unmet,
                      double far) {
  const double width =
      std::abs(unmet.value - met.value) / std::max(std::abs(unmet.value), std::abs(met.value));
  Border border{.end = met.value, .at = met.value, .located = width};
  const bool are_searched = met.analysis.search && unmet.analysis.search;
  if (!are_searched || move_alike(met.analysis, unmet.analysis)) {
    border.kind = BorderKind::limit;
    return border;
  }
  // The one that misses the target, else one that meets it and ends at the border.
  Border found = end_of_lost_cycle(drive, unmet, met, met.value - (far - met.value));
  if (found.kind == BorderKind::unnamed) {
    constexpr double near = 0.01;
    found = end_of_lost_cycle(drive, met, unmet, far);
    if (std::abs(found.at - met.value) > near * std::abs(met.value)) found = {};
  }
  if (found.kind != BorderKind::unnamed) {
    found.end = met.value;
    return found;
  }
  if (has_rest(met.analysis) != has_rest(unmet.analysis)) border.kind = BorderKind::rest;
  return border;
}

}  // namespace gearlash
