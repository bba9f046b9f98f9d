#include "model/linear_drive.hpp"

#include <utility>
#include <variant>

#include "base/lists.hpp"
#include "base/number.hpp"
#include "model/controller.hpp"

namespace gearlash {
namespace {

using drive::ReducedDrive;

template <class Number>
using Vector = std::vector<Number>;
template <class Number>
using System = LinearSystem<Number>;

/// Every form of the system.
template <class Number>
std::vector<LinearForm<Number>*> forms_of(System<Number>& system) {
  std::vector<LinearForm<Number>*> forms{&system.load,    &system.motor, &system.position,
                                         &system.counted, &system.speed, &system.effort};
  for (LinearForm<Number>& slope : system.slopes) forms.push_back(&slope);
  if (system.gap_acceleration) forms.push_back(&*system.gap_acceleration);
  return forms;
}

template <class Number>
System<Number> extended(System<Number> system, std::size_t size) {
  system.slopes.resize(size);
  for (LinearForm<Number>* form : forms_of(system)) form->of_state.resize(size, Number(0.0));
  for (Vector<Number>* start :
       {&system.start_of_position, &system.start_of_speed, &system.start_of_gap}) {
    start->resize(size, Number(0.0));
  }
  return system;
}

/// With x′ = A x + B u + C u̇ the states x − C u have no u̇.
template <class Number>
void eliminate_gap_speed(System<Number>& system) {
  const Vector<Number> of_gap_speed = system.column(LinearInput::gap_speed);
  for (LinearForm<Number>* form : forms_of(system)) {
    (*form)[LinearInput::gap] = (*form)[LinearInput::gap] + dot(form->of_state, of_gap_speed);
  }
  for (LinearForm<Number>& slope : system.slopes) slope[LinearInput::gap_speed] = Number(0.0);
  system.start_of_gap = added(std::move(system.start_of_gap), scaled(Number(-1.0), of_gap_speed));
}

// ---- the plant ----------------------------------------------------------------------------------

/// The torque, delivered, as the last state if the winding lags, where `motor_speed` is a state. It
/// drives the state `of_torque` by `per_torque`.
template <class Number>
void add_torque(System<Number>& plant, const LinearDrive<Number>& drive, std::size_t of_torque,
                const Number& per_torque, std::size_t motor_speed) {
  plant.effort[LinearInput::torque] = Number(1.0);
  if (!drive.lags) {
    plant.slopes[of_torque][LinearInput::torque] = per_torque;
    return;
  }
  const std::size_t torque = plant.size() - 1;
  const Number rate = Number(1.0) / drive.electrical_time;
  LinearForm<Number>& slope = plant.slopes[torque];
  plant.slopes[of_torque].of_state[torque] = per_torque;
  slope.of_state[torque] = -rate;
  slope.of_state[motor_speed] = -(rate * drive.back_emf);
  slope[LinearInput::torque] = rate;
}

template <class Number>
System<Number> rigid_plant(const LinearDrive<Number>& drive) {
  enum : std::size_t { position, speed, states };
  using enum LinearInput;
  const Number one(1.0);
  const Number inertia = drive.motor_inertia + drive.load_inertia;
  const Number friction = drive.motor_friction + drive.load_friction;
  const Number share = drive.motor_inertia / inertia;  // κ
  const Number other_share = drive.load_inertia / inertia;
  const Number per_inertia = one / inertia;
  const std::size_t size = states + (drive.lags ? 1 : 0);

  System<Number> plant = extended(System<Number>{}, size);
  LinearForm<Number>& slope = plant.slopes[speed];
  plant.slopes[position].of_state[speed] = one;
  slope.of_state[position] = -(per_inertia * drive.weight);
  slope.of_state[speed] = -(per_inertia * friction);
  add_torque(plant, drive, speed, per_inertia, speed);
  slope[gap] = per_inertia * drive.weight * share;
  slope[gap_speed] = per_inertia * (friction * share - drive.motor_friction);
  slope[torque_on_motor] = per_inertia;
  slope[torque_on_load] = per_inertia;
  if (drive.lags) {
    plant.slopes[size - 1][gap_speed] = -(drive.back_emf * other_share / drive.electrical_time);
  }

  for (LinearForm<Number>* form : {&plant.load, &plant.motor, &plant.position, &plant.counted}) {
    form->of_state[position] = one;
  }
  plant.load[gap] = -share;
  plant.motor[gap] = other_share;
  plant.position[gap] = one - drive.position_share - share;
  plant.counted[gap] = one - drive.speed_share - share;
  plant.speed.of_state[speed] = one;
  plant.speed[gap_speed] = plant.counted[gap];

  // J_M ω_M′ = τ − F_M ω_M + w_M and J_L ω_L′ = −F_L ω_L − k_g θ_L + w_L.
  const Number per_motor = one / drive.motor_inertia;
  const Number per_load = one / drive.load_inertia;
  LinearForm<Number>& acceleration = plant.gap_acceleration.emplace();
  acceleration.of_state.assign(size, Number(0.0));
  acceleration.of_state[position] = per_load * drive.weight;
  acceleration.of_state[speed] = per_load * drive.load_friction - per_motor * drive.motor_friction;
  (drive.lags ? acceleration.of_state[size - 1] : acceleration[torque]) = per_motor;
  acceleration[gap] = -(per_load * drive.weight * share);
  acceleration[gap_speed] =
      -(per_motor * drive.motor_friction * other_share + per_load * drive.load_friction * share);
  acceleration[torque_on_motor] = per_motor;
  acceleration[torque_on_load] = -per_load;

  plant.start_of_position[position] = one;
  plant.start_of_speed[speed] = one;
  eliminate_gap_speed(plant);
  return plant;
}

template <class Number>
System<Number> sprung_plant(const LinearDrive<Number>& drive) {
  enum : std::size_t { at_motor, motor_speed, at_load, load_speed, states };
  using enum LinearInput;
  const Number one(1.0);
  const Number& stiffness = drive.spring->stiffness;
  const Number& damping = drive.spring->damping;
  const Number per_motor = one / drive.motor_inertia;
  const Number per_load = one / drive.load_inertia;

  System<Number> plant = extended(System<Number>{}, states + (drive.lags ? 1 : 0));
  plant.slopes[at_motor].of_state[motor_speed] = one;
  plant.slopes[at_load].of_state[load_speed] = one;
  LinearForm<Number>& of_motor = plant.slopes[motor_speed];
  of_motor.of_state[at_motor] = -(per_motor * stiffness);
  of_motor.of_state[at_load] = per_motor * stiffness;
  of_motor.of_state[motor_speed] = -(per_motor * (drive.motor_friction + damping));
  of_motor.of_state[load_speed] = per_motor * damping;
  of_motor[gap] = per_motor * stiffness;
  of_motor[torque_on_motor] = per_motor;
  LinearForm<Number>& of_load = plant.slopes[load_speed];
  of_load.of_state[at_motor] = per_load * stiffness;
  of_load.of_state[at_load] = -(per_load * (stiffness + drive.weight));
  of_load.of_state[motor_speed] = per_load * damping;
  of_load.of_state[load_speed] = -(per_load * (drive.load_friction + damping));
  of_load[gap] = -(per_load * stiffness);
  of_load[torque_on_load] = per_load;
  add_torque(plant, drive, motor_speed, per_motor, motor_speed);

  plant.load.of_state[at_load] = one;
  plant.motor.of_state[at_motor] = one;
  plant.position.of_state[at_load] = drive.position_share;
  plant.position.of_state[at_motor] = one - drive.position_share;
  plant.counted.of_state[at_load] = drive.speed_share;
  plant.counted.of_state[at_motor] = one - drive.speed_share;
  plant.speed.of_state[load_speed] = drive.speed_share;
  plant.speed.of_state[motor_speed] = one - drive.speed_share;

  plant.start_of_position[at_motor] = plant.start_of_position[at_load] = one;
  plant.start_of_speed[motor_speed] = plant.start_of_speed[load_speed] = one;
  const Number inertia = drive.motor_inertia + drive.load_inertia;
  plant.start_of_gap[at_motor] = drive.load_inertia / inertia;
  plant.start_of_gap[at_load] = -(drive.motor_inertia / inertia);
  return plant;
}

// ---- from a reduced drive -----------------------------------------------------------------------

/// `form` says what the drive consists of.
template <class Number>
LinearDrive<Number> made_of(const ReducedDrive& form, const drive::ReducedDriveOf<Number>& numbers,
                            const drive::LinearControllerOf<Number>& controller) {
  LinearDrive<Number> linear;
  linear.motor_inertia = numbers.motor.inertia;
  linear.load_inertia = numbers.load.inertia;
  linear.motor_friction = numbers.motor.friction.viscous;
  linear.load_friction = numbers.load.friction.viscous;
  linear.weight = numbers.gravity.stiffness;
  linear.back_emf = numbers.winding.back_emf;
  linear.electrical_time = numbers.winding.time_constant;
  linear.lags = form.winding.time_constant > 0.0;
  linear.position_share = form.sensing.load_share_of_position;
  linear.speed_share = form.sensing.load_share_of_speed;
  if (const auto* faces = std::get_if<drive::CompliantContactOf<Number>>(&numbers.contact)) {
    linear.spring = *faces;
  }
  linear.controller = controller;
  // Of rounded numbers it is not known that two are opposite.
  const auto combine = [&](Vector<Number>& row) {
    row[0] = form.has_rounded_lists ? row[0] + row[1] : drive::sum_of_both(row);
  };
  combine(linear.controller.direct);
  for (Vector<Number>& row : linear.controller.input_matrix) combine(row);
  linear.counts = form.sampling && linear.uses_speed() && form.sampling->speed_by_differences;
  return linear;
}

}  // namespace

template <class Number>
std::vector<Number> LinearSystem<Number>::column(LinearInput input) const {
  return of_each(slopes, [&](const LinearForm<Number>& slope) { return slope[input]; });
}

template <class Number>
bool LinearDrive<Number>::uses_speed() const {
  const auto uses = [](const std::vector<Number>& row) { return !is_exactly(row[2], 0.0); };
  return uses(controller.direct) || any_of(controller.input_matrix, uses);
}

template <class Number>
bool LinearDrive<Number>::knows_error_alone() const {
  const auto knows = [](const std::vector<Number>& row) { return is_exactly(row[0], 0.0); };
  return knows(controller.direct) && all_of(controller.input_matrix, knows);
}

template <class Number>
LinearSystem<Number> LinearDrive<Number>::plant() const {
  return spring ? sprung_plant(*this) : rigid_plant(*this);
}

template <class Number>
LinearForm<Number> LinearDrive<Number>::worked_out(const std::vector<Number>& of_state,
                                                   const std::vector<Number>& of_inputs,
                                                   const LinearForm<Number>& position,
                                                   const LinearForm<Number>& speed,
                                                   std::size_t first) const {
  LinearForm<Number> form = of_inputs[1] * position + of_inputs[2] * speed;
  for (std::size_t i = 0; i < order(); ++i) {
    form.of_state[first + i] = form.of_state[first + i] + of_state[i];
  }
  form[LinearInput::position_reading] = form[LinearInput::position_reading] + of_inputs[1];
  form[LinearInput::reference] = form[LinearInput::reference] + of_inputs[0];
  return form;
}

template <class Number>
LinearSystem<Number> LinearDrive<Number>::open() const {
  const LinearSystem<Number> mechanics = plant();
  const std::size_t first = mechanics.size();
  LinearSystem<Number> open = extended(mechanics, first + order());
  for (std::size_t i = 0; i < order(); ++i) {
    open.slopes[first + i] = worked_out(controller.state_matrix[i], controller.input_matrix[i],
                                        open.position, open.speed, first);
  }
  open.effort = worked_out(controller.output, controller.direct, open.position, open.speed, first);
  return open;
}

template <class Number>
LinearSystem<Number> LinearDrive<Number>::loop() const {
  LinearSystem<Number> loop = open();
  const LinearForm<Number> requested = loop.effort;
  for (LinearForm<Number>* form : forms_of(loop)) {
    const Number share = std::exchange((*form)[LinearInput::torque], Number(0.0));
    if (!is_exactly(share, 0.0)) *form = std::move(*form) + share * requested;
  }
  eliminate_gap_speed(loop);
  return loop;
}

template struct LinearSystem<double>;
template struct LinearSystem<Interval>;
template struct LinearDrive<double>;
template struct LinearDrive<Interval>;

LinearDrive<double> linear_drive(const ReducedDrive& drive) {
  LinearDrive<double> linear = made_of(drive, drive, drive::running_controller(drive));
  if (!drive.sampling) return linear;
  linear.period = drive.sampling->period;
  linear.holds = held_torques(*drive.sampling);
  linear.position_ticks = drive::position_ticks(*drive.sampling);
  return linear;
}

LinearDrive<Interval> linear_drive(const EnclosedDrive& drive) {
  LinearDrive<Interval> linear = made_of(drive.form(), drive.numbers(), drive.controller());
  linear.period = drive.period();
  linear.holds = drive.held_torques();
  if (drive.form().sampling) linear.position_ticks = drive::position_ticks(*drive.form().sampling);
  return linear;
}

}  // namespace gearlash
