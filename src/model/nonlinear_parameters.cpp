// Parameters of relays, dead bands and compensations of a controller.
#include "model/parameter_list.hpp"

namespace gearlash::parameter_rows {
namespace {

const RelayController* relay_of(const Drive& drive) {
  return has_law(drive) ? std::get_if<RelayController>(&drive.controller.law) : nullptr;
}

/// Whether a law other than a relay has a dead band.
bool has_dead_band(const Drive& drive) {
  return has_law(drive) && relay_of(drive) == nullptr && drive.controller.dead_band.width != 0.0;
}

bool has_hysteresis(const Drive& drive) {
  const bool is_whole = drive.controller.dead_band.form == DeadBandForm::whole;
  return relay_of(drive) != nullptr || (has_dead_band(drive) && is_whole);
}

bool compensates_friction(const Drive& drive) {
  return has_law(drive) && drive.controller.compensation.friction != 0.0;
}

bool compensates_gap(const Drive& drive) {
  return has_law(drive) && drive.controller.compensation.backlash != 0.0;
}

template <CompensationInput input>
bool compensates_gap_by(const Drive& drive) {
  return compensates_gap(drive) && drive.controller.compensation.input == input;
}

constexpr DimensionRule output = unit_by_motor<torque, voltage>;
constexpr DimensionRule threshold = [](const Drive& drive) {
  const RelayController* relay = relay_of(drive);
  return relay != nullptr && relay->input == RelayInput::speed ? &angular_speed : &angle;
};

template <Condition condition, auto member>
constexpr Place in_dead_band = in_controller_if<condition, &Controller::dead_band, member>;
template <Condition condition, auto member>
constexpr Place in_compensation = in_controller_if<condition, &Controller::compensation, member>;

}  // namespace

std::vector<Parameter> nonlinear_parameters() {
  return {
      entry("controller.level", in_law<&RelayController::level>,
            "output of the relay, with either sign", output, positive, required,
            UsualRange{1e-3, 1000.0}),
      entry("controller.input", in_law<&RelayController::input>,
            "input of the relay: the error, or the measured speed with the other sign",
            Words{"error", "speed"}),
      entry("controller.dead_band", in_dead_band<has_law, &DeadBand::width>,
            "half of the band about 0 in which the error counts as 0", threshold, not_negative,
            UsualRange{1e-5, 0.1}),
      entry("controller.dead_band_form", in_dead_band<has_dead_band, &DeadBand::form>,
            "what the controller receives beyond the dead band: the excess, or the whole error",
            Words{"excess", "whole"}),
      entry("controller.hysteresis", in_dead_band<has_hysteresis, &DeadBand::hysteresis>,
            "distance from dead_band to the thresholds where the output begins, outside, "
            "and ends, inside",
            threshold, not_negative, UsualRange{1e-5, 0.1}),
      entry("controller.friction_compensation", in_compensation<has_law, &Compensation::friction>,
            "added to the output, with the sign of the reference's speed", output, not_negative,
            UsualRange{1e-3, 100.0}),
      entry("controller.friction_speed",
            in_compensation<compensates_friction, &Compensation::friction_speed>,
            "speed of the reference from which on all of it is added; below, in proportion",
            unit<angular_speed>, not_negative, UsualRange{1e-4, 10.0}),
      entry("controller.backlash_compensation", in_compensation<has_law, &Compensation::backlash>,
            "backlash that the controller assumes, at the load's shaft: half of it is "
            "added to the reference, or to the error",
            unit<angle>, not_negative, UsualRange{1e-5, 0.1}),
      entry("controller.compensation_input", in_compensation<compensates_gap, &Compensation::input>,
            "gives the sign: the last motion of the reference, or the error",
            Words{"reference", "error"}),
      entry("controller.take_up_time",
            in_compensation<compensates_gap_by<CompensationInput::reference>,
                            &Compensation::take_up_time>,
            "time constant in which the addition changes sides; 0: at once", unit<time>,
            not_negative, UsualRange{1e-3, 1.0}),
      entry("controller.take_up_angle",
            in_compensation<compensates_gap_by<CompensationInput::error>,
                            &Compensation::take_up_angle>,
            "error from which on all of the half is added; below, in proportion", unit<angle>,
            positive, required, UsualRange{1e-5, 0.1})};
}

}  // namespace gearlash::parameter_rows
