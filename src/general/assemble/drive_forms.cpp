#include "general/assemble/drive_forms.hpp"

namespace gearlash::drive {

using hybrid::AffineForm;
using hybrid::Matrix;
using hybrid::Vector;

DriveForms::DriveForms(const ReducedDrive& drive)
    : drive_(drive),
      controller_(drive.sampling ? sampled_controller(drive.controller, *drive.sampling)
                                 : linear_controller(drive.controller)),
      is_rigid_(std::holds_alternative<RigidContact>(drive.contact)),
      reference_generator_(generator_of(drive.reference)),
      load_generator_(generator_of(drive.load_torque)),
      at_(state_indices(drive, static_cast<Eigen::Index>(controller_.order()), reference_generator_,
                        load_generator_)),
      modes_(drive) {}

bool DriveForms::is_engaged(const DriveMode& mode) const {
  return is_rigid_ && mode.contact != ContactState::apart;
}

bool DriveForms::sticks_as_one(const DriveMode& mode) const {
  return mode.motor == FrictionState::sticking || mode.load == FrictionState::sticking;
}

double DriveForms::both_breakaway() const {
  return drive_.motor.friction.breakaway + drive_.load.friction.breakaway;
}

AffineForm DriveForms::of(const Generator& generator, Eigen::Index at) const {
  AffineForm form = constant(generator.offset);
  form.normal.segment(at, generator.size()) = generator.output;
  return form;
}

// ---- sensed quantities and requested torque -----------------------------------------------------

AffineForm DriveForms::sensed(double load_share, Eigen::Index motor, Eigen::Index load) const {
  return load_share * number(load) + (1.0 - load_share) * number(motor);
}

AffineForm DriveForms::sensed_position() const {
  return sensed(drive_.sensing.load_share_of_position, motor_position, load_position);
}

AffineForm DriveForms::counted_position() const {
  return sensed(drive_.sensing.load_share_of_speed, motor_position, load_position);
}

AffineForm DriveForms::sensed_speed() const {
  return sensed(drive_.sensing.load_share_of_speed, motor_speed, load_speed);
}

AffineForm DriveForms::of_inputs(const std::vector<double>& factors) const {
  return factors[0] * reference() +
         factors[1] *
             (at_.encoder == StateIndices::none ? sensed_position() : number(at_.encoder)) +
         factors[2] * sensed_speed();
}

AffineForm DriveForms::of_controller(const std::vector<double>& factors) const {
  AffineForm sum = constant(0.0);
  for (std::size_t i = 0; i < factors.size(); ++i) {
    sum.normal[controller_states + static_cast<Eigen::Index>(i)] = factors[i];
  }
  return sum;
}

AffineForm DriveForms::asked_torque() const {
  if (drive_.sampling) return number(at_.held);
  return of_controller(controller_.output) + of_inputs(controller_.direct);
}

AffineForm DriveForms::motor_torque(TorqueState state) const {
  return at_.winding == StateIndices::none ? limited_torque(state) : number(at_.winding);
}

AffineForm DriveForms::limited_torque(TorqueState state) const {
  if (state == TorqueState::highest) return constant(drive_.torque_limit);
  if (state == TorqueState::lowest) return constant(-drive_.torque_limit);
  return asked_torque();
}

AffineForm DriveForms::withdrawal(const DriveMode& mode, std::size_t state) const {
  if (controller_.anti_windup.empty() || mode.torque == TorqueState::linear) return constant(0.0);
  return controller_.anti_windup[state] * (limited_torque(mode.torque) - asked_torque());
}

// ---- torques ------------------------------------------------------------------------------------

AffineForm DriveForms::spring_torque(double face) const {
  return compliant().stiffness * (gap() - 0.5 * face * drive_.backlash);
}

AffineForm DriveForms::damping_torque() const { return compliant().damping * gap_speed(); }

AffineForm DriveForms::mesh_torque(const DriveMode& mode) const {
  const double face = face_of(mode.contact);
  switch (mode.contact) {
    case ContactState::forward:
    case ContactState::backward:
    case ContactState::joined:
      return spring_torque(face) + damping_torque();
    case ContactState::forward_limited:
    case ContactState::backward_limited:
      return 2.0 * spring_torque(face);
    default:
      return constant(0.0);
  }
}

AffineForm DriveForms::torque_on_load() const {
  const Gravity& gravity = drive_.gravity;
  if (gravity.stiffness == 0.0) return load_torque();
  return load_torque() - gravity.stiffness * (number(load_position) - gravity.angle);
}

AffineForm DriveForms::applied_torque(const DriveMode& mode, Side side) const {
  return side == Side::motor ? motor_torque(mode.torque) - mesh_torque(mode)
                             : mesh_torque(mode) + torque_on_load();
}

AffineForm DriveForms::friction_torque(Side side, FrictionState state) const {
  const ShaftFriction& friction = shaft(side).friction;
  return friction.viscous * number(speed_of(side)) + way_of(state) * friction.coulomb;
}

AffineForm DriveForms::engaged_acceleration(const DriveMode& mode) const {
  if (sticks_as_one(mode)) return constant(0.0);
  const double inertia = drive_.motor.inertia + drive_.load.inertia;
  const AffineForm torque = motor_torque(mode.torque) + torque_on_load() -
                            friction_torque(Side::motor, mode.motor) -
                            friction_torque(Side::load, mode.load);
  return 1.0 / inertia * torque;
}

AffineForm DriveForms::acceleration(const DriveMode& mode, Side side) const {
  if (is_engaged(mode)) return engaged_acceleration(mode);
  const FrictionState state = side == Side::motor ? mode.motor : mode.load;
  if (state == FrictionState::sticking) return constant(0.0);
  return 1.0 / shaft(side).inertia * (applied_torque(mode, side) - friction_torque(side, state));
}

hybrid::AffineFlow DriveForms::flow(const DriveMode& mode) const {
  hybrid::AffineFlow flow{Matrix::Zero(at_.size, at_.size), Vector::Zero(at_.size)};
  const auto set = [&](Eigen::Index row, const AffineForm& form) {
    flow.matrix.row(row) = form.normal.transpose();
    flow.offset[row] = form.offset;
  };
  const auto generate = [&](const Generator& generator, Eigen::Index at) {
    flow.matrix.block(at, at, generator.size(), generator.size()) = generator.flow;
  };
  set(motor_position, number(motor_speed));
  set(motor_speed, acceleration(mode, Side::motor));
  set(load_position, number(load_speed));
  set(load_speed, acceleration(mode, Side::load));
  if (at_.winding != StateIndices::none) {
    set(at_.winding, 1.0 / drive_.winding.time_constant *
                         (limited_torque(mode.torque) -
                          drive_.winding.back_emf * number(motor_speed) - number(at_.winding)));
  }
  generate(reference_generator_, at_.reference);
  generate(load_generator_, at_.load_torque);
  for (std::size_t i = 0; !drive_.sampling && i < controller_.order(); ++i) {
    set(controller_states + static_cast<Eigen::Index>(i),
        of_controller(controller_.state_matrix[i]) + of_inputs(controller_.input_matrix[i]) +
            withdrawal(mode, i));
  }
  return flow;
}

}  // namespace gearlash::drive
