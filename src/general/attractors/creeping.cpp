#include "general/attractors/creeping.hpp"

#include <algorithm>
#include <cmath>

#include "general/attractors/found_cycle.hpp"

namespace gearlash::drive {
namespace {

/// A time in which one number hardly changes.
struct Pause {
  double from;
  double to;
  double value;
};

std::vector<Pause> pauses(const std::vector<Sample>& samples, double small) {
  std::vector<Pause> all;
  for (std::size_t i = 0; i + 1 < samples.size();) {
    const Sample& first = samples[i];
    std::size_t last = i;
    while (last + 1 < samples.size() && std::abs(samples[last + 1].value - first.value) <= small) {
      ++last;
    }
    if (samples[last].time > first.time)
      all.push_back({first.time, samples[last].time, first.value});
    i = std::max(last, i + 1);
  }
  return all;
}

double place(const Standstill& at, double share_of_load) {
  return share_of_load * at.load + (1.0 - share_of_load) * at.motor;
}

/// The places of a mixture of both shafts, as turns.
std::vector<Sample> places(const std::vector<Standstill>& all, double share_of_load) {
  std::vector<Sample> result;
  for (const Standstill& one : all) result.push_back({one.from, place(one, share_of_load)});
  return result;
}

/// Whether the slip after `last`, which integral action makes towards the reference, starts as the
/// slip before it did: from the same place in the gap, seen in its direction.
bool goes_on_alike(const Standstill& before, const Standstill& last, double share_of_load,
                   double small) {
  const double here = place(last, share_of_load);
  const auto gap = [](const Standstill& at, double way) {
    return std::copysign(1.0, way) * (at.motor - at.load);
  };
  return std::abs(gap(last, -here) - gap(before, here - place(before, share_of_load))) < small;
}

/// Whether friction of a drive without stiction holds it at the end of its watch.
bool may_creep(const std::vector<Standstill>& all, const Watch& watch,
               const SearchSetting& setting) {
  return !has_stiction(setting.drive) && !all.empty() && all.back().to >= watch.time;
}

}  // namespace

std::vector<Standstill> standstills(const std::vector<Sample>& load,
                                    const std::vector<Sample>& motor, double small) {
  const std::vector<Pause> of_load = pauses(load, small);
  const std::vector<Pause> of_motor = pauses(motor, small);
  std::vector<Standstill> both;
  for (std::size_t i = 0, j = 0; i < of_load.size() && j < of_motor.size();) {
    const double from = std::max(of_load[i].from, of_motor[j].from);
    const double to = std::min(of_load[i].to, of_motor[j].to);
    if (to > from) both.push_back({from, to, of_load[i].value, of_motor[j].value});
    of_load[i].to < of_motor[j].to ? ++i : ++j;
  }
  return both;
}

double duration_of(const std::vector<Standstill>& all) {
  double sum = 0.0;
  for (const Standstill& one : all) sum += one.duration();
  return sum;
}

bool is_creeping(const std::vector<Standstill>& all, const Watch& watch,
                 const SearchSetting& setting, const RestTolerances& tolerances) {
  constexpr std::size_t least = 3;
  if (all.size() < least || !may_creep(all, watch, setting)) return false;
  const Standstill& last = all.back();
  const Standstill& before = all.end()[-2];
  if (!(last.duration() > before.duration() && before.duration() > all.end()[-3].duration())) {
    return false;
  }
  const double small = tolerances.small_swing * setting.small_length;
  const double share_of_load = setting.drive.sensing.load_share_of_position;
  return swing(places(all, 0.0), 0) < small &&
         (share_of_load == 0.0 || goes_on_alike(before, last, share_of_load, small)) &&
         ratio_of_vanishing(places(all, share_of_load), setting, tolerances).has_value();
}

bool stands_for_long(const std::vector<Standstill>& all, const Watch& watch,
                     const SearchSetting& setting, const RestTolerances& tolerances) {
  return may_creep(all, watch, setting) &&
         all.back().duration() > tolerances.long_standstill * (watch.time - duration_of(all));
}

std::vector<Standstill> places_of_rest(const FoundCycle& cycle, const SearchSetting& setting,
                                       const RestTolerances& tolerances) {
  if (has_stiction(setting.drive)) return {};
  const double share = tolerances.hardly_moving;
  const hybrid::Trajectory motion = motion_on(setting.system, cycle.orbit, 1.0);
  std::vector<Standstill> all =
      standstills(samples(motion, setting.load, 0.0), samples(motion, setting.motor, 0.0),
                  share * extent_of(cycle));
  const double moving = cycle.period() - duration_of(all);
  if (!(moving <= share * cycle.period())) all.clear();
  return all;
}

}  // namespace gearlash::drive
