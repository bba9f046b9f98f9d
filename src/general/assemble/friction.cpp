// Dry friction of a shaft that moves independently of the other.
#include "general/assemble/automata.hpp"

namespace gearlash::drive {

void add_falling_friction(const DriveForms& forms, const DriveMode& mode, Side side,
                          hybrid::AffineMode& built) {
  const Shaft& shaft = forms.shaft(side);
  const FrictionState state = mode.*friction_of(side);
  const double way = way_of(state);
  if (way == 0.0 || !shaft.friction.falls()) return;
  const FrictionState slow = moving(shaft, way);
  const FrictionState fast = moving_fast(way);
  const bool is_slow = state == slow;
  const hybrid::AffineForm excess =
      forms.number(speed_of(side)) - way * shaft.friction.stribeck_speed;
  const DriveMode target = with(mode, friction_of(side), is_slow ? fast : slow);
  built.transitions.push_back(transition(
      name_of(side) + (is_slow ? " exceeds its Stribeck speed" : " falls below its Stribeck speed"),
      excess, is_slow ? rising_on(way) : falling_on(way), forms.modes().index_of(target)));
}

void add_friction(const DriveForms& forms, const DriveMode& mode, Side side,
                  hybrid::AffineMode& built) {
  const FrictionState state = mode.*friction_of(side);
  if (state == FrictionState::viscous) return;
  const auto to = [&](double way) {
    return forms.modes().index_of(with(mode, friction_of(side), moving(forms.shaft(side), way)));
  };
  const hybrid::AffineForm applied = forms.applied_torque(mode, side);
  const double breakaway = forms.shaft(side).friction.breakaway;
  if (state == FrictionState::sticking) {
    for (const double way : {1.0, -1.0}) {
      built.transitions.push_back(
          transition(name_of(side) + (way > 0.0 ? " breaks away forward" : " breaks away backward"),
                     applied - way * breakaway, rising_on(way), to(way)));
    }
    return;
  }
  const double way = way_of(state);
  const Eigen::Index speed = speed_of(side);
  hybrid::Transition stops =
      transition(name_of(side) + " stops", forms.number(speed), falling_on(way), to(0.0));
  stops.reset = stopped(forms, {speed});
  stops.alternatives = {{{-way * applied - breakaway}, to(-way)}};
  built.transitions.push_back(std::move(stops));
  add_falling_friction(forms, mode, side, built);
}

}  // namespace gearlash::drive
