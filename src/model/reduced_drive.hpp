// A drive with all its numbers referred to the load's shaft.
#pragma once

#include <optional>
#include <vector>

#include "gearlash/drive.hpp"
#include "model/drive.hpp"
#include "model/drivetrain.hpp"

namespace gearlash {

/// How much of the controller's output arrives at the load: torque there per unit of output, and
/// the friction that the motor's winding adds (back-EMF, or the slope of its speed-torque curve)
/// and its tachometer.
template <class Number>
struct ReferredOutputOf {
  Number torque = 1.0;    ///< N m per V, or per N m at the motor's shaft
  Number friction = 0.0;  ///< N m s/rad
};
using ReferredOutput = ReferredOutputOf<double>;

/// The torque per current of the motor's armature, N m/A, if it is known.
std::optional<double> torque_constant_of(const Motor& motor);

/// Whether the motor's dry friction may be given by its no-load current.
bool takes_no_load_current(const Motor& motor);

/// The dry friction of the moving motor at its own shaft, N m: friction.coulomb, or
/// torque_constant · no_load_current. Part of the no-load current balances friction that grows with
/// speed, so this is an upper bound.
double coulomb_torque(const Motor& motor);

/// The limit of the controller's output: motor.limit, or torque_constant · current_limit.
std::optional<double> output_limit(const Motor& motor);

/// Whether the motor may have a current limit: one that is driven by a voltage through its armature
/// or field, or is torque-controlled with a torque constant.
bool takes_current_limit(const Motor& motor);

/// Whether its current limit gives the motor's torque limit: that of a torque-controlled one.
bool limits_torque_by_current(const Motor& motor);

/// Whether the controller is a cascade, as it is given or as a firmware's registers mean it.
bool is_cascade(const Drive& drive);

/// Torque at the load per unit of the controller's output, N m per V or N m: that of a
/// torque-controlled motor is at the joint for gains of the load, else at the motor.
double output_scale(const Drive& drive);

/// Torque at the load per unit of a gain, for angles of the load: with n motor turns per load turn,
/// output_scale() for gains per angle of the load, n times that for gains per angle of the motor.
double gain_scale(const Drive& drive);

/// Armature: K₁n/R and K₁K₂n²/R; field: K₁n/R and 0; two-phase: K_e n and K_N n²; torque: n and 0
/// (thesis Appendix A, steps 1 to 5; n motor turns per load turn).
ReferredOutput refer_output(const Drive& drive);

/// All at the load's shaft. Faulty numbers give a faulty result; see faults().
drive::ReducedDrive reduce(const Drive& drive);
/// The faults of the drive. If there are none, reduce() of it is written to `reduced`.
std::vector<Fault> faults(const Drive& drive, drive::ReducedDrive& reduced);
/// With the final course of its signals, on which hunting depends.
drive::ReducedDrive with_settled_signals(drive::ReducedDrive reduced);
/// The same of reduce().
drive::ReducedDrive reduce_settled(const Drive& drive);

/// Replaces a normal form by a drive with equivalent numbers: torque control, n = 1 and
/// J_M + J_L = 1 kg m². Any other drive is unchanged.
Drive physical_form(const Drive& drive);

/// The drivetrain of a drive that is known to be a proportional servo, without checks:
///   J_M = (J + J_G) n²,  F_M = (f + E) n² + S d,  K = S g,  S = gain_scale(),
/// E the winding's friction (K₁K₂/R, 0, K_N, 0), more by the torque per output times the feedback
/// of the motor's speed, g and d the controller's output per error and per speed; or of a normal
/// form
///   J_M = 1/(1 + r),  J_L = 1 − J_M,  F_M = 2ζω_n(1 − φ),  F_L = 2ζω_nφ,  K = ω_n².
/// Nothing is allocated if the controller is P, PD or a cascade.
Drivetrain referred_drivetrain(const Drive& drive);

}  // namespace gearlash
