// Parameters of the reference, of the load torque and of what is asked of a drive.
#include "model/parameter_list.hpp"

namespace gearlash::parameter_rows {
namespace {

/// A path of one of the two signals, whose rows differ in path and unit only.
template <auto signal>
std::string_view path_of(std::string_view of_reference, std::string_view of_load_torque) {
  return signal == &Drive::reference ? of_reference : of_load_torque;
}

template <auto signal>
constexpr DimensionRule signal_unit = signal == &Drive::reference ? unit<angle> : unit<torque>;

/// Indices of Signal's alternatives, in the order of the words. Load torques permit some of them.
constexpr Place reference_kind =
    alternative_at<std::array{0U, 1U, 2U, 3U, 4U, 5U}, &Drive::reference>;
constexpr Place load_torque_kind = alternative_at<std::array{0U, 1U, 3U, 5U}, &Drive::load_torque>;

template <auto signal>
Slot constant_value(Drive& drive) {
  auto* constant = std::get_if<double>(content_of(&(drive.*signal)));
  return constant == nullptr ? Slot{} : Slot{constant};
}

/// Whether the points of a table are not read from a file.
template <auto signal>
bool has_points(const Drive& drive) {
  const std::string* file = follow<signal, &TableSignal::file>(&drive);
  return file != nullptr && file->empty();
}

/// Parameters of both kinds of signals.
template <auto signal>
std::vector<Parameter> shared_parameters() {
  const auto path = path_of<signal>;
  constexpr DimensionRule value_unit = signal_unit<signal>;
  return {entry(path("reference.value", "load_torque.value"), constant_value<signal>,
                "constant value", value_unit, required),
          entry(path("reference.before", "load_torque.before"), at<signal, &StepSignal::before>,
                "value before the step", value_unit),
          entry(path("reference.after", "load_torque.after"), at<signal, &StepSignal::after>,
                "value after the step", value_unit, required),
          entry(path("reference.mean", "load_torque.mean"), at<signal, &SineSignal::mean>,
                "mean of the sine", value_unit),
          entry(path("reference.amplitude", "load_torque.amplitude"),
                at<signal, &SineSignal::amplitude>, "amplitude of the sine", value_unit, required),
          entry(path("reference.frequency", "load_torque.frequency"),
                at<signal, &SineSignal::frequency>, "frequency of the sine",
                unit<angular_frequency>, positive, required),
          entry(path("reference.phase", "load_torque.phase"), at<signal, &SineSignal::phase>,
                "phase of the sine at time 0", unit<angle>),
          entry(path("reference.time", "load_torque.time"),
                first_of<at<signal, &StepSignal::time>, at<signal, &RampSignal::time>,
                         at<signal, &TrapezoidSignal::time>>,
                "start time", unit<time>),
          entry(path("reference.file", "load_torque.file"), at<signal, &TableSignal::file>,
                "CSV file of times and values, beside the drive's file", required,
                Wanted{"the name of a CSV file"}),
          entry(path("reference.times", "load_torque.times"),
                only_if<has_points<signal>, at<signal, &TableSignal::times>>,
                "times of the points in s, rising, instead of a file", required,
                Wanted{"times in s, rising"}),
          entry(path("reference.values", "load_torque.values"),
                only_if<has_points<signal>, at<signal, &TableSignal::values>>,
                "values at these times, rad or N m", required,
                Wanted{"a value for each of the times"})};
}

std::vector<Parameter> reference_kinds() {
  return {entry("reference.kind", reference_kind, "shape over time", required,
                Words{"constant", "step", "ramp", "sine", "trapezoid", "table"})};
}

std::vector<Parameter> load_torque_kinds() {
  return {entry("load_torque.kind", load_torque_kind, "shape over time", required,
                Words{"constant", "step", "sine", "table"})};
}

template <auto member>
constexpr Place in_reference = at<&Drive::reference, member>;

std::vector<Parameter> motion_parameters() {
  return {
      entry("reference.value", in_reference<&RampSignal::value>, "value before the ramp",
            unit<angle>),
      entry("reference.rate", in_reference<&RampSignal::rate>, "speed of the ramp",
            unit<angular_speed>, required),
      entry("reference.from", in_reference<&TrapezoidSignal::from>, "start of the move",
            unit<angle>),
      entry("reference.to", in_reference<&TrapezoidSignal::to>, "end of the move", unit<angle>,
            required),
      entry("reference.speed", in_reference<&TrapezoidSignal::speed>, "highest speed of the move",
            unit<angular_speed>, positive, required),
      entry("reference.acceleration", in_reference<&TrapezoidSignal::acceleration>,
            "highest acceleration of the move", unit<angular_acceleration>, positive, required)};
}

template <auto member>
constexpr Place in_specification = at<&Drive::specification, member>;

std::vector<Parameter> specification_parameters() {
  return {entry("specification.error", in_specification<&Specification::error>,
                "error of the load that is permitted in the end", unit<angle>, positive),
          entry("specification.step", in_specification<&Specification::step>,
                "step of the reference whose response is measured", unit<angle>),
          entry("specification.band", in_specification<&Specification::band>,
                "distance within which a motion has settled", unit<angle>, positive)};
}

}  // namespace

std::vector<Parameter> signal_parameters() {
  return joined({&reference_kinds, &shared_parameters<&Drive::reference>, &motion_parameters,
                 &load_torque_kinds, &shared_parameters<&Drive::load_torque>,
                 &specification_parameters});
}

}  // namespace gearlash::parameter_rows
