// How far bounded disturbances can move the loop of a drive whose controller is linear, whatever
// its contact does (docs/explanation/ceiling.md).
#pragma once

#include <memory>
#include <vector>

#include "base/lists.hpp"
#include "model/linear_drive.hpp"
#include "numeric/interval_matrix.hpp"

namespace gearlash {

/// What disturbs the loop at once and by the same number: one input, or both readings of one
/// encoder.
using Disturbance = std::vector<LinearInput>;

/// What it does to a form at once.
inline Interval at_once(const LinearForm<Interval>& form, const Disturbance& disturbance) {
  Interval sum = 0.0;
  for (const LinearInput input : disturbance) sum = sum + form[input];
  return sum;
}
/// What it adds to each of the forms.
inline IntervalVector at_once(const std::vector<LinearForm<Interval>>& forms,
                              const Disturbance& disturbance) {
  return of_each(forms,
                 [&](const LinearForm<Interval>& form) { return at_once(form, disturbance); });
}

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
  virtual LoopGain gain(const Disturbance& disturbance) = 0;
  /// Infinite where none is known.
  virtual StartGain start_gain(StartOutput output) = 0;
  /// Whether the controller reads the gap's speed, so that the effort needs its bound.
  virtual bool reads_gap_speed() const = 0;
  virtual Interval gap_acceleration_per_speed() const = 0;  ///< 1/s; rigid faces only
};

/// Null if it is not proved that the loop decays. Precondition: rigid faces, or compliant ones
/// without damping or without a gap.
std::unique_ptr<DisturbedLoop> disturbed_loop(const LinearDrive<Interval>& drive);

/// Whether it is proved that the loop decays, with the faces together. Any faces.
bool loop_decays(const LinearDrive<Interval>& drive);

/// The parts of both, by how the controller acts.
std::unique_ptr<DisturbedLoop> continuous_loop(const LinearDrive<Interval>& drive);
std::unique_ptr<DisturbedLoop> sampled_loop(const LinearDrive<Interval>& drive);

}  // namespace gearlash
