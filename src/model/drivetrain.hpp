// Motor, gearbox, load and loop referred to the load shaft, in SI units.
#pragma once

#include "model/normalized_servo.hpp"

namespace gearlash {

/// What remains of any motor once it is referred to the load's shaft. SI units.
template <class Number>
struct DrivetrainOf {
  Number motor_inertia = 0.0;   ///< J_M, kg m², ≥ 0
  Number load_inertia = 0.0;    ///< J_L, kg m², ≥ 0; not both zero
  Number motor_friction = 0.0;  ///< F_M, N m s/rad, ≥ 0; includes back-EMF or speed-torque slope
  Number load_friction = 0.0;   ///< F_L, N m s/rad, ≥ 0
  Number stiffness = 0.0;       ///< K, N m/rad, > 0: torque at the load per unit position error
  Number backlash = 0.0;        ///< b, rad, ≥ 0, face to face at the load shaft
  Number restitution = 0.0;     ///< e, 0 … 1

  bool operator==(const DrivetrainOf&) const = default;
};
using Drivetrain = DrivetrainOf<double>;

/// Every fault in the ranges above and in those of the normalised servo.
std::vector<Fault> faults(const Drivetrain& drivetrain);

/// ω_n = √(K/(J_M+J_L)), rad/s.
double natural_frequency(const Drivetrain& drivetrain);

/// ζ, J_L/J_M, F_L/(F_M+F_L) and b (thesis Appendix A, steps 6 to 8). The friction ratio of a
/// drivetrain without friction is 0. Throws InvalidInput.
NormalizedServo normalize(const Drivetrain& drivetrain);

/// normalize() without its checks, for a drivetrain that is known to be sound.
NormalizedServo normalize_sound(const Drivetrain& drivetrain);

}  // namespace gearlash
