// What a data sheet says of a servo, in SI units at the motor's own shaft (thesis Appendix A).
#pragma once

#include <variant>

#include "model/drivetrain.hpp"

namespace gearlash {

/// Direct-current motor fed through its armature: K = K₁K₃n/R, back-EMF friction K₁K₂n²/R, n being
/// motor turns per load turn (the thesis's P is 1/n).
struct ArmatureControlledMotor {
  double inertia = 0.0;            ///< J_m, kg m², ≥ 0
  double friction = 0.0;           ///< f_m, N m s/rad, ≥ 0
  double torque_constant = 0.0;    ///< K₁, N m/A, > 0
  double back_emf_constant = 0.0;  ///< K₂, V s/rad, ≥ 0
  double resistance = 0.0;         ///< R, Ω, > 0 (armature)

  bool operator==(const ArmatureControlledMotor&) const = default;
};

/// Direct-current motor fed through its field, whose time constant is negligible: K = K₁K₃n/R.
struct FieldControlledMotor {
  double inertia = 0.0;          ///< J_m, kg m², ≥ 0
  double friction = 0.0;         ///< f_m, N m s/rad, ≥ 0
  double torque_constant = 0.0;  ///< K₁, N m per ampere of field current, > 0
  double resistance = 0.0;       ///< R, Ω, > 0 (field)

  bool operator==(const FieldControlledMotor&) const = default;
};

/// Two-phase induction servo motor given by the slopes of its characteristic curves.
struct TwoPhaseMotor {
  double inertia = 0.0;          ///< J_m, kg m², ≥ 0
  double friction = 0.0;         ///< f_m, N m s/rad, ≥ 0
  double torque_per_volt = 0.0;  ///< K_e = ∂T/∂e, N m/V, > 0
  double torque_per_speed = 0.0;  ///< K_N = −∂T/∂n, N m s/rad, ≥ 0 (the slope, taken positive)

  bool operator==(const TwoPhaseMotor&) const = default;
};

using SheetMotor = std::variant<ArmatureControlledMotor, FieldControlledMotor, TwoPhaseMotor>;

struct SheetGearbox {
  double ratio = 1.0;     ///< n, motor turns per load turn, > 0
  double backlash = 0.0;  ///< b, rad at the load shaft, face to face, ≥ 0

  bool operator==(const SheetGearbox&) const = default;
};

struct SheetLoad {
  double inertia = 0.0;   ///< J_L, kg m², ≥ 0
  double friction = 0.0;  ///< F_L, N m s/rad, ≥ 0

  bool operator==(const SheetLoad&) const = default;
};

struct SheetLoop {
  double error_gain = 0.0;  ///< K₃, volts per radian of load error, > 0
  ShaftName sensor = ShaftName::load;

  bool operator==(const SheetLoop&) const = default;
};

struct SheetContact {
  double restitution = 0.0;  ///< e, 0 … 1

  bool operator==(const SheetContact&) const = default;
};

struct Datasheet {
  SheetMotor motor;
  SheetGearbox gearbox;
  SheetLoad load;
  SheetLoop loop;
  SheetContact contact;

  bool operator==(const Datasheet&) const = default;
};

/// Names of the fields of a data sheet for those that a drivetrain or its normal form reports.
std::vector<Fault> named_for_datasheet(std::vector<Fault> faults);

/// Every fault, field by field ("motor.resistance", …).
std::vector<Fault> validate(const Datasheet& datasheet);

/// The parts of the motor's contribution at the load shaft, in SI (Appendix A, steps 1 to 5).
struct ReferredMotor {
  double stiffness;            ///< K, N m/rad
  double inertia;              ///< J_M = J_m n², kg m²
  double mechanical_friction;  ///< f_m n², N m s/rad
  double electrical_friction;  ///< back-EMF K₁K₂n²/R, or slope K_N n², or 0 (field), N m s/rad
};

/// Appendix A, steps 1, 2, 4 and 5, for the three motors:
///   armature  K = K₁K₃n/R, F₁ = K₁K₂n²/R;  field  K = K₁K₃n/R, F₁ = 0;
///   two-phase K = K_e K₃ n, F₁ = K_N n² (the thesis writes K_e and K_N for n = 1, K₃ = 1 V/rad).
ReferredMotor refer_to_load(const Datasheet& datasheet);

/// The drivetrain of a sound data sheet. Throws InvalidInput with every fault.
Drivetrain to_drivetrain(const Datasheet& datasheet);

/// to_drivetrain() without its checks, for a data sheet that is known to be sound.
Drivetrain to_drivetrain_sound(const Datasheet& datasheet);

}  // namespace gearlash
