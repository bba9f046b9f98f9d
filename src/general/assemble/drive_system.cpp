#include "general/assemble/drive_system.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "base/range_check.hpp"
#include "general/assemble/automata.hpp"

namespace gearlash::drive {
namespace {

using hybrid::Vector;

/// One mode, with the transitions of each automaton. Their order is part of the physics: of several
/// at one instant the first is taken.
hybrid::AffineMode built_mode(const DriveForms& forms, const DriveClocks& clocks,
                              const DriveMode& mode) {
  hybrid::AffineMode built;
  built.name = text_of(mode);
  built.flow = forms.flow(mode);
  if (forms.drive().sampling) {
    add_sampling(forms, clocks, mode, built);
  } else {
    add_error_shape(forms, mode, built);
    add_torque_limit(forms, mode, built);
    add_counting(forms, mode, built);
  }
  add_current_limit(forms, mode, built);
  add_feedforward(forms, mode, built);
  if (forms.is_engaged(mode)) {
    add_engaged(forms, mode, built);
  } else {
    add_friction(forms, mode, Side::motor, built);
    add_friction(forms, mode, Side::load, built);
    if (forms.is_rigid()) {
      add_impacts(forms, mode, built);
    } else {
      add_compliance(forms, mode, built);
    }
  }
  add_settings(forms, clocks, mode, built);
  return built;
}

// ---- numbers that follow their own flow alone ---------------------------------------------------

/// Whether only exogenous numbers and the state itself act on a controller's state (no feedback),
/// as in a filter of the reference.
bool is_exogenous_state(const DriveForms& forms, const std::vector<bool>& exogenous,
                        std::size_t state) {
  const LinearController& controller = forms.controller();
  const std::vector<double>& inputs = controller.input_matrix[state];
  const std::vector<double>& states = controller.state_matrix[state];
  const bool is_withdrawn = !controller.anti_windup.empty() &&
                            std::isfinite(forms.drive().torque_limit) &&
                            controller.anti_windup[state] != 0.0;
  const bool is_compensated = inputs[0] != 0.0 && forms.drive().feedforward.half_gap != 0.0;
  if (is_withdrawn || is_compensated || inputs[1] != 0.0 || inputs[2] != 0.0) return false;
  if (forms.drive().sampling) {  // the sampling ticks must not change it
    for (std::size_t j = 0; j < states.size(); ++j) {
      if (states[j] != (j == state ? 1.0 : 0.0)) return false;
    }
    return inputs[0] == 0.0;
  }
  if (inputs[0] != 0.0 && !forms.reference_generator().times.empty()) return false;
  for (std::size_t j = 0; j < states.size(); ++j) {
    if (states[j] != 0.0 && !exogenous[controller_states + j]) return false;
  }
  return true;
}

/// Signals that no clock sets, controller states that follow these alone, and an encoder's count.
std::vector<bool> exogenous_numbers(const DriveForms& forms) {
  const StateIndices& at = forms.at();
  std::vector<bool> exogenous(static_cast<std::size_t>(at.size), false);
  const auto mark = [&](Eigen::Index first, Eigen::Index count, bool is) {
    for (Eigen::Index i = first; i < first + count; ++i) {
      exogenous[static_cast<std::size_t>(i)] = is;
    }
  };
  mark(at.reference, at.reference_size, forms.reference_generator().times.empty());
  mark(at.load_torque, at.load_torque_size, forms.load_generator().times.empty());
  mark(controller_states, at.controller_order, true);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < forms.controller().order(); ++i) {
      if (!exogenous[controller_states + i] || is_exogenous_state(forms, exogenous, i)) continue;
      exogenous[controller_states + i] = false;
      changed = true;
    }
  }
  if (at.encoder != StateIndices::none) mark(at.encoder, 1, true);
  return exogenous;
}

Vector start_of(const DriveForms& forms) {
  const StateIndices& at = forms.at();
  Vector numbers = Vector::Zero(at.size);
  numbers.segment(at.reference, at.reference_size) = forms.reference_generator().start;
  numbers.segment(at.load_torque, at.load_torque_size) = forms.load_generator().start;
  return numbers;
}

}  // namespace

ShaftStates shafts_of(const hybrid::State& state) {
  const Vector& numbers = state.numbers;
  return {numbers[motor_position], numbers[motor_speed], numbers[load_position],
          numbers[load_speed]};
}

DriveSystem drive_system(const ReducedDrive& drive) {
  require_none(faults(drive));
  const auto forms = std::make_shared<const DriveForms>(drive);
  DriveSystem result;
  result.at = forms->at();
  result.modes = forms->modes();
  DriveClocks clocks = drive_clocks(*forms);
  result.system.state_names = state_names(result.at);
  result.system.clocks = clocks.clocks;
  result.system.exogenous = exogenous_numbers(*forms);
  result.system.source = hybrid::ModeSource(
      result.modes.count(), [forms, clocks = std::move(clocks)](std::size_t index) {
        return built_mode(*forms, clocks, forms->modes().mode(index));
      });
  result.start = start_of(*forms);
  result.first_feedforward = first_feedforward(*forms, result.start);
  result.first_readings = first_readings(*forms);
  result.reference = forms->reference();
  result.load_torque = forms->load_torque();
  result.shape_input = forms->first_shape_input();
  for (std::size_t i = 0; i < result.modes.others(); ++i) {
    result.motor_torques.push_back(forms->motor_torque(result.modes.mode(i)));
  }
  result.mesh_torque = [forms](std::size_t index) -> std::optional<hybrid::AffineForm> {
    const DriveMode mode = forms->modes().mode(index);
    const bool is_undetermined = forms->is_engaged(mode) && forms->stands(mode, Side::load);
    if (mode.contact == ContactState::apart || is_undetermined) return std::nullopt;
    return forms->mesh_torque(mode);
  };
  return result;
}

hybrid::State drive_start(const ReducedDrive& drive, const DriveSystem& system,
                          const ShaftStates& shafts) {
  const bool rigid = std::holds_alternative<RigidContact>(drive.contact);
  const double gap = shafts.motor_position - shafts.load_position;
  const double half = 0.5 * drive.backlash;
  constexpr double rounding = 8.0 * std::numeric_limits<double>::epsilon();
  const double unknown =
      rounding * (std::abs(shafts.motor_position) + std::abs(shafts.load_position));
  RangeCheck check;
  if (rigid && std::abs(gap) > half + unknown) {
    check.refuse("motor_position - load_position", exact_text(gap),
                 "must be within half the backlash, " + exact_text(half) + " rad");
  }
  require_none(check.faults());
  DriveMode mode = system.first_feedforward;
  const bool is_closed = std::abs(gap) >= half - (rigid ? unknown : 0.0);
  if (is_closed && (!rigid || shafts.motor_speed == shafts.load_speed)) {
    mode.contact = gap > 0.0 ? ContactState::forward : ContactState::backward;
  }
  if (is_joined(drive)) mode.contact = ContactState::joined;
  mode.motor = friction_at(drive.motor, shafts.motor_speed);
  mode.load = friction_at(drive.load, shafts.load_speed);
  Vector numbers = system.start;
  numbers[motor_position] = shafts.motor_position;
  numbers[motor_speed] = shafts.motor_speed;
  numbers[load_position] = shafts.load_position;
  numbers[load_speed] = shafts.load_speed;
  if (drive.error_shape.is_present()) {
    mode.error = first_branch(drive.error_shape, system.shape_input.at(numbers));
  }
  return {system.modes.index_of(mode), system.first_readings.after(numbers)};
}

}  // namespace gearlash::drive
