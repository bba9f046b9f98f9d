#include "general/assemble/drive_mode.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/names.hpp"

namespace gearlash::drive {
namespace {

const char* text_of(ContactState contact) {
  constexpr Names<ContactState::joined> names(
      "apart", "forward", "backward", "forward, damping limited", "backward, damping limited",
      "forward, letting go", "backward, letting go", "joined");
  return names[contact];
}

const char* text_of(FrictionState friction) {
  constexpr Names<FrictionState::backward_slowly> names("", "moves forward", "moves backward",
                                                        "sticks", "moves slowly forward",
                                                        "moves slowly backward");
  return names[friction];
}

std::vector<ContactState> contacts_of(const ReducedDrive& drive) {
  using enum ContactState;
  if (is_joined(drive)) return {joined};
  const Contact& contact = drive.contact;
  std::vector<ContactState> all = {apart, forward, backward};
  const auto* compliant = std::get_if<CompliantContact>(&contact);
  if (compliant == nullptr || !(compliant->damping > 0.0)) return all;
  all.insert(all.end(), {forward_letting_go, backward_letting_go});
  if (compliant->law == ContactDamping::limited) {
    all.insert(all.end(), {forward_limited, backward_limited});
  }
  return all;
}

std::vector<FrictionState> frictions_of(const Shaft& shaft) {
  using enum FrictionState;
  if (!shaft.friction.is_dry()) return {viscous};
  if (!shaft.friction.falls()) return {forward, backward, sticking};
  return {forward, backward, sticking, forward_slowly, backward_slowly};
}

std::string text_of(const char* what, Branch branch, const char* forward = " forward",
                    const char* backward = " backward") {
  if (branch == Branch::inner) return {};
  return std::string("; ") + what + (branch == Branch::forward ? forward : backward);
}

constexpr std::size_t branches = 3;  // of an automaton that a drive has

/// The states of the automata other than contact and frictions, as indices.
std::array<std::size_t, 6> others_of(const DriveMode& mode) {
  return {
      static_cast<std::size_t>(mode.torque),          static_cast<std::size_t>(mode.current),
      static_cast<std::size_t>(mode.worked_out),      static_cast<std::size_t>(mode.error),
      static_cast<std::size_t>(mode.reference_speed), static_cast<std::size_t>(mode.reference_way)};
}

template <class State>
std::size_t place_in(const std::vector<State>& all, const State& state) {
  return static_cast<std::size_t>(std::find(all.begin(), all.end(), state) - all.begin());
}

}  // namespace

ContactState closed_contact(const ReducedDrive& drive) {
  return is_joined(drive) ? ContactState::joined : ContactState::forward;
}

double face_of(ContactState contact) {
  switch (contact) {
    case ContactState::forward:
    case ContactState::forward_limited:
    case ContactState::forward_letting_go:
      return 1.0;
    case ContactState::backward:
    case ContactState::backward_limited:
    case ContactState::backward_letting_go:
      return -1.0;
    case ContactState::apart:
    case ContactState::joined:
      break;
  }
  return 0.0;
}

double way_of(FrictionState friction) {
  switch (friction) {
    case FrictionState::forward:
    case FrictionState::forward_slowly:
      return 1.0;
    case FrictionState::backward:
    case FrictionState::backward_slowly:
      return -1.0;
    case FrictionState::viscous:
    case FrictionState::sticking:
      break;
  }
  return 0.0;
}

double sign_of(Branch branch) {
  if (branch == Branch::inner) return 0.0;
  return branch == Branch::forward ? 1.0 : -1.0;
}

Branch branch_of(double sign) {
  if (sign == 0.0) return Branch::inner;
  return sign > 0.0 ? Branch::forward : Branch::backward;
}

FrictionState moving(const Shaft& shaft, double way) {
  if (!shaft.friction.is_dry()) return FrictionState::viscous;
  if (way == 0.0) return FrictionState::sticking;
  if (shaft.friction.falls()) {
    return way > 0.0 ? FrictionState::forward_slowly : FrictionState::backward_slowly;
  }
  return moving_fast(way);
}

FrictionState moving_fast(double way) {
  return way > 0.0 ? FrictionState::forward : FrictionState::backward;
}

FrictionState friction_at(const Shaft& shaft, double speed) {
  const ShaftFriction& friction = shaft.friction;
  const bool is_fast = friction.falls() && std::abs(speed) > friction.stribeck_speed;
  return is_fast ? moving_fast(speed) : moving(shaft, speed);
}

bool remembers_worked_out(const ReducedDrive& drive) {
  if (!drive.sampling || !std::isfinite(drive.torque_limit)) return false;
  const SplitDelay delay = split_delay(*drive.sampling);
  const bool is_late = delay.whole_periods > 0 || delay.rest == drive.sampling->period;
  return is_late && !drive.controller.anti_windup.empty();
}

std::string text_of(const DriveMode& mode) {
  std::string text = text_of(mode.contact);
  if (mode.motor != FrictionState::viscous) text += std::string("; motor ") + text_of(mode.motor);
  if (mode.load != FrictionState::viscous) text += std::string("; load ") + text_of(mode.load);
  text += text_of("torque", mode.torque, " at its highest", " at its lowest");
  text += text_of("current", mode.current, " at its highest", " at its lowest");
  text += text_of("error", mode.error);
  return text + text_of("reference", mode.reference_speed);
}

DriveModes::DriveModes(const ReducedDrive& drive)
    : is_rigid_(std::holds_alternative<RigidContact>(drive.contact)),
      contacts_(contacts_of(drive)),
      has_{std::isfinite(drive.torque_limit), std::isfinite(drive.winding.torque_limit),
           remembers_worked_out(drive),       drive.error_shape.is_present(),
           drive.feedforward.torque != 0.0,   drive.feedforward.half_gap != 0.0} {
  for (const FrictionState motor : frictions_of(drive.motor)) {
    for (const FrictionState load : frictions_of(drive.load)) {
      const bool as_one = way_of(motor) == way_of(load) || motor == FrictionState::viscous ||
                          load == FrictionState::viscous;
      apart_.emplace_back(motor, load);
      if (as_one) together_.emplace_back(motor, load);
    }
  }
  for (const bool is_there : has_) others_ *= is_there ? branches : 1;
}

const std::vector<DriveModes::Frictions>& DriveModes::frictions_in(ContactState contact) const {
  return is_rigid_ && contact != ContactState::apart ? together_ : apart_;
}

std::size_t DriveModes::count() const {
  std::size_t count = 0;
  for (const ContactState contact : contacts_) {
    count += frictions_in(contact).size() * others_;
  }
  return count;
}

std::size_t DriveModes::index_of(const DriveMode& mode) const {
  std::size_t first = 0;  // index of the first mode with this contact
  for (const ContactState contact : contacts_) {
    const std::vector<Frictions>& frictions = frictions_in(contact);
    if (contact == mode.contact) {
      const std::size_t pair = place_in(frictions, {mode.motor, mode.load});
      if (pair == frictions.size()) break;
      std::size_t other = 0;
      const std::array<std::size_t, 6> states = others_of(mode);
      for (std::size_t i = 0; i < has_.size(); ++i) {
        if (!has_[i] && states[i] != 0) return count();
        if (has_[i]) other = branches * other + states[i];
      }
      return first + pair * others_ + other;
    }
    first += frictions.size() * others_;
  }
  return count();
}

DriveMode DriveModes::mode(std::size_t index) const {
  for (const ContactState contact : contacts_) {
    const std::vector<Frictions>& frictions = frictions_in(contact);
    const std::size_t here = frictions.size() * others_;
    if (index < here) {
      const auto& [motor, load] = frictions[index / others_];
      std::size_t other = index % others_;
      std::array<std::size_t, 6> states{};
      for (std::size_t i = has_.size(); i-- > 0;) {
        if (!has_[i]) continue;
        states[i] = other % branches;
        other /= branches;
      }
      return {.contact = contact,
              .motor = motor,
              .load = load,
              .torque = static_cast<Branch>(states[0]),
              .current = static_cast<Branch>(states[1]),
              .worked_out = static_cast<Branch>(states[2]),
              .error = static_cast<Branch>(states[3]),
              .reference_speed = static_cast<Branch>(states[4]),
              .reference_way = static_cast<Branch>(states[5])};
    }
    index -= here;
  }
  return {};
}

}  // namespace gearlash::drive
