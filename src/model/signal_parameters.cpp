#include "model/parameter_list.hpp"

namespace gearlash {
namespace {

using namespace dimensions;

/// A reference or a load torque, whose lists differ in names and dimensions only.
struct ReferenceSignal {
  static std::optional<Signal>& of(Drive& drive) { return drive.reference; }
  static const std::optional<Signal>& of(const Drive& drive) { return drive.reference; }
  static constexpr const Dimension* value = &angle;
  static constexpr std::size_t kinds = 6;
};
struct LoadTorqueSignal {
  static std::optional<Signal>& of(Drive& drive) { return drive.load_torque; }
  static const std::optional<Signal>& of(const Drive& drive) { return drive.load_torque; }
  static constexpr const Dimension* value = &torque;
  static constexpr std::size_t kinds = 4;
};

// Indices into Signal's alternatives, in the order of the words. Load torques permit some of them.
constexpr std::size_t reference_order[] = {0, 1, 2, 3, 4, 5};
constexpr std::size_t load_torque_order[] = {0, 1, 3, 5};

Signal signal_of_kind(std::size_t kind) {
  switch (kind) {
    case 1:
      return StepSignal{};
    case 2:
      return RampSignal{};
    case 3:
      return SineSignal{};
    case 4:
      return TrapezoidSignal{};
    case 5:
      return TableSignal{};
    default:
      return 0.0;
  }
}

template <class Which>
const std::size_t* order_of() {
  return Which::kinds == 6 ? reference_order : load_torque_order;
}

template <class Which>
Slot kind_slot(Drive& drive) {
  if (!Which::of(drive)) return {};
  return Choice{[](const Drive& d) {
                  std::size_t word = 0;
                  while (word < Which::kinds && order_of<Which>()[word] != Which::of(d)->index()) {
                    ++word;
                  }
                  return word;
                },
                [](Drive& d, std::size_t choice) {
                  Which::of(d) = signal_of_kind(order_of<Which>()[choice]);
                }};
}

template <class Which, class Kind, class Member>
Slot member_slot(Drive& drive, Member Kind::*member) {
  return Which::of(drive) ? slot_of(*Which::of(drive), member) : Slot{};
}

/// The first of two members that the signal has.
template <class Which, class Kind, class Member, class... Others>
Slot member_slot(Drive& drive, Member Kind::*member, Others... others) {
  const Slot first = member_slot<Which>(drive, member);
  return std::holds_alternative<std::monostate>(first) ? member_slot<Which>(drive, others...)
                                                       : first;
}

/// Of a table that is not read from a file.
template <class Which>
Slot point_slot(Drive& drive, std::vector<double> TableSignal::*member) {
  if (!Which::of(drive)) return {};
  auto* table = std::get_if<TableSignal>(&*Which::of(drive));
  return table == nullptr || !table->file.empty() ? Slot{} : Slot{&(table->*member)};
}

template <class Which>
Slot constant_slot(Drive& drive) {
  if (!Which::of(drive)) return {};
  auto* constant = std::get_if<double>(&*Which::of(drive));
  return constant == nullptr ? Slot{} : Slot{constant};
}

template <class Which>
const Dimension* value_dimension(const Drive&) {
  return Which::value;
}

struct Paths {
  std::string_view kind, value, before, after, mean, amplitude, frequency, phase, time, file, times,
      values;
};

/// Parameters of both kinds of signals.
template <class Which>
std::vector<Parameter> shared_parameters(const Paths& paths,
                                         const std::vector<std::string_view>& kinds) {
  return {{.path = paths.kind,
           .slot = &kind_slot<Which>,
           .meaning = "shape over time",
           .is_required = true,
           .choices = kinds},
          {.path = paths.value,
           .slot = &constant_slot<Which>,
           .dimension = &value_dimension<Which>,
           .meaning = "constant value",
           .is_required = true},
          {.path = paths.before,
           .slot = [](Drive& d) { return member_slot<Which>(d, &StepSignal::before); },
           .dimension = &value_dimension<Which>,
           .meaning = "value before the step"},
          {.path = paths.after,
           .slot = [](Drive& d) { return member_slot<Which>(d, &StepSignal::after); },
           .dimension = &value_dimension<Which>,
           .meaning = "value after the step",
           .is_required = true},
          {.path = paths.mean,
           .slot = [](Drive& d) { return member_slot<Which>(d, &SineSignal::mean); },
           .dimension = &value_dimension<Which>,
           .meaning = "mean of the sine"},
          {.path = paths.amplitude,
           .slot = [](Drive& d) { return member_slot<Which>(d, &SineSignal::amplitude); },
           .dimension = &value_dimension<Which>,
           .meaning = "amplitude of the sine",
           .is_required = true},
          {.path = paths.frequency,
           .slot = [](Drive& d) { return member_slot<Which>(d, &SineSignal::frequency); },
           .dimension = &always<angular_frequency>,
           .meaning = "frequency of the sine",
           .permitted = Permitted::positive,
           .is_required = true},
          {.path = paths.phase,
           .slot = [](Drive& d) { return member_slot<Which>(d, &SineSignal::phase); },
           .dimension = &always<angle>,
           .meaning = "phase of the sine at time 0"},
          {.path = paths.time,
           .slot =
               [](Drive& d) {
                 return member_slot<Which>(d, &StepSignal::time, &RampSignal::time,
                                           &TrapezoidSignal::time);
               },
           .dimension = &always<time>,
           .meaning = "start time"}};
}

/// The points of a table: in a file of its own, or in the drive's.
template <class Which>
std::vector<Parameter> table_parameters(const Paths& paths) {
  return {{.path = paths.file,
           .slot = [](Drive& d) { return member_slot<Which>(d, &TableSignal::file); },
           .meaning = "CSV file of times and values, beside the drive's file",
           .is_required = true,
           .wanted = "the name of a CSV file"},
          {.path = paths.times,
           .slot = [](Drive& d) { return point_slot<Which>(d, &TableSignal::times); },
           .meaning = "times of the points in s, rising, instead of a file",
           .is_required = true,
           .wanted = "times in s, rising"},
          {.path = paths.values,
           .slot = [](Drive& d) { return point_slot<Which>(d, &TableSignal::values); },
           .meaning = "values at these times, rad or N m",
           .is_required = true,
           .wanted = "a value for each of the times"}};
}

std::vector<Parameter> motion_parameters() {
  using Which = ReferenceSignal;
  return {{.path = "reference.value",
           .slot = [](Drive& d) { return member_slot<Which>(d, &RampSignal::value); },
           .dimension = &always<angle>,
           .meaning = "value before the ramp"},
          {.path = "reference.rate",
           .slot = [](Drive& d) { return member_slot<Which>(d, &RampSignal::rate); },
           .dimension = &always<angular_speed>,
           .meaning = "speed of the ramp",
           .is_required = true},
          {.path = "reference.from",
           .slot = [](Drive& d) { return member_slot<Which>(d, &TrapezoidSignal::from); },
           .dimension = &always<angle>,
           .meaning = "start of the move"},
          {.path = "reference.to",
           .slot = [](Drive& d) { return member_slot<Which>(d, &TrapezoidSignal::to); },
           .dimension = &always<angle>,
           .meaning = "end of the move",
           .is_required = true},
          {.path = "reference.speed",
           .slot = [](Drive& d) { return member_slot<Which>(d, &TrapezoidSignal::speed); },
           .dimension = &always<angular_speed>,
           .meaning = "highest speed of the move",
           .permitted = Permitted::positive,
           .is_required = true},
          {.path = "reference.acceleration",
           .slot = [](Drive& d) { return member_slot<Which>(d, &TrapezoidSignal::acceleration); },
           .dimension = &always<angular_acceleration>,
           .meaning = "highest acceleration of the move",
           .permitted = Permitted::positive,
           .is_required = true}};
}

}  // namespace

std::vector<Parameter> signal_parameters() {
  constexpr Paths reference = {"reference.kind",      "reference.value", "reference.before",
                               "reference.after",     "reference.mean",  "reference.amplitude",
                               "reference.frequency", "reference.phase", "reference.time",
                               "reference.file",      "reference.times", "reference.values"};
  constexpr Paths load_torque = {
      "load_torque.kind", "load_torque.value",     "load_torque.before",    "load_torque.after",
      "load_torque.mean", "load_torque.amplitude", "load_torque.frequency", "load_torque.phase",
      "load_torque.time", "load_torque.file",      "load_torque.times",     "load_torque.values"};
  std::vector<Parameter> list;
  const auto add = [&](std::vector<Parameter> parameters) {
    for (Parameter& parameter : parameters) list.push_back(std::move(parameter));
  };
  add(shared_parameters<ReferenceSignal>(
      reference, {"constant", "step", "ramp", "sine", "trapezoid", "table"}));
  add(table_parameters<ReferenceSignal>(reference));
  add(motion_parameters());
  add(shared_parameters<LoadTorqueSignal>(load_torque, {"constant", "step", "sine", "table"}));
  add(table_parameters<LoadTorqueSignal>(load_torque));
  return list;
}

}  // namespace gearlash
