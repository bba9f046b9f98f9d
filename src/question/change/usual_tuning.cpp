#include <array>

#include "gearlash/tune.hpp"
#include "model/reduced_drive.hpp"
#include "question/axis.hpp"

namespace gearlash {

std::vector<std::string> usual_gains(const Drive& drive) {
  constexpr std::array gains = {"controller.proportional", "controller.integral",
                                "controller.derivative",   "controller.position",
                                "controller.speed",        "controller.speed_integral",
                                "controller.gain"};
  std::vector<std::string> usual;
  for (const char* gain : gains) {
    const Axis axis{.path = gain};
    if (parameter_of(axis, drive) == nullptr) continue;
    if (present_value(axis, drive).value_or(0.0) > 0.0) usual.emplace_back(gain);
  }
  return usual;
}

Axis usual_axis_to_tune(const Drive& drive, std::string_view parameter) {
  Axis axis = usual_axis(drive, parameter);
  if (axis.values.size() > 2 && axis.values.front() == 0.0) axis.values.erase(axis.values.begin());
  if (!axis.values.empty()) axis.logarithmic = axis.values.front() > 0.0;
  return axis;
}

Target usual_target(const Drive& drive) {
  Target target{.no_runaway = true};
  const drive::ReducedDrive reduced = reduce(drive);
  const double step = reduced.sensing.resolution;
  if (step == 0.0) {
    target.no_hunting = true;
    return target;
  }
  const bool is_of_motor = reduced.sensing.load_share_of_position < 0.5;
  target.require(is_of_motor ? Quantity::motor_amplitude : Quantity::amplitude, {0.0, step});
  return target;
}

}  // namespace gearlash
