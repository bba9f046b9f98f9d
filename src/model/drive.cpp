#include "model/drive.hpp"

#include <string>

#include "base/range_check.hpp"

namespace gearlash::drive {
namespace {

/// Roots on the unit circle are integrators; rounding may put them a little beyond.
constexpr double largest_radius = 1.0 + 1e-9;

std::string pole_text(double radius) {
  return "a pole of modulus " + exact_text(radius) + " from sample to sample";
}

void check_sampling(RangeCheck& all, const ReducedDrive& drive) {
  const bool is_sound = faults(drive.controller).empty();
  const bool is_of_samples = drive.controller.is_of_samples;
  if (is_of_samples && is_sound) {
    const double radius = spectral_radius(drive.controller);
    if (radius > largest_radius) {
      all.refuse("controller.denominator", pole_text(radius),
                 "must have its roots in the unit circle: the controller's state grows without "
                 "bound");
    }
  }
  if (!drive.sampling) {
    if (is_of_samples) {
      all.refuse("sampling", "missing", "must be given: the controller is a function of z");
    }
    return;
  }
  const Sampling& sampling = *drive.sampling;
  RangeCheck check("sampling.");
  check.positive("period", sampling.period, "s");
  if (!check.faults().empty()) return void(all.include(check.faults()));
  const double longest = most_periods_of_delay * sampling.period;
  constexpr double rounding = 1e-12;  // as split_delay() has it
  if (!(sampling.delay >= 0.0 && sampling.delay <= longest * (1.0 + rounding))) {
    check.refuse("delay", exact_text(sampling.delay),
                 "must be from 0 to " + std::to_string(most_periods_of_delay) + " periods, " +
                     exact_text(longest) + " s");
  }
  all.include(check.faults());
  if (is_of_samples || !is_sound || !check.faults().empty()) return;
  const double radius = spectral_radius(sampled_controller(drive.controller, sampling));
  if (radius <= largest_radius) return;
  const std::string pole = pole_text(radius);
  all.refuse(
      "sampling.period", pole,
      "must be shorter, or the method another one: the controller's state grows without bound (" +
          pole + ")");
}

}  // namespace

bool is_driven(const ReducedDrive& drive) {
  return std::holds_alternative<Sine>(settled(drive.reference)) ||
         std::holds_alternative<Sine>(settled(drive.load_torque));
}

std::vector<Fault> faults(const ReducedDrive& drive) {
  RangeCheck all;
  all.positive("motor.inertia", drive.motor.inertia, "kg m2");
  all.positive("load.inertia", drive.load.inertia, "kg m2");
  if (!is_joined(drive) && !(drive.backlash > 0.0)) {
    all.refuse("backlash", exact_text(drive.backlash) + " rad",
               "must be positive and finite; without a gap the faces need a contact.stiffness");
  }
  all.include(faults(drive.controller));
  // On the threshold the torque would push the error back and forth.
  const ErrorShape& shape = drive.error_shape;
  if (shape.is_present() && shape.jumps && !drive.sampling && !(shape.begins > shape.ends)) {
    all.refuse("error_shape.hysteresis", "0",
               "must be positive, or the controller sampled: a continuous one may switch without "
               "end at its threshold");
  }
  all.include(faults(drive.reference, "reference"));
  all.include(faults(drive.load_torque, "load_torque"));
  check_sampling(all, drive);
  return all.faults();
}

}  // namespace gearlash::drive
