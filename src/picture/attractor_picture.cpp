#include "picture/attractor_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/lists.hpp"
#include "gearlash/units.hpp"
#include "model/reduced_drive.hpp"
#include "model/signal.hpp"
#include "question/motion.hpp"

namespace gearlash {
namespace {

constexpr int digits = 3;

/// The motion of one cycle. The search's positions are measured from the reference, and its states
/// may be numbered differently from the drive's.
Motion motion_of_cycle(const drive::ReducedDrive& reduced, const drive::AttractorSearch& search,
                       const drive::FoundCycle& cycle) {
  drive::DriveSystem system = drive::drive_system(reduced);
  system.system = search.system;
  system.reference = {};
  system.load_torque = {};
  system.motor_torques = {hybrid::AffineForm{}};
  const double from = cycle.orbit.start_time;
  hybrid::Trajectory trajectory = hybrid::simulate(search.system, cycle.orbit.start,
                                                   {.from = from, .until = from + cycle.period()});
  return motion_of(std::move(system), std::move(trajectory));
}

/// A name with enough numbers to distinguish the cycles of a picture.
std::string name_of_cycle(const drive::FoundCycle& cycle, double amplitude,
                          const AngleUnit& angle) {
  return fmt::format("{} cycle ±{}, {}", name_of(cycle.stability),
                     angle_text(amplitude, angle, digits), significant(cycle.period(), digits));
}

/// What is seen in practice: the first cycle that is not unstable, else irregular motion, else
/// running away.
struct Seen {
  drive::MotionEnd end = drive::MotionEnd::rest;
  std::size_t which = 0;
  double amplitude = 0.0;  ///< rad, of the shaft that swings more
  double period = 0.0;     ///< s
  double approach = 0.0;   ///< s
};

Seen seen_in(const drive::AttractorSearch& search) {
  constexpr double near_enough = 0.01;  // of a disturbance, which a line's width hides
  for (std::size_t i = 0; i < search.cycles.size(); ++i) {
    const drive::FoundCycle& cycle = search.cycles[i];
    if (cycle.stability == Stability::unstable || cycle.starts == 0) continue;
    const double periods = std::log(near_enough) / std::log(std::min(cycle.multiplier, 0.9));
    return {drive::MotionEnd::cycle, i, std::max(cycle.amplitude, cycle.motor_amplitude),
            cycle.period(), std::max(periods, 3.0) * cycle.period()};
  }
  if (!search.irregular.empty()) {
    const drive::IrregularFound& motion = search.irregular.front();
    return {drive::MotionEnd::irregular, 0, std::max(motion.amplitude, motion.motor_amplitude),
            motion.period, 3.0 * motion.period};
  }
  const bool runs_away = search.count(drive::MotionEnd::diverges) > 0;
  return {runs_away ? drive::MotionEnd::diverges : drive::MotionEnd::rest, 0, 0.0, 0.0, 0.0};
}

/// Of the starts at rest that lead there the one nearest to twice the amplitude from the reference;
/// if there is no amplitude, the middle one by its distance. nullptr if there is none.
const drive::Outcome* start_to_show(const drive::AttractorSearch& search, const Seen& seen,
                                    double reference) {
  const bool has_which =
      seen.end == drive::MotionEnd::cycle || seen.end == drive::MotionEnd::irregular;
  std::vector<const drive::Outcome*> starts;
  for (const drive::Outcome& outcome : search.outcomes) {
    if (outcome.end != seen.end || outcome.start.load_speed != 0.0) continue;
    if (!has_which || outcome.which == seen.which) starts.push_back(&outcome);
  }
  if (starts.empty()) return nullptr;
  const auto away = [&](const drive::Outcome* outcome) {
    return std::abs(outcome->start.load_position - reference);
  };
  if (seen.amplitude == 0.0) {
    const auto middle = starts.begin() + static_cast<std::ptrdiff_t>(starts.size() / 2);
    std::nth_element(starts.begin(), middle, starts.end(), by(away));
    return *middle;
  }
  const auto miss = [&](const drive::Outcome* outcome) {
    return std::abs(away(outcome) - 2.0 * seen.amplitude);
  };
  return *std::min_element(starts.begin(), starts.end(), by(miss));
}

/// The last few mean periods of the watched motion.
Motion motion_of_irregular(const drive::ReducedDrive& reduced,
                           const drive::IrregularFound& irregular, const drive::Outcome& outcome) {
  constexpr double periods = 5.0;
  constexpr std::size_t most_events = 2'000'000;  // ticks included
  drive::DriveSystem system = drive::drive_system(reduced);
  const hybrid::Trajectory whole =
      hybrid::simulate(system.system, drive::drive_start(reduced, system, outcome.start),
                       {.until = outcome.watched, .event_limit = most_events});
  const double end = whole.end_time();
  const double from = std::max(0.0, end - periods * irregular.period);
  hybrid::Trajectory last =
      hybrid::simulate(system.system, whole.at(from), {.from = from, .until = end});
  return motion_of(std::move(system), std::move(last));
}

}  // namespace

Motion motion_from(const drive::ReducedDrive& reduced, const drive::ShaftStates& start,
                   double until, std::size_t most_events) {
  drive::DriveSystem system = drive::drive_system(reduced);
  hybrid::Trajectory trajectory =
      hybrid::simulate(system.system, drive::drive_start(reduced, system, start),
                       {.until = until, .event_limit = most_events});
  return motion_of(std::move(system), std::move(trajectory));
}

MotionPicture hunting_picture(const std::string& title, const Drive& drive,
                              const drive::ReducedDrive& reduced,
                              const drive::AttractorSearch& search) {
  constexpr double swings = 10.0;
  constexpr double periods = 8.0;
  constexpr std::size_t most_events = 200'000;
  MotionPicture picture{.title = title, .drive = drive};
  const Seen seen = seen_in(search);
  const drive::Outcome* outcome =
      start_to_show(search, seen, drive::value_at(reduced.reference, 0.0));
  const drive::ShaftStates start = outcome != nullptr ? outcome->start : drive::ShaftStates{};
  picture.period = search.swing_time > 0.0 ? search.swing_time : 1.0;
  picture.hunting_period = seen.period;
  const bool runs_away = outcome != nullptr && seen.end == drive::MotionEnd::diverges;
  const double longest = 0.25 * most_periods_drawn * picture.period;
  const double until =
      std::max({swings * picture.period, seen.approach + periods * seen.period,
                runs_away ? std::min(outcome->watched, longest) : 0.0});  // so that it shows
  picture.motions.push_back({.motion = motion_from(reduced, start, until, most_events)});
  picture.subtitle =
      "from " + angle_text(start.load_position, drive.angle_unit, digits) + ", at rest";
  return picture;
}

MotionPicture attractor_picture(const std::string& title, const Drive& drive,
                                const drive::ReducedDrive& reduced,
                                const drive::AttractorSearch& search) {
  MotionPicture picture{.title = title, .subtitle = "", .drive = drive};
  const char* per = is_normalized(drive) ? "/ω_n" : " s";
  for (const drive::FoundCycle& cycle : search.cycles) {
    const bool is_first = picture.motions.empty();
    picture.period = is_first ? cycle.period() : std::min(picture.period, cycle.period());
    picture.motions.push_back(
        {.motion = motion_of_cycle(reduced, search, cycle),
         .name = name_of_cycle(cycle, cycle.amplitude, drive.angle_unit) + per,
         .name_of_motor = name_of_cycle(cycle, cycle.motor_amplitude, drive.angle_unit) + per,
         .is_cycle = true,
         .role =
             cycle.stability == Stability::unstable ? MotionRole::unstable : MotionRole::subject});
  }
  if (picture.motions.empty() && !search.irregular.empty()) {
    const drive::Outcome* outcome =
        start_to_show(search, seen_in(search), drive::value_at(reduced.reference, 0.0));
    if (outcome == nullptr) return picture;
    const drive::IrregularFound& irregular = search.irregular[outcome->which];
    picture.motions.push_back(
        {.motion = motion_of_irregular(reduced, irregular, *outcome), .name = "over five periods"});
    picture.period = irregular.period;
  }
  return picture;
}

}  // namespace gearlash
