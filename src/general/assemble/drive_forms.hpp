// A drive's torques, positions and accelerations as affine forms of the state, in each mode.
#pragma once

#include <string>
#include <vector>

#include "general/assemble/affine_sum.hpp"
#include "general/assemble/drive_mode.hpp"
#include "general/assemble/signal_generator.hpp"
#include "general/assemble/state_indices.hpp"
#include "model/controller.hpp"
#include "model/drive.hpp"

namespace gearlash::drive {

enum class Side { motor, load };

class DriveForms {
 public:
  /// Precondition: sound.
  explicit DriveForms(const ReducedDrive& drive);

  const ReducedDrive& drive() const { return drive_; }
  const LinearController& controller() const { return controller_; }
  const Generator& reference_generator() const { return reference_generator_; }
  const Generator& load_generator() const { return load_generator_; }
  const StateIndices& at() const { return at_; }
  const DriveModes& modes() const { return modes_; }

  bool is_rigid() const { return is_rigid_; }
  /// For rigid faces.
  bool is_engaged(const DriveMode& mode) const;
  /// Whether friction holds the shaft, or the one with which its rigid faces are engaged.
  bool stands(const DriveMode& mode, Side side) const;
  const CompliantContact& compliant() const { return std::get<CompliantContact>(drive_.contact); }
  const Shaft& shaft(Side side) const { return side == Side::motor ? drive_.motor : drive_.load; }
  double both_breakaway() const;

  hybrid::Vector unit(Eigen::Index index) const { return hybrid::Vector::Unit(at_.size, index); }
  hybrid::Matrix identity() const { return hybrid::Matrix::Identity(at_.size, at_.size); }
  hybrid::AffineForm number(Eigen::Index index) const { return {unit(index), 0.0}; }
  hybrid::AffineForm constant(double value) const {
    return {hybrid::Vector::Zero(at_.size), value};
  }
  hybrid::AffineForm gap() const { return number(motor_position) - number(load_position); }
  hybrid::AffineForm gap_speed() const { return number(motor_speed) - number(load_speed); }
  hybrid::AffineForm reference() const { return of(reference_generator_, at_.reference); }
  hybrid::AffineForm reference_speed() const { return rate_of_reference(1); }
  /// The reference that the controller follows: with its lead and the addition for the gap.
  hybrid::AffineForm command(const DriveMode& mode) const;
  hybrid::AffineForm load_torque() const { return of(load_generator_, at_.load_torque); }

  hybrid::AffineForm sensed_position() const;
  /// The position whose differences are the speed.
  hybrid::AffineForm counted_position() const;
  hybrid::AffineForm sensed_speed() const;

  /// The input by which ReducedDrive::error_shape chooses its branch: as measured, or as last read.
  hybrid::AffineForm shape_input(const DriveMode& mode) const;
  /// As measured, before any reading.
  hybrid::AffineForm first_shape_input() const;
  /// What ReducedDrive::error_shape gives.
  hybrid::AffineForm shaped_error(const DriveMode& mode) const;
  /// Of the reference's speed and acceleration, N m.
  hybrid::AffineForm feedforward_torque(const DriveMode& mode) const;

  /// Σ factors (r, y, v), of a continuous controller.
  hybrid::AffineForm input_form(const DriveMode& mode, const std::vector<double>& factors) const;
  /// Σ factors of the controller's states.
  hybrid::AffineForm controller_form(const std::vector<double>& factors) const;
  hybrid::AffineForm asked_torque(const DriveMode& mode) const;
  /// The requested torque within its limit.
  hybrid::AffineForm limited_torque(const DriveMode& mode) const;
  /// What a winding's torque tends to: the limited torque less the back-EMF.
  hybrid::AffineForm driving_torque(const DriveMode& mode) const;
  /// On the motor: the limited torque, or the winding's that lags behind it, within the current's
  /// limit. A winding without lag has its back-EMF among the frictions.
  hybrid::AffineForm motor_torque(const DriveMode& mode) const;
  /// Anti-windup, of one of the controller's states.
  hybrid::AffineForm withdrawal(const DriveMode& mode, std::size_t state) const;

  /// For compliant faces.
  hybrid::AffineForm spring_torque(double face) const;
  hybrid::AffineForm damping_torque() const;
  /// On the load. Not of rigid faces together while both shafts stand.
  hybrid::AffineForm mesh_torque(const DriveMode& mode) const;

  /// From outside: the load torque and gravity.
  hybrid::AffineForm torque_on_load() const;
  /// Without friction.
  hybrid::AffineForm applied_torque(const DriveMode& mode, Side side) const;
  hybrid::AffineForm friction_torque(Side side, FrictionState state) const;
  /// Of both shafts as one.
  hybrid::AffineForm engaged_acceleration(const DriveMode& mode) const;
  hybrid::AffineForm acceleration(const DriveMode& mode, Side side) const;

  hybrid::AffineFlow flow(const DriveMode& mode) const;

 private:
  /// A derivative of the reference.
  hybrid::AffineForm rate_of_reference(int order) const;
  hybrid::AffineForm of(const Generator& generator, Eigen::Index at) const;
  hybrid::AffineForm measured_position() const;
  hybrid::AffineForm sensed(double load_share, Eigen::Index motor, Eigen::Index load) const;

  ReducedDrive drive_;
  LinearController controller_;
  bool is_rigid_;
  Generator reference_generator_;
  Generator load_generator_;
  StateIndices at_;
  DriveModes modes_;
};

inline std::string name_of(Side side) { return side == Side::motor ? "motor" : "load"; }
inline Eigen::Index speed_of(Side side) { return side == Side::motor ? motor_speed : load_speed; }
inline FrictionState DriveMode::*friction_of(Side side) {
  return side == Side::motor ? &DriveMode::motor : &DriveMode::load;
}

}  // namespace gearlash::drive
