// How far bounded disturbances can move the loop of a drive whose controller is linear, whatever
// its contact does (docs/explanation/ceiling.md).
#pragma once

#include <memory>

#include "analysis/ceiling/enclosed.hpp"

namespace gearlash {

/// What disturbs the loop.
enum class Disturbance {
  gap,               ///< rad, the motor less the load
  torque_on_motor,   ///< N m
  torque_on_load,    ///< N m
  position_reading,  ///< rad, error of the position that the controller receives
  speed_reading,     ///< rad, error of the position whose differences are the speed
  both_readings,     ///< rad, of both, from one encoder
  reference,         ///< rad, a reference that the position follows: of_both()
  gap_speed          ///< rad/s, as far as the controller reads it
};

/// Upper bounds per unit of the largest disturbance.
struct LoopGain {
  double load = infinity;    ///< rad of the load's position
  double motor = infinity;   ///< rad of the motor's position, at the load's shaft
  double effort = infinity;  ///< N m that the controller requests
  /// rad/s² of the motor less the load while the faces are apart, but for what the gap's speed adds
  /// at once, DisturbedLoop::gap_acceleration_per_speed(). Not computed unless it is needed.
  double gap_acceleration = infinity;
};

/// What a start adds to: the requested torque, N m, or the acceleration of LoopGain, rad/s².
enum class StartOutput { effort, gap_acceleration };

/// Upper bounds, at any time, of what a start adds: of both shafts displaced or moving together,
/// per rad and per rad/s, and of the gap at the start, per rad. The controller's numbers are those
/// of rest at the reference.
struct StartGain {
  double of_position = infinity;
  double of_speed = infinity;
  double of_gap = infinity;
};

/// A loop that is proved to decay with the gap closed, or with its springs connected.
class DisturbedLoop {
 public:
  virtual ~DisturbedLoop() = default;
  virtual LoopGain gain(Disturbance disturbance) = 0;
  /// Infinite where none is known.
  virtual StartGain start_gain(StartOutput output) = 0;
  /// Whether the controller reads the gap's speed, so that the effort needs its bound.
  virtual bool reads_gap_speed() const = 0;
  virtual Interval gap_acceleration_per_speed() const = 0;  ///< 1/s; rigid faces only
};

/// What a row of the controller receives of a reference and of a position at it: the sum of both
/// entries, which is 0 where it knows their difference alone.
template <class Row>
Interval of_both(const EnclosedController& controller, const Row& row) {
  const auto differ = [&](const drive::LinearController& one) {
    return row(one)[0] != -row(one)[1];
  };
  if (!controller.any_of(differ)) return 0.0;
  return controller.number([&](const drive::LinearController& one) { return row(one)[0]; }) +
         controller.number([&](const drive::LinearController& one) { return row(one)[1]; });
}

/// Whether the controller's torque depends on the sensed speed.
bool uses_speed(const drive::LinearController& controller);

/// Null if it is not proved that the loop decays. Preconditions: a continuous controller; rigid
/// faces, or compliant ones without damping or without a gap.
std::unique_ptr<DisturbedLoop> continuous_loop(const EnclosedDrive& drive);

/// The same for a sampled controller, whose sampling is that of the form.
std::unique_ptr<DisturbedLoop> sampled_loop(const EnclosedDrive& drive);

/// Whether it is proved that the loop of a continuous controller decays, with the faces together.
/// Any faces.
bool continuous_loop_decays(const drive::ReducedDrive& drive);

/// The same for a sampled controller.
bool sampled_loop_decays(const drive::ReducedDrive& drive);

}  // namespace gearlash
