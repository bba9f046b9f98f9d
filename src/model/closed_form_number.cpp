#include "model/closed_form_number.hpp"

#include <cmath>

#include "gearlash/parameter.hpp"
#include "model/parameters.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {

bool enters_closed_form(const Drive& drive, std::string_view path) {
  const Parameter* parameter = find_parameter(path, drive);
  if (parameter == nullptr && drive.servo) return enters_closed_form(physical_form(drive), path);
  if (parameter == nullptr || !exists(*parameter, drive)) return false;
  // A factor of 0 would hide what it multiplies.
  Drive present = drive;
  if (present.servo && present.servo->damping == 0.0) present.servo->damping = 1.0;
  if (present.gearbox.ratio == 0.0) present.gearbox.ratio = 1.0;
  Drive changed = present;
  const Slot slot = parameter->slot(changed);
  double* place = std::get_if<double*>(&slot) ? std::get<double*>(slot) : nullptr;
  if (auto* const* given = std::get_if<std::optional<double>*>(&slot); given && **given) {
    place = &***given;
  }
  if (place == nullptr || (*place == 0.0 && parameter->path == "gearbox.inertia")) return false;
  *place = *place == 0.0 || std::isinf(*place) ? 0.5 : 0.75 * *place;
  const auto after = drive::proportional_drivetrain(reduce(changed));
  return after && *after != drive::proportional_drivetrain(reduce(present));
}

}  // namespace gearlash
