// The limits of the motor's torque and current.
#include <cmath>

#include "general/assemble/automata.hpp"

namespace gearlash::drive {

void add_torque_limit(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built) {
  const double limit = forms.drive().torque_limit;
  if (!std::isfinite(limit)) return;
  const hybrid::AffineForm asked = forms.asked_torque(mode);
  add_branches(
      forms, mode, &DriveMode::torque, {asked, limit}, {asked, limit},
      {"torque reaches its highest", "torque reaches its lowest", "torque leaves its limit"},
      built);
}

void add_current_limit(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built) {
  const double limit = forms.drive().winding.torque_limit;
  if (!std::isfinite(limit)) return;
  const hybrid::AffineForm driving = forms.driving_torque(mode);
  const bool lags = forms.at().winding != StateIndices::none;
  const hybrid::AffineForm reaching = lags ? forms.number(forms.at().winding) : driving;
  add_branches(
      forms, mode, &DriveMode::current, {reaching, limit}, {driving, limit},
      {"current reaches its highest", "current reaches its lowest", "current leaves its limit"},
      built);
}

}  // namespace gearlash::drive
