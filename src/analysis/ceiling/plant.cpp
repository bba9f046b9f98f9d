#include "analysis/ceiling/plant.hpp"

#include <variant>

namespace gearlash {
namespace {

using drive::ReducedDrive;

/// The data of a drive, with their error.
struct Data {
  explicit Data(const EnclosedDrive& drive)
      : motor_inertia(drive.number([](const ReducedDrive& d) { return d.motor.inertia; })),
        load_inertia(drive.number([](const ReducedDrive& d) { return d.load.inertia; })),
        motor_friction(
            drive.number([](const ReducedDrive& d) { return d.motor.friction.viscous; })),
        load_friction(drive.number([](const ReducedDrive& d) { return d.load.friction.viscous; })),
        weight(drive.number([](const ReducedDrive& d) { return d.gravity.stiffness; })),
        back_emf(drive.number([](const ReducedDrive& d) { return d.winding.back_emf; })),
        electrical_time(
            drive.number([](const ReducedDrive& d) { return d.winding.time_constant; })),
        lags(drive.form().winding.time_constant > 0.0),
        of_position(drive.form().sensing.load_share_of_position),
        of_speed(drive.form().sensing.load_share_of_speed) {}
  Interval motor_inertia;
  Interval load_inertia;
  Interval motor_friction;
  Interval load_friction;
  Interval weight;  ///< k_g
  Interval back_emf;
  Interval electrical_time;
  bool lags;
  Interval of_position;  ///< shares of the load
  Interval of_speed;
};

Plant empty_plant(std::size_t size) {
  Plant plant{.flow = IntervalMatrix(size)};
  const IntervalVector none(size, Interval(0.0));
  for (IntervalVector* vector :
       {&plant.torque, &plant.gap, &plant.torque_on_motor, &plant.torque_on_load,
        &plant.load.of_state, &plant.motor.of_state, &plant.position.of_state,
        &plant.counted.of_state, &plant.speed.of_state, &plant.start_of_position,
        &plant.start_of_speed, &plant.start_of_gap}) {
    *vector = none;
  }
  return plant;
}

/// The torque, delivered, as the last state if the winding lags, where `motor_speed` is a state. It
/// drives the state `of_torque` by `per_torque`.
void add_torque(Plant& plant, const Data& data, std::size_t of_torque, const Interval& per_torque,
                std::size_t motor_speed) {
  if (!data.lags) {
    plant.torque[of_torque] = per_torque;
    return;
  }
  const std::size_t torque = plant.size() - 1;
  const Interval rate = 1.0 / data.electrical_time;
  plant.flow.rows[of_torque][torque] = per_torque;
  plant.flow.rows[torque][torque] = -rate;
  plant.flow.rows[torque][motor_speed] = -(rate * data.back_emf);
  plant.torque[torque] = rate;
}

/// With x′ = flow x + gap u + of_speed u̇ the states x − of_speed u have no u̇. Of rigid faces.
void eliminate_gap_speed(Plant& plant, const IntervalVector& of_speed) {
  plant.gap = added(plant.gap, times(plant.flow, of_speed));
  for (PlantOutput* output : {&plant.load, &plant.motor, &plant.position, &plant.counted,
                              &plant.speed, &*plant.gap_acceleration}) {
    output->of_gap = output->of_gap + dot(output->of_state, of_speed);
  }
  plant.start_of_gap = added(plant.start_of_gap, scaled(-1.0, of_speed));
}

Plant rigid_plant(const Data& data) {
  enum : std::size_t { position, speed, states };
  const Interval inertia = data.motor_inertia + data.load_inertia;
  const Interval friction = data.motor_friction + data.load_friction;
  const Interval share = data.motor_inertia / inertia;  // κ
  const Interval other_share = data.load_inertia / inertia;
  const Interval per_inertia = 1.0 / inertia;
  const std::size_t size = states + (data.lags ? 1 : 0);

  Plant plant = empty_plant(size);
  auto& rows = plant.flow.rows;
  rows[position][speed] = 1.0;
  rows[speed][position] = -(per_inertia * data.weight);
  rows[speed][speed] = -(per_inertia * friction);
  add_torque(plant, data, speed, per_inertia, speed);
  plant.gap[speed] = per_inertia * data.weight * share;
  plant.torque_on_motor[speed] = per_inertia;
  plant.torque_on_load[speed] = per_inertia;

  plant.load.of_state[position] = 1.0;
  plant.load.of_gap = -share;
  plant.motor.of_state[position] = 1.0;
  plant.motor.of_gap = other_share;
  plant.position.of_state[position] = 1.0;
  plant.position.of_gap = 1.0 - data.of_position - share;
  plant.counted.of_state[position] = 1.0;
  plant.counted.of_gap = 1.0 - data.of_speed - share;
  plant.speed.of_state[speed] = 1.0;
  plant.speed.of_gap_speed = plant.counted.of_gap;

  // J_M ω_M′ = τ − F_M ω_M + w_M and J_L ω_L′ = −F_L ω_L − k_g θ_L + w_L.
  const Interval per_motor = 1.0 / data.motor_inertia;
  const Interval per_load = 1.0 / data.load_inertia;
  PlantOutput acceleration{.of_state = IntervalVector(size, Interval(0.0))};
  acceleration.of_state[position] = per_load * data.weight;
  acceleration.of_state[speed] = per_load * data.load_friction - per_motor * data.motor_friction;
  (data.lags ? acceleration.of_state[size - 1] : acceleration.of_torque) = per_motor;
  acceleration.of_gap = -(per_load * data.weight * share);
  acceleration.of_gap_speed =
      -(per_motor * data.motor_friction * other_share + per_load * data.load_friction * share);
  acceleration.of_torque_on_motor = per_motor;
  acceleration.of_torque_on_load = -per_load;
  plant.gap_acceleration = acceleration;

  plant.start_of_position[position] = 1.0;
  plant.start_of_speed[speed] = 1.0;
  IntervalVector of_gap_speed(size, Interval(0.0));
  of_gap_speed[speed] = per_inertia * (friction * share - data.motor_friction);
  if (data.lags) {
    of_gap_speed[size - 1] = -(data.back_emf * other_share / data.electrical_time);
  }
  eliminate_gap_speed(plant, of_gap_speed);
  return plant;
}

Plant sprung_plant(const Data& data, const Interval& stiffness, const Interval& damping) {
  enum : std::size_t { motor, motor_speed, load, load_speed, states };
  const Interval per_motor = 1.0 / data.motor_inertia;
  const Interval per_load = 1.0 / data.load_inertia;

  Plant plant = empty_plant(states + (data.lags ? 1 : 0));
  auto& rows = plant.flow.rows;
  rows[motor][motor_speed] = 1.0;
  rows[load][load_speed] = 1.0;
  rows[motor_speed][motor] = -(per_motor * stiffness);
  rows[motor_speed][load] = per_motor * stiffness;
  rows[motor_speed][motor_speed] = -(per_motor * (data.motor_friction + damping));
  rows[motor_speed][load_speed] = per_motor * damping;
  rows[load_speed][motor] = per_load * stiffness;
  rows[load_speed][load] = -(per_load * (stiffness + data.weight));
  rows[load_speed][motor_speed] = per_load * damping;
  rows[load_speed][load_speed] = -(per_load * (data.load_friction + damping));
  add_torque(plant, data, motor_speed, per_motor, motor_speed);
  plant.gap[motor_speed] = per_motor * stiffness;
  plant.gap[load_speed] = -(per_load * stiffness);
  plant.torque_on_motor[motor_speed] = per_motor;
  plant.torque_on_load[load_speed] = per_load;

  plant.load.of_state[load] = 1.0;
  plant.motor.of_state[motor] = 1.0;
  plant.position.of_state[load] = data.of_position;
  plant.position.of_state[motor] = 1.0 - data.of_position;
  plant.counted.of_state[load] = data.of_speed;
  plant.counted.of_state[motor] = 1.0 - data.of_speed;
  plant.speed.of_state[load_speed] = data.of_speed;
  plant.speed.of_state[motor_speed] = 1.0 - data.of_speed;

  plant.start_of_position[motor] = plant.start_of_position[load] = 1.0;
  plant.start_of_speed[motor_speed] = plant.start_of_speed[load_speed] = 1.0;
  const Interval inertia = data.motor_inertia + data.load_inertia;
  plant.start_of_gap[motor] = data.load_inertia / inertia;
  plant.start_of_gap[load] = -(data.motor_inertia / inertia);
  return plant;
}

}  // namespace

Plant plant_of(const EnclosedDrive& drive) {
  using drive::CompliantContact;
  const Data data(drive);
  if (!std::holds_alternative<CompliantContact>(drive.form().contact)) return rigid_plant(data);
  const auto faces =
      drive.made([](const ReducedDrive& d) { return std::get<CompliantContact>(d.contact); });
  return sprung_plant(data, faces.number([](const CompliantContact& f) { return f.stiffness; }),
                      faces.number([](const CompliantContact& f) { return f.damping; }));
}

}  // namespace gearlash
