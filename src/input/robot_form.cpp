#include "input/robot_form.hpp"

#include "base/lists.hpp"
#include "input/parameter_text.hpp"

namespace gearlash {

bool is_of_robots(std::string_view section) { return section == "joint" || section == "actuator"; }

bool has_robots_form(const Parameter& parameter) {
  return any_of(paths_of(parameter),
                [](std::string_view path) { return is_of_robots(section_of(path)); });
}

bool is_required_of_robots(const Parameter& parameter, std::string_view section) {
  if (has_robots_form(parameter)) {
    return is_of_robots(section) &&
           (parameter.path == "motor.inertia" || parameter.path == "gearbox.backlash" ||
            parameter.path == "controller.proportional");
  }
  return parameter.is_required && parameter.choices.empty() && parameter.path != "gearbox.ratio" &&
         parameter.path != "load.friction";
}

Drive robots_joint(bool has_derivative, bool is_sampled) {
  Drive drive;
  drive.sensor.is_assumed = true;
  drive.controller.shaft = GainShaft::load;
  drive.controller.law = PID{.terms = has_derivative ? PIDTerms::PD : PIDTerms::P};
  if (is_sampled) drive.sampling = Sampling{.speed_by_differences = false};
  return drive;
}

}  // namespace gearlash
