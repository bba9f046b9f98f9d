// Random units of a series of drives, each followed by the fixed-step simulator.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ending.hpp"
#include "plain_drive.hpp"

namespace gearlash::oracle {

/// What varies from unit to unit: evenly and independently the inertia of each shaft, its viscous
/// and its dry friction (Coulomb and breakaway torque in one ratio), and the gap.
struct SeriesOptions {
  std::size_t units = 1000;
  std::uint64_t seed = 1;
  double inertia = 0.2;     ///< ± share
  double friction = 0.5;    ///< ± share
  double least_gap = 0.01;  ///< share of the drive's gap, up to which the gap goes
  /// Each unit starts at rest, both shafts displaced together, evenly by ratio and to either side,
  /// and the motor anywhere in the gap.
  double nearest_start = 0.1;    ///< gaps of the drive
  double furthest_start = 50.0;  ///< gaps
  /// Motion whose end is not clear by then is followed for `patience`.
  EndingOptions ending{.longest_step = 50e-6, .first_time = 8.0, .longest_time = 32.0};
  double patience = 320.0;  ///< s
};

/// A unit and its start.
struct SeriesUnit {
  PlainDrive drive{};
  ShaftReadings start{};
  double motor_inertia = 1.0, load_inertia = 1.0;     ///< of the drive's, as shares
  double motor_viscous = 1.0, load_viscous = 1.0;     ///< likewise
  double motor_dry = 1.0, load_dry = 1.0, gap = 1.0;  ///< likewise
};

/// Unit `number` of the series, from 0 on: the same on every machine and in any order.
[[nodiscard]] SeriesUnit unit_of(const PlainDrive& drive, std::size_t number,
                                 const SeriesOptions& options);

/// Counts of units. Amplitudes are half the peak-to-peak of the shaft whose position is measured.
struct SeriesCheck {
  std::size_t resting = 0;  ///< and fading
  std::size_t within = 0;   ///< bounded motion of at most one step of the encoder
  std::size_t beyond = 0;   ///< ... of more
  std::size_t running_away = 0;
  /// Of `beyond` and `within`: those whose swings still grew, shrank or waited for the integral.
  std::size_t unclear = 0;
  /// The unit that swings furthest, or the first that runs away.
  std::size_t worst = 0;
  double worst_amplitude = 0.0;  ///< rad; infinite of one that runs away

  [[nodiscard]] std::size_t kept() const { return resting + within; }
};

/// Follows the units on all cores. Precondition: a drive with an encoder.
[[nodiscard]] SeriesCheck check_series(const PlainDrive& drive, const SeriesOptions& options);

}  // namespace gearlash::oracle
