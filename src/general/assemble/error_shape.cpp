// Dead bands, relays and other pieces between the error and the controller.
#include <utility>

#include "general/assemble/automata.hpp"

namespace gearlash::drive {

Branch first_branch(const ErrorShape& shape, double input) {
  if (!shape.is_two_level()) return Branch::inner;
  return input >= 0.0 ? Branch::forward : Branch::backward;
}

void add_error_shape(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built) {
  const ErrorShape& shape = forms.drive().error_shape;
  if (!shape.is_present()) return;
  const hybrid::AffineForm input = forms.shape_input(mode);
  const double way = sign_of(mode.error);
  if (shape.is_two_level() && way != 0.0) {
    const DriveMode other = with(mode, &DriveMode::error, branch_of(-way));
    built.transitions.push_back(transition("relay switches", input - way * shape.ends,
                                           falling_on(way), forms.modes().index_of(other)));
    return;
  }
  add_branches(
      forms, mode, &DriveMode::error, {input, shape.begins}, {input, shape.ends},
      {"error leaves its band forward", "error leaves its band backward", "error enters its band"},
      built);
}

void add_error_reading(const DriveForms& forms, std::size_t clock, const DriveMode& mode,
                       hybrid::AffineMode& built) {
  const ErrorShape& shape = forms.drive().error_shape;
  const Sensing& sensing = forms.drive().sensing;
  const StateIndices& at = forms.at();
  const hybrid::Vector read = forms.unit(at.error);
  hybrid::TimedTransition reading;
  reading.name = "reading";
  reading.clock = clock;
  reading.reset = {forms.identity(), hybrid::Vector::Zero(at.size), {}};
  reading.reset.matrix(at.error, at.error) = 0.0;
  if (!shape.is_of_speed) {
    add_reading(reading.reset, forms.command(mode), 0.0, read);
    add_reading(reading.reset, forms.sensed_position(), sensing.resolution, -read);
  } else if (at.last_reading == StateIndices::none) {
    add_reading(reading.reset, forms.sensed_speed(), 0.0, -read);
  } else {
    const double period = forms.drive().sampling->period;
    add_reading(reading.reset, forms.counted_position(), sensing.resolution_of_speed,
                -1.0 / period * read);
    add_reading(reading.reset, forms.number(at.last_reading), 0.0, 1.0 / period * read);
  }
  const auto on = [&](Branch branch) {
    return forms.modes().index_of(with(mode, &DriveMode::error, branch));
  };
  for (const Branch branch : {Branch::forward, Branch::backward}) {
    if (!shape.is_present()) break;
    const double threshold = mode.error == branch ? shape.ends : shape.begins;
    reading.alternatives.push_back(
        {{sign_of(branch) * forms.number(at.error) - threshold}, on(branch)});
  }
  // Between its thresholds a relay with two levels stays as it is.
  const bool stays = shape.is_two_level() && mode.error != Branch::inner;
  reading.target = on(stays ? mode.error : Branch::inner);
  built.timed.push_back(std::move(reading));
}

}  // namespace gearlash::drive
