#include "mechanism.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gearlash::oracle {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

int way_of(double speed) { return speed > 0.0 ? 1 : speed < 0.0 ? -1 : 0; }

int way_of_break(double torque, double breakaway) {
  if (torque > breakaway) return 1;
  return torque < -breakaway ? -1 : 0;
}

double friction(const PlainShaft& shaft, double speed, int way) {
  double dry = shaft.coulomb;
  if (shaft.stribeck_speed > 0.0 && way * speed < shaft.stribeck_speed) {
    const double share = 1.0 - std::max(0.0, way * speed) / shaft.stribeck_speed;
    dry += share * (shaft.breakaway - shaft.coulomb);
  }
  return shaft.viscous * speed + dry * way;
}

/// Until a shaft that moves in `way` stands.
double time_to_stop(double speed, int way, double rate) {
  if (way == 0 || rate * way >= 0.0) return never;
  return std::max(0.0, -speed / rate);
}

}  // namespace

Mechanism::Mechanism(const PlainDrive& drive, const ShaftReadings& start)
    : drive_(drive),
      is_rigid_(drive.contact == PlainContact::rigid),
      now_(start),
      motor_way_(way_of(start.motor_speed)),
      load_way_(way_of(start.load_speed)) {
  const double gap = start.motor_position - start.load_position;
  const double rounding = 1e-15 * (std::abs(start.motor_position) + std::abs(start.load_position));
  const bool is_closed = std::abs(gap) >= 0.5 * drive.backlash - rounding;
  if (is_rigid_ && is_closed && start.motor_speed == start.load_speed)
    engage(gap > 0.0 ? 1.0 : -1.0);
  forget_extremes();
}

void Mechanism::forget_extremes() {
  lowest_load_ = highest_load_ = now_.load_position;
  lowest_motor_ = highest_motor_ = now_.motor_position;
}

void Mechanism::note_extremes() {
  lowest_load_ = std::min(lowest_load_, now_.load_position);
  highest_load_ = std::max(highest_load_, now_.load_position);
  lowest_motor_ = std::min(lowest_motor_, now_.motor_position);
  highest_motor_ = std::max(highest_motor_, now_.motor_position);
}

double Mechanism::motor_torque(const ShaftReadings& at, const AppliedTorque& torque) const {
  const double position = drive_.reads_load ? at.load_position : at.motor_position;
  const double speed = drive_.speed_of_load ? at.load_speed : at.motor_speed;
  const double asked =
      torque.held - torque.stiffness * (position - drive_.reference) - torque.damping * speed;
  return std::clamp(asked, -drive_.limit, drive_.limit);
}

double Mechanism::load_torque(const ShaftReadings& at) const {
  return drive_.load_torque - drive_.gravity_stiffness * (at.load_position - drive_.reference);
}

/// Of compliant faces on the load.
double Mechanism::mesh_torque(const ShaftReadings& at) const {
  if (is_rigid_) return 0.0;
  const double gap = at.motor_position - at.load_position;
  if (drive_.backlash == 0.0)
    return drive_.stiffness * gap + drive_.damping * (at.motor_speed - at.load_speed);
  const double face = gap > 0.0 ? 1.0 : -1.0;
  const double compression = face * gap - 0.5 * drive_.backlash;
  if (compression <= 0.0) return 0.0;
  const double spring = drive_.stiffness * compression;
  double damper = drive_.damping * face * (at.motor_speed - at.load_speed);
  if (drive_.contact == PlainContact::spring_damping_limited) damper = std::min(damper, spring);
  return face * std::max(0.0, spring + damper);
}

Mechanism::Accelerations Mechanism::accelerations(const ShaftReadings& at,
                                                  const AppliedTorque& torque) const {
  const double drive_torque = motor_torque(at, torque);
  const double motor_friction = friction(drive_.motor, at.motor_speed, motor_way_);
  const double load_friction = friction(drive_.load, at.load_speed, load_way_);
  if (face_ != 0) {
    if (load_way_ == 0) return {};
    const double both = (drive_torque + load_torque(at) - motor_friction - load_friction) /
                        (drive_.motor.inertia + drive_.load.inertia);
    return {both, both};
  }
  const double mesh = mesh_torque(at);
  Accelerations rate;
  if (motor_way_ != 0) rate.motor = (drive_torque - mesh - motor_friction) / drive_.motor.inertia;
  if (load_way_ != 0) {
    rate.load = (mesh + load_torque(at) - load_friction) / drive_.load.inertia;
  }
  return rate;
}

/// Both first: a load that its own torque moves away is still pushed by a motor that follows.
void Mechanism::break_away_together(double torque) {
  const double of_load = load_torque(now_);
  const int both = way_of_break(torque + of_load, drive_.motor.breakaway + drive_.load.breakaway);
  if (both != 0) {
    motor_way_ = load_way_ = both;
  } else if (-torque * face_ > drive_.motor.breakaway) {  // the motor leaves the load
    motor_way_ = -face_;
    face_ = 0;
  } else if (of_load * face_ > drive_.load.breakaway) {  // the load leaves the motor
    load_way_ = face_;
    face_ = 0;
  }
}

void Mechanism::break_away(const AppliedTorque& torque) {
  if (motor_way_ != 0 && load_way_ != 0) return;
  const double drive_torque = motor_torque(now_, torque);
  if (face_ != 0) break_away_together(drive_torque);
  if (face_ != 0) return;
  const double mesh = mesh_torque(now_);
  if (motor_way_ == 0) motor_way_ = way_of_break(drive_torque - mesh, drive_.motor.breakaway);
  if (load_way_ == 0) {
    load_way_ = way_of_break(mesh + load_torque(now_), drive_.load.breakaway);
  }
}

/// Rigid faces that would have to pull.
void Mechanism::part(const AppliedTorque& torque) {
  if (face_ == 0 || load_way_ == 0) return;
  const double mesh = drive_.load.inertia * accelerations(now_, torque).load +
                      friction(drive_.load, now_.load_speed, load_way_) - load_torque(now_);
  if (mesh * face_ < 0.0) face_ = 0;
}

/// Until the motor reaches the face, with constant accelerations.
double Mechanism::time_to_face(double face, const Accelerations& rate) const {
  const double gap = now_.motor_position - now_.load_position;
  const double distance = 0.5 * drive_.backlash - face * gap;
  const double speed = face * (now_.motor_speed - now_.load_speed);
  const double growth = face * (rate.motor - rate.load);
  const double rounding =
      4e-16 * (std::abs(now_.motor_position) + std::abs(now_.load_position) + drive_.backlash);
  if (distance <= rounding) {
    if (speed > 0.0 || (speed == 0.0 && growth > 0.0)) return 0.0;
    return growth > 0.0 ? -2.0 * speed / growth : never;
  }
  const double square = speed * speed + 2.0 * growth * distance;
  if (square < 0.0) return never;
  const double root = std::sqrt(square);
  const double time = speed >= 0.0   ? 2.0 * distance / (speed + root)
                      : growth > 0.0 ? (root - speed) / growth
                                     : never;
  return time >= 0.0 ? time : never;
}

void Mechanism::move(double time, const Accelerations& rate) {
  now_.motor_position += time * (now_.motor_speed + 0.5 * time * rate.motor);
  now_.motor_speed += time * rate.motor;
  now_.load_position += time * (now_.load_speed + 0.5 * time * rate.load);
  now_.load_speed += time * rate.load;
  if (face_ != 0) now_.motor_position = now_.load_position + 0.5 * face_ * drive_.backlash;
}

void Mechanism::engage(double face) {
  const double sum = drive_.motor.inertia + drive_.load.inertia;
  const double speed =
      (drive_.motor.inertia * now_.motor_speed + drive_.load.inertia * now_.load_speed) / sum;
  face_ = face > 0.0 ? 1 : -1;
  now_.motor_speed = now_.load_speed = speed;
  now_.motor_position = now_.load_position + 0.5 * face_ * drive_.backlash;
  motor_way_ = load_way_ = way_of(speed);
}

void Mechanism::meet(double face, double step, const AppliedTorque& torque) {
  const double closing = now_.motor_speed - now_.load_speed;
  if (drive_.restitution == 0.0 || closing == 0.0) return engage(face);
  const double sum = drive_.motor.inertia + drive_.load.inertia;
  const double change = (1.0 + drive_.restitution) * closing;
  now_.motor_speed -= change * drive_.load.inertia / sum;
  now_.load_speed += change * drive_.motor.inertia / sum;
  now_.motor_position = now_.load_position + 0.5 * face * drive_.backlash;
  motor_way_ = way_of(now_.motor_speed);
  load_way_ = way_of(now_.load_speed);
  const Accelerations rate = accelerations(now_, torque);
  const double pressing = face * (rate.motor - rate.load);
  const double flight = 2.0 * drive_.restitution * std::abs(closing) / pressing;
  if (pressing > 0.0 && flight < 0.01 * step) engage(face);
}

/// Up to the first cut, or the whole of what remains. Returns the time taken.
double Mechanism::cut_step(double remaining, double step, const AppliedTorque& torque) {
  break_away(torque);
  part(torque);
  const Accelerations first = accelerations(now_, torque);
  ShaftReadings middle = now_;
  const double half = 0.5 * remaining;
  middle.motor_position += half * now_.motor_speed;
  middle.load_position += half * now_.load_speed;
  middle.motor_speed += half * first.motor;
  middle.load_speed += half * first.load;
  const Accelerations rate = accelerations(middle, torque);
  Cut cut = Cut::none;
  double time = remaining;
  const auto consider = [&](Cut one, double when) {
    if (when < time || (when == time && when == 0.0 && cut == Cut::none)) {
      time = when;
      cut = one;
    }
  };
  consider(Cut::load_stops, time_to_stop(now_.load_speed, load_way_, rate.load));
  if (face_ == 0) {
    consider(Cut::motor_stops, time_to_stop(now_.motor_speed, motor_way_, rate.motor));
    if (is_rigid_) {
      consider(Cut::meets_forward, time_to_face(1.0, rate));
      consider(Cut::meets_backward, time_to_face(-1.0, rate));
    }
  }
  move(time, rate);
  if (cut == Cut::motor_stops || (cut == Cut::load_stops && face_ != 0)) {
    now_.motor_speed = 0.0;
    motor_way_ = 0;
  }
  if (cut == Cut::load_stops) {
    now_.load_speed = 0.0;
    load_way_ = 0;
  }
  if (cut == Cut::meets_forward) meet(1.0, step, torque);
  if (cut == Cut::meets_backward) meet(-1.0, step, torque);
  note_extremes();
  return time;
}

void Mechanism::advance(double step, const AppliedTorque& torque) {
  if (drive_.current_rate == 0.0) return advance_shafts(step, torque);
  const double tended = std::clamp(torque.held, -drive_.limit, drive_.limit);
  const double off = current_ - tended;
  const double steps = drive_.current_rate * step;
  current_ = tended + off * std::exp(-steps);
  advance_shafts(step, {.held = tended - off * std::expm1(-steps) / steps});
}

void Mechanism::advance_shafts(double step, const AppliedTorque& torque) {
  if (motor_way_ == 0 && load_way_ == 0) {
    break_away(torque);
    if (motor_way_ == 0 && load_way_ == 0) return;  // nothing changes as long as the torque holds
  }
  double remaining = step;
  // A chain of bounces is over after some dozens of cuts. More of them would be events at one point
  // of time that take turns; the rest of the step is then left out.
  constexpr int most_cuts = 400;
  for (int cuts = 0; remaining > 0.0 && cuts < most_cuts; ++cuts) {
    remaining -= cut_step(remaining, step, torque);
    if (remaining < 1e-12 * step) return;
  }
  left_out_ += remaining;
}

}  // namespace gearlash::oracle
