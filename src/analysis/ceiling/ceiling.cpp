#include "analysis/ceiling/ceiling.hpp"

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/ceiling/loop_gain.hpp"

namespace gearlash {
namespace {

using drive::ReducedDrive;

struct Source {
  const char* name;
  Disturbance disturbance;
  Interval size;  ///< the largest |disturbance|
};

/// Why no theorem applies; empty if one does.
std::string obstacle(const ReducedDrive& drive) {
  const auto* faces = std::get_if<drive::CompliantContact>(&drive.contact);
  if (faces != nullptr && faces->damping > 0.0 && !drive::is_joined(drive)) {
    return "faces with damping: it can be exceeded (docs/mathematics.md)";
  }
  if (drive.winding.time_constant > 0.0) {
    return "a winding with inductance: no bound is known";
  }
  if (!drive.sampling) return {};
  if (drive.gravity.stiffness != 0.0) {
    return "the stiffness of gravity under a sampled controller: no bound is known";
  }
  if (faces != nullptr) return "compliant faces under a sampled controller: no bound is known";
  const drive::LinearController controller =
      drive::sampled_controller(drive.controller, *drive.sampling);
  if (uses_speed(controller) && !drive.sampling->speed_by_differences) {
    return "a sampled tachometer: it reads the speed of the gap, which has no bound here";
  }
  return {};
}

std::vector<Source> sources_of(const ReducedDrive& drive) {
  std::vector<Source> sources;
  const auto add = [&](const char* name, Disturbance disturbance, const Interval& size) {
    if (size.high > 0.0) sources.push_back({name, disturbance, size});
  };
  add("gap", Disturbance::gap, 0.5 * datum(drive.backlash));
  add("motor friction", Disturbance::torque_on_motor, datum(drive.motor.friction.breakaway));
  add("load friction", Disturbance::torque_on_load, datum(drive.load.friction.breakaway));
  const drive::Sensing& sensing = drive.sensing;
  const Interval of_position = 0.5 * datum(sensing.resolution);
  const Interval of_speed = 0.5 * datum(sensing.resolution_of_speed);
  const bool counts = drive.sampling && drive.sampling->speed_by_differences;
  if (counts && sensing.load_share_of_position == sensing.load_share_of_speed &&
      sensing.resolution == sensing.resolution_of_speed) {
    add("encoder", Disturbance::both_readings, of_position);
  } else {
    add("encoder", Disturbance::position_reading, of_position);
    if (counts) add("speed encoder", Disturbance::speed_reading, of_speed);
  }
  if (const auto* sine = std::get_if<drive::Sine>(&drive.load_torque)) {
    add("load torque", Disturbance::torque_on_load, abs(datum(sine->amplitude)));
  }
  return sources;
}

/// The motor's torque at rest, or while following a ramp; empty where the signals swing, or where
/// gravity makes it depend on the position.
std::optional<Interval> holding_torque(const ReducedDrive& drive) {
  const auto* load_torque = std::get_if<double>(&drive.load_torque);
  if (load_torque == nullptr || drive.gravity.stiffness != 0.0 ||
      !std::holds_alternative<double>(drive.reference)) {
    return std::nullopt;
  }
  return -datum(*load_torque);
}

}  // namespace

Ceiling ceiling_of(const ReducedDrive& drive) {
  Ceiling ceiling;
  ceiling.reason = obstacle(drive);
  if (!ceiling.reason.empty()) return ceiling;
  const std::unique_ptr<DisturbedLoop> loop =
      drive.sampling ? sampled_loop(drive) : continuous_loop(drive);
  if (loop == nullptr) {
    ceiling.reason = "the loop with the gap closed is not proved stable";
    return ceiling;
  }
  Interval load = 0.0;
  Interval motor = 0.0;
  std::optional<Interval> effort = Interval(0.0);
  for (const Source& source : sources_of(drive)) {
    const LoopGain gain = loop->gain(source.disturbance);
    CeilingTerm term{.source = source.name,
                     .size = source.size.high,
                     .load = (source.size * Interval(gain.load)).high,
                     .motor = (source.size * Interval(gain.motor)).high};
    if (gain.effort) term.effort = (source.size * Interval(*gain.effort)).high;
    load = load + term.load;
    motor = motor + term.motor;
    effort = effort && term.effort ? std::optional(*effort + *term.effort) : std::nullopt;
    ceiling.terms.push_back(std::move(term));
  }
  ceiling.is_below_limit = std::isfinite(drive.torque_limit);
  if (!std::isfinite(load.high) || !std::isfinite(motor.high)) {
    ceiling.terms.clear();
    ceiling.reason = "its bound is beyond the numbers of this computer";
    return ceiling;
  }
  ceiling.load = load.high;
  ceiling.motor = motor.high;
  if (effort && std::isfinite(effort->high)) {
    ceiling.effort = effort->high;
  } else {
    ceiling.effort_reason = "the torque contains the speed of the gap, which has no bound here";
  }
  if (const auto holding = holding_torque(drive);
      holding && ceiling.effort && ceiling.is_below_limit) {
    ceiling.meets_limit = (abs(*holding) + *effort).high <= drive.torque_limit;
  }
  return ceiling;
}

}  // namespace gearlash
