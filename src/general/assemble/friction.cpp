// Dry friction of a shaft that moves independently of the other.
#include "general/assemble/automata.hpp"

namespace gearlash::drive {

void add_friction(const DriveForms& forms, const DriveMode& mode, Side side,
                  hybrid::AffineMode& built) {
  const bool is_motor = side == Side::motor;
  const FrictionState state = is_motor ? mode.motor : mode.load;
  if (state == FrictionState::viscous) return;
  const auto to = [&](FrictionState next) {
    DriveMode target = mode;
    (is_motor ? target.motor : target.load) = next;
    return forms.modes().index_of(target);
  };
  const hybrid::AffineForm applied = forms.applied_torque(mode, side);
  const double breakaway = forms.shaft(side).friction.breakaway;
  if (state == FrictionState::sticking) {
    built.transitions.push_back(
        transition(is_motor ? "motor breaks away forward" : "load breaks away forward",
                   applied - breakaway, hybrid::Direction::rising, to(FrictionState::forward)));
    built.transitions.push_back(
        transition(is_motor ? "motor breaks away backward" : "load breaks away backward",
                   applied + breakaway, hybrid::Direction::falling, to(FrictionState::backward)));
    return;
  }
  const double way = way_of(state);
  const Eigen::Index speed = speed_of(side);
  hybrid::Transition stops =
      transition(is_motor ? "motor stops" : "load stops", forms.number(speed), falling_on(way),
                 to(FrictionState::sticking));
  stops.reset = stopped(forms, {speed});
  const FrictionState back = way > 0.0 ? FrictionState::backward : FrictionState::forward;
  stops.alternatives = {{{-way * applied - breakaway}, to(back)}};
  built.transitions.push_back(std::move(stops));
}

}  // namespace gearlash::drive
