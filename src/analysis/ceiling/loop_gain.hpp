// How far bounded disturbances can move the loop of a drive whose controller is linear, whatever
// its contact does (docs/mathematics.md, "The ceiling").
#pragma once

#include <memory>
#include <optional>

#include "base/datum.hpp"
#include "model/drive.hpp"
#include "numeric/decaying_motion.hpp"

namespace gearlash {

/// What disturbs the loop.
enum class Disturbance {
  gap,               ///< rad, the motor less the load
  torque_on_motor,   ///< N m
  torque_on_load,    ///< N m
  position_reading,  ///< rad, error of the position that the controller receives
  speed_reading,     ///< rad, error of the position whose differences are the speed
  both_readings      ///< rad, of both, from one encoder
};

/// Upper bounds per unit of the largest disturbance.
struct LoopGain {
  double load = infinity;          ///< rad of the load's position
  double motor = infinity;         ///< rad of the motor's position, at the load's shaft
  std::optional<double> effort{};  ///< N m of the motor's torque; empty if none is known
};

/// A loop that is proved to decay with the gap closed, or with its springs connected.
class DisturbedLoop {
 public:
  virtual ~DisturbedLoop() = default;
  virtual LoopGain gain(Disturbance disturbance) const = 0;
};

/// Whether the controller's torque depends on the sensed speed.
bool uses_speed(const drive::LinearController& controller);

/// Null if it is not proved that the loop decays. Preconditions: a continuous controller; rigid
/// faces, or compliant ones without damping.
std::unique_ptr<DisturbedLoop> continuous_loop(const drive::ReducedDrive& drive);

/// The same for a sampled controller and rigid faces. Precondition: no speed from a tachometer,
/// unless the controller ignores it.
std::unique_ptr<DisturbedLoop> sampled_loop(const drive::ReducedDrive& drive);

}  // namespace gearlash
