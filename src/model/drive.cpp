#include "model/drive.hpp"

#include <cmath>
#include <string>

#include "base/overloaded.hpp"
#include "base/range_check.hpp"

namespace gearlash::drive {
namespace {

void check(RangeCheck& all, const std::string& name, const Shaft& shaft) {
  all.positive(name + ".inertia", shaft.inertia, "kg m2");
  all.not_negative(name + ".viscous", shaft.friction.viscous, "N m s/rad");
  all.not_negative(name + ".coulomb", shaft.friction.coulomb, "N m");
  all.not_negative(name + ".stribeck_speed", shaft.friction.stribeck_speed, "rad/s");
  if (!(shaft.friction.breakaway >= shaft.friction.coulomb) ||
      std::isinf(shaft.friction.breakaway)) {
    all.refuse(name + ".breakaway", exact_text(shaft.friction.breakaway),
               "must be finite and at least " + name + ".coulomb, " +
                   exact_text(shaft.friction.coulomb) + " N m");
  }
}

void check_error_shape(RangeCheck& all, const ReducedDrive& drive) {
  const ErrorShape& shape = drive.error_shape;
  if (!shape.is_present()) return;
  all.finite("error_shape.begins", shape.begins);
  all.finite("error_shape.ends", shape.ends);
  if (shape.begins < std::abs(shape.ends)) {
    all.refuse("error_shape.begins", exact_text(shape.begins),
               "must be at least |error_shape.ends|");
  }
  // On the threshold the torque would push the error back and forth.
  if (shape.jumps && !drive.sampling && !(shape.begins > shape.ends)) {
    all.refuse("error_shape.hysteresis", "0",
               "must be positive, or the controller sampled: a continuous one may switch without "
               "end at its threshold");
  }
}

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
  check(all, "motor", drive.motor);
  check(all, "load", drive.load);
  if (drive.backlash == 0.0 && !is_joined(drive)) {
    all.refuse("backlash", "0 rad",
               "must be positive and finite; without a gap the faces need a contact.stiffness");
  } else {
    all.not_negative("backlash", drive.backlash, "rad");
  }
  std::visit(Overloaded{[&](const RigidContact& rigid) {
                          all.within("contact.restitution", rigid.restitution, 0.0, 1.0);
                        },
                        [&](const CompliantContact& compliant) {
                          all.positive("contact.stiffness", compliant.stiffness, "N m/rad");
                          all.not_negative("contact.damping", compliant.damping, "N m s/rad");
                        }},
             drive.contact);
  all.within("sensing.load_share_of_position", drive.sensing.load_share_of_position, 0.0, 1.0);
  all.within("sensing.load_share_of_speed", drive.sensing.load_share_of_speed, 0.0, 1.0);
  all.include(faults(drive.controller));
  if (!(drive.torque_limit > 0.0)) {
    all.refuse("torque_limit", exact_text(drive.torque_limit), "must be positive, N m");
  }
  all.not_negative("winding.time_constant", drive.winding.time_constant, "s");
  all.not_negative("winding.back_emf", drive.winding.back_emf, "N m s/rad");
  if (!(drive.winding.torque_limit > 0.0)) {
    all.refuse("winding.torque_limit", exact_text(drive.winding.torque_limit),
               "must be positive, N m");
  }
  check_error_shape(all, drive);
  all.finite("feedforward.torque", drive.feedforward.torque);
  all.not_negative("feedforward.speed", drive.feedforward.speed, "rad/s");
  all.finite("feedforward.half_gap", drive.feedforward.half_gap);
  all.not_negative("feedforward.take_up_time", drive.feedforward.take_up_time, "s");
  all.not_negative("sensing.resolution", drive.sensing.resolution, "rad");
  if (drive.sensing.resolution_of_speed != drive.sensing.resolution) {  // else it is one encoder
    all.not_negative("sensing.resolution_of_speed", drive.sensing.resolution_of_speed, "rad");
  }
  all.include(faults(drive.reference, "reference"));
  all.include(faults(drive.load_torque, "load_torque"));
  all.finite("gravity.torque", drive.gravity.torque);
  all.finite("gravity.stiffness", drive.gravity.stiffness);
  check_sampling(all, drive);
  return all.faults();
}

}  // namespace gearlash::drive
