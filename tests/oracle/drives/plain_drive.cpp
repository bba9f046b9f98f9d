#include "plain_drive.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <variant>

namespace gearlash::oracle {
namespace {

void refuse(bool condition, const char* what) {
  if (condition) throw std::invalid_argument(what);
}

PlainShaft shaft_of(double inertia, const Friction& friction, double ratio) {
  return {.inertia = inertia * ratio * ratio,
          .viscous = friction.viscous * ratio * ratio,
          .coulomb = friction.coulomb * ratio,
          .breakaway = friction.breakaway.value_or(friction.coulomb) * ratio,
          .stribeck_speed = friction.stribeck_speed / ratio};
}

double step_of(const Encoder& encoder, double turns, double otherwise) {
  constexpr double turn = 6.283185307179586476925;
  if (encoder.resolution) return *encoder.resolution / turns;
  if (encoder.counts_per_turn) return turn / *encoder.counts_per_turn / turns;
  return otherwise;
}

void set_contact(const Contact& contact, PlainDrive& plain) {
  if (const auto* rigid = std::get_if<RigidContact>(&contact)) {
    plain.restitution = rigid->restitution;
    return;
  }
  const auto& faces = std::get<CompliantContact>(contact);
  plain.contact = faces.law == ContactDamping::full ? PlainContact::spring_damping_full
                                                    : PlainContact::spring_damping_limited;
  plain.stiffness = faces.stiffness;
  plain.damping = faces.damping;
}

void set_sensor(const Sensor& sensor, double ratio, PlainDrive& plain) {
  plain.reads_load = sensor.position != SensorPlace::motor;
  const ShaftName usual = sensor.position == SensorPlace::load ? ShaftName::load : ShaftName::motor;
  plain.speed_of_load = sensor.speed.value_or(usual) == ShaftName::load;
  plain.step = step_of(sensor.encoder, plain.reads_load ? 1.0 : ratio, 0.0);
  plain.speed_step = step_of(sensor.speed_encoder, plain.speed_of_load ? 1.0 : ratio,
                             plain.reads_load == plain.speed_of_load ? plain.step : 0.0);
}

void set_controller(const Controller& controller, double ratio, PlainDrive& plain) {
  // Torque and, for gains of the motor's shaft, the angle are those of the faster shaft.
  const double scale = controller.shaft == GainShaft::load    ? 1.0
                       : controller.shaft == GainShaft::mixed ? ratio
                                                              : ratio * ratio;
  PlainController& plainly = plain.controller;
  refuse(controller.firmware.has_value(), "the simulator knows no firmware's registers");
  if (const auto* cascade = std::get_if<CascadeController>(&controller.law)) {
    refuse(cascade->filter != 0.0, "the simulator knows cascades without a filter only");
    plainly.is_cascade = true;
    plainly.position = cascade->position;
    plainly.proportional = scale * cascade->speed;
    plainly.integral = scale * cascade->speed_integral;
    plainly.tracking_time = cascade->tracking_time;
    return;
  }
  const auto* pid = std::get_if<PID>(&controller.law);
  refuse(pid == nullptr, "the simulator knows PID controllers and cascades only");
  plainly.proportional = scale * pid->proportional;
  if (pid->terms == PIDTerms::PI || pid->terms == PIDTerms::PID) {
    plainly.integral = scale * pid->integral;
    plainly.tracking_time = pid->tracking_time;
  }
  if (pid->terms == PIDTerms::PD || pid->terms == PIDTerms::PID) {
    plainly.derivative = scale * pid->derivative;
    plainly.filter = pid->filter;
    plainly.derivative_of_speed = pid->derivative_of_speed;
  }
}

void set_sampling(const Sampling& sampling, PlainDrive& plain) {
  plain.period = sampling.period;
  plain.delay = sampling.delay;
  refuse(plain.delay > plain.period * (1.0 + 1e-12),
         "the simulator knows delays of one period at most");
  plain.delay = std::min(plain.delay, plain.period);
  plain.has_tachometer = !sampling.speed_by_differences;
  plain.blend = sampling.method == Discretization::tustin     ? 0.5
                : sampling.method == Discretization::backward ? 1.0
                                                              : 0.0;
}

double constant_of(const std::optional<Signal>& signal) {
  if (!signal) return 0.0;
  const auto* constant = std::get_if<double>(&*signal);
  refuse(constant == nullptr, "the simulator knows constant signals only");
  return *constant;
}

}  // namespace

double PlainDrive::small_length() const {
  double length = backlash;
  if (step > 0.0) length = std::min(length, step);
  if (speed_step > 0.0 && !has_tachometer) length = std::min(length, speed_step);
  return length;
}

PlainDrive plain_drive(const Drive& drive) {
  refuse(drive.servo.has_value(), "the simulator takes no normal form");
  refuse(!std::holds_alternative<TorqueControl>(drive.motor.kind),
         "the simulator knows torque-controlled motors only");
  refuse(
      drive.controller.dead_band != DeadBand{} || drive.controller.compensation != Compensation{},
      "the simulator knows no dead bands and compensations");
  const double ratio = drive.gearbox.ratio;
  PlainDrive plain;
  plain.motor = shaft_of(drive.motor.inertia, drive.motor.friction, ratio);
  plain.load = shaft_of(drive.load.inertia, drive.load.friction, 1.0);
  plain.backlash = drive.gearbox.backlash;
  set_contact(drive.contact, plain);
  set_sensor(drive.sensor, ratio, plain);
  set_controller(drive.controller, ratio, plain);
  if (drive.motor.limit) plain.limit = *drive.motor.limit * ratio;
  if (drive.sampling) set_sampling(*drive.sampling, plain);
  refuse(!drive.sampling && (plain.step > 0.0 || plain.speed_step > 0.0),
         "the simulator knows continuous controllers only without an encoder");
  if (!drive.sampling) plain.has_tachometer = true;
  plain.reference = constant_of(drive.reference);
  plain.load_torque = constant_of(drive.load_torque);
  // The weight, linearised about the reference.
  const double angle = drive.load.gravity_angle + plain.reference;
  plain.load_torque -= drive.load.gravity * std::cos(angle);
  plain.gravity_stiffness = -drive.load.gravity * std::sin(angle);
  return plain;
}

}  // namespace gearlash::oracle
