#include "picture/attractor_picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/motion.hpp"
#include "model/reduced_drive.hpp"
#include "output/report_units.hpp"

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

/// The last few mean periods of the watched motion.
Motion motion_of_irregular(const drive::ReducedDrive& reduced,
                           const drive::IrregularFound& irregular, const drive::Outcome& outcome) {
  constexpr double periods = 5.0;
  drive::DriveSystem system = drive::drive_system(reduced);
  const hybrid::Trajectory whole =
      hybrid::simulate(system.system, drive::drive_start(reduced, system, outcome.start),
                       {.until = outcome.watched});
  const double end = whole.end_time();
  const double from = std::max(0.0, end - periods * irregular.period);
  hybrid::Trajectory last =
      hybrid::simulate(system.system, whole.at(from), {.from = from, .until = end});
  return motion_of(std::move(system), std::move(last));
}

/// A name with enough numbers to distinguish the cycles of a picture.
std::string name_of_cycle(const drive::FoundCycle& cycle, double amplitude,
                          const AngleUnit& angle) {
  return fmt::format("{} cycle ±{}, {}", name_of(cycle.stability),
                     angle_text(amplitude, angle, digits), significant(cycle.period(), digits));
}

}  // namespace

MotionPicture attractor_picture(const std::string& title, const Drive& drive,
                                const drive::ReducedDrive& reduced,
                                const drive::AttractorSearch& search, const AngleUnit& angle) {
  MotionPicture picture{.title = title, .subtitle = "", .drive = drive, .angle = angle};
  const char* per = is_normalized(drive) ? "/ω_n" : " s";
  for (const drive::FoundCycle& cycle : search.cycles) {
    const bool is_first = picture.motions.empty();
    picture.period = is_first ? cycle.period() : std::min(picture.period, cycle.period());
    picture.motions.push_back(
        {.motion = motion_of_cycle(reduced, search, cycle),
         .name = name_of_cycle(cycle, cycle.amplitude, angle) + per,
         .name_of_motor = name_of_cycle(cycle, cycle.motor_amplitude, angle) + per,
         .is_cycle = true});
  }
  if (picture.motions.empty() && !search.irregular.empty()) {
    const auto outcome = std::find_if(
        search.outcomes.begin(), search.outcomes.end(),
        [](const drive::Outcome& one) { return one.end == drive::MotionEnd::irregular; });
    const drive::IrregularFound& irregular = search.irregular[outcome->which];
    picture.motions.push_back(
        {.motion = motion_of_irregular(reduced, irregular, *outcome), .name = "for some periods"});
    picture.period = irregular.period;
  }
  return picture;
}

}  // namespace gearlash
