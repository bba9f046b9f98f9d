#include "general/assemble/drive_forms.hpp"

namespace gearlash::drive {

using hybrid::AffineForm;
using hybrid::Matrix;
using hybrid::Vector;

DriveForms::DriveForms(const ReducedDrive& drive)
    : drive_(drive),
      controller_(running_controller(drive)),
      is_rigid_(std::holds_alternative<RigidContact>(drive.contact)),
      reference_generator_(generator_of(drive.reference)),
      load_generator_(generator_of(drive.load_torque)),
      at_(state_indices(drive, static_cast<Eigen::Index>(controller_.order()), reference_generator_,
                        load_generator_)),
      modes_(drive) {}

bool DriveForms::is_engaged(const DriveMode& mode) const {
  return is_rigid_ && mode.contact != ContactState::apart;
}

bool DriveForms::stands(const DriveMode& mode, Side side) const {
  const bool of_motor = mode.motor == FrictionState::sticking;
  const bool of_load = mode.load == FrictionState::sticking;
  if (is_engaged(mode)) return of_motor || of_load;
  return side == Side::motor ? of_motor : of_load;
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

AffineForm DriveForms::measured_position() const {
  return at_.encoder == StateIndices::none ? sensed_position() : number(at_.encoder);
}

AffineForm DriveForms::rate_of_reference(int order) const {
  Vector output = reference_generator_.output;
  for (int i = 0; i < order; ++i) output = reference_generator_.flow.transpose() * output;
  AffineForm form = constant(0.0);
  form.normal.segment(at_.reference, at_.reference_size) = output;
  return form;
}

AffineForm DriveForms::command(const DriveMode& mode) const {
  const AffineForm led = reference() + drive_.feedforward.lead * reference_speed();
  if (at_.taken_up != StateIndices::none) return led + number(at_.taken_up);
  return led + sign_of(mode.reference_way) * drive_.feedforward.half_gap;
}

AffineForm DriveForms::shape_input(const DriveMode& mode) const {
  if (at_.error != StateIndices::none) return number(at_.error);
  if (drive_.error_shape.is_of_speed) return -1.0 * sensed_speed();
  return command(mode) - measured_position();
}

AffineForm DriveForms::first_shape_input() const {
  if (drive_.error_shape.is_of_speed) return -1.0 * sensed_speed();
  return reference() - sensed_position();
}

AffineForm DriveForms::shaped_error(const DriveMode& mode) const {
  const ErrorShape& shape = drive_.error_shape;
  // A relay's input may be the speed, of which it takes the sign alone.
  const double sign = sign_of(mode.error);
  const double gain = sign == 0.0 ? shape.inner_gain : shape.outer_gain;
  if (gain == 0.0) return constant(sign * shape.offset);
  return gain * shape_input(mode) + sign * shape.offset;
}

AffineForm DriveForms::feedforward_torque(const DriveMode& mode) const {
  const Feedforward& forward = drive_.feedforward;
  const AffineForm of_inertia = forward.inertia * rate_of_reference(2);
  const double sign = sign_of(mode.reference_speed);
  if (sign != 0.0 || forward.speed == 0.0) return of_inertia + sign * forward.torque;
  return of_inertia + forward.torque / forward.speed * reference_speed();
}

AffineForm DriveForms::input_form(const DriveMode& mode, const std::vector<double>& factors) const {
  const AffineForm speed = factors[2] * sensed_speed();
  if (drive_.error_shape.is_present()) return factors[0] * shaped_error(mode) + speed;
  return factors[0] * command(mode) + factors[1] * measured_position() + speed;
}

AffineForm DriveForms::controller_form(const std::vector<double>& factors) const {
  AffineForm sum = constant(0.0);
  for (std::size_t i = 0; i < factors.size(); ++i) {
    sum.normal[controller_states + static_cast<Eigen::Index>(i)] = factors[i];
  }
  return sum;
}

AffineForm DriveForms::asked_torque(const DriveMode& mode) const {
  if (drive_.sampling) return number(at_.held);
  return controller_form(controller_.output) + input_form(mode, controller_.direct) +
         feedforward_torque(mode);
}

AffineForm DriveForms::driving_torque(const DriveMode& mode) const {
  return limited_torque(mode) - drive_.winding.back_emf * number(motor_speed);
}

AffineForm DriveForms::motor_torque(const DriveMode& mode) const {
  if (at_.winding != StateIndices::none) return number(at_.winding);
  if (mode.current == Branch::inner) return limited_torque(mode);
  return drive_.winding.back_emf * number(motor_speed) +
         sign_of(mode.current) * drive_.winding.torque_limit;
}

AffineForm DriveForms::limited_torque(const DriveMode& mode) const {
  if (mode.torque == Branch::inner) return asked_torque(mode);
  return constant(sign_of(mode.torque) * drive_.torque_limit);
}

AffineForm DriveForms::withdrawal(const DriveMode& mode, std::size_t state) const {
  if (controller_.anti_windup.empty() || mode.torque == Branch::inner) return constant(0.0);
  return controller_.anti_windup[state] * (limited_torque(mode) - asked_torque(mode));
}

// ---- torques ------------------------------------------------------------------------------------

AffineForm DriveForms::spring_torque(double face) const {
  return compliant().stiffness * (gap() - 0.5 * face * drive_.backlash);
}

AffineForm DriveForms::damping_torque() const { return compliant().damping * gap_speed(); }

AffineForm DriveForms::mesh_torque(const DriveMode& mode) const {
  if (is_engaged(mode)) {
    return drive_.load.inertia * engaged_acceleration(mode) +
           friction_torque(Side::load, mode.load) - torque_on_load();
  }
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
  return side == Side::motor ? motor_torque(mode) - mesh_torque(mode)
                             : mesh_torque(mode) + torque_on_load();
}

AffineForm DriveForms::friction_torque(Side side, FrictionState state) const {
  const ShaftFriction& friction = shaft(side).friction;
  const bool falls =
      state == FrictionState::forward_slowly || state == FrictionState::backward_slowly;
  if (!falls) return friction.viscous * number(speed_of(side)) + way_of(state) * friction.coulomb;
  const double slope = (friction.breakaway - friction.coulomb) / friction.stribeck_speed;
  return (friction.viscous - slope) * number(speed_of(side)) + way_of(state) * friction.breakaway;
}

AffineForm DriveForms::engaged_acceleration(const DriveMode& mode) const {
  const double inertia = drive_.motor.inertia + drive_.load.inertia;
  const AffineForm torque = motor_torque(mode) + torque_on_load() -
                            friction_torque(Side::motor, mode.motor) -
                            friction_torque(Side::load, mode.load);
  return 1.0 / inertia * torque;
}

AffineForm DriveForms::acceleration(const DriveMode& mode, Side side) const {
  if (stands(mode, side)) return constant(0.0);
  if (is_engaged(mode)) return engaged_acceleration(mode);
  return 1.0 / shaft(side).inertia *
         (applied_torque(mode, side) - friction_torque(side, mode.*friction_of(side)));
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
  // A speed that is 0 but for rounding would move a shaft that stands for hours.
  if (!stands(mode, Side::motor)) set(motor_position, number(motor_speed));
  set(motor_speed, acceleration(mode, Side::motor));
  if (!stands(mode, Side::load)) set(load_position, number(load_speed));
  set(load_speed, acceleration(mode, Side::load));
  if (at_.winding != StateIndices::none && mode.current == Branch::inner) {
    set(at_.winding,
        1.0 / drive_.winding.time_constant * (driving_torque(mode) - number(at_.winding)));
  }
  if (at_.taken_up != StateIndices::none) {
    const Feedforward& forward = drive_.feedforward;
    set(at_.taken_up,
        1.0 / forward.take_up_time *
            (constant(sign_of(mode.reference_way) * forward.half_gap) - number(at_.taken_up)));
  }
  generate(reference_generator_, at_.reference);
  generate(load_generator_, at_.load_torque);
  for (std::size_t i = 0; !drive_.sampling && i < controller_.order(); ++i) {
    set(controller_states + static_cast<Eigen::Index>(i),
        controller_form(controller_.state_matrix[i]) +
            input_form(mode, controller_.input_matrix[i]) + withdrawal(mode, i));
  }
  return flow;
}

}  // namespace gearlash::drive
