// The limit of the motor's torque.
#include <cmath>

#include "general/assemble/automata.hpp"

namespace gearlash::drive {

void add_torque_limit(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built) {
  const double limit = forms.drive().torque_limit;
  if (!std::isfinite(limit)) return;
  const hybrid::AffineForm asked = forms.asked_torque();
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

}  // namespace gearlash::drive
