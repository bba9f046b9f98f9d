// Random industrial servo drives: one seed, one drive, on every machine.
#pragma once

#include <cstdint>

#include "gearlash/drive.hpp"

namespace gearlash::oracle {

/// A torque-controlled motor with a sampled controller, drawn as its engineer would tune it for the
/// mechanics with the gap closed:
///   cascade of position P and speed PI with anti-windup, or PID, at 1 … 20 kHz, with a delay of
///   half a period to one; encoders of 10 … 20 bit on load, motor or both; faces rigid and plastic,
///   bouncing (restitution up to 0.7) or compliant (10 … 80 Hz with the motor held); backlash 0.5 …
///   10 arcmin; inertia ratio 0.2 … 10; Coulomb friction 1 … 10 % of the rated torque, with and
///   without a higher breakaway torque; a constant load torque for an eighth of them, and the
///   weight of an arm for another.
[[nodiscard]] Drive random_drive(std::uint64_t seed);

/// The same without a computer: a continuous controller and exact sensors. Those of even seeds have
/// no breakaway torque above Coulomb friction.
[[nodiscard]] Drive continuous_drive(std::uint64_t seed);

/// What a family of drives has beside that of random_drive. Half of each has a computer.
enum class DriveKind : std::uint8_t {
  industrial,        ///< random_drive
  filtered_cascade,  ///< a filter of the measured speed, friction that falls with the speed
  weight_at_limit,   ///< PID, the weight of an arm at 0.6 … 1.1 of the torque limit, dead bands,
                     ///< friction and backlash compensated
  state_space,       ///< PID with notches as state space, order 2 … 6; restitution up to 0.9,
                     ///< inertia ratio 0.02 … 50
  moving_reference,  ///< a sine, a ramp or a trapezoid
  two_rates,  ///< a cascade at two rates, a current loop, a limit of the speed, feed-forward of
              ///< a reference that moves
  without_integral,  ///< PD control, rigid faces, a third each with a dead band, a constant load
                     ///< torque and a weight
  extreme            ///< a gap of 1e-6 rad, encoder steps beyond the gap, gains 3 … 30 times too
                     ///< high, or a delay of 1 … 8 periods
};

[[nodiscard]] Drive random_drive(std::uint64_t seed, DriveKind kind);

/// PD control of the load's position, continuous, the derivative filtered, without dry friction:
/// natural frequency 1 … 30 Hz, damping 0.02 … 1, restitution 0 … 0.9, inertia ratio 0.1 … 10.
[[nodiscard]] Drive frictionless_drive(std::uint64_t seed);

}  // namespace gearlash::oracle
