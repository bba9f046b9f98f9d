#include "general/attractors/cycle_derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "general/attractors/found_cycle.hpp"
#include "hybrid/disturbances.hpp"
#include "hybrid/orbit_slopes.hpp"

namespace gearlash::drive {
namespace {

using hybrid::Event;
using hybrid::EventKind;

/// The least speed at which a guard is met, as a share of the highest.
double least_share_of_speed(const hybrid::HybridSystem& system,
                            const hybrid::PeriodicOrbit& orbit) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  double last = -1.0;
  for (const Event& event : orbit.events) {
    const bool is_chained = event.time == last;  // it has no delay of its own
    last = event.time;
    if (event.kind != EventKind::transition || is_chained) continue;
    const hybrid::AffineMode& mode = system.mode(event.mode);
    const double speed = std::abs(mode.transitions[event.transition].guard.normal.dot(
        hybrid::velocity(mode.flow, event.before)));
    least = std::min(least, speed);
    most = std::max(most, speed);
  }
  return most > 0.0 ? least / most : 1.0;
}

bool has_multiplier_of_one(const FoundCycle& cycle) {
  const auto is_one = [](const std::complex<double>& multiplier) {
    constexpr double near = 1e-6;
    return std::abs(multiplier - 1.0) < near;
  };
  const std::vector<std::complex<double>>& all = cycle.orbit.multipliers;
  return std::any_of(all.begin(), all.end(), is_one);
}

}  // namespace

std::string obstacle_to_slopes(const SearchSetting& setting, const FoundCycle& cycle) {
  const ReducedDrive& drive = setting.drive;
  if (drive.sampling) return "the controller's ticks hold its period to multiples of their own";
  if (drive.sensing.resolution > 0.0 || drive.sensing.resolution_of_speed > 0.0) {
    return "the encoder's steps have no derivative";
  }
  if (!is_mirrored(drive) && (std::holds_alternative<Sine>(drive.reference) ||
                              std::holds_alternative<Sine>(drive.load_torque))) {
    return "a sine drives it";
  }
  const std::vector<Event>& events = cycle.orbit.events;
  if (std::any_of(events.begin(), events.end(),
                  [](const Event& event) { return event.kind == EventKind::settling; })) {
    return "infinitely many bounces settle in each period";
  }
  constexpr double grazing = 1e-6;
  if (least_share_of_speed(setting.system.system(), cycle.orbit) < grazing) {
    return "it grazes a border between two motions";
  }
  if (has_multiplier_of_one(cycle)) return "a multiplier is 1: it is one of a family, or at a fold";
  return "";
}

std::optional<CycleSlopes> cycle_slopes(const SearchSetting& setting, const FoundCycle& cycle,
                                        const std::function<ReducedDrive(double)>& family,
                                        double parameter, double step) {
  const hybrid::SystemSlopes slopes(
      [&](double value) { return search_setting(family(value)).system.system(); }, parameter, step);
  hybrid::PeriodicOrbit orbit = cycle.orbit;
  orbit.start_time = 0.0;
  const hybrid::Trajectory motion = motion_on(setting.system, orbit, 1.0);
  orbit.events = motion.events();  // their times to the last bit
  const auto along = orbit_slopes(setting.system, orbit, slopes);
  if (!along) return std::nullopt;
  const auto by_value = [](const Sample& a, const Sample& b) { return a.value < b.value; };
  const auto slope_at = [&](const Watched& shaft, double time) {
    return slope_of(shaft.value, time, setting.system, orbit, slopes, *along);
  };
  struct Ends {
    double low, high;
  };
  const auto ends_of = [&](const Watched& shaft) {
    const std::vector<Sample> all = samples(motion, shaft);
    const auto [low, high] = std::minmax_element(all.begin(), all.end(), by_value);
    return Ends{slope_at(shaft, low->time), slope_at(shaft, high->time)};
  };
  const Ends load = ends_of(setting.load);
  const Ends motor = ends_of(setting.motor);
  CycleSlopes found{.amplitude = 0.5 * (load.high - load.low),
                    .motor_amplitude = 0.5 * (motor.high - motor.low),
                    .center = 0.5 * (load.high + load.low),
                    .period = along->period};
  if (cycle.amplitude == 0.0) found.amplitude = std::numeric_limits<double>::quiet_NaN();
  return found;
}

}  // namespace gearlash::drive
