// A sampled controller.
#include <cmath>
#include <utility>
#include <vector>

#include "base/lists.hpp"
#include "general/assemble/automata.hpp"

namespace gearlash::drive {
namespace {

using hybrid::AffineForm;
using hybrid::AffineReset;
using hybrid::Vector;

/// A torque that a tick sets, and the branch of its limit.
struct SetTorque {
  Eigen::Index at;
  Branch DriveMode::*branch;
};

/// A tick of the controller's clocks. The torques that it sets reach or leave the torque limit.
hybrid::TimedTransition tick(const DriveForms& forms, const char* name, std::size_t clock,
                             AffineReset reset, const DriveMode& mode,
                             const std::vector<SetTorque>& torques) {
  struct Way {
    DriveMode mode;
    std::vector<AffineForm> conditions;
  };
  std::vector<Way> ways = {{mode, {}}};
  for (const SetTorque& torque : torques) {
    std::vector<Way> next;
    for (const double sign : {1.0, -1.0, 0.0}) {
      for (Way way : ways) {
        way.mode.*torque.branch = branch_of(sign);
        if (sign != 0.0) {
          way.conditions.push_back(sign * forms.number(torque.at) - forms.drive().torque_limit);
        }
        next.push_back(std::move(way));
      }
    }
    ways = std::move(next);
  }
  // The last way, with all torques within their limits, has no conditions: it is the target.
  sort_by(ways, [](const Way& way) { return -std::ssize(way.conditions); });
  hybrid::TimedTransition result;
  result.name = name;
  result.clock = clock;
  result.reset = std::move(reset);
  result.target = forms.modes().index_of(ways.back().mode);
  ways.pop_back();
  for (Way& way : ways) {
    result.alternatives.push_back({std::move(way.conditions), forms.modes().index_of(way.mode)});
  }
  return result;
}

/// The last torque worked out less its excess over the limit, and less itself.
AffineForm excess_withheld(const DriveForms& forms, const DriveMode& mode) {
  const bool remembers = remembers_worked_out(forms.drive());
  const Branch branch = remembers ? mode.worked_out : mode.torque;
  if (branch == Branch::inner) return forms.constant(0.0);
  const StateIndices& at = forms.at();
  return forms.constant(sign_of(branch) * forms.drive().torque_limit) -
         forms.number(remembers ? at.last_worked_out : at.held);
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
    AffineForm next = forms.controller_form(controller.state_matrix[i]);
    if (!controller.anti_windup.empty()) {
      next = next + controller.anti_windup[i] * excess_withheld(forms, mode);
    }
    set(controller_states + static_cast<Eigen::Index>(i), next);
  }
  set(result, forms.controller_form(controller.output) + forms.feedforward_torque(mode));
  if (at.last_reading != StateIndices::none) set(at.last_reading, forms.constant(0.0));
  const Sampling& sampling = *forms.drive().sampling;
  if (sampling.delay > 0.0) {
    for (Eigen::Index i = at.worked_out; i < at.last_worked_out; ++i) set(i, forms.number(i + 1));
    if (!gives_out_between_samples(sampling)) set(at.held, forms.number(at.worked_out));
  }
  return reset;
}

/// Adds the contributions of the inputs r, y and v.
void add_inputs(const DriveForms& forms, const DriveMode& mode, Eigen::Index result,
                AffineReset& reset) {
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
  if (keeps_error(forms.drive())) {
    add_reading(reset, forms.shaped_error(mode), 0.0, gain_of(0));
  } else {
    add_reading(reset, forms.command(mode), 0.0, gain_of(0));
    add_reading(reset, forms.sensed_position(), sensing.resolution, gain_of(1));
  }
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
  add_inputs(forms, mode, result, reset);
  const bool gives_out = !gives_out_between_samples(sampling);
  const bool is_limited = std::isfinite(forms.drive().torque_limit);
  const SetTorque held{at.held, &DriveMode::torque};
  std::vector<SetTorque> torques;
  if (gives_out && is_limited) torques.push_back(held);
  if (remembers_worked_out(forms.drive())) {
    torques.push_back({at.last_worked_out, &DriveMode::worked_out});
  }
  if (keeps_error(forms.drive())) {
    add_error_reading(forms, clocks.sample - 1, mode, built);
  }
  built.timed.push_back(tick(forms, "sample", clocks.sample, std::move(reset), mode, torques));
  if (gives_out) return;
  AffineReset output{forms.identity(), Vector::Zero(at.size), {}};
  output.matrix.row(at.held) = forms.unit(at.worked_out).transpose();
  built.timed.push_back(tick(forms, "output", clocks.sample + 1, std::move(output), mode,
                             is_limited ? std::vector{held} : std::vector<SetTorque>{}));
}

}  // namespace gearlash::drive
