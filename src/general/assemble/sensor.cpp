// Encoders.
#include "general/assemble/automata.hpp"

namespace gearlash::drive {

using hybrid::AffineForm;
using hybrid::Vector;

void add_reading(hybrid::AffineReset& reset, const AffineForm& measured, double step,
                 const Vector& gain) {
  if (step > 0.0) {
    reset.quantizers.push_back({measured, step, gain});
  } else {
    reset.matrix += gain * measured.normal.transpose();
    reset.offset += gain * measured.offset;
  }
}

void add_counting(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built) {
  const Eigen::Index encoder = forms.at().encoder;
  if (encoder == StateIndices::none) return;
  const double step = forms.drive().sensing.resolution;
  for (const double way : {1.0, -1.0}) {
    hybrid::Transition counts =
        transition(way > 0.0 ? "encoder counts up" : "encoder counts down",
                   forms.sensed_position() - forms.number(encoder) - 0.5 * way * step,
                   rising_on(way), forms.modes().index_of(mode));
    counts.reset.offset = way * step * forms.unit(encoder);
    built.transitions.push_back(std::move(counts));
  }
}

hybrid::AffineReset first_readings(const DriveForms& forms) {
  hybrid::AffineReset reset{forms.identity(), Vector::Zero(forms.at().size), {}};
  const Sensing& sensing = forms.drive().sensing;
  const Eigen::Index encoder = forms.at().encoder;
  if (encoder != StateIndices::none) {
    add_reading(reset, forms.sensed_position(), sensing.resolution, forms.unit(encoder));
  }
  const Eigen::Index last_reading = forms.at().last_reading;
  if (last_reading != StateIndices::none) {
    const AffineForm earlier =
        forms.counted_position() - forms.drive().sampling->period * forms.sensed_speed();
    add_reading(reset, earlier, sensing.resolution_of_speed, forms.unit(last_reading));
  }
  return reset;
}

}  // namespace gearlash::drive
