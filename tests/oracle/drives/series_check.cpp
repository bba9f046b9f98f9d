#include "series_check.hpp"

#include <limits>
#include <vector>

#include "base/on_threads.hpp"
#include "base/seeded_draws.hpp"

namespace gearlash::oracle {
namespace {

void vary(PlainShaft& shaft, double inertia, double viscous, double dry) {
  shaft.inertia *= inertia;
  shaft.viscous *= viscous;
  shaft.coulomb *= dry;
  shaft.breakaway *= dry;
}

double sensed_amplitude(const PlainDrive& drive, const Ending& ending) {
  if (ending.kind == EndKind::runs_away) return std::numeric_limits<double>::infinity();
  return drive.reads_load ? ending.amplitude : ending.motor_amplitude;
}

}  // namespace

SeriesUnit unit_of(const PlainDrive& drive, std::size_t number, const SeriesOptions& options) {
  constexpr std::uint64_t apart = 1'000'003;  // so that seeds of two series hardly meet
  SeededDraws draws(apart * options.seed + number);
  const auto about_1 = [&](double share) { return draws.uniform(1.0 - share, 1.0 + share); };
  SeriesUnit unit{.drive = drive};
  unit.motor_inertia = about_1(options.inertia);
  unit.load_inertia = about_1(options.inertia);
  unit.motor_viscous = about_1(options.friction);
  unit.load_viscous = about_1(options.friction);
  unit.motor_dry = about_1(options.friction);
  unit.load_dry = about_1(options.friction);
  unit.gap = draws.uniform(options.least_gap, 1.0);
  vary(unit.drive.motor, unit.motor_inertia, unit.motor_viscous, unit.motor_dry);
  vary(unit.drive.load, unit.load_inertia, unit.load_viscous, unit.load_dry);
  unit.drive.backlash *= unit.gap;
  unit.start.load_position =
      drive.reference +
      drive.backlash * draws.either_sign(options.nearest_start, options.furthest_start);
  unit.start.motor_position =
      unit.start.load_position + unit.drive.backlash * draws.uniform(-0.5, 0.5);
  return unit;
}

SeriesCheck check_series(const PlainDrive& drive, const SeriesOptions& options) {
  std::vector<Ending> endings(options.units);
  on_threads(0, options.units, [&](std::size_t i) {
    const SeriesUnit unit = unit_of(drive, i, options);
    endings[i] = ending_of(unit.drive, unit.start, options.ending);
    if (endings[i].kind != EndKind::unclear) return;
    EndingOptions longer = options.ending;
    longer.longest_time = options.patience;
    endings[i] = ending_of(unit.drive, unit.start, longer);
  });
  SeriesCheck check;
  for (std::size_t i = 0; i < endings.size(); ++i) {
    const EndKind kind = endings[i].kind;
    const double amplitude = sensed_amplitude(drive, endings[i]);
    if (kind == EndKind::rest || kind == EndKind::fades) {
      ++check.resting;
      continue;
    }
    if (kind == EndKind::runs_away) {
      ++check.running_away;
    } else {
      ++(amplitude <= drive.step ? check.within : check.beyond);
      if (kind == EndKind::unclear) ++check.unclear;
    }
    if (amplitude > check.worst_amplitude) {
      check.worst = i;
      check.worst_amplitude = amplitude;
    }
  }
  return check;
}

}  // namespace gearlash::oracle
