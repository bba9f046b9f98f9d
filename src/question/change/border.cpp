#include "question/change/border.hpp"

#include <algorithm>
#include <cmath>

#include "base/lists.hpp"
#include "base/names.hpp"

namespace gearlash {
namespace {

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
    const bool is_there =
        any_of(others, [&](const auto& other) { return are_alike(cycle, other); });
    if (is_there) continue;
    if (largest == nullptr || cycle.amplitude > largest->amplitude) largest = &cycle;
  }
  return largest;
}

/// Those of one side that the other does not have, followed across the border.
Border end_of_lost_cycle(const DriveAlong& drive, const AnalysedValue& here,
                         const AnalysedValue& there, double to, Progress& progress) {
  const drive::FoundCycle* cycle = lost_cycle(here.analysis, there.analysis);
  return cycle == nullptr ? Border{} : end_of_cycle(drive, *cycle, here.value, to, progress);
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
  constexpr Names<BorderKind::unnamed> names("limit", "fold", "branching", "flip", "Neimark–Sacker",
                                             "grazing", "endless period", "rest", "unnamed");
  return names[kind];
}

Border border_between(const DriveAlong& drive, const AnalysedValue& met, const AnalysedValue& unmet,
                      double far, Progress& progress) {
  const double width =
      std::abs(unmet.value - met.value) / std::max(std::abs(unmet.value), std::abs(met.value));
  Border border{.end = met.value, .at = met.value, .located = width};
  const bool are_searched = met.analysis.search && unmet.analysis.search;
  if (!are_searched || move_alike(met.analysis, unmet.analysis)) {
    border.kind = BorderKind::limit;
    return border;
  }
  // The one that misses the target, else one that meets it and ends at the border.
  Border found = end_of_lost_cycle(drive, unmet, met, met.value - (far - met.value), progress);
  if (found.kind == BorderKind::unnamed) {
    constexpr double near = 0.01;
    found = end_of_lost_cycle(drive, met, unmet, far, progress);
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
