// Compliant faces.
#include "general/assemble/automata.hpp"

namespace gearlash::drive {
namespace {

ContactState on_face(double face, ContactState forward, ContactState backward) {
  return face > 0.0 ? forward : backward;
}

ContactState full(double face) {
  return on_face(face, ContactState::forward, ContactState::backward);
}

ContactState limited_on(double face) {
  return on_face(face, ContactState::forward_limited, ContactState::backward_limited);
}

ContactState letting_go(double face) {
  return on_face(face, ContactState::forward_letting_go, ContactState::backward_letting_go);
}

}  // namespace

void add_compliance(const DriveForms& forms, const DriveMode& mode, hybrid::AffineMode& built) {
  if (mode.contact == ContactState::joined) return;
  const bool damped = forms.compliant().damping > 0.0;
  const bool limited = damped && forms.compliant().law == ContactDamping::limited;
  const auto add = [&](const char* name, const hybrid::AffineForm& guard,
                       hybrid::Direction direction, ContactState contact) {
    const DriveMode target = with(mode, &DriveMode::contact, contact);
    built.transitions.push_back(transition(name, guard, direction, forms.modes().index_of(target)));
  };
  const auto pressed = [&](double face) {
    return forms.gap() - 0.5 * face * forms.drive().backlash;
  };
  const double face = face_of(mode.contact);
  if (face == 0.0) {
    for (const double met : {1.0, -1.0}) {
      add(met > 0.0 ? "faces meet forward" : "faces meet backward", pressed(met), rising_on(met),
          limited ? limited_on(met) : full(met));
    }
    return;
  }
  const hybrid::AffineForm torque = forms.spring_torque(face) + forms.damping_torque();
  const hybrid::AffineForm damping_excess = forms.damping_torque() - forms.spring_torque(face);
  if (mode.contact == full(face)) {
    if (!damped) {
      add("faces part", pressed(face), falling_on(face), ContactState::apart);
      return;
    }
    add("faces let go", torque, falling_on(face), letting_go(face));
    if (limited) add("damping is limited", damping_excess, rising_on(face), limited_on(face));
  } else if (mode.contact == limited_on(face)) {
    add("damping is no more limited", damping_excess, falling_on(face), full(face));
    add("faces part", pressed(face), falling_on(face), ContactState::apart);
  } else {
    add("faces part", pressed(face), falling_on(face), ContactState::apart);
    add("faces press again", torque, rising_on(face), full(face));
  }
}

}  // namespace gearlash::drive
