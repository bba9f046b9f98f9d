// The limits of the motor's torque and current.
#include <cmath>

#include "general/assemble/automata.hpp"

namespace gearlash::drive {

void add_torque_limit(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built) {
  const double limit = forms.drive().torque_limit;
  if (!std::isfinite(limit)) return;
  const hybrid::AffineForm asked = forms.asked_torque(mode);
  const auto to = [&](TorqueState torque) {
    DriveMode target = mode;
    target.torque = torque;
    return forms.modes().index_of(target);
  };
  if (mode.torque == TorqueState::linear) {
    built.transitions.push_back(transition("torque reaches its highest", asked - limit,
                                           hybrid::Direction::rising, to(TorqueState::highest)));
    built.transitions.push_back(transition("torque reaches its lowest", asked + limit,
                                           hybrid::Direction::falling, to(TorqueState::lowest)));
    return;
  }
  const double way = mode.torque == TorqueState::highest ? 1.0 : -1.0;
  built.transitions.push_back(transition("torque leaves its limit", asked - way * limit,
                                         falling_on(way), to(TorqueState::linear)));
}

void add_current_limit(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built) {
  const double limit = forms.drive().winding.torque_limit;
  if (!std::isfinite(limit)) return;
  const auto to = [&](TorqueState current) {
    DriveMode target = mode;
    target.current = current;
    return forms.modes().index_of(target);
  };
  const hybrid::AffineForm driving = forms.driving_torque(mode);
  const bool lags = forms.at().winding != StateIndices::none;
  if (mode.current == TorqueState::linear) {
    const hybrid::AffineForm torque = lags ? forms.number(forms.at().winding) : driving;
    built.transitions.push_back(transition("current reaches its highest", torque - limit,
                                           hybrid::Direction::rising, to(TorqueState::highest)));
    built.transitions.push_back(transition("current reaches its lowest", torque + limit,
                                           hybrid::Direction::falling, to(TorqueState::lowest)));
    return;
  }
  const double way = mode.current == TorqueState::highest ? 1.0 : -1.0;
  built.transitions.push_back(transition("current leaves its limit", driving - way * limit,
                                         falling_on(way), to(TorqueState::linear)));
}

}  // namespace gearlash::drive
