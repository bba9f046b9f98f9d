// A sampled controller.
#include <cmath>
#include <utility>

#include "general/assemble/automata.hpp"

namespace gearlash::drive {
namespace {

using hybrid::AffineForm;
using hybrid::AffineReset;
using hybrid::Vector;

/// A tick of the controller's clocks. A tick that outputs torque reaches or leaves the torque
/// limit.
hybrid::TimedTransition tick(const DriveForms& forms, const char* name, std::size_t clock,
                             AffineReset reset, DriveMode mode, bool gives_out) {
  hybrid::TimedTransition result;
  result.name = name;
  result.clock = clock;
  result.reset = std::move(reset);
  const double limit = forms.drive().torque_limit;
  if (gives_out && std::isfinite(limit)) {
    for (const double way : {1.0, -1.0}) {
      DriveMode limited = mode;
      limited.torque = way > 0.0 ? TorqueState::highest : TorqueState::lowest;
      result.alternatives.push_back(
          {{way * forms.number(forms.at().held) - limit}, forms.modes().index_of(limited)});
    }
    mode.torque = TorqueState::linear;
  }
  result.target = forms.modes().index_of(mode);
  return result;
}

/// The controller's next states and torque from its states alone, and the queue of delayed torques
/// shifted by one. add_inputs() adds the rest.
AffineReset without_inputs(const DriveForms& forms, const DriveMode& mode, Eigen::Index result) {
  const StateIndices& at = forms.at();
  const LinearController& controller = forms.controller();
  AffineReset reset{forms.identity(), Vector::Zero(at.size), {}};
  const auto set = [&](Eigen::Index row, const AffineForm& form) {
    reset.matrix.row(row) = form.normal.transpose();
    reset.offset[row] = form.offset;
  };
  for (std::size_t i = 0; i < controller.order(); ++i) {
    AffineForm next = forms.of_controller(controller.state_matrix[i]);
    if (!controller.anti_windup.empty() && mode.torque != TorqueState::linear) {
      next = next + controller.anti_windup[i] *
                        (forms.limited_torque(mode.torque) - forms.number(at.held));
    }
    set(controller_states + static_cast<Eigen::Index>(i), next);
  }
  set(result, forms.of_controller(controller.output));
  if (at.last_reading != StateIndices::none) set(at.last_reading, forms.constant(0.0));
  const Sampling& sampling = *forms.drive().sampling;
  if (sampling.delay > 0.0) {
    for (Eigen::Index i = at.worked_out; i < at.last_worked_out; ++i) set(i, forms.number(i + 1));
    if (!gives_out_between_samples(sampling)) set(at.held, forms.number(at.worked_out));
  }
  return reset;
}

/// Adds the contributions of the inputs r, y and v.
void add_inputs(const DriveForms& forms, Eigen::Index result, AffineReset& reset) {
  const LinearController& controller = forms.controller();
  const Sensing& sensing = forms.drive().sensing;
  const Eigen::Index last_reading = forms.at().last_reading;
  const auto gain_of = [&](std::size_t input) {
    Vector gain = Vector::Zero(forms.at().size);
    for (std::size_t i = 0; i < controller.order(); ++i) {
      gain[controller_states + static_cast<Eigen::Index>(i)] = controller.input_matrix[i][input];
    }
    gain[result] = controller.direct[input];
    return gain;
  };
  add_reading(reset, forms.reference(), 0.0, gain_of(0));
  add_reading(reset, forms.sensed_position(), sensing.resolution, gain_of(1));
  const Vector speed_gain = gain_of(2);
  if (last_reading == StateIndices::none) {
    add_reading(reset, forms.sensed_speed(), 0.0, speed_gain);
    return;
  }
  const double period = forms.drive().sampling->period;
  const Vector kept = forms.unit(last_reading);
  add_reading(reset, forms.counted_position(), sensing.resolution_of_speed,
              1.0 / period * speed_gain + kept);
  add_reading(reset, forms.number(last_reading), 0.0, -1.0 / period * speed_gain);
}

}  // namespace

bool gives_out_between_samples(const Sampling& sampling) {
  return sampling.delay > 0.0 && split_delay(sampling).rest < sampling.period;
}

void add_sampling(const DriveForms& forms, const DriveClocks& clocks, const DriveMode& mode,
                  hybrid::AffineMode& built) {
  const Sampling& sampling = *forms.drive().sampling;
  const StateIndices& at = forms.at();
  const Eigen::Index result = sampling.delay > 0.0 ? at.last_worked_out : at.held;
  AffineReset reset = without_inputs(forms, mode, result);
  add_inputs(forms, result, reset);
  const bool gives_out = !gives_out_between_samples(sampling);
  built.timed.push_back(tick(forms, "sample", clocks.sample, std::move(reset), mode, gives_out));
  if (gives_out) return;
  AffineReset output{forms.identity(), Vector::Zero(at.size), {}};
  output.matrix.row(at.held) = forms.unit(at.worked_out).transpose();
  built.timed.push_back(tick(forms, "output", clocks.sample + 1, std::move(output), mode, true));
}

}  // namespace gearlash::drive
