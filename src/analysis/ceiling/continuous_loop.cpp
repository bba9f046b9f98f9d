// A continuous controller.
//
// Rigid faces. The sum of both shafts' equations has no mesh torque. With u the gap, J = J_M + J_L,
// F = F_M + F_L, κ = J_M/J, z = θ_L + κu, sensed position z + αu and speed ż + βu̇,
//   J z̈ = τ − F ż + (Fκ − F_M) u̇ − k_g (z − κu) + w,
// with the stiffness k_g of gravity, whose torque at the reference is part of the load torque.
// The numbers z, s = J ż − c u with c = Fκ − F_M + D_v β, and x̃ = x − B_v β u, x of the controller,
// obey a linear flow in which u appears and u̇ does not.
//
// Compliant faces without damping. Torque k (u − sat u), |sat u| ≤ b/2: both shafts joined by the
// spring, and driven by ±k sat u. Without a gap the spring may be damped.
#include <variant>

#include "analysis/ceiling/loop_gain.hpp"

namespace gearlash {
namespace {

using drive::LinearController;
using drive::ReducedDrive;

/// A disturbance's way into the loop and straight to its outputs.
struct Way {
  IntervalVector input{};
  Interval load{0.0};
  Interval motor{0.0};
  Interval effort{0.0};
};

struct Model {
  IntervalMatrix flow;
  Way gap{};
  Way torque_on_motor{};
  Way torque_on_load{};
  Way reading{};
  IntervalVector load{};
  IntervalVector motor{};
  IntervalVector effort{};
  bool has_effort = true;  ///< the torque does not contain the gap's speed
};

/// The controller's numbers, with their error.
struct Data {
  explicit Data(const ReducedDrive& drive) : given(drive::linear_controller(drive.controller)) {}
  LinearController given;
  std::size_t order() const { return given.order(); }
  Interval state(std::size_t i, std::size_t j) const { return datum(given.state_matrix[i][j]); }
  Interval of_position(std::size_t i) const { return datum(given.input_matrix[i][1]); }
  Interval of_speed(std::size_t i) const { return datum(given.input_matrix[i][2]); }
  Interval output(std::size_t i) const { return datum(given.output[i]); }
  Interval position() const { return datum(given.direct[1]); }
  Interval speed() const { return datum(given.direct[2]); }
};

Model rigid_model(const ReducedDrive& drive) {
  const Data controller(drive);
  const std::size_t order = controller.order();
  const std::size_t size = order + 2;
  const Interval motor_inertia = datum(drive.motor.inertia);
  const Interval inertia = motor_inertia + datum(drive.load.inertia);
  const Interval motor_friction = datum(drive.motor.friction.viscous);
  const Interval friction = motor_friction + datum(drive.load.friction.viscous);
  const Interval share = motor_inertia / inertia;
  const Interval alpha = 1.0 - datum(drive.sensing.load_share_of_position) - share;
  const Interval beta = 1.0 - datum(drive.sensing.load_share_of_speed) - share;
  const Interval lead = friction * share - motor_friction + controller.speed() * beta;
  const Interval damping = controller.speed() - friction;

  Model model{.flow = IntervalMatrix(size)};
  const IntervalVector none(size, Interval(0.0));
  for (Way* way : {&model.gap, &model.torque_on_motor, &model.torque_on_load, &model.reading}) {
    way->input = none;
  }
  auto& rows = model.flow.rows;
  rows[0][1] = 1.0 / inertia;
  const Interval weight = datum(drive.gravity.stiffness);
  rows[1][0] = controller.position() - weight;
  rows[1][1] = damping / inertia;
  model.gap.input[0] = lead / inertia;
  model.gap.input[1] = controller.position() * alpha + weight * share + damping * lead / inertia;
  model.reading.input[1] = controller.position();
  model.effort = none;
  model.effort[0] = controller.position();
  model.effort[1] = controller.speed() / inertia;
  model.gap.effort = controller.position() * alpha + controller.speed() * lead / inertia;
  model.reading.effort = controller.position();
  for (std::size_t i = 0; i < order; ++i) {
    const Interval jump = controller.of_speed(i) * beta;  // B_v β
    Interval own = controller.of_position(i) * alpha + controller.of_speed(i) * lead / inertia;
    for (std::size_t j = 0; j < order; ++j) {
      rows[i + 2][j + 2] = controller.state(i, j);
      own = own + controller.state(i, j) * controller.of_speed(j) * beta;
    }
    rows[i + 2][0] = controller.of_position(i);
    rows[i + 2][1] = controller.of_speed(i) / inertia;
    rows[1][i + 2] = controller.output(i);
    model.gap.input[i + 2] = own;
    model.gap.input[1] = model.gap.input[1] + controller.output(i) * jump;
    model.reading.input[i + 2] = controller.of_position(i);
    model.effort[i + 2] = controller.output(i);
    model.gap.effort = model.gap.effort + controller.output(i) * jump;
  }
  model.torque_on_motor.input[1] = 1.0;
  model.torque_on_load.input[1] = 1.0;
  model.load = none;
  model.load[0] = 1.0;
  model.motor = model.load;
  model.gap.load = -share;
  model.gap.motor = 1.0 - share;
  model.has_effort = controller.given.direct[2] == 0.0 || (beta.low == 0.0 && beta.high == 0.0);
  return model;
}

enum Sprung : std::size_t { motor, motor_speed, load, load_speed, states };

/// Damping between both shafts.
void join(std::vector<IntervalVector>& rows, const Interval& damping, const Interval& per_motor,
          const Interval& per_load) {
  rows[motor_speed][motor_speed] = rows[motor_speed][motor_speed] - per_motor * damping;
  rows[motor_speed][load_speed] = rows[motor_speed][load_speed] + per_motor * damping;
  rows[load_speed][motor_speed] = rows[load_speed][motor_speed] + per_load * damping;
  rows[load_speed][load_speed] = rows[load_speed][load_speed] - per_load * damping;
}

Model sprung_model(const ReducedDrive& drive) {
  const Data controller(drive);
  const std::size_t order = controller.order();
  const std::size_t size = order + states;
  const auto& faces = std::get<drive::CompliantContact>(drive.contact);
  const Interval stiffness = datum(faces.stiffness);
  const Interval per_motor = 1.0 / datum(drive.motor.inertia);
  const Interval per_load = 1.0 / datum(drive.load.inertia);
  const Interval position_share = datum(drive.sensing.load_share_of_position);
  const Interval speed_share = datum(drive.sensing.load_share_of_speed);

  Model model{.flow = IntervalMatrix(size)};
  const IntervalVector none(size, Interval(0.0));
  for (Way* way : {&model.gap, &model.torque_on_motor, &model.torque_on_load, &model.reading}) {
    way->input = none;
  }
  // Torque and states from the sensed numbers.
  const auto sensed = [&](const Interval& of_position, const Interval& of_speed) {
    IntervalVector row = none;
    row[load] = of_position * position_share;
    row[motor] = of_position * (1.0 - position_share);
    row[load_speed] = of_speed * speed_share;
    row[motor_speed] = of_speed * (1.0 - speed_share);
    return row;
  };
  model.effort = sensed(controller.position(), controller.speed());
  for (std::size_t i = 0; i < order; ++i) model.effort[i + states] = controller.output(i);
  auto& rows = model.flow.rows;
  rows[motor][motor_speed] = 1.0;
  rows[load][load_speed] = 1.0;
  for (std::size_t j = 0; j < size; ++j) rows[motor_speed][j] = per_motor * model.effort[j];
  rows[motor_speed][motor] = rows[motor_speed][motor] - per_motor * stiffness;
  rows[motor_speed][load] = rows[motor_speed][load] + per_motor * stiffness;
  rows[motor_speed][motor_speed] =
      rows[motor_speed][motor_speed] - per_motor * datum(drive.motor.friction.viscous);
  rows[load_speed][motor] = per_load * stiffness;
  rows[load_speed][load] = -(per_load * stiffness);
  rows[load_speed][load_speed] = -(per_load * datum(drive.load.friction.viscous));
  rows[load_speed][load] = rows[load_speed][load] - per_load * datum(drive.gravity.stiffness);
  if (faces.damping > 0.0) join(rows, datum(faces.damping), per_motor, per_load);
  for (std::size_t i = 0; i < order; ++i) {
    rows[i + states] = sensed(controller.of_position(i), controller.of_speed(i));
    for (std::size_t j = 0; j < order; ++j) rows[i + states][j + states] = controller.state(i, j);
    model.reading.input[i + states] = controller.of_position(i);
  }
  model.gap.input[motor_speed] = per_motor * stiffness;
  model.gap.input[load_speed] = -(per_load * stiffness);
  model.torque_on_motor.input[motor_speed] = per_motor;
  model.torque_on_load.input[load_speed] = per_load;
  model.reading.input[motor_speed] = per_motor * controller.position();
  model.reading.effort = controller.position();
  model.load = none;
  model.load[load] = 1.0;
  model.motor = none;
  model.motor[motor] = 1.0;
  return model;
}

class ContinuousLoop : public DisturbedLoop {
 public:
  ContinuousLoop(Model model, DecayingMotion motion)
      : model_(std::move(model)), motion_(std::move(motion)) {}

  LoopGain gain(Disturbance disturbance) const override {
    const Way& way = of(disturbance);
    const auto bound = [&](const IntervalVector& output, const Interval& straight) {
      return (motion_.impulse_norm(way.input, output) + abs(straight)).high;
    };
    LoopGain gain{.load = bound(model_.load, way.load), .motor = bound(model_.motor, way.motor)};
    if (model_.has_effort) gain.effort = bound(model_.effort, way.effort);
    return gain;
  }

 private:
  const Way& of(Disturbance disturbance) const {
    switch (disturbance) {
      case Disturbance::gap:
        return model_.gap;
      case Disturbance::torque_on_motor:
        return model_.torque_on_motor;
      case Disturbance::torque_on_load:
        return model_.torque_on_load;
      default:  // the speed is measured exactly
        return model_.reading;
    }
  }

  Model model_;
  DecayingMotion motion_;
};

}  // namespace

std::unique_ptr<DisturbedLoop> continuous_loop(const ReducedDrive& drive) {
  Model model = std::holds_alternative<drive::RigidContact>(drive.contact) ? rigid_model(drive)
                                                                           : sprung_model(drive);
  std::optional<DecayingMotion> motion = DecayingMotion::of(model.flow, TimeKind::continuous);
  if (!motion) return nullptr;
  return std::make_unique<ContinuousLoop>(std::move(model), *std::move(motion));
}

}  // namespace gearlash
