#include "gearlash/drive/drive.hpp"

#include <cmath>
#include <string>

#include "gearlash/servo/overloaded.hpp"
#include "gearlash/servo/range_check.hpp"

namespace gearlash {
namespace {

void check(RangeCheck& all, const std::string& name, const Shaft& shaft) {
  all.positive(name + ".inertia", shaft.inertia, "kg m2");
  all.not_negative(name + ".viscous", shaft.friction.viscous, "N m s/rad");
  all.not_negative(name + ".coulomb", shaft.friction.coulomb, "N m");
  if (!(shaft.friction.breakaway >= shaft.friction.coulomb) ||
      std::isinf(shaft.friction.breakaway)) {
    all.refuse(name + ".breakaway", exact_text(shaft.friction.breakaway),
               "must be finite and at least " + name + ".coulomb, " +
                   exact_text(shaft.friction.coulomb) + " N m");
  }
}

}  // namespace

std::vector<Violation> validate(const Drive& drive) {
  RangeCheck all;
  check(all, "motor", drive.motor);
  check(all, "load", drive.load);
  all.positive("backlash", drive.backlash, "rad");
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
  all.include(validate(drive.controller));
  if (!(drive.torque_limit > 0.0)) {
    all.refuse("torque_limit", exact_text(drive.torque_limit), "must be positive, N m");
  }
  if (!std::isfinite(drive.reference)) {
    all.refuse("reference", exact_text(drive.reference), "must be finite, rad");
  }
  if (!std::isfinite(drive.load_torque)) {
    all.refuse("load_torque", exact_text(drive.load_torque), "must be finite, N m");
  }
  return all.violations();
}

}  // namespace gearlash
