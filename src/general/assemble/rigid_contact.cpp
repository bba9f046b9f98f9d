// Rigid faces: impacts, common motion, and parting.
#include <utility>

#include "base/lists.hpp"
#include "general/assemble/automata.hpp"

namespace gearlash::drive {
namespace {

using hybrid::AffineForm;
using hybrid::AffineReset;

DriveMode moving_as_one(const DriveForms& forms, const DriveMode& mode, double way) {
  DriveMode result = mode;
  result.motor = moving(forms.shaft(Side::motor), way);
  result.load = moving(forms.shaft(Side::load), way);
  return result;
}

/// Momentum is kept. The relative speed is multiplied by −e.
AffineReset impact(const DriveForms& forms, double restitution) {
  const double sum = forms.drive().motor.inertia + forms.drive().load.inertia;
  const double motor = forms.drive().motor.inertia / sum;
  const double load = forms.drive().load.inertia / sum;
  AffineReset reset;
  reset.matrix = forms.identity();
  reset.matrix(motor_speed, motor_speed) = motor - restitution * load;
  reset.matrix(motor_speed, load_speed) = load * (1.0 + restitution);
  reset.matrix(load_speed, motor_speed) = motor * (1.0 + restitution);
  reset.matrix(load_speed, load_speed) = load - restitution * motor;
  return reset;
}

/// How a shaft may move after an impact: the state of its friction, and its conditions.
struct Going {
  FrictionState state;
  std::vector<AffineForm> conditions;
};

/// Faster ways first, rest last.
std::vector<Going> goings(const DriveForms& forms, Side side) {
  const Shaft& shaft = forms.shaft(side);
  if (!shaft.friction.is_dry()) return {{FrictionState::viscous, {}}};
  std::vector<Going> all;
  const AffineForm speed = forms.number(speed_of(side));
  for (const double way : {1.0, -1.0}) {
    if (!shaft.friction.falls()) break;
    all.push_back({moving_fast(way), {way * speed - shaft.friction.stribeck_speed}});
  }
  for (const double way : {1.0, -1.0}) all.push_back({moving(shaft, way), {way * speed}});
  all.push_back({FrictionState::sticking, {}});
  return all;
}

/// The modes after an impact, by the speeds of dry shafts.
std::vector<hybrid::Alternative> ways_after(const DriveForms& forms, const DriveMode& target) {
  std::vector<hybrid::Alternative> alternatives;
  for (const Going& motor : goings(forms, Side::motor)) {
    for (const Going& load : goings(forms, Side::load)) {
      DriveMode mode = target;
      mode.motor = motor.state;
      mode.load = load.state;
      if (!forms.modes().has(mode)) continue;
      hybrid::Alternative alternative{motor.conditions, forms.modes().index_of(mode)};
      add_all(alternative.positive, load.conditions);
      alternatives.push_back(std::move(alternative));
    }
  }
  sort_by(alternatives, [](const auto& one) { return -std::ssize(one.positive); });
  return alternatives;
}

void add_impact(const DriveForms& forms, const DriveMode& mode, double face,
                hybrid::AffineMode& built) {
  const double restitution = std::get<RigidContact>(forms.drive().contact).restitution;
  const DriveMode engaged =
      with(mode, &DriveMode::contact, face > 0.0 ? ContactState::forward : ContactState::backward);
  const bool plastic = restitution == 0.0;
  hybrid::Transition meets =
      transition(face > 0.0 ? "impact forward" : "impact backward",
                 forms.gap() - 0.5 * face * forms.drive().backlash, rising_on(face), 0);
  meets.reset = impact(forms, restitution);
  // The last alternative, with all dry shafts at rest, has no conditions: it is the default target.
  meets.alternatives = ways_after(forms, plastic ? engaged : mode);
  meets.target = meets.alternatives.back().target;
  meets.alternatives.pop_back();
  if (!plastic) {
    hybrid::Settling settling;
    settling.reset = impact(forms, 0.0);
    settling.alternatives = ways_after(forms, engaged);
    settling.target = settling.alternatives.back().target;
    settling.alternatives.pop_back();
    meets.settling = std::move(settling);
  }
  built.transitions.push_back(std::move(meets));
}

/// The state where engaged faces part: equal speeds, and the gap exactly closed on this face.
AffineReset parting(const DriveForms& forms, double face) {
  AffineReset reset;
  reset.matrix = forms.identity();
  reset.matrix.row(motor_position) = forms.unit(load_position).transpose();
  reset.matrix.row(motor_speed) = forms.unit(load_speed).transpose();
  reset.offset = hybrid::Vector::Zero(forms.at().size);
  reset.offset[motor_position] = 0.5 * face * forms.drive().backlash;
  return reset;
}

/// From rest with the faces together. Both shafts move if the torque exceeds both breakaway
/// torques. One moves alone, away from the other, if it exceeds its own.
void add_engaged_breakaway(const DriveForms& forms, const DriveMode& mode,
                           hybrid::AffineMode& built) {
  const AffineForm motor_torque = forms.motor_torque(mode);
  const AffineForm applied = motor_torque + forms.torque_on_load();
  for (const double way : {1.0, -1.0}) {
    built.transitions.push_back(
        transition(way > 0.0 ? "both break away forward" : "both break away backward",
                   applied - way * forms.both_breakaway(), rising_on(way),
                   forms.modes().index_of(moving_as_one(forms, mode, way))));
  }
  const double face = face_of(mode.contact);
  const auto add_alone = [&](Side side, double away) {
    DriveMode alone = with(mode, &DriveMode::contact, ContactState::apart);
    alone.*friction_of(side) = moving(forms.shaft(side), away);
    const AffineForm torque = side == Side::motor ? motor_torque : forms.torque_on_load();
    hybrid::Transition breaks = transition(name_of(side) + " breaks away alone",
                                           torque - away * forms.shaft(side).friction.breakaway,
                                           rising_on(away), forms.modes().index_of(alone));
    breaks.reset = parting(forms, face);
    built.transitions.push_back(std::move(breaks));
  };
  add_alone(Side::motor, -face);
  add_alone(Side::load, face);
}

}  // namespace

void add_impacts(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built) {
  add_impact(forms, mode, 1.0, built);
  add_impact(forms, mode, -1.0, built);
}

void add_engaged(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built) {
  if (forms.stands(mode, Side::motor)) {
    add_engaged_breakaway(forms, mode, built);
    return;
  }
  const double face = face_of(mode.contact);
  const DriveMode apart = with(mode, &DriveMode::contact, ContactState::apart);
  hybrid::Transition parts = transition("faces part", forms.mesh_torque(mode), falling_on(face),
                                        forms.modes().index_of(apart));
  parts.reset = parting(forms, face);
  built.transitions.push_back(std::move(parts));
  const double way = way_of(mode.motor) != 0.0 ? way_of(mode.motor) : way_of(mode.load);
  if (way == 0.0) return;
  hybrid::Transition stops = transition("both stop", forms.number(load_speed), falling_on(way),
                                        forms.modes().index_of(moving_as_one(forms, mode, 0.0)));
  stops.reset = stopped(forms, {motor_speed, load_speed});
  const AffineForm applied = forms.motor_torque(mode) + forms.torque_on_load();
  stops.alternatives = {{{-way * applied - forms.both_breakaway()},
                         forms.modes().index_of(moving_as_one(forms, mode, -way))}};
  built.transitions.push_back(std::move(stops));
  add_falling_friction(forms, mode, Side::motor, built);
  add_falling_friction(forms, mode, Side::load, built);
}

}  // namespace gearlash::drive
