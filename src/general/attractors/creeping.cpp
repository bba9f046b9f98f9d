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

  double duration() const { return to - from; }
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

/// Whether dry friction without stiction holds a shaft. With stiction slips have a size of their
/// own.
bool has_coulomb_friction_alone(const ReducedDrive& drive) {
  return has_dry_friction(drive) && !has_stiction(drive);
}

/// Whether friction of a drive without stiction holds it at the end of its watch.
bool may_creep(const std::vector<Standstill>& all, const Watch& watch,
               const SearchSetting& setting) {
  return has_coulomb_friction_alone(setting.drive) && !all.empty() && all.back().to >= watch.time;
}

/// Whether slips are in proportion to the errors before them: integral action alone ends a
/// standstill, and neither an encoder's step nor a dead band gives them a size.
bool slips_in_proportion(const ReducedDrive& drive) {
  return has_coulomb_friction_alone(drive) && !drive.error_shape.changes_small_errors() &&
         drive.sensing.resolution == 0.0 && integrates(drive.controller);
}

/// Pauses of the measured shaft. Where no friction of its own holds it, both shafts must stand.
std::vector<Pause> held_pauses(const Watch& watch, const SearchSetting& setting, double small) {
  const bool is_of_load = setting.drive.sensing.load_share_of_position > 0.5;
  const Shaft& measured = is_of_load ? setting.drive.load : setting.drive.motor;
  if (measured.friction.is_dry()) return pauses(is_of_load ? watch.load : watch.motor, small);
  std::vector<Pause> all;
  for (const Standstill& one : standstills(watch.load, watch.motor, small)) {
    all.push_back({one.from, one.to, is_of_load ? one.load : one.motor});
  }
  return all;
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

std::optional<ShrinkingSteps> creeping(const Watch& watch, const SearchSetting& setting,
                                       const RestTolerances& tolerances) {
  if (!slips_in_proportion(setting.drive)) return std::nullopt;
  const std::vector<Pause> all =
      held_pauses(watch, setting, tolerances.no_move * setting.small_length);
  constexpr std::size_t least = 3;
  if (all.size() < least) return std::nullopt;
  const Pause& first = all.end()[-3];
  const Pause& second = all.end()[-2];
  const Pause& third = all.end()[-1];
  const bool shrinks = std::abs(third.value) < std::abs(second.value) &&
                       std::abs(second.value) < std::abs(first.value) &&
                       std::abs(first.value) < setting.small_length;
  const bool stays_longer = third.duration() > second.duration() &&
                            second.duration() > first.duration() &&
                            first.duration() > setting.swing_time;
  const bool is_by_one_ratio = std::abs(limit_of(first.value, second.value, third.value)) <
                               tolerances.vanishing_limit * std::abs(third.value);
  if (!shrinks || !stays_longer || !is_by_one_ratio) return std::nullopt;
  // Behind the motor the load moves no farther than the motor still does.
  const bool is_of_load = setting.drive.sensing.load_share_of_position > 0.5;
  return ShrinkingSteps{.final = is_of_load ? 0.0 : setting.load.value.at(watch.here.numbers),
                        .size = std::abs(third.value),
                        .ratio = third.value / second.value,
                        .duration = third.duration(),
                        .duration_ratio = third.duration() / second.duration()};
}

bool stands_for_long(const std::vector<Standstill>& all, const Watch& watch,
                     const SearchSetting& setting, const RestTolerances& tolerances) {
  return may_creep(all, watch, setting) &&
         all.back().duration() > tolerances.long_standstill * (watch.time - duration_of(all));
}

std::vector<Standstill> places_of_rest(const FoundCycle& cycle, const SearchSetting& setting,
                                       const RestTolerances& tolerances) {
  if (!has_coulomb_friction_alone(setting.drive)) return {};
  const double share = tolerances.hardly_moving;
  const hybrid::Trajectory motion = motion_on(setting.system, cycle.orbit, 1.0);
  std::vector<Standstill> all = standstills(
      samples(motion, setting.load), samples(motion, setting.motor), share * extent_of(cycle));
  const double moving = cycle.period() - duration_of(all);
  if (!(moving <= share * cycle.period())) all.clear();
  return all;
}

}  // namespace gearlash::drive
