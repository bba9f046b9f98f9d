#include "general/attractors/found_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/lists.hpp"

namespace gearlash::drive {
namespace {

using hybrid::Event;
using hybrid::PeriodicOrbit;
using hybrid::Trajectory;
using hybrid::Vector;

double largest_multiplier(const PeriodicOrbit& orbit) {
  return orbit.multipliers.empty() ? 0.0 : std::abs(orbit.multipliers.front());
}

Stability stability_of(double multiplier, const CycleTolerances& tolerances) {
  if (std::abs(multiplier - 1.0) <= tolerances.neutral_band) return Stability::neutral;
  return multiplier < 1.0 ? Stability::stable : Stability::unstable;
}

void drop_nearest(std::vector<std::complex<double>>& values, double target) {
  if (values.empty()) return;
  values.erase(std::min_element(values.begin(), values.end(), [&](const auto& a, const auto& b) {
    return std::abs(a - target) < std::abs(b - target);
  }));
}

/// Removes the multipliers of impossible disturbances: differences between shafts whose rigid faces
/// stay together.
PeriodicOrbit without_spare_multipliers(const SearchSetting& setting, PeriodicOrbit orbit) {
  const bool is_rigid = std::holds_alternative<RigidContact>(setting.drive.contact);
  bool parts = false;
  bool sticks = false;
  const auto look = [&](std::size_t index) {
    const DriveMode mode = setting.built.modes.mode(index);
    parts = parts || mode.contact == ContactState::apart;
    sticks =
        sticks || mode.motor == FrictionState::sticking || mode.load == FrictionState::sticking;
  };
  look(orbit.start.mode);
  for (const Event& event : orbit.events) look(event.mode_after);
  if (is_rigid && !parts) {
    drop_nearest(orbit.multipliers, 1.0);                 // the position difference persists
    drop_nearest(orbit.multipliers, sticks ? 0.0 : 1.0);  // the speed difference too, unless a stop
                                                          // ends it
  }
  return orbit;
}

bool stays_apart(const SearchSetting& setting, const PeriodicOrbit& orbit) {
  return all_of(orbit.events, [&](const Event& event) {
    return setting.built.modes.mode(event.mode).contact == ContactState::apart;
  });
}

double hardest_impact(const SearchSetting& setting, const PeriodicOrbit& orbit) {
  const auto is_apart = [&](std::size_t mode) {
    return setting.built.modes.mode(mode).contact == ContactState::apart;
  };
  double hardest = 0.0;
  for (const Event& event : orbit.events) {
    if (event.kind != hybrid::EventKind::transition || !is_apart(event.mode)) continue;
    const bool meets = !is_apart(event.mode_after);
    const bool bounces =
        setting.load.speed.at(event.before) != setting.load.speed.at(event.after) &&
        setting.motor.speed.at(event.before) != setting.motor.speed.at(event.after);
    if (!meets && !bounces) continue;
    hardest = std::max(hardest, std::abs(setting.motor.speed.at(event.before) -
                                         setting.load.speed.at(event.before)));
  }
  return hardest;
}

double missed(const std::vector<Sample>& of_shaft) {
  return of_shaft.empty() ? 0.0 : std::abs(of_shaft.back().value - of_shaft.front().value);
}

}  // namespace

Trajectory motion_on(const hybrid::PreparedSystem& system, const PeriodicOrbit& orbit,
                     double periods) {
  const double from = orbit.start_time;
  return simulate(system, orbit.start, {.from = from, .until = from + periods * orbit.period});
}

bool agree(double a, double b, double scale, double share) {
  return std::abs(a - b) <= share * scale;
}

double mismatch_after(const SearchSetting& setting, const PeriodicOrbit& orbit, double share,
                      double sign) {
  const Vector& start = orbit.start.numbers;
  const Vector here = motion_on(setting.system, orbit, share).end().numbers;
  return (here - sign * start).cwiseAbs().maxCoeff() / start.cwiseAbs().maxCoeff();
}

FoundCycle measured(const SearchSetting& setting, const PeriodicOrbit& orbit,
                    const SearchTolerances& all) {
  const CycleTolerances& tolerances = all.cycle;
  const Trajectory motion = motion_on(setting.system, orbit, 1.0);
  const std::vector<Sample> of_load = samples(motion, setting.load);
  const std::vector<Sample> of_motor = samples(motion, setting.motor);
  const Extent load = extent_of(of_load);
  const Extent motor = extent_of(of_motor);
  FoundCycle cycle;
  cycle.mismatch = std::max(missed(of_load), missed(of_motor));
  cycle.orbit = without_spare_multipliers(setting, orbit);
  cycle.multiplier = largest_multiplier(cycle.orbit);
  cycle.stability = stability_of(cycle.multiplier, tolerances);
  const bool load_moves = load.width() > all.rest.negligible_swing * setting.small_length;
  cycle.amplitude = load_moves ? 0.5 * load.width() : 0.0;
  cycle.motor_amplitude = 0.5 * motor.width();
  cycle.center = load.middle();
  const Extent error = setting.error ? extent_of(samples(motion, *setting.error)) : load;
  cycle.error = std::max(std::abs(error.low), std::abs(error.high));
  if (!load_moves && !setting.error && stays_apart(setting, orbit)) {
    cycle.error = std::max(cycle.error, error_beside(motor, setting.drive));
  }
  cycle.centers.include(cycle.center);
  cycle.amplitudes.include(cycle.amplitude);
  cycle.frequency = 2.0 * std::numbers::pi / orbit.period;
  cycle.impact_speed = hardest_impact(setting, orbit);
  cycle.is_symmetric = mismatch_after(setting, orbit, 0.5, -1.0) < tolerances.recurrence;
  return cycle;
}

double extent_of(const FoundCycle& cycle) {
  return std::max(cycle.amplitude, cycle.motor_amplitude);
}

bool returns(const FoundCycle& cycle, const CycleTolerances& tolerances) {
  return cycle.mismatch <=
         tolerances.return_of_shafts * std::max(1.0, cycle.multiplier) * extent_of(cycle);
}

bool is_one_with(FoundCycle& known, const FoundCycle& cycle, const CycleTolerances& tolerances) {
  if (known.stability != cycle.stability) return false;
  const double period = cycle.period();
  if (cycle.stability == Stability::neutral) {
    return agree(known.period(), period, period, tolerances.same_family);
  }
  const double same = tolerances.same_cycle;
  if (!agree(known.period(), period, period, same) ||
      !agree(known.amplitude, cycle.amplitude, extent_of(cycle), same) ||
      !agree(known.motor_amplitude, cycle.motor_amplitude, extent_of(cycle), same)) {
    return false;
  }
  if (agree(known.center, cycle.center, extent_of(cycle), same)) return true;
  const bool is_image = agree(known.center, -cycle.center, extent_of(cycle), same);
  known.has_mirror_image = known.has_mirror_image || is_image;
  return is_image;
}

double largest_mesh_torque(const SearchSetting& setting, const Trajectory& motion) {
  const auto torque_in = [&](std::size_t mode) {
    std::optional<hybrid::AffineForm> torque = setting.built.mesh_torque(mode);
    if (torque) torque = setting.frame.inside(std::move(*torque));
    return torque;
  };
  return largest_size(motion, setting.system.system(), torque_in);
}

std::size_t place_of(const FoundCycle& cycle, const CycleTolerances& tolerances,
                     std::vector<FoundCycle>& all) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!is_one_with(all[i], cycle, tolerances)) continue;
    all[i].centers.include(cycle.center);
    all[i].amplitudes.include(cycle.amplitude);
    return i;
  }
  all.push_back(cycle);
  return all.size() - 1;
}

}  // namespace gearlash::drive
