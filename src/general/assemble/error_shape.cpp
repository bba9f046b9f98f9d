// Dead bands, relays and other pieces between the error and the controller.
#include <utility>

#include "general/assemble/automata.hpp"

namespace gearlash::drive {
namespace {

constexpr Branch outer_branches[] = {Branch::forward, Branch::backward};

DriveMode on(const DriveMode& mode, Branch branch) {
  DriveMode target = mode;
  target.error = branch;
  return target;
}

}  // namespace

Branch first_branch(const ErrorShape& shape, double input) {
  if (!shape.is_two_level()) return Branch::inner;
  return input >= 0.0 ? Branch::forward : Branch::backward;
}

void add_error_shape(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built) {
  const ErrorShape& shape = forms.drive().error_shape;
  if (!shape.is_present()) return;
  const hybrid::AffineForm input = forms.shape_input(mode);
  const auto add = [&](const char* name, const hybrid::AffineForm& guard,
                       hybrid::Direction direction, Branch branch) {
    built.transitions.push_back(
        transition(name, guard, direction, forms.modes().index_of(on(mode, branch))));
  };
  if (mode.error == Branch::inner) {
    add("error leaves its band forward", input - shape.begins, hybrid::Direction::rising,
        Branch::forward);
    add("error leaves its band backward", input + shape.begins, hybrid::Direction::falling,
        Branch::backward);
    return;
  }
  const double way = sign_of(mode.error);
  if (shape.is_two_level()) {
    add("relay switches", input - way * shape.ends, falling_on(way),
        way > 0.0 ? Branch::backward : Branch::forward);
    return;
  }
  add("error enters its band", input - way * shape.ends, falling_on(way), Branch::inner);
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
  for (const Branch branch : outer_branches) {
    const double threshold = mode.error == branch ? shape.ends : shape.begins;
    reading.alternatives.push_back({{sign_of(branch) * forms.number(at.error) - threshold},
                                    forms.modes().index_of(on(mode, branch))});
  }
  // Between its thresholds a relay with two levels stays as it is.
  const bool stays = shape.is_two_level() && mode.error != Branch::inner;
  reading.target = forms.modes().index_of(on(mode, stays ? mode.error : Branch::inner));
  built.timed.push_back(std::move(reading));
}

}  // namespace gearlash::drive
