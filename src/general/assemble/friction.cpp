// Dry friction of a shaft that moves independently of the other.
#include "general/assemble/automata.hpp"

namespace gearlash::drive {

namespace {

/// The target with one shaft's friction in another state.
std::size_t with_friction(const DriveForms& forms, const DriveMode& mode, Side side,
                          FrictionState next) {
  DriveMode target = mode;
  (side == Side::motor ? target.motor : target.load) = next;
  return forms.modes().index_of(target);
}

}  // namespace

void add_falling_friction(const DriveForms& forms, const DriveMode& mode, Side side,
                          hybrid::AffineMode& built) {
  const bool is_motor = side == Side::motor;
  const Shaft& shaft = forms.shaft(side);
  const FrictionState state = is_motor ? mode.motor : mode.load;
  const double way = way_of(state);
  if (way == 0.0 || !shaft.friction.falls()) return;
  const FrictionState slow = moving(shaft, way);
  const FrictionState fast = moving_fast(way);
  const bool is_slow = state == slow;
  const hybrid::AffineForm excess =
      forms.number(speed_of(side)) - way * shaft.friction.stribeck_speed;
  const char* name =
      is_slow ? (is_motor ? "motor exceeds its Stribeck speed" : "load exceeds its Stribeck speed")
              : (is_motor ? "motor falls below its Stribeck speed"
                          : "load falls below its Stribeck speed");
  built.transitions.push_back(transition(name, excess, is_slow ? rising_on(way) : falling_on(way),
                                         with_friction(forms, mode, side, is_slow ? fast : slow)));
}

void add_friction(const DriveForms& forms, const DriveMode& mode, Side side,
                  hybrid::AffineMode& built) {
  const bool is_motor = side == Side::motor;
  const FrictionState state = is_motor ? mode.motor : mode.load;
  if (state == FrictionState::viscous) return;
  const auto to = [&](double way) {
    return with_friction(forms, mode, side, moving(forms.shaft(side), way));
  };
  const hybrid::AffineForm applied = forms.applied_torque(mode, side);
  const double breakaway = forms.shaft(side).friction.breakaway;
  if (state == FrictionState::sticking) {
    built.transitions.push_back(
        transition(is_motor ? "motor breaks away forward" : "load breaks away forward",
                   applied - breakaway, hybrid::Direction::rising, to(1.0)));
    built.transitions.push_back(
        transition(is_motor ? "motor breaks away backward" : "load breaks away backward",
                   applied + breakaway, hybrid::Direction::falling, to(-1.0)));
    return;
  }
  const double way = way_of(state);
  const Eigen::Index speed = speed_of(side);
  hybrid::Transition stops = transition(is_motor ? "motor stops" : "load stops",
                                        forms.number(speed), falling_on(way), to(0.0));
  stops.reset = stopped(forms, {speed});
  stops.alternatives = {{{-way * applied - breakaway}, to(-way)}};
  built.transitions.push_back(std::move(stops));
  add_falling_friction(forms, mode, side, built);
}

}  // namespace gearlash::drive
